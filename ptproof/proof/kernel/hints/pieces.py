"""Equations with minima, maxima, absolute values and branches: what one of them has to be is shown by inequalities."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import sympy as sp

from ptproof.proof.kernel.hints.cases import KINDS, split
from ptproof.proof.kernel.hints.goals import Goal, as_factors
from ptproof.proof.kernel.hints.refuted import by_refutation
from ptproof.proof.statement import Relation, RelationSign

_BOTH: tuple[RelationSign, ...] = ("<=", ">=")


def by_two_inequalities(goal: Goal) -> Iterator[str]:
    """An equation from what bounds each side by the other one."""
    shown = []
    for sign in _BOTH:
        tactic = next(by_refutation(replace(goal, relation=replace(goal.relation, sign=sign))), "")
        if not tactic:
            return
        shown.append(tactic)
    yield f"apply Rle_antisym; [> {shown[0]} | apply Rge_le; {shown[1]} ]"


def by_equal_pieces(goal: Goal) -> Iterator[str]:
    """One piece is the other one, or what the equation says that it is; else in each of the branches that there are."""
    for one, value in _equal(goal):
        for proof in by_two_inequalities(replace(goal, relation=Relation(one, "=", value))):
            yield f"replace {goal.text(one)} with {goal.text(value)} by (symmetry; {proof}); rational"
            return
    if goal.relation.has(sp.Piecewise) and (found := split(replace(goal, known=()), sp.Piecewise)) is not None:
        line, cases = found
        goals = (replace(case, known=(*goal.known, *case.known)) for case in cases)
        each = [next(by_equal_pieces(case), "") for case in goals]
        if all(each):
            yield f"{line}; [> {' | '.join(each)} ]"


def _equal(goal: Goal) -> Iterator[tuple[sp.Expr, sp.Expr]]:
    """A piece and what it is equal to if the equation holds."""
    left, right = (_innermost(side) for side in (goal.relation.left, goal.relation.right))
    alone, others = left - right, right - left
    if len(alone) == len(others) == 1:
        yield alone.pop(), others.pop()
    elif len(alone) + len(others) == 1:
        (piece,) = alone | others
        stands = sp.Dummy()
        gap = (goal.relation.left - goal.relation.right).xreplace({piece: stands})
        if not gap.has(*KINDS) and gap.is_polynomial(stands) and sp.degree(gap, stands) == 1:
            factor = gap.diff(stands)
            yield piece, as_factors(stands - gap / factor)


def _innermost(side: sp.Basic) -> set[sp.Basic]:
    """Those that hold no others."""
    return {part for part in side.atoms(*KINDS) if not any(inner.has(*KINDS) for inner in part.args)}
