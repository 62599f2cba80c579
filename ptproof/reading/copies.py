"""Work in copies of one process: what it does to its process costs itself only, and how it ended is known.

::

    this process ── host ──┬── keeper ── worker        a host has read what the work needs, once; it only makes copies
                           └── keeper ── worker        a keeper waits for its worker, and ends what that leaves behind

What the work has changed in the state of its worker (:mod:`ptproof.reading.state`) is set again; where that is not
possible the worker is replaced, and so is one that died or was killed for its time or memory. Keepers and workers have
process groups of their own, so that what kills its parent or its group does not reach the others.
"""

from __future__ import annotations

import multiprocessing
import os
import pickle
import sys
import threading
import warnings
from collections.abc import Callable, Iterator, Mapping
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, TypeVar

from ptproof.reading import nursery
from ptproof.reading.host import serve
from ptproof.reading.outcomes import Answered, Unanswered, Why, end_in_words, in_words

Key = TypeVar("Key")
LOADING = 600.0


def possible() -> bool:
    """Whether the system can copy a process."""
    return hasattr(os, "fork") and sys.platform != "darwin"


def _alone() -> bool:
    """Whether this process has one thread, the only kind of which a copy is known to work.

    z3 leaves threads that wait to ring for its next question. It ends them itself before a copy is made, of which an
    empty one is enough; what is left then is somebody else's.
    """
    if threading.active_count() > 1:
        return False
    if _threads() > 1:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)  # of Python 3.12, that there are threads
            pid = os.fork()
        if pid == 0:
            os._exit(0)
        os.waitpid(pid, 0)
    return _threads() == 1


def _threads() -> int:
    try:
        return len(list(Path("/proc/self/task").iterdir()))
    except OSError:
        return 2


class Copies:
    """Processes for work as :class:`ptproof.reading.limits.Workers` describes them, on systems that can copy a process.

    The host is a copy of this process if this has a single thread, and otherwise of its nursery.
    """

    def __init__(self, count: int, start: Callable[..., None] | None, arguments: tuple[Any, ...], memory: int) -> None:
        self._given = (count, start, arguments, memory)
        self._host: Any = None
        self._to_host: Connection | None = None
        self._ready = False

    def stop(self) -> None:
        """End the processes, and what still runs in them."""
        if self._to_host is not None:
            self._to_host.close()
            self._to_host = None
        if self._host is not None:
            self._host.join(1)
            if self._host.is_alive():
                self._host.kill()
                self._host.join()
            self._host = None

    def each(
        self, seconds: float, work: Callable[..., Any], tasks: Mapping[Key, tuple[Any, ...]]
    ) -> Iterator[tuple[Key, Answered[Any] | Unanswered]]:
        """The key of each task with what came of it, as they end; the work begins at once."""
        keys = dict(enumerate(tasks))
        payloads = [(n, pickle.dumps((work, tasks[key]))) for n, key in keys.items()]
        try:
            self._connected(work).send((seconds, payloads))
        except OSError as error:
            return self._outcomes(keys, error)
        return self._outcomes(keys)

    def _outcomes(
        self, keys: dict[int, Key], lost: OSError | None = None
    ) -> Iterator[tuple[Key, Answered[Any] | Unanswered]]:
        try:
            connection = self._to_host
            if lost is not None or connection is None:
                raise lost or EOFError
            while keys:
                if not connection.poll(None if self._ready else LOADING):
                    raise TimeoutError
                n, outcome = pickle.loads(connection.recv_bytes())
                self._ready = True
                if n is not None:
                    yield keys.pop(n), _read(outcome)
        except (EOFError, OSError) as error:
            late = isinstance(error, TimeoutError)
            outcome = self._lost("ran out of time while it read what the work needs" if late else "")
            for key in keys.values():
                yield key, outcome
        finally:
            if keys:
                self.stop()

    def _connected(self, work: Callable[..., Any]) -> Connection:
        if self._to_host is None:
            context: Any = multiprocessing.get_context("fork")
            ours, theirs = context.Pipe()
            if _alone():
                held = threading.current_thread() is threading.main_thread()
                self._host = context.Process(target=serve, args=(theirs, ours, held, *self._given), daemon=True)
                self._host.start()
            else:
                self._host = nursery.host(theirs, work, *self._given)
            theirs.close()
            self._to_host, self._ready = ours, False
        return self._to_host

    def _lost(self, reason: str) -> Unanswered:
        """The host is gone: how it ended is why there are no answers."""
        host = self._host
        if host is not None and not reason:
            host.join(1)
            reason = "died" if host.exitcode is None else end_in_words(host.exitcode)
        self.stop()
        doing = "that decides" if self._ready else "that reads what is to be decided"
        return Unanswered(Why.DIED, f"the process {doing} {reason}")


def _read(outcome: Any) -> Answered[Any] | Unanswered:
    """What a worker has sent, which anything may stand in."""
    if isinstance(outcome, Unanswered):
        return outcome
    try:
        kind, value, error = pickle.loads(outcome)
    except BaseException as unreadable:
        return Unanswered(Why.FAILED, f"the answer cannot be read: {in_words(unreadable)}")
    if kind == "answer":
        return Answered(value)
    return Unanswered(Why(kind), str(value), error)
