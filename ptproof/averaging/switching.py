"""Signals that switch: Piecewise, Abs, sign, Max, Min, Mod, floor and triangle waves become smooth pieces.

A switch is resolved by the signs of some functions and by the integer parts of others. The exact route
decides these between exact switching points, the enclosure decides them on balls; the rewriting is one.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import sympy as sp
from sympy.core.relational import Relational

from ptproof.averaging.quasipolynomial import exact_sign, linear_part, read
from ptproof.averaging.refusal import AveragingUndecided
from ptproof.balls.ball import enclose

_SIMPLE = (sp.Piecewise, sp.Abs, sp.sign, sp.Max, sp.Min, sp.Mod, sp.floor, sp.Heaviside)
_WAVES = {(sp.asin, sp.sin), (sp.acos, sp.cos), (sp.atan, sp.tan)}
_MOST_PIECES = 4096
_BITS = 96

SignOf = Callable[[sp.Expr], int | None]
FloorOf = Callable[[sp.Expr], int | None]


def has_switch(expression: sp.Basic, variable: sp.Symbol) -> bool:
    """Whether ``expression`` switches as ``variable`` moves."""
    return any(_is_switch(node, variable) for node in sp.preorder_traversal(expression))


def _is_switch(node: sp.Basic, variable: sp.Symbol) -> bool:
    if variable not in node.free_symbols:
        return False
    return isinstance(node, _SIMPLE) or (bool(node.args) and (node.func, node.args[0].func) in _WAVES)


def _innermost(expression: sp.Expr, variable: sp.Symbol) -> sp.Basic | None:
    for node in sp.preorder_traversal(expression):
        if _is_switch(node, variable) and not any(
            _is_switch(inner, variable) for arg in node.args for inner in sp.preorder_traversal(arg)
        ):
            return node
    return None


def _levels(node: sp.Basic) -> sp.Expr | None:
    """The expression whose integer part resolves ``node``, or None where signs resolve it."""
    if isinstance(node, sp.floor):
        return node.args[0]
    if isinstance(node, sp.Mod):
        return node.args[0] / node.args[1]
    if isinstance(node, sp.asin | sp.atan):
        return node.args[0].args[0] / sp.pi + sp.Rational(1, 2)
    if isinstance(node, sp.acos):
        return node.args[0].args[0] / sp.pi
    return None


def _sides(node: sp.Basic, variable: sp.Symbol) -> list[sp.Expr]:
    """The functions whose signs resolve ``node``."""
    if isinstance(node, sp.Piecewise):
        relations = set().union(*(condition.atoms(Relational) for _, condition in node.args))
        return [relation.lhs - relation.rhs for relation in sorted(relations, key=str)]
    if isinstance(node, sp.Max | sp.Min):
        return [left - right for left, right in itertools.combinations(node.args, 2)]
    return [node.args[0]]


def _rewrite(node: sp.Basic, sign_of: SignOf, floor_of: FloorOf) -> sp.Expr | None:
    """``node`` without its switch, or None where a sign or an integer part is not known."""
    level = _levels(node)
    if level is not None:
        k = floor_of(level)
        if k is None:
            return None
        if isinstance(node, sp.floor):
            return sp.Integer(k)
        if isinstance(node, sp.Mod):
            return node.args[0] - k * node.args[1]
        angle = node.args[0].args[0] - k * sp.pi
        if isinstance(node, sp.atan):
            return angle
        if isinstance(node, sp.asin):
            return angle if k % 2 == 0 else -angle
        return angle if k % 2 == 0 else sp.pi - angle
    if isinstance(node, sp.Piecewise):
        return _branch(node, sign_of)
    if isinstance(node, sp.Max | sp.Min):
        best = node.args[0]
        for other in node.args[1:]:
            sign = sign_of(best - other)
            if sign is None:
                return None
            if (sign < 0) == isinstance(node, sp.Max):
                best = other
        return best
    sign = sign_of(node.args[0])
    if sign is None:
        return None
    if isinstance(node, sp.Abs):
        return sign * node.args[0]
    return sp.Integer(sign) if isinstance(node, sp.sign) else sp.Rational(1 + sign, 2)


def _branch(node: sp.Piecewise, sign_of: SignOf) -> sp.Expr | None:
    for value, condition in node.args:
        known: dict[sp.Basic, sp.Basic] = {}
        for relation in condition.atoms(Relational):
            sign = sign_of(relation.lhs - relation.rhs)
            if sign is None:
                return None
            known[relation] = sp.sympify(relation.func(sign, 0))
        truth = condition.xreplace(known)
        if truth == sp.true:
            return value
        if truth != sp.false:
            return None
    raise AveragingUndecided(f"{node} has no value where none of its conditions holds; end it with (value, True)")


def resolve(expression: sp.Expr, variable: sp.Symbol, sign_of: SignOf, floor_of: FloorOf) -> sp.Expr | None:
    """``expression`` without switches where all signs and integer parts are known, else None."""
    while (node := _innermost(expression, variable)) is not None:
        replacement = _rewrite(node, sign_of, floor_of)
        if replacement is None:
            return None
        expression = expression.xreplace({node: replacement})
    return expression


def pieces(
    expression: sp.Expr, variable: sp.Symbol, start: sp.Expr, end: sp.Expr, where: str
) -> Iterator[tuple[sp.Expr, sp.Expr, sp.Expr]]:
    """The smooth pieces (from, to, expression) of ``expression`` on [start, end], from left to right.

    The end points are exact. Raises :class:`AveragingUndecided`, naming ``where``, if a switching point
    depends on a symbol or is no root of a polynomial or of a single sinusoid.
    """
    node = _innermost(expression, variable)
    if node is None:
        yield start, end, expression
        return
    points = _switching_points(node, variable, start, end, where)
    if len(points) > _MOST_PIECES:
        raise AveragingUndecided(f"{where}: more than {_MOST_PIECES} switching points in a period")
    for left, right in itertools.pairwise([start, *points, end]):
        middle = _between(left, right)

        def sign_of(side: sp.Expr, middle: sp.Rational = middle) -> int:
            return exact_sign(side.subs(variable, middle))

        def floor_of(level: sp.Expr, middle: sp.Rational = middle) -> int:
            return int(sp.floor(level.subs(variable, middle)))

        replacement = _rewrite(node, sign_of, floor_of)
        assert replacement is not None  # both callbacks always answer
        yield from pieces(expression.xreplace({node: replacement}), variable, left, right, where)


def _between(left: sp.Expr, right: sp.Expr) -> sp.Rational:
    """A rational number strictly between two exact numbers."""
    for digits in (20, 60):
        middle = sp.Rational(str(((left + right) / 2).evalf(digits)))
        if exact_sign(middle - left) > 0 and exact_sign(right - middle) > 0:
            return middle
    raise AveragingUndecided(f"{left} and {right} are too close to each other")


def _switching_points(node: sp.Basic, variable: sp.Symbol, start: sp.Expr, end: sp.Expr, where: str) -> list[sp.Expr]:
    """The exact points strictly inside (start, end) where ``node`` may switch, ascending, each once."""
    level = _levels(node)
    if level is not None:
        candidates = _level_crossings(level, variable, start, end, where)
    else:
        candidates = [
            root
            for side in _sides(node, variable)
            if variable in side.free_symbols
            for root in zeros(side, variable, start, end, where)
        ]
        for side in _sides(node, variable):
            if variable not in side.free_symbols and not side.is_number:
                raise AveragingUndecided(f"{where}: which branch of {node} holds depends on symbols")
    inside = [root for root in candidates if exact_sign(root - start) > 0 and exact_sign(end - root) > 0]
    ordered = sorted(inside, key=functools.cmp_to_key(_order))
    distinct: list[sp.Expr] = []
    for point in ordered:
        if not distinct or exact_sign(point - distinct[-1]) > 0:
            distinct.append(point)
    return distinct


def _order(a: sp.Expr, b: sp.Expr) -> int:
    return exact_sign(a - b)


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
        return [root for root in sp.roots(polynomial) if root.is_real]
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


def decide_on_ball(variable: sp.Symbol, ball: Any, values: Mapping[sp.Symbol, Any]) -> tuple[SignOf, FloorOf]:
    """Callbacks for :func:`resolve` that answer only what holds on the whole ``ball``."""

    def at(expression: sp.Expr, where: Any) -> Any:
        return enclose(expression, {**values, variable: where}, bits=_BITS)

    def sign_of(side: sp.Expr) -> int | None:
        if (sign := _sign(at(side, ball))) is not None:
            return sign
        # A monotone function has on the whole ball the sign that it has at both ends.
        if variable not in side.free_symbols or _sign(at(_slope(side, variable), ball)) is None:
            return None
        first, last = (_sign(at(side, end)) for end in (ball.lower(), ball.upper()))
        return first if first == last else None

    def floor_of(level: sp.Expr) -> int | None:
        ends = [at(level, end).floor().unique_fmpz() for end in (ball.lower(), ball.upper())]
        if linear_part(level, variable) is None or ends[0] is None or ends[0] != ends[1]:
            return None
        return int(ends[0])

    return sign_of, floor_of


def _sign(ball: Any) -> int | None:
    return 1 if ball > 0 else -1 if ball < 0 else None


@functools.lru_cache(maxsize=1024)
def _slope(side: sp.Expr, variable: sp.Symbol) -> sp.Expr:
    return sp.diff(side, variable)
