"""What averaging raises for a system that the averaging theorem does not cover."""

from __future__ import annotations

from collections.abc import Callable

from ptproof.proof.verdict import Evidence, Verdict


class AveragingRefused(ValueError):
    """The system is well formed, but Lie bracket averaging does not apply to it.

    ``assumption`` is the letter of the violated hypothesis (A to F of ass:singular_ass, or "form" where the
    system is not of the averaged class at all), ``place`` says which field, dither or state it is, and
    ``reason`` why, with what would help where something would.
    """

    def __init__(self, assumption: str, place: str, reason: str) -> None:
        super().__init__(f"{place}: {reason}")
        self.assumption, self.place, self.reason = assumption, place, reason


class NotAPeriod(AveragingRefused):
    """A dither does not have the period that the system declares; what would be one depends on all dithers."""

    def __init__(self, place: str, reason: str) -> None:
        super().__init__("D", place, reason)


class AveragingUndecided(ValueError):
    """No exact route that is trusted here leads to a value; ``str`` says what was met and where."""


def unless_refused(engine: str, work: Callable[[], object], fine: str) -> Evidence:
    """Proved, in the words ``fine``, where ``work`` comes to its end, and else what it was stopped by."""
    try:
        work()
    except AveragingRefused as refusal:
        return Evidence(engine, Verdict.REFUTED, str(refusal))
    except AveragingUndecided as unknown:
        return Evidence(engine, Verdict.UNDECIDED, str(unknown))
    return Evidence(engine, Verdict.PROVED, fine)
