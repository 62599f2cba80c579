"""Equalities by exact algebra: the difference of the two sides has the normal form 0.

That shows them equal wherever both are defined; that they are defined is an obligation of the claim, shown by whoever
asked (:mod:`ptproof.proof.deciding`).
"""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from ptproof.proof.algebra import NotAlgebraic, is_zero
from ptproof.proof.claim import Goal, engine
from ptproof.proof.statement import relations_of
from ptproof.proof.substitution import replaced
from ptproof.proof.verdict import Evidence, Verdict


@engine
def exact(goal: Goal) -> Evidence:
    """Show every equality of the goal; an assumption ``symbol = expression`` is substituted first."""
    given = definitions_in(goal)
    for part in relations_of(goal.statement):
        if part.sign != "=":
            return Evidence("exact algebra", Verdict.UNDECIDED, f"not an equality: {part}")
        try:
            shown = is_zero(resolve(part.left - part.right, given))
            reason = "the difference does not have the normal form 0"
        except NotAlgebraic as error:
            shown, reason = False, str(error)
        if not shown:
            return Evidence("exact algebra", Verdict.UNDECIDED, f"{part}: {reason}")
    detail = "the difference of the two sides has the normal form 0"
    return Evidence("exact algebra", Verdict.PROVED, detail)


def definitions_in(goal: Goal) -> dict[sp.Expr, sp.Expr]:
    """The assumptions of the form symbol = expression, or applied function = expression, as replacements."""
    found: dict[sp.Expr, sp.Expr] = {}
    for relation in goal.relations:
        if relation.sign == "=" and (relation.left.is_Symbol or relation.left.is_Function):
            found.setdefault(relation.left, relation.right)
    return found


def resolve(expression: sp.Expr, given: Mapping[sp.Expr, sp.Expr]) -> sp.Expr:
    """Replace until nothing changes; a circle of definitions is left as it is after as many rounds as there are."""
    for _ in range(len(given) + 1):
        before, expression = expression, replaced(expression, given)
        if before == expression:
            break
    return expression
