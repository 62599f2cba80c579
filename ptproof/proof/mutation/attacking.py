"""Values at which a mutant fails: found by the attacker, and looked at again as exact ones."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace

from ptproof.errors import InputError
from ptproof.proof.attack import Hit, attack
from ptproof.proof.claim import Goal
from ptproof.proof.definedness import domain_of
from ptproof.proof.engines.existence import defeats_every_choice
from ptproof.proof.engines.witnesses import candidates, check_witness, search
from ptproof.proof.mutation.mutant import Mutant
from ptproof.proof.signs import holds
from ptproof.proof.statement import All, Exists, Relation, Runs, eq, free_symbols
from ptproof.proof.substitution import Substitution
from ptproof.proof.verdict import Witness

_FALSE = eq(0, 1)
_POINTS = 16


@dataclass(frozen=True)
class Falsity:
    """That a mutant is false: by exact values, or only by the attacker's numbers."""

    witness: Witness | None
    how: str


def falsity(mutant: Mutant, seconds: float) -> Falsity | None:
    """How the mutant is seen to be false, or None; where an assumption is weaker, what was excluded is tried first."""
    goal = mutant.claim.goal()
    if isinstance(goal.statement, Exists):
        return _against_every_choice(goal, goal.statement, seconds)
    if isinstance(goal.statement, Runs):
        hit = attack(goal, seconds=seconds).hit
        return None if hit is None else Falsity(None, f"by the attacker: {hit}")
    if not isinstance(goal.statement, Relation | All):
        return None
    for given in mutant.original.assumptions:
        if given not in goal.assumptions and isinstance(given, Relation):
            for part in given.components():
                outside = replace(goal, assumptions=(*goal.assumptions, part.negation()))
                hit = attack(outside, points=_POINTS, seconds=seconds).hit
                if hit is not None:
                    return _looked_at(goal, hit, seconds)
    hit = attack(goal, points=_POINTS, seconds=seconds).hit
    return _at_the_example(goal) if hit is None else _looked_at(goal, hit, seconds)


def _at_the_example(goal: Goal) -> Falsity | None:
    """The example of the original, where what the mutant assumes holds there, and what it says does not."""
    if not goal.example:
        return None
    witness, _ = check_witness(goal, dict(goal.example))
    return None if witness is None else Falsity(witness, "the two sides differ at the example of the claim")


def _looked_at(goal: Goal, hit: Hit, seconds: float) -> Falsity:
    """What was hit, with an exact witness where there is one."""
    witness, _ = check_witness(goal, hit.values)
    if witness is None:
        witness = _undefined_at(goal, hit)
    if witness is None:
        witness, _ = search(goal, seconds)
    return Falsity(witness, f"{hit.what} at exact values" if witness is not None else f"by the attacker: {hit}")


def _undefined_at(goal: Goal, hit: Hit) -> Witness | None:
    """Exact values that the assumptions allow and at which a side has no real value, where the attacker says so too."""
    if (hit.left and hit.right) or not isinstance(hit.part, Relation) or goal.where_defined:
        return None
    if check_witness(replace(goal, statement=_FALSE), hit.values)[0] is None:
        return None
    try:
        there = Substitution(hit.values)
        for need in domain_of(hit.part):
            if need.relation is not None and not need.given and holds(there.relation(need.relation).negation()):
                values = {str(letter): str(value) for letter, value in there.values.items()}
                return Witness(values, f"undefined unless {need}", hit.right or "undefined")
    except (InputError, ValueError, TypeError, ArithmeticError, NotImplementedError):
        return None
    return None


def _against_every_choice(goal: Goal, statement: Exists, seconds: float) -> Falsity | None:
    """Numbers for all that is not chosen, at which one relation fails whatever is chosen."""
    given = sorted(free_symbols([*statement.body, *goal.assumptions]) - set(statement.variables), key=str)
    # Against numbers it makes no difference whether the choice may depend on them.
    goal = replace(goal, statement=replace(statement, over=tuple(given)))
    end = time.monotonic() + 3 * seconds
    for values in candidates(replace(goal, statement=All(statement.body))):
        if time.monotonic() > end:
            return None
        evidence = defeats_every_choice(goal, {symbol: values[symbol] for symbol in given if symbol in values})
        if evidence.witness is not None:
            return Falsity(evidence.witness, evidence.detail)
    return None
