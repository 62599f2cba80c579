"""Equalities by exact algebra: the difference of the two sides has the normal form 0."""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Any

import sympy as sp

from ptproof.proof.algebra import NotAlgebraic, is_zero
from ptproof.proof.claim import Goal
from ptproof.proof.refute import or_refute
from ptproof.proof.statement import Relation, relations_of
from ptproof.proof.verdict import Evidence, Verdict


def exact(goal: Goal) -> Evidence:
    """Show every equality of the goal; an assumption ``symbol = expression`` is substituted first."""
    start = time.perf_counter()
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
            seconds = time.perf_counter() - start
            return or_refute(goal, Evidence("exact algebra", Verdict.UNDECIDED, f"{part}: {reason}", seconds))
    detail = "the difference of the two sides has the normal form 0"
    return Evidence("exact algebra", Verdict.PROVED, detail, time.perf_counter() - start)


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
        replaced = expression.xreplace(dict(given))
        if replaced == expression:
            break
        expression = replaced
    return expression


def same(left: Any, right: Any) -> bool:
    """Whether two scalars or columns are equal by exact algebra."""
    return all(is_zero(part.left - part.right) for part in Relation(left, "=", right).components())
