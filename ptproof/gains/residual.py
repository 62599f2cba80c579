"""A distance that is wanted at t₀ + T: what is proved of the average, and how near the vehicle itself can come."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp

from ptproof.gains.numbers import NotApplicable, sign


@dataclass(frozen=True)
class Residual:
    """A wanted distance against the best bound of the averaged system and the vehicle's circle around its average.

    The bound is a theorem about the average. The vehicle is where its average is up to a circle of the radius 1/√ω, to
    leading order in ω, and no bound of the average says that it comes closer to the source than that.

    Attributes
    ----------
    wanted
        The residual, exact.
    bounds
        What the averaged distance at t₀ + T certainly does not exceed, exact; empty where no bound is proved.
    omega
        The seeker's frequency, None where it is not known.

    Examples
    --------
    >>> asked = Residual(sp.Rational(1, 100), (sp.exp(-5),), sp.Integer(30))
    >>> asked.average_meets_it, asked.vehicle_can_meet_it, asked.omega_needed
    (True, False, 10000)
    """

    wanted: sp.Expr
    bounds: tuple[sp.Expr, ...]
    omega: sp.Expr | None = None

    @property
    def average_meets_it(self) -> bool:
        """Whether the averaged system certainly is within the residual."""
        return any(map(self._is_within, self.bounds))

    def _is_within(self, bound: sp.Expr) -> bool:
        try:
            return sign(self.wanted - bound) >= 0
        except NotApplicable:  # too close to tell
            return False

    @property
    def hover_radius(self) -> sp.Expr | None:
        """1/√ω."""
        return None if self.omega is None else 1 / sp.sqrt(self.omega)

    @property
    def omega_needed(self) -> sp.Expr:
        """The ω from which on 1/√ω is at most the residual."""
        return 1 / self.wanted**2

    @property
    def vehicle_can_meet_it(self) -> bool | None:
        """Whether the circle around the source lies within the residual; None where ω is not known."""
        return None if self.omega is None else sign(self.omega - self.omega_needed) >= 0

    @property
    def is_met(self) -> bool:
        """Whether the average is within the residual and nothing is known that keeps the vehicle from it."""
        return self.average_meets_it and self.vehicle_can_meet_it is not False

    def to_json(self) -> dict[str, Any]:
        """What is proved of the average beside what is expected of the vehicle."""
        return {
            "wanted": {"exact": str(self.wanted), "value": float(self.wanted)},
            "average": {
                "bound": min((float(bound) for bound in self.bounds), default=None),
                "guaranteed": self.average_meets_it,
            },
            "vehicle": {
                "guaranteed": False,
                "hover_radius": None if self.hover_radius is None else float(self.hover_radius),
                "reachable": self.vehicle_can_meet_it,
                "omega_needed": float(self.omega_needed),
            },
        }

    @property
    def sentences(self) -> list[str]:
        """The same for people."""
        name = f"Residual {self.wanted} at t₀ + T"
        if self.average_meets_it:
            first = f"{name}: proved of the average. Of the vehicle it is not."
        else:
            first = f"{name}: not shown by these bounds, not even for the average."
        circle = "The vehicle itself circles around its average at about 1/√ω, which is no theorem about its distance"
        least = f"{float(self.omega_needed):.6g}"
        if self.omega is None:
            return [first, f"{circle}; 1/√ω is within the residual for ω ≥ {least}."]
        radius = f"1/√ω = {float(1 / sp.sqrt(self.omega)):.4g}"
        if not self.vehicle_can_meet_it:
            return [first, f"{circle}: {radius} is more than the residual, which needs ω ≥ {least}."]
        return [first, f"{circle}: {radius}."]
