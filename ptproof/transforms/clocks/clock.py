"""A change of time: a clock whose rate and inverse don't fit together can't be made."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import sympy as sp
from sympy.core.relational import Relational

from ptproof.errors import InputError
from ptproof.proof.declarations import is_plainly_real
from ptproof.proof.engines.limits import limit_of
from ptproof.proof.signs import vanishes
from ptproof.transforms.clocks.algebra import (
    factored,
    is_nonnegative,
    is_positive,
    is_smooth,
    limit_at_infinity,
    settle,
)
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


def inside(start: sp.Expr, horizon: sp.Expr) -> tuple[sp.Expr, sp.Symbol]:
    """Any instant t with t₀ ≤ t < t₀ + horizon, by one symbol w ≥ 0, and the symbol."""
    w = sp.Dummy("w", nonnegative=True)
    return start + (w if horizon is sp.oo else horizon * w / (1 + w)), w


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

    The times in τ are those that a reaches: from t₀ on, and all of them where :meth:`tends_to_the_end`.

    Raises
    ------
    InputError
        Unless both times are plain real symbols, the start is real, the horizon positive, and no formula contains the
        wrong time or a symbol that is not real; a(t₀) = a⁻¹(t₀) = t₀; a is continuously differentiable on the interval
        by its structure, da/dt > 0 there, and a⁻¹ is the inverse. The last two in one of four ways:

        1. da/dt > 0 is shown on the interval, and a⁻¹(a(t)) = t by exact algebra, with a⁻¹ smooth where a leads;
        2. da/dt > 0, and a(a⁻¹(τ)) = τ for τ ≥ t₀, with an a⁻¹ that is shown to stay in the interval;
        3. da⁻¹/dτ > 0 for all τ ≥ t₀, a⁻¹ tends to the interval's end, and a(a⁻¹(τ)) = τ: it is onto, so that a is its
           inverse on the whole interval;
        4. da⁻¹/dτ > 0 for all τ ≥ t₀, a⁻¹(a(t)) = t, and a(t) ≥ t₀ is shown: without the last, a may be another branch
           of the inverse, which may well fall.
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
        self._check_symbols()
        for what, shown in (
            ("both times agree at the start", self._agree_at_start),
            ("the map is smooth", lambda: self.is_smooth_on_interval(self.to_tau)),
            ("the inverse undoes the map", lambda: self._undoes_map or self._is_undone),
            ("the map increases", self._is_increasing_inverse),
        ):
            if not shown():
                raise InputError(f"{self.name}: it does not hold, or cannot be shown, that {what}")
        unshaken(self, points=3)

    def _check_symbols(self) -> None:
        times = {self.t, self.tau}
        if not all(isinstance(time, sp.Symbol) for time in times) or len(times) < 2:
            raise InputError(f"{self.name}: the two times must be distinct symbols")
        for time in (self.t, self.tau):
            if not is_plainly_real(time):
                raise InputError(f"{self.name}: the time {time} must be declared real, and nothing more")
        if not (self.start.is_real and self.start.is_finite) or self.start.free_symbols & times:
            raise InputError(f"{self.name}: the start {self.start} is not a real instant")
        if not (self.horizon is sp.oo or self.horizon.is_positive) or self.horizon.free_symbols & times:
            raise InputError(f"{self.name}: the horizon {self.horizon} is not shown to be a positive length of time")
        for formula, other in ((self.to_tau, self.tau), (self.to_t, self.t)):
            if other in formula.free_symbols:
                raise InputError(f"{self.name}: {formula} contains {other}, the other time")
            if unknown := [symbol.name for symbol in formula.free_symbols if not symbol.is_real]:
                raise InputError(f"{self.name}: not declared real: {', '.join(sorted(unknown))}")

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
        return settle(expression.subs(self.t, inside(self.start, self.horizon)[0]))

    def _by_nu(self, expression: sp.Expr) -> sp.Expr:
        """An expression in t for t < t₀ + horizon, by the symbol ν > 0: t − t₀ is horizon·(1 − ν)."""
        if self.horizon is sp.oo:
            return expression
        return settle(expression.subs(self.t, self.instant(sp.Dummy("nu", positive=True))))

    def _later(self, expression: sp.Expr, **elapsed: bool) -> sp.Expr:
        """An expression in τ by the symbol τ − t₀, which is ``elapsed``: positive, or nonnegative."""
        return settle(expression.subs(self.tau, self.start + sp.Dummy("e", **elapsed)))

    def _agree_at_start(self) -> bool:
        starts = (self.to_tau.subs(self.t, self.start), self.to_t.subs(self.tau, self.start))
        return all(vanishes(instant - self.start) for instant in starts)

    def is_smooth_on_interval(self, expression: sp.Expr) -> bool:
        """Whether an expression in t is continuously differentiable on the interval, as it is written."""
        instant, w = inside(self.start, self.horizon)
        return is_smooth(expression.subs(self.t, instant), w)

    @cached_property
    def _inverse_is_smooth(self) -> bool:
        """Whether a⁻¹ is continuously differentiable for all τ ≥ t₀, as it is written."""
        e = sp.Dummy("e", nonnegative=True)
        return is_smooth(self.to_t.subs(self.tau, self.start + e), e)

    @cached_property
    def _grows(self) -> bool:
        return is_positive(self.on_interval(self.rate))

    @cached_property
    def _rises(self) -> bool:
        """Whether a⁻¹ is shown to increase for all τ ≥ t₀."""
        return self._inverse_is_smooth and is_positive(self._later(self.rate_back, nonnegative=True))

    @cached_property
    def _undoes_map(self) -> bool:
        """Whether a⁻¹(a(t)) = t by exact algebra."""
        back = self.to_t.subs(self.tau, self.to_tau) - self.t
        views: tuple[Callable[[sp.Expr], sp.Expr], ...] = (lambda entry: entry, self._by_nu, self.on_interval)
        return any(vanishes(view(back)) for view in views)

    @cached_property
    def _is_undone(self) -> bool:
        """Whether a(a⁻¹(τ)) = τ for τ > t₀ by exact algebra."""
        return vanishes(self._later(self.to_tau.subs(self.t, self.to_t) - self.tau, positive=True))

    def _is_increasing_inverse(self) -> bool:
        """One of the four ways, the cheapest first."""
        leads = self.to_t.subs(self.tau, self.to_tau)
        if self._grows and self._undoes_map and (self._inverse_is_smooth or self.is_smooth_on_interval(leads)):
            return True
        if self._is_undone and self._grows and self._inverse_is_smooth and self._stays_inside():
            return True
        if not self._rises:
            return False
        if self._is_undone and self._inverse_tends_to_the_end():
            return True
        return self._undoes_map and is_nonnegative(self.on_interval(self.to_tau - self.start))

    def _stays_inside(self) -> bool:
        elapsed = self._later(self.to_t - self.start, positive=True)
        left = () if self.horizon is sp.oo else (self.horizon - elapsed,)
        return all(is_positive(length) for length in (elapsed, *left))

    def _inverse_tends_to_the_end(self) -> bool:
        end = limit_at_infinity(self.to_t, self.tau)
        if end is None or sp.oo in (end, self.horizon):
            return end is self.horizon
        return vanishes(end - self.start - self.horizon)

    def tends_to_the_end(self) -> bool:
        """Whether τ is shown to tend to ∞ at the end of the interval: by a⁻¹, where it rises to the end, or by a."""
        if self._rises and self._inverse_tends_to_the_end():
            return True
        end = sp.oo if self.horizon is sp.oo else self.start + self.horizon
        return limit_of(self.to_tau, self.t, end, "-") is sp.oo

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
