"""A time limit for work in this process."""

from __future__ import annotations

import ctypes
import math
import threading
from collections.abc import Callable
from typing import TypeVar

from ptproof.errors import InputError

Answer = TypeVar("Answer")
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
    if isinstance(seconds, bool) or not isinstance(seconds, int | float) or not 0 < seconds < math.inf:
        raise InputError(f"seconds: expected a positive number, got {seconds!r}")
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
