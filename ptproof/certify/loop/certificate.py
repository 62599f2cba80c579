"""What is proved about a vehicle in closed loop, as a value."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ptproof.balls.arrays import Array
from ptproof.certify.loop.failing import Advice, Failing
from ptproof.proof.verdict import Verdict


@dataclass(frozen=True)
class LoopCertificate:
    """A bound of the distance from the source, for every vehicle that starts within a radius of it.

    Attributes
    ----------
    verdict
        ``proved``, or ``undecided`` where no bound was found (never ``refuted``: nothing is said then).
    omega, mu, start_radius, filter_gap
        For which ω and μ; |x(t₀) − x*| ≤ ``start_radius`` and |F(x(t₀)) − z(t₀)| ≤ ``filter_gap``.
    times, distances
        r at increasing times t from t₀ to t₀ + T. Between two of them |x(t) − x*| is at most the larger distance.
    hover
        The distance that would not be exceeded from some time on if the last gain and a drift that does not change
        went on; None where the drift depends on time or nothing was proved.
    detail
        In words: how, or what failed and what would help.
    seconds
        How long it took.
    failing
        The worst boxes on which the proof failed, where they were asked for.
    help
        What would probably be proved instead, likewise.
    """

    verdict: Verdict
    omega: float
    mu: float
    start_radius: float
    filter_gap: float
    times: tuple[float, ...]
    distances: tuple[float, ...]
    hover: float | None
    detail: str
    seconds: float
    failing: tuple[Failing, ...] = ()
    help: Advice | None = None

    @property
    def final(self) -> float | None:
        """r(t₀ + T); None where nothing was proved."""
        return self.distances[-1] if self.verdict is Verdict.PROVED else None

    def bound(self, time: Array) -> Array:
        """r at any times between the first and the last one."""
        at = np.clip(np.searchsorted(self.times, time, side="right") - 1, 0, len(self.times) - 2)
        found = np.asarray(self.distances)
        exact = np.asarray(self.times)[at] == time
        return np.asarray(np.where(exact, found[at], np.maximum(found[at], found[at + 1])))

    def to_json(self) -> dict[str, Any]:
        """As the command prints it."""
        return {
            "verdict": str(self.verdict), "omega": self.omega, "mu": self.mu, "start_radius": self.start_radius,
            "filter_gap": self.filter_gap, "times": list(self.times), "distances": list(self.distances),
            "final": self.final, "hover": self.hover, "detail": self.detail, "seconds": round(self.seconds, 3),
            "failing": [box.to_json() for box in self.failing], "help": self.help and self.help.to_json(),
        }  # fmt: skip
