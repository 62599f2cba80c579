"""How long an interval of time becomes under a rate: the exact integral that decides about prescribed time."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from ptproof.proof.engines.evaluation import continuous
from ptproof.proof.engines.limits import limit_of
from ptproof.proof.kinks import branch, is_kink, switching
from ptproof.proof.signs import vanishes
from ptproof.reading.limits import OutOfTime, within

SECONDS = 10.0


@dataclass(frozen=True)
class DilatedLength:
    """∫ rate over [t₀, t₀ + horizon): an exact value or ``oo``, for ``provided`` corners inside the interval."""

    value: sp.Expr
    provided: tuple[str, ...] = ()

    def __str__(self) -> str:
        return str(self.value) + (f" (for {' and '.join(self.provided)})" if self.provided else "")


def dilated_length(rate: sp.Expr, t: sp.Symbol, *, start: sp.Expr, horizon: sp.Expr) -> DilatedLength | None:
    """The exact integral of ``rate`` (in t) over [t₀, t₀ + horizon), or None where it is not found and checked.

    One choice at a corner, as in a capped gain, is split there: a maximum or minimum of a constant and something linear
    in t or a power of ν, or two pieces. The antiderivative comes from SymPy and is checked by exact algebra; it is
    taken only where it is continuous by its structure on the whole interval; the limit at the end is one of the limit
    theorems'.

    >>> t = sp.Symbol("t", real=True); T = sp.Symbol("T", positive=True)
    >>> print(dilated_length(1 / (1 - t / T) ** 2, t, start=0, horizon=T))
    oo
    >>> print(dilated_length(1 / sp.sqrt(1 - t / T), t, start=0, horizon=T))
    2*T
    >>> print(dilated_length(1 / sp.Max(sp.Rational(3, 10), 1 - t / T) ** 2, t, start=0, horizon=T))
    17*T/3
    """
    start, horizon = sp.sympify(start), sp.sympify(horizon)
    nu = sp.Dummy("nu", positive=True)
    integrand = horizon * sp.sympify(rate).subs(t, start + horizon * (1 - nu))
    integrand = integrand.replace(
        lambda node: isinstance(node, sp.Max | sp.Min),
        lambda node: node.func(*(sp.factor(sp.cancel(argument)) for argument in node.args)),
    )
    choices = {node for node in sp.preorder_traversal(integrand) if is_kink(node, {nu})}
    if len(choices) > 1:
        return None
    if not choices:
        value = _improper(integrand, nu, sp.S.Zero, sp.S.One)
        return None if value is None else DilatedLength(value)
    return _split(integrand, nu, choices.pop())


def _split(integrand: sp.Expr, nu: sp.Symbol, choice: sp.Expr) -> DilatedLength | None:
    sides = switching(choice)
    found = _crossing(sides[0], nu) if len(sides) == 1 else None
    if found is None:
        return None
    corner, slope = found
    inside = (corner.is_positive, (1 - corner).is_nonnegative)
    if False in inside or not (slope.is_positive or slope.is_negative):
        return None
    parts = []
    for sign, low, high in ((-1, sp.S.Zero, corner), (1, corner, sp.S.One)):
        there = sign if slope.is_positive else -sign
        piece = branch(choice, lambda side: there if side == sides[0] else -there)  # noqa: B023
        if piece is None or (value := _improper(integrand.xreplace({choice: piece}), nu, low, high)) is None:
            return None
        parts.append(value)
    provided = tuple(
        text for known, text in zip(inside, (f"{corner} > 0", f"{corner} <= 1"), strict=True) if known is None
    )
    return DilatedLength(sp.oo if sp.oo in parts else sp.factor(sp.cancel(sp.Add(*parts))), provided)


def _crossing(side: sp.Expr, nu: sp.Symbol) -> tuple[sp.Expr, sp.Expr] | None:
    """Where a + bν, or c ν^q − d, vanishes, and an expression with the sign of its slope."""
    side = sp.expand(side)
    if side.is_polynomial(nu) and sp.degree(side, nu) == 1:
        slope = sp.diff(side, nu)
        return sp.cancel(nu - side / slope), slope
    rest, moving = side.as_independent(nu, as_Add=True)
    factor, power = moving.as_independent(nu, as_Add=False)
    base, exponent = power.as_base_exp()
    if base != nu or exponent.has(nu) or not (-rest / factor).is_positive:
        return None
    return sp.simplify((-rest / factor) ** (1 / exponent)), factor * exponent


def antiderivative(integrand: sp.Expr, variable: sp.Symbol) -> sp.Expr | None:
    """What SymPy suggests within its time, if exact algebra shows that its derivative is the integrand."""
    try:
        found = within(SECONDS, lambda: sp.integrate(sp.simplify(integrand), variable))
    except OutOfTime:
        return None
    checked = not found.has(sp.Integral, sp.Piecewise) and vanishes(sp.diff(found, variable) - integrand)
    return found if checked else None


def _improper(integrand: sp.Expr, nu: sp.Symbol, low: sp.Expr, high: sp.Expr) -> sp.Expr | None:
    """∫ from low to high within (0, 1], the lower end approached from above."""
    found, w = antiderivative(integrand, nu), sp.Dummy("w", nonnegative=True)
    if found is None or not continuous(found.subs(nu, 1 / (1 + w)), w):
        return None
    turned = found.replace(sp.log, lambda u: -sp.log(1 / u))
    ends = [limit_of(form, nu, low, "+") for form in (found, turned)] if low.is_zero else [found.subs(nu, low)]
    start = next((end for end in ends if end is not None), None)
    if start is None or start is sp.oo:
        return None
    return sp.oo if start is -sp.oo else sp.factor_terms(sp.simplify(found.subs(nu, high) - start))
