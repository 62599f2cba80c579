"""Goals that speak of unknown functions: their values as numbers, also in instances of assumptions."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterable, Iterator, Sequence

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.kernel.hints.goals import Goal, one_of
from ptproof.proof.kernel.hints.ground import Ground, written
from ptproof.proof.kernel.hints.instances import Instance, at_values
from ptproof.proof.kernel.terms import NoTranslation
from ptproof.proof.statement import Relation


def by_values(goal: Goal, found: Sequence[Instance], close: Callable[[Goal], Iterable[str]]) -> Iterator[str]:
    """The goal without unknown functions, which ``close`` has tactics for."""
    if not found and not any(item.has(AppliedUndef, sp.Derivative) for item in goal.relations()):
        return
    ground = Ground.over(goal.names)
    relation = goal.relation.map(ground)
    spoken = [item for item in goal.known if item.has(AppliedUndef)]
    facts = [*goal.known, *(item for instance in found for item in at_values(instance, ground))]
    grounded = Goal(relation, tuple(dict.fromkeys(_grounded(facts, ground))), ground.names)
    tactic = one_of(close(grounded))  # its names are those of the lines
    again = list(_grounded(spoken, ground))
    yield "; ".join([
        *ground.lines(),
        *(f"try (assert ({written(item, ground.names)}) by found_as)" for item in again),
        f"try (shown_as {grounded.text(relation.left)} {grounded.text(relation.right)})", tactic,
    ])  # fmt: skip


def _grounded(facts: Iterable[Relation], ground: Ground) -> Iterator[Relation]:
    for fact in facts:
        with contextlib.suppress(NoTranslation):
            item = fact.map(ground)
            if item.left != item.right and not (item.left - item.right).is_number:
                yield item
