"""The squeeze: a value between 0 and a bound that tends to 0 tends to 0."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import sympy as sp

from ptproof.proof.claim import Goal, engine
from ptproof.proof.declarations import is_plainly_real
from ptproof.proof.engines.limits import limit_of
from ptproof.proof.engines.reals import reals
from ptproof.proof.facts import Fact
from ptproof.proof.statement import Relation, le
from ptproof.proof.verdict import Evidence, Verdict

ENGINE = "squeeze"


@engine
def squeezed(goal: Goal, bound: sp.Expr, near: Sequence[Relation], facts: Callable[[Goal], Sequence[Fact]]) -> Evidence:
    """Show ``Limit(v(t), t, point, "-") = 0`` for a v that is known not to be negative, as a norm or by declaration.

    Parameters
    ----------
    goal
        Its statement is the limit; the approach is from below, or to infinity.
    bound
        An upper bound of v(t) that tends to 0 by the limit theorems.
    near
        Relations on t, such as t ≥ t₀, that hold for all t close enough to the point: checked.
    facts
        Given the goal ``v(t) ≤ bound`` at one arbitrary t near the point, the facts that show it over the reals.
    """
    undecided = partial(Evidence, ENGINE, Verdict.UNDECIDED)
    statement = goal.statement
    if not (isinstance(statement, Relation) and statement.sign == "=" and isinstance(statement.left, sp.Limit)):
        return undecided("not a limit with its value")
    value, t, point, side = statement.left.args
    if statement.right != 0 or str(side) != "-":
        return undecided("only limits from below with the value 0")
    if not value.is_nonnegative:
        return undecided(f"{value} is not known to have values at or above 0")
    if not is_plainly_real(t):
        return undecided(f"{t} is not declared to be any real number, so that it may not come close to {point}")
    if any(t in part.free_symbols for part in goal.relations):
        return undecided(f"an assumption speaks of one {t} only")
    for part in near:
        if not _eventually(part, t, point):
            return undecided(f"{part} is not known to hold near {t} = {point}")
    if limit_of(bound, t, point, "-") != 0:
        return undecided(f"the bound is not shown to tend to 0 as {t} tends to {point}")
    there = replace(goal, statement=le(value, bound), assumptions=(*goal.assumptions, *near))
    shown = reals(there, *facts(there))
    if shown.verdict is not Verdict.PROVED:
        return undecided(f"the bound is not shown: {shown.detail}")
    detail = f"0 ≤ {value} ≤ {bound}, which tends to 0; the bound: {shown.detail}"
    return Evidence(ENGINE, Verdict.PROVED, detail, found={statement.left: sp.S.Zero})


def _eventually(part: Relation, t: sp.Symbol, point: sp.Expr) -> bool:
    """Whether a relation holds for all t below the point and close enough to it."""
    part = part.standard()
    if part.sign not in ("<=", "<"):
        return False
    if point is not sp.oo and part.left == t and sp.expand(part.right - point) == 0:
        return True
    room = limit_of(part.right - part.left, t, point, "-")
    return room is not None and bool(room is sp.oo or sp.expand(room).is_positive)
