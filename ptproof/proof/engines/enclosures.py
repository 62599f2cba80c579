"""Inequalities between numbers, or over a bounded box of values, by enclosures in real balls."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import sympy as sp

from ptproof.balls.ball import Undefined
from ptproof.balls.cover import RELATIONS, holds_on_box
from ptproof.errors import InputError
from ptproof.proof.algebra import NotAlgebraic
from ptproof.proof.claim import Goal, engine
from ptproof.proof.engines.evaluation import carried_out
from ptproof.proof.engines.reals import follows
from ptproof.proof.statement import Relation, ge, le, relations_of
from ptproof.proof.verdict import Evidence, Verdict

SECONDS = 10.0
_undecided = partial(Evidence, "ball arithmetic", Verdict.UNDECIDED)
Box = Mapping[sp.Symbol, tuple[Any, Any]]


@engine
def enclosures(goal: Goal, box: Box | None = None, *, seconds: float = SECONDS) -> Evidence:
    """Show the goal's inequalities by a cover of ``box``, or refute them at an exact point of it.

    Parameters
    ----------
    goal
        Inequalities <, <=, >, >= between expressions as for :func:`ptproof.balls.ball.enclose`.
    box
        For every free symbol its smallest and largest value; left out for numbers. That each symbol lies in its
        range has to follow from the goal's assumptions, which is shown first.
    seconds
        The time limit of each cover. [s]

    Returns
    -------
    Evidence
        Proved only if a cover of the box has the right sign in every piece, for every inequality. A point at
        which one fails is a witness only if it satisfies all assumptions.
    """
    box = dict(box or {})
    for symbol, (low, high) in box.items():
        for end in (ge(symbol, low), le(symbol, high)):
            inside = follows(end, goal.relations)
            if not inside.shown:
                return _undecided(f"{end} does not follow from the assumptions: {inside.how}")
    boxes = 0
    for part in relations_of(goal.statement):
        if part.sign not in RELATIONS:
            return _undecided(f"not an inequality: {part}")
        try:
            result = holds_on_box(_difference(part), part.sign, box, seconds=seconds)
        except (InputError, Undefined, NotAlgebraic) as error:
            return _undecided(f"{part}: {error}")
        boxes += result.boxes
        if not result.holds and result.point is not None:
            detail = result.detail if box else f"{part} fails by disjoint enclosures"
            return replace(_undecided(detail), suspect=result.point)
        if not result.holds:
            return _undecided(f"{part}: {result.detail}")
    where = f"a cover of {boxes} boxes" if box else "disjoint enclosures of the two sides"
    return Evidence("ball arithmetic", Verdict.PROVED, where)


def _difference(part: Relation) -> sp.Expr:
    value = carried_out(sp.sympify(part.left - part.right))
    if value is None:
        raise NotAlgebraic("an integral, a limit or a sum for which no rule gives a value")
    return value
