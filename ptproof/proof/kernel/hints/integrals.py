"""Hints for integrals: an antiderivative of each, the inner ones first; Coq differentiates it again."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable

import sympy as sp

from ptproof.proof.kernel.names import Names
from ptproof.proof.kernel.terms import NoTranslation, term
from ptproof.proof.statement import Relation


def integrals(relations: Iterable[Relation], names: Names) -> list[str]:
    """The lines for every integral between finite ends in the relations."""
    sides = (side for relation in relations for side in (relation.left, relation.right))
    found = [part for side in sides for part in sp.preorder_traversal(side) if isinstance(part, sp.Integral)]
    lines: dict[str, None] = {}
    for integral in reversed(found):
        with contextlib.suppress(NoTranslation):
            lines.update(dict.fromkeys(_lines(integral, names)))
    return list(lines)


def _lines(integral: sp.Integral, names: Names) -> list[str]:
    """That the integrand is a plain function, and that this one has an antiderivative."""
    if len(integral.limits) != 1 or len(integral.limits[0]) != 3 or integral.limits[0][2].is_infinite:
        raise NoTranslation("no hint for such an integral")
    variable = integral.limits[0][0]
    name = names[variable]
    plain = _plain(integral.function)
    antiderivative = sp.integrate(sp.expand(plain), variable)
    if antiderivative.has(sp.Integral, sp.Piecewise):
        raise NoTranslation("no antiderivative")

    def function(expression: sp.Basic) -> str:
        return f"(fun {name} => {term(expression, names)})"

    lines = [f"integral {function(plain)} {function(antiderivative)}"]
    if plain != integral.function:
        lines.insert(0, f"integrand {function(integral.function)} {function(plain)}")
    return [f"try ({line})" for line in lines]


def _plain(expression: sp.Basic) -> sp.Basic:
    """The expression with every inner integral carried out."""
    if isinstance(expression, sp.Integral):
        ((variable, lower, upper),) = expression.limits
        found = sp.integrate(sp.expand(_plain(expression.function)), variable)
        return found.subs(variable, upper) - found.subs(variable, lower)
    if not expression.has(sp.Integral):
        return expression
    return expression.func(*map(_plain, expression.args))
