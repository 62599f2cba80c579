"""What averaging raises for a system that the averaging theorem does not cover, and the form that it has to have."""

from __future__ import annotations

from collections.abc import Callable

from ptproof.averaging.brackets import Vector
from ptproof.proof.verdict import Evidence, Verdict
from ptproof.system import DitherSystem


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


def parts(system: DitherSystem) -> list[tuple[str, Vector]]:
    """The drift and the fields, with what people call them."""
    return [("drift", system.drift), *((f"field {i}", entries) for i, entries in enumerate(system.fields, start=1))]


def check_form(system: DitherSystem, amplitude: str = "the amplitude sqrt(omega)") -> None:
    """Refuse what is not of the form drift + √ω Σ field · dither with the frequency in √ω and the phase only.

    ``amplitude`` is what stands in place of the root, in words.
    """
    dithers = [(f"dither {i}", (entry,)) for i, entry in enumerate(system.dithers, start=1)]
    for place, entries in [*parts(system), *dithers]:
        free = set().union(*(entry.free_symbols for entry in entries))
        if system.omega in free:
            raise AveragingRefused(
                "form",
                place,
                f"it contains the frequency {system.omega}; the theorem is for {amplitude} "
                f"exactly, with fields, drift and signals that do not depend on it",
            )
        if place == "drift" and system.phase in free:
            raise AveragingRefused(
                "form", place, f"it depends on the phase {system.phase}; the theorem's drift b0 varies slowly only"
            )
