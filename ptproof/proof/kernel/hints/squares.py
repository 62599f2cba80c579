"""A polynomial of degree two in variables of unknown sign, as a sum of squares and a rest of plain sign."""

from __future__ import annotations

from functools import lru_cache

import sympy as sp

from ptproof.proof.kernel.hints.goals import as_factors, is_shown


@lru_cache(maxsize=1024)  # one gap is looked at in several ways
def sum_of_squares(expression: sp.Expr) -> sp.Expr | None:
    """The same with one square completed after the other, where what stands before each is positive."""
    top, bottom = sp.fraction(as_factors(expression))
    variables = sorted((s for s in top.free_symbols if s.is_nonnegative is None), key=lambda s: s.name)
    rest = sp.expand(top)
    if not variables or not is_shown(bottom, strictly=True) or not rest.is_polynomial(*variables):
        return None
    if sp.Poly(rest, *variables).total_degree() > 2:
        return None
    squares: list[sp.Expr] = []
    for variable in variables:
        form = sp.Poly(rest, variable)
        first, second, last = (form.coeff_monomial(variable**n) for n in (2, 1, 0))
        if first == 0 and second == 0:
            continue
        first, second = as_factors(first), as_factors(second)
        if not is_shown(first, strictly=True):
            return None
        squares.append(first * (variable + as_factors(second / (2 * first))) ** 2)
        rest = sp.together(last - second**2 / (4 * first))
        above, below = sp.fraction(rest)
        rest = sp.expand(above) / as_factors(below) if below.free_symbols else sp.expand(rest)
        rest = sum((as_factors(part) for part in _collected(rest, variables)), sp.Integer(0))
    if not is_shown(rest):
        return None
    return sp.Add(*squares, rest) / bottom


def _collected(expression: sp.Expr, variables: list[sp.Symbol]) -> list[sp.Expr]:
    """The terms by the powers of the variables."""
    above, below = sp.fraction(sp.together(expression))
    form = sp.Poly(above, *variables)
    return [
        sp.prod(v**n for v, n in zip(variables, powers, strict=True)) * value / below for powers, value in form.terms()
    ]
