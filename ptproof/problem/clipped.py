"""The time map of a clipped prescribed-time gain: the paper's map until the clip, a constant rate from then on."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.algebra import is_zero
from ptproof.transforms.clocks.cap import Continuation
from ptproof.transforms.clocks.clock import Clock


@dataclass(frozen=True)
class ClippedClock:
    """τ = a(t) with dτ/dt = 1/max(ν_min, ν)², for all t ≥ t₀ (the rate is the gain of eq:kt).

    It has a :class:`~ptproof.transforms.clocks.clock.Clock`'s attributes, with expressions in two pieces. The general
    :class:`ptproof.transforms.clocks.cap.ClippedClock` asks for a corner strictly after t₀ for every value of its
    symbols; ν_min = 1, the gain that is constant from the start, has it at t₀.

    Parameters
    ----------
    clock
        The paper's map, valid up to the corner.
    minimum
        ν_min in (0, 1].

    Raises
    ------
    InputError
        Unless both pieces agree in value and rate at the corner, by exact algebra.
    """

    clock: Clock
    minimum: sp.Expr

    def __post_init__(self) -> None:
        corner = {self.t: self.corner_t}
        continuous = is_zero(self.clock.to_t.subs(self.tau, self.corner_tau) - self.corner_t)
        smooth = is_zero(self.clock.rate.subs(corner) - 1 / self.minimum**2)
        if not (continuous and smooth):
            raise InputError(f"{self.clock.name}: the clipped map does not continue it")

    @property
    def t(self) -> sp.Symbol:
        return self.clock.t

    @property
    def tau(self) -> sp.Symbol:
        return self.clock.tau

    @property
    def start(self) -> sp.Expr:
        return self.clock.start

    @cached_property
    def corner_t(self) -> sp.Expr:
        """The instant from which on the gain is constant: t₀ + T(1 − ν_min)."""
        return self.start + self.clock.horizon * (1 - self.minimum)

    @cached_property
    def corner_tau(self) -> sp.Expr:
        """The same instant in τ."""
        return sp.factor(sp.cancel(self.clock.to_tau.subs(self.t, self.corner_t)))

    @cached_property
    def _whole(self) -> Continuation:
        return Continuation(self.clock, self.corner_t, self.corner_tau, 1 / self.minimum**2)

    @property
    def to_tau(self) -> sp.Expr:
        """a(t)."""
        return self._whole.to_tau

    @property
    def to_t(self) -> sp.Expr:
        """a⁻¹(τ)."""
        return self._whole.to_t

    @cached_property
    def rate_back(self) -> sp.Expr:
        """dt/dτ = max(ν_min, ν)², with ν as a function of τ."""
        nu = 1 - (self.clock.to_t - self.start) / self.clock.horizon
        return sp.Max(self.minimum, sp.factor(sp.cancel(nu))) ** 2
