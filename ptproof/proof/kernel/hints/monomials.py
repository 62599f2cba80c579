"""Sums of products of powers, in one form: what the hints about inequalities between such sums calculate with."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.kernel.hints.goals import as_factors

Exponents = Mapping[sp.Basic, sp.Expr]


def summands(expression: sp.Basic) -> dict[sp.Expr, sp.Rational]:
    """Monomials with their rational factors; a sum is multiplied out unless it is not negative as a whole."""
    found: dict[sp.Expr, sp.Rational] = {}
    for product in _split(sp.sympify(expression)):
        factor, monomial = monomial_of(product).as_coeff_Mul(rational=True)
        found[monomial] = found.get(monomial, sp.Integer(0)) + factor
    return {monomial: factor for monomial, factor in found.items() if factor != 0}


def total(parts: Mapping[sp.Expr, sp.Rational]) -> sp.Expr:
    """The sum again."""
    return sp.Add(*(factor * monomial for monomial, factor in parts.items()))


def monomial_of(product: sp.Expr) -> sp.Expr:
    """The product with every base once, its exponent in one form."""
    factor, exponents = powers(product)
    return sp.Mul(factor, *(base**exponent for base, exponent in exponents.items()))


def powers(product: sp.Expr) -> tuple[sp.Rational, dict[sp.Basic, sp.Expr]]:
    """A rational factor, and the exponents of all other bases. An exponential is a base of its own."""
    factor, exponents = sp.Integer(1), dict[sp.Basic, sp.Expr]()

    def add(part: sp.Basic, times: sp.Expr) -> None:
        nonlocal factor
        if part.is_Mul and (times.is_Integer or part.is_positive):
            for item in part.args:
                add(item, times)
        elif isinstance(part, sp.Pow) and (times.is_Integer or part.base.is_positive):
            add(part.base, times * part.exp)
        elif part.is_Rational and times.is_Integer:
            factor *= part**times
        elif part.is_Rational and part.q != 1 and part.is_positive:
            add(sp.Integer(part.p), times)
            add(sp.Integer(part.q), -times)
        elif part != 1:
            plain, base = _plain(part) if part.is_Add else (sp.Integer(1), part)
            if base.is_Add and base.is_negative and times.is_even:
                base = -base
            if plain != 1:
                add(plain, times)
            exponents[base] = exponents.get(base, sp.Integer(0)) + times

    add(product, sp.Integer(1))
    tidy = {base: _tidy(exponent) for base, exponent in exponents.items()}
    return factor, {base: exponent for base, exponent in tidy.items() if exponent != 0}


def difference(a: Exponents, b: Exponents) -> dict[sp.Basic, sp.Expr]:
    """The exponents of the quotient."""
    bases = dict.fromkeys([*a, *b])
    found = {base: _tidy(a.get(base, sp.Integer(0)) - b.get(base, sp.Integer(0))) for base in bases}
    return {base: exponent for base, exponent in found.items() if exponent != 0}


def product_of(exponents: Exponents) -> sp.Expr:
    """The product again."""
    return sp.Mul(*(base**exponent for base, exponent in exponents.items()))


def _plain(part: sp.Expr) -> tuple[sp.Rational, sp.Expr]:
    """A rational factor, and the sum without it: with the constant 1, where there is a positive one."""
    constant = part.as_coeff_Add()[0]
    if constant > 0:
        return constant, sp.Add(*(item / constant for item in part.args))
    plain, base = part.primitive()
    return plain, base


def _tidy(exponent: sp.Expr) -> sp.Expr:
    return exponent if exponent.is_Rational else as_factors(exponent)


def _split(expression: sp.Expr) -> list[sp.Expr]:
    if expression.is_Add:
        return [part for item in expression.args for part in _split(item)]
    if expression.is_Mul:
        found = [sp.Integer(1)]
        for item in expression.args:
            if item.is_Add and not any(map(_open, sp.Mul.make_args(joined := as_factors(item)))):
                item = joined
            found = [a * b for a in found for b in (_split(item) if _open(item) else [item])]
        return found
    if _open(expression) and isinstance(expression, sp.Pow):
        return _split(sp.expand_multinomial(expression))
    return [expression]


def _open(expression: sp.Expr) -> bool:
    """Whether the factor is multiplied out: a sum of unknown sign or of many letters, or a power of one."""
    if expression.is_Pow and expression.base.is_Add and expression.exp.is_Integer and expression.exp > 0:
        return _open(expression.base)
    short = len(expression.free_symbols) <= 3 and not expression.atoms(sp.exp, AppliedUndef)
    return bool(expression.is_Add and not (expression.is_nonnegative and short))
