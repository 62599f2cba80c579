"""A coefficient of second-order averaging, and its limit as the frequency grows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import sympy as sp

from ptproof.averaging.exponents import Point


@dataclass(frozen=True)
class Gamma:
    """γ(ω) = ω^exponent · mean, the factor of [f_i, f_j] or [[f_i, f_j], f_m]; ``signs``: those of the exponent.

    γ_ij = ω^(p_i + p_j)/T ∫₀^T u_j(s) ∫₀^s u_i(p) dp ds, and γ_ijm = ω^(p_i + p_j + p_m)/(3T) ∫₀^T u_m(τ)
    ∫₀^τ ∫₀^s (u_j(s) u_i(p) − u_i(s) u_j(p)) dp ds dτ, at the phases ω times these, over a common period T.
    """

    mean: sp.Expr
    exponent: sp.Expr
    signs: Mapping[int, Point]

    @property
    def limit(self) -> sp.Expr | None:
        """The limit as ω → ∞ for all allowed values of the powers; None where there is none, or not the same one."""
        if self.mean == 0 or self.signs.keys() == {-1}:
            return sp.S.Zero
        return self.mean if self.signs.keys() == {0} else None

    @property
    def condition(self) -> str:
        """What the limit rests on, in words."""
        if self.mean == 0:
            return "it vanishes for every omega"
        if self.signs.keys() == {-1}:
            return f"{self.exponent} < 0"
        if self.signs.keys() == {0}:
            return "it does not depend on omega"
        return f"it tends to 0 where {self.exponent} < 0 only"

    def to_json(self, omega: sp.Symbol) -> dict[str, Any]:
        limit = self.limit
        return {
            "value": str(self.mean * omega**self.exponent),
            "exponent": str(self.exponent),
            "limit": None if limit is None else str(limit),
            "condition": self.condition,
        }
