"""What came of work under limits: an answer, or why there is none, in words."""

from __future__ import annotations

import math
import signal
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Generic, TypeVar

from ptproof.errors import InputError

Answer = TypeVar("Answer")


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


def check_seconds(seconds: Any, where: str = "seconds") -> None:
    """Refuse a time limit that is none; ``where`` is what the caller calls it."""
    if isinstance(seconds, bool) or not isinstance(seconds, int | float) or not 0 < seconds < math.inf:
        raise InputError(f"{where}: the time limit is a positive number of seconds, got {seconds!r}")


def in_words(error: BaseException) -> str:
    """What an error says about the work that raised it.

    >>> in_words(SystemExit(0)), in_words(KeyboardInterrupt()), in_words(ValueError("no number"))
    ('called sys.exit(0)', 'raised KeyboardInterrupt', 'raised ValueError: no number')
    """
    if isinstance(error, SystemExit):
        return f"called sys.exit({'' if error.code is None else repr(error.code)})"
    try:
        text = str(error)
    except BaseException:  # an error's own words may fail as well
        text = ""
    return f"raised {type(error).__name__}{text and f': {text}'}"


def end_in_words(status: int) -> str:
    """How a process ended, from its exit status as ``subprocess`` gives it: negative for a signal.

    >>> end_in_words(3), end_in_words(-11)
    ('ended with status 3', 'was ended by signal 11 (segmentation fault)')
    """
    if status >= 0:
        return f"ended with status {status}"
    words = (signal.strsignal(-status) or "").lower()
    return f"was ended by signal {-status}{words and f' ({words})'}"


def too_much(memory: int) -> Unanswered:
    """No answer, since more memory was wanted than there is for one piece of work. [bytes]"""
    return Unanswered(Why.MEMORY, f"more than {memory / 2**30:.3g} GiB of memory", MemoryError())
