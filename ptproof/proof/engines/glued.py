"""Pieces that are glued smoothly: E₊ where g > 0 and E₋ where g < 0, with E₊ − E₋ divisible by g^(order+1)."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp
from sympy.core.relational import Relational

from ptproof.proof.signs import vanishes

KINKS = (sp.Abs, sp.sign, sp.Heaviside, sp.Max, sp.Min, sp.Piecewise)


def glued_smoothly(
    term: sp.Expr, variables: frozenset[sp.Symbol], order: int, is_smooth: Callable[[sp.Expr], bool]
) -> bool:
    """Whether ``term`` is C^order because its kinks, all at the zeros of one g, cancel to that order.

    ``is_smooth`` decides about expressions without these kinks. True is a proof: with D = E₊ − E₋ = g^(order+1) q
    and q smooth, the term is E₋ + max(g, 0)^(order+1) q, and the values on g = 0 are checked separately.
    """
    kinks = [node for node in term.atoms(*KINKS) if node.free_symbols & variables]
    sides = {_canonical(g) for node in kinks for g in _sides(node)}
    if len(sides) != 1 or None in sides:
        return False
    (side,) = sides
    assert side is not None
    branches = []
    for sign in (1, -1, 0):
        branch: sp.Expr | None = term
        while branch is not None and (inner := _innermost(branch, variables)) is not None:
            replacement = _choose(inner, side, sign)
            branch = None if replacement is None else branch.xreplace({inner: replacement})
        if branch is None:
            return False
        branches.append(branch)
    plus, minus, on = branches
    if not (is_smooth(side) and is_smooth(plus) and is_smooth(minus)):
        return False
    return _divisible(plus - minus, side, order + 1) and _divisible(on - plus, side, 1)


def _canonical(side: sp.Expr | None) -> sp.Expr | None:
    if side is None:
        return None
    side = sp.expand(side)
    return -side if side.could_extract_minus_sign() else side


def _sides(node: sp.Basic) -> list[sp.Expr | None]:
    if isinstance(node, sp.Max | sp.Min):
        return [node.args[0] - node.args[1]] if len(node.args) == 2 else [None]
    if isinstance(node, sp.Piecewise):
        return [
            relation.lhs - relation.rhs if isinstance(relation, sp.Lt | sp.Le | sp.Gt | sp.Ge) else None
            for _, condition in node.args
            for relation in condition.atoms(Relational)
        ]
    return [node.args[0]]


def _innermost(expression: sp.Expr, variables: frozenset[sp.Symbol]) -> sp.Basic | None:
    for node in expression.atoms(*KINKS):
        if node.free_symbols & variables and not any(arg.has(*KINKS) for arg in node.args):
            return node
    return None


def _choose(node: sp.Basic, side: sp.Expr, sign: int) -> sp.Expr | None:
    """``node`` where ``side`` has the given sign."""

    def sign_of(entry: sp.Expr) -> int | None:
        entry = sp.expand(entry)
        return sign if entry == side else -sign if entry == sp.expand(-side) else None

    if isinstance(node, sp.Piecewise):
        for value, condition in node.args:
            known = {}
            for relation in condition.atoms(Relational):
                there = sign_of(relation.lhs - relation.rhs)
                if there is None:
                    return None
                known[relation] = sp.sympify(relation.func(there, 0))
            if condition.xreplace(known) == sp.true:
                return value
        return None
    there = sign_of(node.args[0] - node.args[1] if isinstance(node, sp.Max | sp.Min) else node.args[0])
    if there is None:
        return None
    if isinstance(node, sp.Max | sp.Min):
        return node.args[0] if (there >= 0) == isinstance(node, sp.Max) else node.args[1]
    if isinstance(node, sp.Abs):
        return node.args[0] if there >= 0 else -node.args[0]  # both where it is 0
    return sp.Integer(there) if isinstance(node, sp.sign) else sp.Rational(1 + there, 2)


def _divisible(difference: sp.Expr, side: sp.Expr, power: int) -> bool:
    """Whether difference = side^power · (polynomial in the symbols and in smooth functions)."""
    if vanishes(difference):
        return True
    try:
        generators = sorted(side.free_symbols, key=lambda symbol: symbol.name)
        numerator = sp.Poly(sp.expand(difference), *generators)
        return bool(sp.rem(numerator, sp.Poly(side, *generators) ** power, *generators) == 0)
    except sp.PolynomialError:
        return False
