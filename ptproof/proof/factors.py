"""Rational functions as products of irreducible polynomials, factored by FLINT."""

from __future__ import annotations

from functools import lru_cache

import sympy as sp
from flint import Ordering, fmpz_mpoly_ctx


@lru_cache(maxsize=2**14)
def factored(expression: sp.Expr) -> sp.Expr:
    """What SymPy's ``factor(together(expression))`` is, in a tenth of the time.

    >>> x, y = sp.symbols("x y")
    >>> factored(x**2 - y**2), factored(2 / x + 2 / y), factored(-x - y)
    ((x - y)*(x + y), 2*(x + y)/(x*y), -x - y)
    """
    whole = sp.together(expression)
    number: sp.Expr = sp.S.One
    factors: list[sp.Expr] = []
    for part in sp.Mul.make_args(whole):
        base, exponent = part.as_base_exp() if isinstance(part, sp.Pow) and part.exp.is_Integer else (part, sp.S.One)
        if base.is_Rational:
            number *= part
        elif base.is_Symbol:
            factors.append(part)
        elif (found := _irreducible(base)) is None:
            return sp.factor(whole)
        else:
            coefficient, some = found
            number *= sp.Integer(coefficient) ** exponent
            factors += [factor ** (multiplicity * exponent) for factor, multiplicity in some]
    product = sp.Mul(*factors)
    # SymPy would multiply a number into a sum that stands beside it alone.
    alone = product.is_Add and number not in (sp.S.One, sp.S.NegativeOne)
    return sp.Mul(number, product, evaluate=not alone)


def _irreducible(polynomial: sp.Expr) -> tuple[int, list[tuple[sp.Expr, int]]] | None:
    """A sum as an integer and irreducible polynomials with their multiplicities; None for another."""
    if not polynomial.is_Add:
        return None
    try:
        read = sp.Poly(polynomial)
    except sp.PolynomialError:
        return None
    if not read.domain.is_ZZ:
        return None
    context = fmpz_mpoly_ctx.get([f"x{i}" for i in range(len(read.gens))], Ordering.lex)
    constant, found = context.from_dict({powers: int(number) for powers, number in read.terms()}).factor()
    coefficient, factors = int(constant), []
    for factor, multiplicity in found:
        if factor.leading_coefficient() < 0:
            factor, coefficient = -factor, coefficient * (-1) ** int(multiplicity)
        terms = {powers: int(number) for powers, number in factor.to_dict().items()}
        factors.append((sp.Poly.from_dict(terms, *read.gens).as_expr(), int(multiplicity)))
    return coefficient, factors
