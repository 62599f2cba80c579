"""The figures and tables of Section 7, drawn from simulations of the examples when the report asks for them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

    from ptproof.problem import Problem

CAPTIONS = {
    "trajectories": "paths of the seekers and of their averages over the field's level lines",
    "field": "field at the vehicle against time; dashed, the peak; dotted, the prescribed time",
    "distance": "distance from the source against time, with the certified bound of the average; dashed, the hover "
    "radius $1/\\sqrt{\\omega}$",
    "inputs": "forward and angular velocity of the seeker with clipped gain",
    "phase-portrait": "the averaged system at the initial time",
    "order": "largest gap between the closed loop and its average over a ladder of ω, with the slope of the theory",
    "saturated-trajectories": "paths with the time-varying and with the constant gain",
    "saturated-field": "field at the vehicle with the time-varying and with the constant gain",
    "saturated-acceleration": "saturated signal of the angular acceleration under both gains",
}
EXAMPLES = {
    "vanishing": "Section 7.1, vanishing drift",
    "nonvanishing": "Section 7.2, nonvanishing drift",
    "saturated": "Section 7.3, saturated angular acceleration",
}


@dataclass(frozen=True)
class Drawn:
    """A figure for the report."""

    name: str
    caption: str
    content: bytes


@dataclass(frozen=True)
class Listed:
    """A table for the report."""

    title: str
    caption: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def figures() -> Iterator[Drawn]:
    """Every figure of the paper's examples, one after the other."""
    from ptproof.problem import example
    from ptproof.simulation import gallery
    from ptproof.simulation.figures import png

    for name, title in EXAMPLES.items():
        problem = example(name)
        bounds = _certified(problem) if problem.saturation is None else {}
        for kind, figure in gallery.figures(problem, bounds).items():
            how = (
                "Repeat: `ptproof report`"
                if kind in ("phase-portrait", "order")
                else (f"See also: `ptproof simulate {name} --plot run.png`")
            )
            yield Drawn(f"{name}-{kind.removeprefix(f'{name}-')}", f"{title}: {CAPTIONS[kind]}. {how}.", png(figure))


def _certified(problem: Problem) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """The certified bound of the averaged distance against time, where one is proved."""
    import numpy as np

    from ptproof.gains.tight import tight_bound
    from ptproof.proof.verdict import Verdict

    curve = tight_bound(problem)
    if curve.evidence.verdict is not Verdict.PROVED:
        return {}
    return {"certified bound of the average": (np.array(curve.times), np.array(curve.distances))}


def tables() -> Iterator[Listed]:
    """What Section 7 says of its simulations, over all initial headings."""
    from ptproof.simulation.section7 import statements

    rows = [
        (
            item.words,
            "supported" if item.supported else "not supported",
            item.criterion,
            "; ".join(f"{key} {value:.4g}" for key, value in item.data.items()),
            item.remark,
        )
        for item in statements()
    ]
    yield Listed(
        "Section 7, observed",
        "The statements about simulations, each over an even grid of initial headings with the filter at the measured "
        "field. This is evidence with its spread, not a proof.",
        ("statement", "outcome", "criterion", "numbers", "remark"),
        tuple(rows),
    )
