"""Concrete trajectories of a system of differential equations that a goal assumes, where one state moves alone."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.attack.functions import Concrete, closed_forms
from ptproof.proof.statement import ForAll


def trajectories(items: Iterable[ForAll]) -> Iterator[tuple[Any, Concrete]]:
    """Functions that satisfy together the equations x' = rhs(s, x) among the ``items``.

    One of them moves and the others are 0, if their equations allow it. The constant of integration is the symbol
    ``START``. Whoever draws one of each function checks that they belong together, and that they satisfy the equations.
    """
    rates = dict(_equations(items))
    for moving in rates:
        rest = {other: sp.S.Zero for other in rates if other != moving}
        if not all(map(_may_vanish, rest)):
            continue
        if any(rates[other].subs(rest, simultaneous=True) != 0 for other in rest):
            continue
        (time,) = moving.args
        value = sp.Dummy("value", positive=True)
        right = sp.expand_mul(rates[moving].subs({**rest, moving: value}, simultaneous=True))
        right = sp.Add(*(sp.powsimp(term, combine="exp") for term in sp.Add.make_args(right)))
        if right.has(AppliedUndef, sp.Derivative) or not _may_be_positive(moving):
            continue
        place = sp.Symbol("_argument0", real=True)
        forms = closed_forms(right, value, time)
        yield from ((moving.func, Concrete((place,), form.xreplace({time: place}))) for form in forms)
        if forms:
            yield from ((other.func, Concrete((place,), sp.S.Zero)) for other in rest)


def _equations(items: Iterable[ForAll]) -> Iterator[tuple[AppliedUndef, sp.Expr]]:
    """Each function of one time with its rate."""
    for item in items:
        left = item.relation.left
        if item.relation.sign != "=" or len(item.variables) != 1 or not isinstance(left, sp.Derivative):
            continue
        state = left.expr
        if (
            isinstance(state, AppliedUndef)
            and state.args == item.variables
            and left == sp.Derivative(state, state.args[0])
        ):
            yield state, item.relation.right


def _may_vanish(state: AppliedUndef) -> bool:
    return not (state.is_positive or state.is_negative or state.is_nonzero)


def _may_be_positive(state: AppliedUndef) -> bool:
    return not (state.is_negative or state.is_nonpositive or state.is_integer)
