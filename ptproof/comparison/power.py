"""Growth and decay by a power: du/dτ ≤ α(τ)·u^p."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.definedness import obligations
from ptproof.proof.engines.reals import are_met
from ptproof.proof.signs import vanishes


def holds(difference: sp.Expr, what: str) -> None:
    """Raise unless ``difference`` is shown to vanish."""
    if not vanishes(difference):
        raise InputError(f"comparison: it does not hold, or cannot be shown, that {what}")


def sympify_members(bound: Any) -> None:
    """Numbers given to a bound become exact SymPy numbers."""
    for member in fields(bound):
        object.__setattr__(bound, member.name, sp.sympify(getattr(bound, member.name)))


@dataclass(frozen=True)
class PowerBound:
    """du/dτ ≤ α(τ)·u^p with u(start) ≤ initial implies u(τ) ≤ ``bound`` while ``denominator`` > 0.

    With σ = p − 1, A(τ) = ∫ α from start to τ and σ ≠ 0 (Bernoulli), w = u^(−σ) satisfies −dw/dτ ≤ σα for σ > 0,
    so w ≥ initial^(−σ) − σA, and as long as the right side is positive the power −1/σ, a decreasing function,
    turns this into an upper bound of u. For σ < 0 both directions flip and the conclusion is the same. For
    σ = 0 the logarithm does the same with an exponential, for every τ.

    Attributes
    ----------
    time, start, initial
        τ, where the inequality starts to hold, and an upper bound of u there (positive).
    rate, power
        α as an expression in τ (of either sign, continuous), and p.
    integral
        A, with dA/dτ = α and A(start) = 0.

    Raises
    ------
    InputError
        Unless the bound starts at ``initial`` and solves du/dτ = α·u^p by exact algebra, and rate and integral are
        shown to be continuous from ``start`` on.
    """

    time: sp.Symbol
    start: sp.Expr
    initial: sp.Expr
    rate: sp.Expr
    power: sp.Expr
    integral: sp.Expr

    def __post_init__(self) -> None:
        sympify_members(self)
        if self.initial.is_positive is False:
            raise InputError(f"comparison: the initial value {self.initial} is not positive")
        sigma = self.sigma
        check_regular(self.integral, self.time, self.start, "the integral")
        holds(sp.diff(self.integral, self.time) - self.rate, "the integral's derivative is the rate")
        holds(self.integral.subs(self.time, self.start), "the integral starts at zero")
        if sigma == 0:
            holds(sp.diff(self.bound, self.time) - self.rate * self.bound, "the bound solves the equation")
        else:  # in letters: D for the denominator, positive on the domain, and σ for p − 1
            D, V = sp.symbols("D V", positive=True)
            exponent = sp.Dummy("sigma", real=True, nonzero=True)
            masked = V * D ** (-1 / exponent)
            slope = -exponent * V**exponent * self.rate
            holds(
                sp.diff(self.denominator, self.time) + sigma * self.initial**sigma * self.rate,
                "the denominator's derivative follows from the rate",
            )
            holds(sp.diff(masked, D) * slope - self.rate * masked ** (1 + exponent), "the bound solves the equation")
        holds(self.bound.subs(self.time, self.start) - self.initial, "the bound starts at the initial value")

    @property
    def sigma(self) -> sp.Expr:
        """p − 1."""
        return sp.cancel(sp.together(self.power - 1))

    @cached_property
    def denominator(self) -> sp.Expr:
        """1 − σ·initial^σ·A, or 1 when p = 1; the bound is valid from start on while this stays positive."""
        return 1 - self.sigma * self.initial**self.sigma * self.integral

    @cached_property
    def bound(self) -> sp.Expr:
        """initial·denominator^(−1/σ), or initial·exp(A) when p = 1."""
        return self.initial * (sp.exp(self.integral) if self.sigma == 0 else self.denominator ** (-1 / self.sigma))


def power_bound(
    *, time: sp.Symbol, rate: sp.Expr, power: sp.Expr, initial: sp.Expr, start: sp.Expr = sp.S.Zero,
    integral: sp.Expr | None = None,
) -> PowerBound:  # fmt: skip
    """The bound from du/dτ ≤ α(τ)·u^p; the integral of α is found, or given, and in both cases checked.

    Raises
    ------
    InputError
        If the integral is not found, or not right.

    Examples
    --------
    >>> s = sp.Symbol("s", real=True)
    >>> power_bound(time=s, rate=sp.Integer(-2), power=sp.Integer(1), initial=sp.Integer(3)).bound
    3*exp(-2*s)
    >>> power_bound(time=s, rate=sp.Integer(-2), power=sp.Integer(2), initial=sp.Integer(3)).bound
    3/(6*s + 1)
    """
    if integral is None:
        antiderivative = sp.integrate(rate, time)
        if antiderivative.has(sp.Integral):
            raise InputError(f"comparison: no antiderivative found for the rate {rate}; give the integral")
        integral = antiderivative - antiderivative.subs(time, start)
    return PowerBound(time, start, initial, rate, power, integral)


def check_regular(expression: sp.Expr, time: sp.Symbol, start: sp.Expr, what: str) -> None:
    """Raise unless ``expression`` is shown to be continuously differentiable for all times from ``start`` on.

    A solution on one side of a pole or a jump says nothing about the other side.
    Exact algebra alone does not see a jump or a kink: for SymPy the derivative of a jump is 0.
    """
    elapsed = sp.Dummy("elapsed", nonnegative=True)
    there = sp.sympify(expression).subs(time, start + elapsed)
    found = are_met(list(obligations(there, moving=[elapsed])), (), seconds=2.0)
    if not found.shown:
        raise InputError(
            f"comparison: {what} {expression} is not shown to be without jump, kink or pole from {time} = {start} on: "
            f"{found.how}"
        )
