"""Limits of time and memory: for work in this process, and for work in processes of its own."""

from __future__ import annotations

import ctypes
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from typing import Any, Generic, TypeVar

from ptproof.reading.copies import Copies, possible
from ptproof.reading.outcomes import Answered as Answered
from ptproof.reading.outcomes import Unanswered as Unanswered
from ptproof.reading.outcomes import Why as Why
from ptproof.reading.outcomes import check_seconds as check_seconds
from ptproof.reading.spawned import Spawned
from ptproof.reading.system import MEMORY, memory_here

Answer = TypeVar("Answer")
Key = TypeVar("Key")
_STACK = 64 * 2**20
_PAUSE = 0.005  # until a thread has left the callback in which it was told to stop [s]


class OutOfTime(Exception):
    """No answer within the time limit."""


class Stop(BaseException):
    """Ends the thread whose answer nobody waits for any more."""


def within(seconds: float, work: Callable[[], Answer]) -> Answer:
    """The answer of ``work``, or :class:`OutOfTime`.

    The work runs in a thread of its own, which is told to stop when its time is over: expressions cannot all be
    sent to another process, and a signal would be in the way of a test runner's own time limit.
    """
    check_seconds(seconds)
    working = _Working(work)
    working.thread.join(min(seconds, threading.TIMEOUT_MAX))
    if not working.over_or_told():
        raise OutOfTime
    return working.answer()


def unbroken(work: Callable[[], Answer]) -> Answer:
    """The answer of ``work``, which no time limit breaks off in the middle: it ends the thread afterwards.

    For a library whose objects must not be left half made, since a limit's exception may come between any two steps.
    """
    working: _Working[Any] | None = getattr(_here, "working", None)
    if working is None:
        return work()
    with working.unbroken():
        return work()


_here = threading.local()


class _Working(Generic[Answer]):
    """Work in a thread of its own, and what has come of it."""

    def __init__(self, work: Callable[[], Answer]) -> None:
        self._work = work
        self._answers: list[Answer] = []
        self._errors: list[BaseException] = []
        self._guard = threading.Lock()
        self._told = self._begun = self._over = self._telling = False
        self._inside = 0
        _listen()
        self.thread = threading.Thread(target=self._run, daemon=True, name="ptproof time limit")
        usual = threading.stack_size(_STACK)  # expressions are deep, and some systems give a thread very little
        try:
            self.thread.start()
        finally:
            threading.stack_size(usual)

    def answer(self) -> Answer:
        """The answer, once the work is over; or its error."""
        if self._errors:
            raise self._errors[0]
        return self._answers[0]

    def over_or_told(self) -> bool:
        """Whether the work is over; if not, it is told to stop."""
        with self._guard:  # the thread cannot end meanwhile: its number might become another's
            if self._over:
                return True
            self._told = True
            if self._begun and not self._inside:
                _raise_in(self.thread, Stop)
            return False

    def tell_again(self) -> None:
        """Tell the thread, from another one, after what had swallowed the first time, until it has heard: on a busy
        machine it may still be in there."""
        if self._telling:
            return
        self._telling = True

        def tell() -> None:
            time.sleep(_PAUSE)
            while not self.over_or_told():
                time.sleep(_PAUSE)

        self._inside += 1  # starting waits, and nothing could be raised out of here either
        try:
            threading.Thread(target=tell, daemon=True, name="ptproof tells again").start()
        finally:
            self._inside -= 1

    @contextmanager
    def unbroken(self) -> Iterator[None]:
        """Within, the thread is not told to stop; it stops at the end if it would have been, or before it begins."""
        with self._guard:
            if self._told:
                raise Stop
            self._inside += 1
        try:
            yield
        finally:
            with self._guard:
                self._inside -= 1
                told = self._told
            if told:
                raise Stop

    def _run(self) -> None:
        _here.working = self
        try:
            with suppress(Stop):  # told in the last moment
                self._begin()
            while not self._end():
                pass
        finally:
            self._over = True

    def _begin(self) -> None:
        with self._guard:
            if self._told:  # before there was anything that would catch what it is told by
                return
            self._begun = True
        try:
            self._answers.append(self._work())
        except BaseException as error:  # handed over to the thread that waits
            self._errors.append(error)

    def _end(self) -> bool:
        """Nothing is told to the thread from here on; False where it has just been told once more."""
        with suppress(Stop), self._guard:
            self._over = True
            _raise_in(self.thread, None)  # not in the steps by which a thread ends
            return True
        return False


