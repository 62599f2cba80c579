"""Exact values at which a mutant fails: at points where its original's assumptions hold, and by search."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, TypeAlias

import sympy as sp

from ptproof.proof.claim import Claim, Goal
from ptproof.proof.engines.existence import defeats_every_choice
from ptproof.proof.engines.witnesses import candidates, check_witness, search
from ptproof.proof.mutation.mutant import Mutant
from ptproof.proof.statement import All, Exists, Relation, free_symbols, relations_of
from ptproof.proof.verdict import Witness

Point: TypeAlias = Mapping[Any, Any]
_FALSE = Relation(sp.S.Zero, "=", sp.S.One)
_PLAIN_FIRST = 6


def points_of(claim: Claim, *, count: int = 8, seconds: float = 1.5) -> tuple[Point, ...]:
    """Exact values at which every assumption of the claim is shown to hold: where its mutants are tried first."""
    goal = replace(claim.goal(), statement=_FALSE)
    end = time.monotonic() + seconds
    found: list[Point] = []
    for values in candidates(claim.goal()):
        if check_witness(goal, values)[0] is not None:
            found.append(values)
        if len(found) >= count or time.monotonic() > end:
            break
    # Values of one kind make many things equal by chance, so the mixed ones come first.
    return tuple(reversed(found))


def witness_at(mutant: Mutant, points: tuple[Point, ...]) -> Witness | None:
    """A witness against the mutant among these points."""
    if not isinstance(mutant.claim.statement, Relation | All):
        return None
    goal = mutant.claim.goal()
    known = set(relations_of(mutant.original.statement)) if _relational(mutant.original) else set()
    changed = [part for part in relations_of(goal.statement) if part not in known] or [*relations_of(goal.statement)]
    quick = replace(goal, statement=All(tuple(changed)), assumptions=())
    for point in points:
        if check_witness(quick, point)[0] is not None:
            witness, _ = check_witness(goal, point)
            if witness is not None:
                return witness
    return None


def searched(mutant: Mutant, seconds: float) -> Witness | None:
    """A witness against the mutant by search; against a weaker assumption, first where the original's fails."""
    if isinstance(mutant.claim.statement, Exists):
        return _against_every_choice(mutant.claim.goal(), mutant.claim.statement, seconds)
    if not isinstance(mutant.claim.statement, Relation | All):
        return None
    goal = mutant.claim.goal()
    for given in mutant.original.assumptions:
        if given not in mutant.claim.assumptions and isinstance(given, Relation):
            for part in given.components():
                outside = replace(goal, assumptions=(*goal.assumptions, part.negation()))
                witness = _search(outside, seconds / 2)
                if witness is not None:
                    return witness
    return _search(goal, seconds)


def _against_every_choice(goal: Goal, statement: Exists, seconds: float) -> Witness | None:
    """Numbers for all that is not chosen, at which one relation fails whatever is chosen."""
    given = sorted(free_symbols([*statement.body, *goal.assumptions]) - set(statement.variables), key=str)
    # Against numbers it makes no difference whether the choice may depend on them.
    goal = replace(goal, statement=replace(statement, over=tuple(given)))
    end = time.monotonic() + 4 * seconds
    for values in candidates(replace(goal, statement=All(statement.body))):
        if time.monotonic() > end:
            return None
        evidence = defeats_every_choice(goal, {symbol: values[symbol] for symbol in given if symbol in values})
        if evidence.witness is not None:
            return evidence.witness
    return None


def _search(goal: Goal, seconds: float) -> Witness | None:
    return search(goal, seconds)[0]


def _relational(claim: Claim) -> bool:
    return isinstance(claim.statement, Relation | All)
