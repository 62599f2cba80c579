"""Growth that fades in the stretched time against steady decay, its escape time and its critical initial value."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ptproof.comparison.power import PowerBound, holds, sympify_members
from ptproof.errors import InputError

_ELAPSED = sp.Symbol("s", nonnegative=True)


@dataclass(frozen=True)
class DilatedBound:
    """du/dτ ≤ (g/(1 + (τ − t₀)/T)² − h)·u^(1+σ), u(t₀) ≤ initial: the bound, its domain and its escape time.

    This is the paper's comparison for a drift that fades in the stretched time (eq:Lyapunov_inequality_upper_bound
    with σ = 0 before its last step, eq:remark_inequality with σ > 0). g ≥ 0 is the growth at the start, h > 0 the
    decay, T > 0 the prescribed time. With s = τ − t₀ the integral of the rate is A(s) = gTs/(T + s) − hs.

    For σ > 0 the denominator times (T + s) is a quadratic in s, positive at 0:
    T − Bs + Whs², W = σ·initial^σ, B = WT(g − h) − 1. It has a root s > 0 exactly if
    WT(√g − √h)² ≥ 1 and g > h, and the first one is 2T/(B + √(B² − 4WhT)).
    """

    time: sp.Symbol
    start: sp.Expr
    initial: sp.Expr
    horizon: sp.Expr
    growth: sp.Expr
    decay: sp.Expr
    sigma: sp.Expr

    def __post_init__(self) -> None:
        sympify_members(self)
        for name in ("horizon", "decay", "initial"):
            if getattr(self, name).is_positive is False:
                raise InputError(f"comparison: {name} = {getattr(self, name)} is not positive")
        if self.growth.is_negative or self.sigma.is_negative:
            raise InputError(f"comparison: growth = {self.growth} and sigma = {self.sigma} must not be negative")
        s, T, denominator = self.time - self.start, self.horizon, self.result.denominator
        if self.sigma != 0:
            difference = denominator * (T + s) - self.quadratic.subs(_ELAPSED, s)
            holds(difference, "the denominator is the stated quadratic over T + s")
            B, R = sp.symbols("B R", real=True)  # in letters: B and the root of the discriminant
            r = 2 * T / (B + R)
            weight = (B**2 - R**2) / (4 * self.decay * T)
            holds(T - B * r + weight * self.decay * r**2, "the escape time is a root of the quadratic")

    @cached_property
    def result(self) -> PowerBound:
        """The bound as one of a power, with the rate g/(1 + s/T)² − h and its integral A."""
        s, T = self.time - self.start, self.horizon
        rate = self.growth / (1 + s / T) ** 2 - self.decay
        integral = self.growth * T * s / (T + s) - self.decay * s
        return PowerBound(self.time, self.start, self.initial, rate, 1 + self.sigma, integral)

    @property
    def weight(self) -> sp.Expr:
        """W = σ·initial^σ."""
        return self.sigma * self.initial**self.sigma

    @property
    def _linear(self) -> sp.Expr:
        return self.weight * self.horizon * (self.growth - self.decay) - 1

    @property
    def discriminant(self) -> sp.Expr:
        """B² − 4WhT; the bound escapes exactly if this is ≥ 0 and B > 0."""
        return self._linear**2 - 4 * self.weight * self.decay * self.horizon

    @property
    def bound(self) -> sp.Expr:
        """The upper bound of u as an expression in τ."""
        return self.result.bound

    @property
    def quadratic(self) -> sp.Expr:
        """T − Bs + Whs² in the symbol ``s`` of elapsed stretched time (σ > 0)."""
        return self.horizon - self._linear * _ELAPSED + self.weight * self.decay * _ELAPSED**2

    @property
    def escape_elapsed(self) -> sp.Expr:
        """The first s = τ − t₀ at which the bound is infinite, as a formula; it applies where :attr:`escapes`."""
        return 2 * self.horizon / (self._linear + sp.sqrt(self.discriminant))

    @property
    def excess(self) -> sp.Expr:
        """WT(√g − √h)² − 1: with g > h the bound escapes if this is ≥ 0 and is finite for all time if it is < 0."""
        return self.weight * self.largest_integral - 1

    @property
    def turning_elapsed(self) -> sp.Expr:
        """s = T(√(g/h) − 1), where the rate changes sign: the bound has its maximum there (g > h)."""
        return self.horizon * (sp.sqrt(self.growth / self.decay) - 1)

    @property
    def largest_integral(self) -> sp.Expr:
        """max A = T(√g − √h)² for g ≥ h, reached at :attr:`turning_elapsed`."""
        return self.horizon * (sp.sqrt(self.growth) - sp.sqrt(self.decay)) ** 2

    def critical_initial_at(self, elapsed: sp.Expr) -> sp.Expr:
        """The initial value whose denominator vanishes at s = ``elapsed`` (critical-V_0): (σA(s))^(−1/σ), A(s) > 0.

        At :attr:`turning_elapsed` it is the smallest whose bound escapes.
        """
        T = self.horizon
        stretch = 1 + elapsed / T
        return (stretch / (self.sigma * elapsed * (self.growth - self.decay * stretch))) ** (1 / self.sigma)
