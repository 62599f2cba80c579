"""Damping against an input: du/dτ ≤ −h·u^r + ζ."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ptproof.comparison.power import PowerBound, check_regular, holds, sympify_members
from ptproof.errors import InputError


@dataclass(frozen=True)
class DampedBound:
    """du/dτ ≤ −h·u^r + ζ with h > 0, r ≥ 1 and a constant ζ ≥ 0 implies u(τ) ≤ w(τ) + u* from the start on.

    w solves dw/dτ = −h·w^r from w(start) = initial, and u* = (ζ/h)^(1/r) is the rest point. Their sum v = w + u*
    lies above u because r ≥ 1 makes the power superadditive, (w + u*)^r ≥ w^r + u*^r for w, u* ≥ 0: so
    dv/dτ = −h·w^r ≥ −h(v^r − u*^r) = −h·v^r + ζ, and v(start) ≥ u(start). This is the explicit form of
    ‖x̄‖ ≤ β + γ (eq:upper_bound).

    Raises
    ------
    InputError
        Unless w solves its equation from ``initial`` and h·u*^r = ζ, by exact algebra.
    """

    time: sp.Symbol
    start: sp.Expr
    initial: sp.Expr
    damping: sp.Expr
    power: sp.Expr
    input: sp.Expr

    def __post_init__(self) -> None:
        sympify_members(self)
        if self.damping.is_positive is False or self.initial.is_positive is False:
            raise InputError(f"comparison: damping {self.damping} and initial {self.initial} must be positive")
        if self.input.is_negative or (self.power - 1).is_negative:
            raise InputError(f"comparison: the input {self.input} must be ≥ 0 and the power {self.power} ≥ 1")
        _ = self.transient  # which is checked as it is made
        if self.input != 0:  # in the letter r for the power
            ratio, r = sp.symbols("ratio r", positive=True)
            holds((ratio ** (1 / r)) ** r - ratio, "the rest point balances damping and input")

    @cached_property
    def transient(self) -> sp.Expr:
        """w(τ)."""
        integral = -self.damping * (self.time - self.start)
        return PowerBound(self.time, self.start, self.initial, -self.damping, self.power, integral).bound

    @property
    def rest(self) -> sp.Expr:
        """u* = (ζ/h)^(1/r)."""
        return (self.input / self.damping) ** (1 / self.power)

    @property
    def bound(self) -> sp.Expr:
        """w(τ) + u*."""
        return self.transient + self.rest


@dataclass(frozen=True)
class LinearBound:
    """du/dτ ≤ −h·u + ζ(τ) implies u(τ) ≤ e^(−h(τ−t₀))·initial + ∫ e^(−h(τ−v)) ζ(v) dv, with the convolution given.

    The right side solves the equation with equality, and the equation is linear, so the comparison is exact:
    no smaller bound follows from the inequality.

    Raises
    ------
    InputError
        Unless ``convolution`` starts at zero and solves dc/dτ = −h·c + ζ by exact algebra, and it and ζ are shown to be
        continuous from ``start`` on.
    """

    time: sp.Symbol
    start: sp.Expr
    initial: sp.Expr
    damping: sp.Expr
    input: sp.Expr
    convolution: sp.Expr

    def __post_init__(self) -> None:
        sympify_members(self)
        check_regular(self.convolution, self.time, self.start, "the convolution")
        difference = sp.diff(self.convolution, self.time) + self.damping * self.convolution - self.input
        holds(difference, "the convolution solves its equation")
        holds(self.convolution.subs(self.time, self.start), "the convolution starts at zero")

    @property
    def bound(self) -> sp.Expr:
        """e^(−h(τ−t₀))·initial + convolution."""
        return sp.exp(-self.damping * (self.time - self.start)) * self.initial + self.convolution


def fading_input(
    *, time: sp.Symbol, start: sp.Expr, initial: sp.Expr, damping: sp.Expr, horizon: sp.Expr, input: sp.Expr
) -> LinearBound:
    """The exact bound for du/dτ ≤ −h·u + ζ₀/(1 + (τ − t₀)/T)² (eq:Ux_inequality for κ = 1).

    ``input`` is ζ₀ and ``horizon`` T. The convolution, with the exponential
    integral Ei, is
    ζ₀T·e^(−h(T+s))·[c·Ei(cy) − e^(cy)/y] between y = 1 and y = 1 + s/T, with c = hT and s = τ − t₀.
    """
    s, T = time - start, sp.sympify(horizon)
    c = damping * T
    y = sp.Dummy("y", positive=True)
    primitive = c * sp.Ei(c * y) - sp.exp(c * y) / y
    convolution = input * T * sp.exp(-damping * (T + s)) * (primitive.subs(y, 1 + s / T) - primitive.subs(y, 1))
    return LinearBound(time, start, initial, damping, input / (1 + s / T) ** 2, convolution)
