"""An attack on a certificate for a vehicle: simulated vehicles, any number of them, none of which may be outside.

The certificate shares nothing with it but the problem: a fleet is integrated from the closed loop as it is printed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ptproof.certify import LoopCertificate
from ptproof.problem import Problem
from ptproof.simulation.fleet import Fleet, fleet
from ptproof.simulation.plan import Array

_PIECE = 1000
_SAMPLES = 1000
SLACK = 1e-6
"""By how much a simulated distance may be above a bound: far more than the error of the distances."""


@dataclass(frozen=True)
class Attacked:
    """What became of an attack.

    Attributes
    ----------
    vehicles, samples
        How many were simulated, and at how many times each was held against the bound.
    outside
        How many were ever farther than the bound, or could not be followed: 0, or a promise is broken.
    tightest, at
        The largest distance as a part of the bound, and the time of it.
    until
        The last time; before t₀ + T where the gain is not clipped.
    error
        About how exact the distances are, from runs with sharper tolerances.
    seed
        What repeats it.
    """

    vehicles: int
    samples: int
    outside: int
    tightest: float
    at: float
    until: float
    error: float
    seed: int

    def to_json(self) -> dict[str, Any]:
        """As the command prints it."""
        return dict(vars(self))

    def __str__(self) -> str:
        return (
            f"attacked: {self.vehicles} simulated vehicles at {self.samples} times up to t = {self.until:.6g}, "
            f"{self.outside} outside; the tightest came to {self.tightest:.4f} of the bound, at t = {self.at:.4g} "
            f"(distances to {self.error:.0e})"
        )


def attack_loop(
    problem: Problem, certificate: LoopCertificate, vehicles: int = 10_000, *, seed: int = 0,
    workers: int | None = None, samples: int = _SAMPLES, progress: Callable[[int], None] = lambda _: None,
) -> Attacked:  # fmt: skip
    """Hold simulated vehicles against a proved certificate, in pieces; ``progress`` gets the size of each.

    Parameters
    ----------
    vehicles, seed
        How many, from random starts, headings and filter states of those that the certificate speaks of.
    samples
        About at how many times.
    workers
        Threads (left out: one per processor); they don't change the result.
    """
    outside, tightest, at, error, times = 0, 0.0, 0.0, 0.0, np.zeros(1)
    for many in _pieces(problem, certificate, vehicles, seed, workers, samples):
        bound, times = certificate.bound(many.times), many.times
        outside += outside_of(bound, many.distances)
        worst = np.nanmax(many.distances, axis=0, initial=0.0) / bound
        if worst.max() > tightest:
            tightest, at = float(worst.max()), float(times[np.argmax(worst)])
        error = max(error, many.error)
        progress(len(many.distances))
    return Attacked(vehicles, len(times), outside, tightest, at, float(times[-1]), error, seed)


def outside_of(bound: Array, distances: Array) -> int:
    """How many vehicles (vehicles × times) are ever outside a bound (times); who could not be followed counts."""
    return int((~(distances <= bound + SLACK)).any(axis=1).sum())


def _pieces(
    problem: Problem, certificate: LoopCertificate, vehicles: int, seed: int, workers: int | None, samples: int
) -> Iterator[Fleet]:
    for first in range(0, vehicles, _PIECE):
        yield fleet(
            problem, min(_PIECE, vehicles - first), radius=certificate.start_radius,
            filter_gap=certificate.filter_gap, seed=(seed, first), samples=samples, workers=workers,
        )  # fmt: skip
