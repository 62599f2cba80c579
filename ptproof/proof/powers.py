"""Powers with exponents that are not integers: read apart, and split as far as the assumptions of their bases allow."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import sympy as sp


def symbolic_power(node: sp.Expr) -> tuple[sp.Expr, sp.Expr] | None:
    """Base and exponent of a power whose exponent is not an integer, the exponential among them; None for the rest."""
    if isinstance(node, sp.exp):
        return sp.E, node.args[0]
    if isinstance(node, sp.Pow) and not node.exp.is_Integer:
        return node.base, node.exp
    return None


@lru_cache(maxsize=4096)
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
    return expression.replace(
        lambda node: isinstance(node, sp.Pow) and bool(node.exp.free_symbols) and node.exp.is_rational_function(),
        lambda node: node.base ** sp.cancel(node.exp),
    )


@lru_cache(maxsize=4096)
def fraction(exponent: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """Numerator and denominator of an exponent."""
    return sp.fraction(sp.together(exponent))


@lru_cache(maxsize=4096)
def _factored(base: sp.Expr) -> sp.Expr:
    return sp.factor(sp.together(base))


@lru_cache(maxsize=4096)
def split_powers(expression: sp.Expr) -> sp.Expr:
    """Give every power a base that is one positive factor where SymPy's assumptions allow to split it."""

    def split(node: sp.Expr) -> sp.Expr:
        base, exponent = node.base, node.exp
        if exponent.is_Integer:
            return node
        if isinstance(base, sp.Pow) and base.base.is_positive and base.exp.is_real:
            return split(sp.Pow(base.base, sp.expand(base.exp * exponent), evaluate=False))
        if isinstance(base, sp.exp) and base.args[0].is_real:
            return sp.exp(base.args[0] * exponent)
        if not base.is_Symbol and not base.is_number:
            base = _factored(base)
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

    return expression.replace(lambda node: isinstance(node, sp.Pow), split)


def positive_multiples(exponents: Sequence[sp.Expr]) -> bool:
    """Whether the exponents are positive rational multiples of the first, which is no number."""
    first, *others = exponents
    ratios = (sp.cancel(exponent / first) for exponent in others)
    return not first.is_number and all(ratio.is_Rational and ratio.is_positive for ratio in ratios)