def _listen() -> None:
    """Hear of what Python swallows: nothing can be raised out of a callback of its garbage collector or of a weak
    reference, or out of ``__del__``. Whoever is told to stop there is told again, and that is nothing to report."""
    usual = sys.unraisablehook
    if getattr(usual, "hears_limits", False):
        return

    def hook(unraisable: Any, /) -> None:
        working: _Working[Any] | None = getattr(_here, "working", None)
        if unraisable.exc_type is Stop and working is not None:
            working.tell_again()
        else:
            usual(unraisable)

    hook.hears_limits = True  # type: ignore[attr-defined]
    sys.unraisablehook = hook


def _raise_in(thread: threading.Thread, error: type[BaseException] | None) -> None:
    """Have the error raised in the thread at its next step; or take back what has not been raised."""
    assert thread.ident is not None
    raised = None if error is None else ctypes.py_object(error)
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread.ident), raised)


def apart(seconds: float, work: Callable[..., Answer], *arguments: Any) -> Answered[Answer] | Unanswered:
    """What came of ``work(*arguments)`` in a process of its own, which is ended when its ``seconds`` are over."""
    with Workers() as workers:
        return workers.run(seconds, work, *arguments)


class Workers:
    """Processes in which one piece of work can end, run out of time or die without the others.

    They are copies of one process in which ``start`` was called (:mod:`ptproof.reading.copies`); where the system
    cannot copy a process, each starts afresh. The work is a top-level function, since it, its arguments and its answer
    are sent.

    Parameters
    ----------
    count
        How many processes; they start when there is something to do.
    start, arguments
        Called as ``start(*arguments)`` before any work, and not counted as the time of any.
    memory
        How much a process may hold, in bytes; systems without such a limit leave it out. Left out: 8 GiB, or less
        where the machine has less for all of them.

    Examples
    --------
    >>> with Workers() as workers:
    ...     workers.run(30, divmod, 7, 3)
    Answered(answer=(2, 1))
    """

    def __init__(
        self, count: int = 1, *, start: Callable[..., None] | None = None, arguments: tuple[Any, ...] = (),
        memory: int | None = None,
    ) -> None:  # fmt: skip
        most = MEMORY if memory is None else memory
        if memory is None:  # all of them together leave some of the machine's
            most = max(min(MEMORY, int(memory_here() * 0.8 / count)), 2**30)
        self._backend = (Copies if possible() else Spawned)(count, start, arguments, most)

    def __enter__(self) -> Workers:
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    def stop(self) -> None:
        """End the processes, and what still runs in them."""
        self._backend.stop()

    def run(self, seconds: float, work: Callable[..., Answer], *arguments: Any) -> Answered[Answer] | Unanswered:
        """What came of ``work(*arguments)``; waits for it."""
        return next(outcome for _, outcome in self.each(seconds, work, {None: arguments}))

    def each(
        self, seconds: float, work: Callable[..., Answer], tasks: Mapping[Key, tuple[Any, ...]]
    ) -> Iterator[tuple[Key, Answered[Answer] | Unanswered]]:
        """The key of each task with what came of ``work(*task)``, as they end; the limit is that of one task.

        The work begins at once, also where nobody has asked yet for what comes of it.
        """
        check_seconds(seconds)
        return self._backend.each(seconds, work, tasks)
