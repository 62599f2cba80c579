"""Pieces that are glued smoothly: E₊ where g > 0 and E₋ where g < 0, with E₊ − E₋ divisible by g^(order+1)."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from ptproof.proof.kinks import SignOf, is_kink, level, resolved, switching
from ptproof.proof.signs import vanishes

_BINDERS = (sp.Derivative, sp.Integral, sp.Subs, sp.Limit, sp.Sum, sp.Product, sp.Lambda)


def glued_smoothly(
    term: sp.Expr, variables: frozenset[sp.Symbol], order: int, is_smooth: Callable[[sp.Expr], bool]
) -> bool:
    """Whether ``term`` is C^order because its kinks, all at the zeros of one g, cancel to that order.

    ``is_smooth`` decides about expressions without these kinks. True is a proof: with D = E₊ − E₋ = g^(order+1) q
    and q smooth, the term is E₋ + max(g, 0)^(order+1) q, and the values on g = 0 are checked separately. Where the
    term is defined is not looked at.
    """
    if term.has(*_BINDERS):  # what is inside may be about a variable of its own
        return False
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
    return _divisible(plus - minus, side, order + 1, is_smooth) and _divisible(on - plus, side, 1, is_smooth)


def _canonical(side: sp.Expr) -> sp.Expr:
    side = sp.expand(side)
    return -side if side.could_extract_minus_sign() else side


def _signs(side: sp.Expr, sign: int) -> SignOf:
    known = {side: sign, sp.expand(-side): -sign}
    return lambda entry: known.get(sp.expand(entry))


def _divisible(difference: sp.Expr, side: sp.Expr, power: int, is_smooth: Callable[[sp.Expr], bool]) -> bool:
    """Whether difference = side^power · q, with q a polynomial in the symbols of ``side`` over smooth functions.

    The coefficients of q are sums of numbers times coefficients of the difference, which must be smooth themselves. A
    common denominator is left out, if its reciprocal is smooth as well: it stays where it is, under q.
    """
    if vanishes(difference):
        return True
    above, below = sp.fraction(sp.together(difference))
    if not (below.is_number or is_smooth(1 / below)):
        return False
    try:
        generators = sorted(side.free_symbols, key=lambda symbol: symbol.name)
        divisor = sp.Poly(side, *generators)
        numerator = sp.Poly(sp.expand(above), *generators)
        divides = bool(sp.rem(numerator, divisor**power, *generators) == 0)
    except sp.PolynomialError:
        return False
    return divides and all(value.is_number for value in divisor.coeffs()) and all(map(is_smooth, numerator.coeffs()))
