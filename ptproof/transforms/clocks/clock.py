"""A change of time: a clock whose rate and inverse don't fit together can't be made."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import sympy as sp
from sympy.core.relational import Relational

from ptproof.errors import InputError
from ptproof.proof.signs import vanishes
from ptproof.transforms.clocks.algebra import factored, is_positive, limit_at_infinity, settle
from ptproof.transforms.clocks.attack import unshaken


@dataclass(frozen=True)
class Piece:
    """A change of time on a stretch without corners: both maps and both rates, in t, τ, t and τ."""

    to_tau: sp.Expr
    to_t: sp.Expr
    rate: sp.Expr
    rate_back: sp.Expr


def displayed(t: sp.Symbol, tau: sp.Symbol, piece: Piece) -> str:
    """The map, its rate and its inverse as a displayed formula of LaTeX."""
    left = (sp.latex(tau), rf"\frac{{\mathrm{{d}} {sp.latex(tau)}}}{{\mathrm{{d}} {sp.latex(t)}}}", sp.latex(t))
    rows = zip(left, (piece.to_tau, piece.rate, piece.to_t), strict=True)
    lines = r" \\ ".join(f"{name} &= {sp.latex(value)}" for name, value in rows)
    return rf"$\displaystyle \begin{{aligned}}{lines}\end{{aligned}}$"


@dataclass(frozen=True)
class Clock:
    """A change of time τ = a(t) on [t₀, t₀ + horizon).

    Parameters
    ----------
    t, tau
        The two times, real symbols.
    to_tau
        a, an expression in ``t``.
    to_t
        a⁻¹, an expression in ``tau``.
    start
        t₀, where both times agree.
    horizon
        The length of the interval in t (``oo`` allowed). [time]
    name
        For people.

    Raises
    ------
    InputError
        Unless a⁻¹(a(t)) = t, a(t₀) = t₀ and (da/dt)·(da⁻¹/dτ) = 1 hold by exact algebra, and da/dt > 0 on the
        interval. Where a⁻¹(a(t)) = t is out of reach, as for arctan(tan), a(a⁻¹(τ)) = τ serves if a⁻¹ is shown to
        increase from t₀ and to tend to the interval's end: then it is onto, and the only inverse.
    """

    t: sp.Symbol
    tau: sp.Symbol
    to_tau: sp.Expr
    to_t: sp.Expr
    start: sp.Expr
    horizon: sp.Expr
    name: str = "clock"

    def __post_init__(self) -> None:
        for field in ("to_tau", "to_t", "start", "horizon"):
            object.__setattr__(self, field, sp.sympify(getattr(self, field)))
        if not isinstance(self.t, sp.Symbol) or not isinstance(self.tau, sp.Symbol) or self.t == self.tau:
            raise InputError(f"{self.name}: the two times must be distinct symbols")
        for what, shown in (
            ("both times agree at the start", self._agree_at_start),
            ("the inverse undoes the map", self._is_inverse),
            ("the map increases", lambda: self._grows() or self._rises_to_the_end()),
        ):
            if not shown():
                raise InputError(f"{self.name}: it does not hold, or cannot be shown, that {what}")
        unshaken(self, points=3)

    def instant(self, nu: sp.Expr) -> sp.Expr:
        """The t at which ν = 1 − (t − t₀)/horizon, which falls from 1 to 0 (eq:nu), has the value ``nu``."""
        if self.horizon is sp.oo:
            raise InputError(f"{self.name}: without an end of its interval it has no nu; name an instant in t")
        return self.start + self.horizon * (1 - nu)

    @property
    def until(self) -> None:
        """The instant from which on the rate is capped: never."""
        return None

    @property
    def conditions(self) -> tuple[Relational, ...]:
        """The conditions of the choices that the clock makes: none."""
        return ()

    @cached_property
    def pieces(self) -> tuple[Piece, ...]:
        """The map itself, in one piece."""
        return (Piece(self.to_tau, self.to_t, self.rate, self.rate_back),)

    def on_interval(self, expression: sp.Expr) -> sp.Expr:
        """An expression in t for t₀ ≤ t < t₀ + horizon, by one symbol w ≥ 0: t − t₀ is w, or horizon·w/(1 + w)."""
        w = sp.Dummy("w", nonnegative=True)
        elapsed = w if self.horizon is sp.oo else self.horizon * w / (1 + w)
        return settle(expression.subs(self.t, self.start + elapsed))

    def _by_nu(self, expression: sp.Expr) -> sp.Expr:
        """An expression in t for t < t₀ + horizon, by the symbol ν > 0: t − t₀ is horizon·(1 − ν)."""
        if self.horizon is sp.oo:
            return expression
        return settle(expression.subs(self.t, self.instant(sp.Dummy("nu", positive=True))))

    def _later(self, expression: sp.Expr) -> sp.Expr:
        """An expression in τ for τ > t₀, by the symbol τ − t₀ > 0."""
        return settle(expression.subs(self.tau, self.start + sp.Dummy("e", positive=True)))

    def _agree_at_start(self) -> bool:
        starts = (self.to_tau.subs(self.t, self.start), self.to_t.subs(self.tau, self.start))
        return all(vanishes(instant - self.start) for instant in starts)

    def _grows(self) -> bool:
        return is_positive(self.on_interval(self.rate))

    def _is_inverse(self) -> bool:
        back = self.to_t.subs(self.tau, self.to_tau) - self.t
        rates = self.rate * self.rate_back.subs(self.tau, self.to_tau) - 1
        views: tuple[Callable[[sp.Expr], sp.Expr], ...] = (lambda entry: entry, self._by_nu, self.on_interval)
        if any(vanishes(view(back)) and vanishes(view(rates)) for view in views):
            return True
        forth = self.to_tau.subs(self.t, self.to_t) - self.tau
        rates = self.rate.subs(self.t, self.to_t) * self.rate_back - 1
        if not (vanishes(self._later(forth)) and vanishes(self._later(rates))):
            return False
        # Injective: then a(a⁻¹(a(t))) = a(t) gives a⁻¹(a(t)) = t, if a⁻¹ stays in the interval.
        elapsed = self._later(self.to_t - self.start)
        left = () if self.horizon is sp.oo else (self.horizon - elapsed,)
        if self._grows() and all(is_positive(length) for length in (elapsed, *left)):
            return True
        # Onto: then every t is a⁻¹(τ) for some τ, and a⁻¹(a(a⁻¹(τ))) = a⁻¹(τ).
        return self._rises_to_the_end()

    def _rises_to_the_end(self) -> bool:
        """Whether a⁻¹ is shown to increase, and to tend to the end of the interval as τ → ∞."""
        return is_positive(self._later(self.rate_back)) and self.tends_to_the_end()

    def tends_to_the_end(self) -> bool:
        """Whether a⁻¹ is shown to tend to the end of the interval as τ → ∞."""
        end = limit_at_infinity(self.to_t, self.tau)
        if end is None or sp.oo in (end, self.horizon):
            return end is self.horizon
        return vanishes(end - self.start - self.horizon)

    def _repr_latex_(self) -> str:
        return displayed(self.t, self.tau, self.pieces[0])

    @cached_property
    def rate(self) -> sp.Expr:
        """dτ/dt as an expression in t."""
        return factored(sp.diff(self.to_tau, self.t))

    @cached_property
    def rate_back(self) -> sp.Expr:
        """dt/dτ as an expression in τ."""
        return factored(sp.diff(self.to_t, self.tau))
