"""Pieces that are glued smoothly: E₊ where g > 0 and E₋ where g < 0, with E₊ − E₋ divisible by g^(order+1)."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from ptproof.proof.kinks import SignOf, is_kink, level, resolved, switching
from ptproof.proof.signs import vanishes


def glued_smoothly(
    term: sp.Expr, variables: frozenset[sp.Symbol], order: int, is_smooth: Callable[[sp.Expr], bool]
) -> bool:
    """Whether ``term`` is C^order because its kinks, all at the zeros of one g, cancel to that order.

    ``is_smooth`` decides about expressions without these kinks. True is a proof: with D = E₊ − E₋ = g^(order+1) q
    and q smooth, the term is E₋ + max(g, 0)^(order+1) q, and the values on g = 0 are checked separately.
    """
    kinks = [node for node in sp.preorder_traversal(term) if is_kink(node, variables)]
    sides = {_canonical(side) for node in kinks for side in switching(node)}
    if len(sides) != 1 or any(level(node) is not None for node in kinks):
        return False
    (side,) = sides
    branches = []
    for sign in (1, -1, 0):
        branch = resolved(term, variables, _signs(side, sign))
        if branch is None or branch.has(sp.nan):
            return False
        branches.append(branch)
    plus, minus, on = branches
    if not (is_smooth(side) and is_smooth(plus) and is_smooth(minus)):
        return False
    return _divisible(plus - minus, side, order + 1) and _divisible(on - plus, side, 1)


def _canonical(side: sp.Expr) -> sp.Expr:
    side = sp.expand(side)
    return -side if side.could_extract_minus_sign() else side


def _signs(side: sp.Expr, sign: int) -> SignOf:
    known = {side: sign, sp.expand(-side): -sign}
    return lambda entry: known.get(sp.expand(entry))


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
