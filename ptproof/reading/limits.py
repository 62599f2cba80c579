"""Limits of time and memory: for work in this process, and for work in processes of its own."""

from __future__ import annotations

import contextlib
import ctypes
import math
import threading
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Generic, TypeVar

from ptproof.errors import InputError

Answer = TypeVar("Answer")
Key = TypeVar("Key")
MEMORY = 8 * 2**30
_STACK = 64 * 2**20


class OutOfTime(Exception):
    """No answer within the time limit."""


class _Stop(BaseException):
    """Ends the thread whose answer nobody waits for any more."""


def within(seconds: float, work: Callable[[], Answer]) -> Answer:
    """The answer of ``work``, or :class:`OutOfTime`.

    The work runs in a thread of its own, which is told to stop when its time is over: expressions cannot all be
    sent to another process, and a signal would be in the way of a test runner's own time limit.
    """
    check_seconds(seconds)
    answers: list[Answer] = []
    errors: list[BaseException] = []

    def run() -> None:
        try:
            answers.append(work())
        except BaseException as error:  # handed over to the thread that waits
            errors.append(error)

    thread = threading.Thread(target=run, daemon=True, name="ptproof time limit")
    usual = threading.stack_size(_STACK)  # expressions are deep, and some systems give a thread very little
    try:
        thread.start()
    finally:
        threading.stack_size(usual)
    thread.join(min(seconds, threading.TIMEOUT_MAX))
    if answers:
        return answers[0]
    if errors:
        raise errors[0]
    if thread.ident is not None:
        ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread.ident), ctypes.py_object(_Stop))
    raise OutOfTime


def check_seconds(seconds: Any, where: str = "seconds") -> None:
    """Refuse a time limit that is none; ``where`` is what the caller calls it."""
    if isinstance(seconds, bool) or not isinstance(seconds, int | float) or not 0 < seconds < math.inf:
        raise InputError(f"{where}: the time limit is a positive number of seconds, got {seconds!r}")


class Why(StrEnum):
    """Why there is no answer."""

    TIME = "no answer within the time limit"
    MEMORY = "no answer within the limit of memory"
    DIED = "the process ended without an answer"
    FAILED = "the work raised an error"


@dataclass(frozen=True)
class Answered(Generic[Answer]):
    """Work that came to its end."""

    answer: Answer


@dataclass(frozen=True)
class Unanswered:
    """Work without an answer: why, the reason in words, and the error that the work raised, if it did."""

    why: Why
    reason: str
    error: Exception | None = None


def apart(seconds: float, work: Callable[..., Answer], *arguments: Any) -> Answered[Answer] | Unanswered:
    """What came of ``work(*arguments)`` in a process of its own, which is ended when its ``seconds`` are over."""
    with Workers() as workers:
        return workers.run(seconds, work, *arguments)


class Workers:
    """Processes in which one piece of work can end, run out of time or die without the others.

    Each starts afresh rather than as a copy of this process, since a copy of a process with threads can hang; so
    the work is a top-level function, and it, its arguments and its answer are sent.

    Parameters
    ----------
    count
        How many processes; they start when there is something to do.
    start, arguments
        Called as ``start(*arguments)`` once in each process, and not counted as the time of any work.
    memory
        How much a process may hold, in bytes; systems without such a limit leave it out.

    Examples
    --------
    >>> with Workers() as workers:
    ...     workers.run(30, divmod, 7, 3)
    Answered(answer=(2, 1))
    """

    def __init__(
        self, count: int = 1, *, start: Callable[..., None] | None = None, arguments: tuple[Any, ...] = (),
        memory: int = MEMORY,
    ) -> None:  # fmt: skip
        import multiprocessing

        from pebble import ProcessPool

        self._memory = memory
        self._pool = ProcessPool(
            max_workers=count,
            context=multiprocessing.get_context("spawn"),
            initializer=_start,
            initargs=(memory, start, arguments),
        )

    def __enter__(self) -> Workers:
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    def stop(self) -> None:
        """End the processes, and what still runs in them."""
        self._pool.stop()
        self._pool.join()

    def run(self, seconds: float, work: Callable[..., Answer], *arguments: Any) -> Answered[Answer] | Unanswered:
        """What came of ``work(*arguments)``; waits for it."""
        return next(outcome for _, outcome in self.each(seconds, work, {None: arguments}))

    def each(
        self, seconds: float, work: Callable[..., Answer], tasks: Mapping[Key, tuple[Any, ...]]
    ) -> Iterator[tuple[Key, Answered[Answer] | Unanswered]]:
        """The key of each task with what came of ``work(*task)``, as they end; the limit is that of one task."""
        from concurrent.futures import as_completed

        check_seconds(seconds)
        waiting = {
            self._pool.schedule(_call, args=(work, arguments), timeout=seconds): key for key, arguments in tasks.items()
        }
        for future in as_completed(waiting):
            yield waiting[future], self._outcome(future, seconds)

    def _outcome(self, future: Any, seconds: float) -> Answered[Any] | Unanswered:
        from pebble import ProcessExpired

        try:
            return Answered(future.result())
        except TimeoutError:
            return Unanswered(Why.TIME, f"no answer in {seconds:g} s")
        except ProcessExpired as error:
            return Unanswered(Why.DIED, f"the process ended: {type(error).__name__}: {error}", error)
        except MemoryError as error:
            return Unanswered(Why.MEMORY, f"no answer in {self._memory / 2**30:g} GiB of memory", error)
        except Exception as error:
            return Unanswered(Why.FAILED, f"{type(error).__name__}: {error}", error)


_not_started: list[BaseException] = []


def _start(memory: int, start: Callable[..., None] | None, arguments: tuple[Any, ...]) -> None:
    """In a new process; an error is kept for the work, as the pool would start the process again and again."""
    with contextlib.suppress(ImportError, ValueError, OSError):  # a system that has no such limit, or a lower one
        import resource

        resource.setrlimit(resource.RLIMIT_DATA, (memory, resource.getrlimit(resource.RLIMIT_DATA)[1]))
    try:
        if start is not None:
            start(*arguments)
    except BaseException as error:
        _not_started.append(error)


def _call(work: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
    if _not_started:
        raise _not_started[0]
    return work(*arguments)
