"""Signals that switch: Piecewise, Abs, sign, Max, Min, Mod, floor and triangle waves become smooth pieces.

A switch is resolved by the signs of some functions and by the integer parts of others, which are decided between
exact switching points.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import sympy as sp

from ptproof.averaging.quasipolynomial import exact_sign, linear_part, ordered, read
from ptproof.averaging.refusal import AveragingUndecided
from ptproof.proof.kinks import branch, innermost, level, switching

_MOST_PIECES = 4096


def pieces(
    expression: sp.Expr, variable: sp.Symbol, start: sp.Expr, end: sp.Expr, where: str
) -> Iterator[tuple[sp.Expr, sp.Expr, sp.Expr]]:
    """The smooth pieces (from, to, expression) of ``expression`` on [start, end], from left to right.

    The end points are exact. Raises :class:`AveragingUndecided`, naming ``where``, if a switching point
    depends on a symbol or is no root of a polynomial or of a single sinusoid.
    """
    node = innermost(expression, {variable})
    if node is None:
        yield start, end, expression
        return
    points = _switching_points(node, variable, start, end, where)
    if len(points) > _MOST_PIECES:
        raise AveragingUndecided(f"{where}: more than {_MOST_PIECES} switching points in a period")
    for point in (start, *points):
        _value_at(node, variable, point, where)
    for left, right in itertools.pairwise([start, *points, end]):
        replacement = branch_at(node, variable, between(left, right))
        assert replacement is not None  # signs and integer parts always answer
        if replacement.has(sp.nan):
            raise _no_value(node, where)
        yield from pieces(expression.xreplace({node: replacement}), variable, left, right, where)


def _no_value(node: sp.Basic, where: str) -> AveragingUndecided:
    return AveragingUndecided(
        f"{where}: {node} has no value where none of its conditions holds; end it with (value, True)"
    )


def _value_at(node: sp.Basic, variable: sp.Symbol, point: sp.Expr, where: str) -> None:
    """Refuse a ``Piecewise`` that has no value at a point where it switches."""
    if isinstance(node, sp.Piecewise):
        there = branch_at(node, variable, point)
        if there is None or there.has(sp.nan):
            raise _no_value(node, where)


def branch_at(node: sp.Basic, variable: sp.Symbol, point: sp.Expr) -> sp.Expr | None:
    """What holds of a switch at an exact place; None where none of its conditions does."""
    return branch(
        node,
        lambda side: exact_sign(side.subs(variable, point)),
        lambda counted: int(sp.floor(counted.subs(variable, point))),
    )


def between(left: sp.Expr, right: sp.Expr) -> sp.Rational:
    """A rational number strictly between two exact numbers."""
    for digits in (20, 60):
        middle = sp.Rational(str(((left + right) / 2).evalf(digits)))
        if exact_sign(middle - left) > 0 and exact_sign(right - middle) > 0:
            return middle
    raise AveragingUndecided(f"{left} and {right} are too close to each other")


def _switching_points(node: sp.Basic, variable: sp.Symbol, start: sp.Expr, end: sp.Expr, where: str) -> list[sp.Expr]:
    """The exact points strictly inside (start, end) where ``node`` may switch, ascending, each once."""
    counted, candidates = level(node), []
    if counted is not None:
        candidates = _level_crossings(counted, variable, start, end, where)
    for side in () if counted is not None else switching(node):
        if variable in side.free_symbols:
            candidates += zeros(side, variable, start, end, where)
        elif not side.is_number:
            raise AveragingUndecided(f"{where}: which branch of {node} holds depends on symbols")
    return ordered(root for root in candidates if exact_sign(root - start) > 0 and exact_sign(end - root) > 0)


def _real_roots(polynomial: sp.Poly, where: str) -> list[sp.Expr]:
    """The real roots of a polynomial of degree 1 or 2, by the sign of its discriminant."""
    if polynomial.degree() == 2 and exact_sign(polynomial.discriminant()) < 0:
        return []
    roots = list(sp.roots(polynomial))
    if any(root.is_real is False for root in roots):
        raise AveragingUndecided(f"{where}: the zeros of {polynomial.as_expr()} are not known exactly")
    return roots


def _level_crossings(level: sp.Expr, variable: sp.Symbol, start: sp.Expr, end: sp.Expr, where: str) -> list[sp.Expr]:
    linear = linear_part(level, variable)
    if linear is None or not (linear[0].is_number and linear[1].is_number):
        raise AveragingUndecided(f"{where}: the switching points of floor({level}) are not known exactly")
    slope, offset = linear
    ends = sorted(int(sp.floor(level.subs(variable, point))) for point in (start, end))
    if ends[1] - ends[0] > _MOST_PIECES:
        raise AveragingUndecided(f"{where}: more than {_MOST_PIECES} switching points in a period")
    return [(k - offset) / slope for k in range(ends[0], ends[1] + 2)]


def zeros(side: sp.Expr, variable: sp.Symbol, start: sp.Expr, end: sp.Expr, where: str) -> list[sp.Expr]:
    """All zeros of ``side`` in [start, end] (and possibly more points), exactly."""
    if side.is_Mul:
        parts = [factor for factor in side.args if variable in factor.free_symbols]
        if len(parts) > 1 or parts[0] != side:
            return [root for part in parts for root in zeros(part, variable, start, end, where)]
    terms = read(side, variable, where).terms
    if any(not (a.is_number and b.is_number) for a, b in terms.values()):
        raise AveragingUndecided(f"{where}: the switching points of {side} depend on symbols")
    rates = {rate for _, rate in terms} - {sp.S.Zero}
    if not rates:
        polynomial = sp.Poly(side, variable)
        if polynomial.degree() > 2:
            raise AveragingUndecided(f"{where}: the switching points of {side} are not known exactly")
        return _real_roots(polynomial, where)
    if len(rates) > 1 or any(n for n, _ in terms):
        raise AveragingUndecided(f"{where}: the switching points of {side} are not known exactly")
    (rate,) = rates
    a, b = terms[0, rate]
    constant = terms.get((0, sp.S.Zero), (sp.S.Zero, sp.S.Zero))[0]
    amplitude, shift = sp.sqrt(a**2 + b**2), sp.atan2(b, a)
    ratio = sp.simplify(-constant / amplitude)
    if exact_sign(ratio - 1) > 0 or exact_sign(ratio + 1) < 0:
        return []
    half = sp.acos(ratio)
    low = int(sp.floor((rate * start) / (2 * sp.pi))) - 1
    high = int(sp.floor((rate * end) / (2 * sp.pi))) + 1
    return [sp.expand((shift + sign * half + 2 * sp.pi * k) / rate) for k in range(low, high + 1) for sign in (1, -1)]
