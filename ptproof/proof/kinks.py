"""Kinks: the functions that switch between smooth branches, what decides which, and the branch that applies.

Most are decided by the signs of some expressions (``Abs``, ``sign``, ``Heaviside``, ``Max``, ``Min``,
``Piecewise``), the others by the integer part of one (``floor``, ``ceiling``, ``Mod``, and waves such as
``asin(sin(u))``). Who asks says how signs and integer parts are decided: between exact points, on a ball, beside a
root, or at one instant.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Set
from typing import TypeAlias

import sympy as sp
from sympy.core.relational import Relational

KINKS = (sp.Abs, sp.sign, sp.Heaviside, sp.Max, sp.Min, sp.Piecewise, sp.floor, sp.ceiling, sp.Mod)
_WAVES = {(sp.asin, sp.sin), (sp.acos, sp.cos), (sp.atan, sp.tan)}

SignOf: TypeAlias = Callable[[sp.Expr], int | None]
FloorOf: TypeAlias = Callable[[sp.Expr], int | None]
Symbols: TypeAlias = Set[sp.Symbol]


def is_kink(node: sp.Basic, variables: Symbols) -> bool:
    """Whether ``node`` itself may switch as one of the variables moves."""
    return bool((isinstance(node, KINKS) or _is_wave(node)) and node.free_symbols & variables)


def _is_wave(node: sp.Basic) -> bool:
    return bool(node.args) and (node.func, node.args[0].func) in _WAVES


def innermost(expression: sp.Basic, variables: Symbols) -> sp.Expr | None:
    """A kink of the expression that has no other inside, or None where nothing switches."""
    return _innermost(expression, variables, set())


def _innermost(node: sp.Basic, variables: Symbols, seen: set[sp.Basic]) -> sp.Expr | None:
    if not node.args or node in seen:
        return None
    seen.add(node)
    inside = (found for part in node.args if (found := _innermost(part, variables, seen)) is not None)
    return next(inside, node if is_kink(node, variables) else None)


def level(node: sp.Basic) -> sp.Expr | None:
    """The expression whose integer part decides the branch of ``node``, or None where signs decide it."""
    match node:
        case sp.floor():
            return node.args[0]
        case sp.ceiling():
            return -node.args[0]
        case sp.Mod():
            return node.args[0] / node.args[1]
        case sp.asin() | sp.atan() if _is_wave(node):
            return node.args[0].args[0] / sp.pi + sp.Rational(1, 2)
        case sp.acos() if _is_wave(node):
            return node.args[0].args[0] / sp.pi
    return None


def switching(node: sp.Basic) -> list[sp.Expr]:
    """The expressions at whose zeros ``node`` may switch; for the integer part of a level, its steps at 0 and 1."""
    match node:
        case sp.Piecewise():
            relations = set().union(*(condition.atoms(Relational) for _, condition in node.args))
            return [relation.lhs - relation.rhs for relation in sorted(relations, key=str)]
        case sp.Max() | sp.Min():
            return [left - right for left, right in itertools.combinations(node.args, 2)]
    counted = level(node)
    return [node.args[0]] if counted is None else [counted, counted - 1]


def _none(_: sp.Expr) -> int | None:
    return None


def branch(node: sp.Expr, sign_of: SignOf, floor_of: FloorOf = _none) -> sp.Expr | None:
    """``node`` without its kink, or None where a sign or an integer part that is asked for is not known.

    The answer is ``nan`` for a ``Piecewise`` none of whose conditions holds.

    >>> x = sp.Symbol("x", real=True)
    >>> branch(abs(x), lambda side: -1), branch(sp.Max(x, 1), lambda side: 1 if side == 1 - x else -1)
    (-x, 1)
    """
    counted = level(node)
    if counted is not None:
        k = floor_of(counted)
        return None if k is None else _on_level(node, k)
    if isinstance(node, sp.Piecewise):
        return _piece(node, sign_of)
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
        return node.args[0] if sign >= 0 else -node.args[0]
    return node.func(sp.Integer(sign), *node.args[1:])  # a number: sign, or Heaviside with its value at 0


def _on_level(node: sp.Expr, k: int) -> sp.Expr:
    """The branch where the integer part of the level is k."""
    if isinstance(node, sp.floor | sp.ceiling):
        return sp.Integer(k if isinstance(node, sp.floor) else -k)
    if isinstance(node, sp.Mod):
        return node.args[0] - k * node.args[1]
    angle = node.args[0].args[0] - k * sp.pi
    if isinstance(node, sp.atan) or k % 2 == 0:
        return angle
    return -angle if isinstance(node, sp.asin) else sp.pi - angle


def _piece(node: sp.Piecewise, sign_of: SignOf) -> sp.Expr | None:
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
    return sp.nan


def resolved(expression: sp.Expr, variables: Symbols, sign_of: SignOf, floor_of: FloorOf = _none) -> sp.Expr | None:
    """``expression`` without kinks, from the inside out, where every sign and integer part is known, else None."""
    while (node := innermost(expression, variables)) is not None:
        replacement = branch(node, sign_of, floor_of)
        if replacement is None:
            return None
        expression = expression.xreplace({node: replacement})
    return expression
