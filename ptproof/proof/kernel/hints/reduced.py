"""Expressions with their substitutions carried out, as Coq has them after beta reduction."""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from ptproof.proof.kernel.obligations import Part
from ptproof.proof.kernel.theorem import Proposition

# What binds a symbol.
BINDERS = (sp.Derivative, sp.Integral, sp.Limit, sp.Subs)


def reduced(expression: sp.Basic) -> sp.Basic:
    """The same without ``Subs``, but for those of what depends on the variable as something bound."""
    if not expression.has(sp.Subs):
        return expression
    arguments = [reduced(argument) for argument in expression.args]
    if not isinstance(expression, sp.Subs):
        return expression.func(*arguments)
    inner, points = reduced(expression.expr), [reduced(point) for point in expression.point]
    values = dict(zip(expression.variables, points, strict=True))
    if all(_apart(part, values) for part in inner.atoms(*BINDERS)):
        return inner.xreplace(values)
    return sp.Subs(inner, expression.variables, points)


def reduced_proposition(said: Proposition) -> Proposition:
    """The proposition as hints look at it: the substitutions in its relations are carried out, as Coq does at once."""

    def seen(part: Part) -> Part:
        return replace(part, relation=part.relation and part.relation.map(reduced))

    return replace(said, premises=tuple(map(seen, said.premises)), conclusions=tuple(map(seen, said.conclusions)))


def _apart(part: sp.Basic, values: dict[sp.Symbol, sp.Expr]) -> bool:
    """Whether putting in the values changes nothing that is bound, and nothing bound catches them."""
    match part:
        case sp.Derivative() | sp.Subs():
            bound = set(part.variables)
        case sp.Integral():
            bound = {limits[0] for limits in part.limits}
        case _:
            return False
    return not bound & set(values).union(*(value.free_symbols for value in values.values()))
