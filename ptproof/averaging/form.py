"""The form of a dithered system: its parts, with what people call them, and what may not stand in them."""

from __future__ import annotations

from ptproof.averaging.brackets import Vector
from ptproof.averaging.refusal import AveragingRefused
from ptproof.system import DitherSystem


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
