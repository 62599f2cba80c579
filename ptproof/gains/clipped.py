"""How far the stretched time gets under a clipped gain, and what the drift adds up to by then."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from ptproof.errors import InputError
from ptproof.gains.numbers import sign


@dataclass(frozen=True)
class Horizon:
    """The prescribed time T with a gain 1/max(ν_min, ν)², ν = 1 − (t − t₀)/T; ν_min = None is no clip (eq:kt).

    All times here are elapsed: e = t − t₀ in [0, T], s = τ − t₀.
    """

    T: sp.Expr
    nu_min: sp.Expr | None = None

    @property
    def corner(self) -> sp.Expr:
        """e at which the gain is clipped: T(1 − ν_min); T without a clip."""
        return self.T if self.nu_min is None else self.T * (1 - self.nu_min)

    @property
    def stretched_corner(self) -> sp.Expr:
        """s at the corner: T(1 − ν_min)/ν_min."""
        if self.nu_min is None:
            raise InputError("without a clip the stretched time has no corner")
        return self.T * (1 - self.nu_min) / self.nu_min

    @property
    def stretched_end(self) -> sp.Expr:
        """s at e = T: T(2 − ν_min)/ν_min, that is s at the corner plus ν_min·T at the rate 1/ν_min²."""
        if self.nu_min is None:
            raise InputError("without a clip the stretched time is infinite at t0 + T")
        return self.T * (2 - self.nu_min) / self.nu_min

    def stretched(self, elapsed: sp.Expr) -> sp.Expr:
        """s at the elapsed time e: e/ν before the corner, and on from there at the rate 1/ν_min²."""
        if self.nu_min is not None and sign(elapsed - self.corner) >= 0:
            return self.stretched_corner + (elapsed - self.corner) / self.nu_min**2
        if sign(self.T - elapsed) <= 0:
            raise InputError("without a clip the stretched time is infinite at t0 + T")
        return elapsed / (1 - elapsed / self.T)

    def balance(self, elapsed: sp.Expr, push: sp.Expr, k: sp.Expr) -> sp.Expr:
        """J(e) = ∫ (m·ν² − k/2) dτ = m·e − (k/2)·s(e): the drift's push m against the gain.

        The drift enters dx/dτ with dt/dτ = max(ν_min, ν)², whose integral over τ is the elapsed time itself.
        """
        return push * elapsed - k / 2 * self.stretched(elapsed)

    def turning(self, push: sp.Expr, k: sp.Expr) -> sp.Expr:
        """The e up to which the push outweighs the gain, ν(e) = √(k/(2m)): 0 for k ≥ 2m, T if the clip prevents it."""
        if sign(2 * push - k) <= 0:
            return sp.S.Zero
        nu = sp.sqrt(k / (2 * push))
        if self.nu_min is not None and sign(self.nu_min - nu) > 0:
            return self.T
        return self.T * (1 - nu)
