"""Powers with exponents that are not integers: read apart, and split as far as the assumptions of their bases allow."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import sympy as sp

from ptproof.proof.factors import factored
from ptproof.proof.rewriting import everywhere


def symbolic_power(node: sp.Expr) -> tuple[sp.Expr, sp.Expr] | None:
    """Base and exponent of a power whose exponent is not an integer, the exponential among them; None for the rest."""
    if isinstance(node, sp.exp):
        return sp.E, node.args[0]
    if isinstance(node, sp.Pow) and not node.exp.is_Integer:
        return node.base, node.exp
    return None


@lru_cache(maxsize=2**14)
def exponent_terms(exponent: sp.Expr, common: sp.Expr) -> tuple[tuple[sp.Expr, sp.Rational], ...]:
    """The terms of ``exponent`` times ``common``, each a monomial with its rational coefficient."""
    numerator = sp.expand(sp.cancel(exponent * common))
    pairs = (term.as_coeff_Mul(rational=True) for term in sp.Add.make_args(numerator))
    return tuple((monomial, sp.Rational(coefficient)) for coefficient, monomial in pairs)


def reduced(expression: sp.Expr) -> sp.Expr:
    """Every exponent with symbols in lowest terms: equal ones are then one, also in the base of another power.

    Equal where both are defined, as everything in this algebra.

    >>> n, x = sp.symbols("n x", positive=True)
    >>> reduced((1 + x ** (2 * n / (2 * n + 2))) ** n)
    (x**(n/(n + 1)) + 1)**n
    """
    return _reduced(expression)


def _lowest(node: sp.Pow) -> sp.Expr:
    exponent = _cancelled(node.exp)
    return node if exponent == node.exp else node.base**exponent


@lru_cache(maxsize=2**14)
def _cancelled(exponent: sp.Expr) -> sp.Expr:
    """An exponent in lowest terms, if it has symbols and is a rational function of them."""
    if exponent.is_Symbol or not exponent.free_symbols or not exponent.is_rational_function():
        return exponent
    return sp.cancel(exponent)


_reduced = everywhere(sp.Pow, _lowest)


@lru_cache(maxsize=2**14)
def fraction(exponent: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """Numerator and denominator of an exponent."""
    return sp.fraction(sp.together(exponent))


def split_powers(expression: sp.Expr) -> sp.Expr:
    """Give every power a base that is one positive factor where SymPy's assumptions allow to split it."""
    return _splitted(expression)


def _split(node: sp.Pow) -> sp.Expr:
    base, exponent = node.base, node.exp
    if exponent.is_Integer:
        return node
    if isinstance(base, sp.Pow) and base.base.is_positive and base.exp.is_real:
        return _split(sp.Pow(base.base, sp.expand(base.exp * exponent), evaluate=False))
    if isinstance(base, sp.exp) and base.args[0].is_real:
        return sp.exp(base.args[0] * exponent)
    if not base.is_Symbol and not base.is_number:
        base = factored(base)
    positive = [factor for factor in sp.Mul.make_args(base) if factor.is_positive]
    rest = sp.Mul(*(factor for factor in sp.Mul.make_args(base) if not factor.is_positive))
    factors: list[sp.Expr] = []
    for factor in positive:
        inner, power = factor.as_base_exp()
        if factor.is_Rational and factor.q != 1:
            factors += [sp.Integer(factor.p) ** exponent, sp.Integer(factor.q) ** (-exponent)]
        elif power != 1 and inner.is_positive and power.is_real:
            factors.append(inner ** sp.expand(power * exponent))
        else:
            factors.append(factor**exponent)
    if rest != 1:
        factors.append(rest**exponent)
    return sp.Mul(*factors)


_splitted = everywhere(sp.Pow, _split)


def positive_multiples(exponents: Sequence[sp.Expr]) -> bool:
    """Whether the exponents are positive rational multiples of the first, which is no number."""
    first, *others = exponents
    ratios = (sp.cancel(exponent / first) for exponent in others)
    return not first.is_number and all(ratio.is_Rational and ratio.is_positive for ratio in ratios)
