"""How many examples a target runs, and how long one of them may take."""

from __future__ import annotations

import contextlib
import signal
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import hypothesis
from hypothesis import HealthCheck, Phase, settings


@dataclass(frozen=True)
class Chosen:
    """What ``--fuzz`` asked for."""

    examples: int
    seed: int


chosen: Chosen | None = None


def fuzz(examples: int) -> Callable[[Any], Any]:
    """Run the test on so many examples, the same ones each time; or as ``--fuzz`` says."""
    quiet = [
        HealthCheck.too_slow,
        HealthCheck.filter_too_much,
        HealthCheck.data_too_large,
        HealthCheck.large_base_example,
    ]
    common = {"deadline": None, "database": None, "suppress_health_check": quiet, "print_blob": True}

    def decorate(test: Any) -> Any:
        if chosen is None:
            # The few examples of the suite are looked for among those that run fast; nothing is to be shrunk there.
            return settings(max_examples=examples, derandomize=True, phases=[Phase.explicit, Phase.generate], **common)(
                test
            )
        return hypothesis.seed(chosen.seed)(settings(max_examples=chosen.examples, **common)(test))

    return decorate


class TooSlow(BaseException):
    """One example took longer than it may; not an ``Exception``, so that nothing on the way catches it."""


@contextlib.contextmanager
def within(seconds: float) -> Iterator[None]:
    """Raise :class:`TooSlow` after so many seconds of this process's own time. Code in C is not interrupted."""

    def stop(*_: object) -> None:
        raise TooSlow(f"more than {seconds:g} s of processor time")

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


def or_nothing(seconds: float, work: Callable[..., Any], *arguments: Any) -> Any:
    """``work(*arguments)``, or None where it takes longer: a slow answer is no wrong one."""
    try:
        with within(seconds):
            return work(*arguments)
    except TooSlow:
        return None
