"""Proofs that may give up early, and that ask nothing twice: most of what they are asked about here is false."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import lru_cache
from typing import Any

import ptproof.proof.engines.quantified
import ptproof.proof.engines.reals
import ptproof.proof.settling
from ptproof.proof.attack import Attack, attack
from ptproof.proof.claim import Goal
from ptproof.proof.engines.reals import Answer
from ptproof.proof.statement import Implication, Relation

_answered = ptproof.proof.engines.reals._follows


@lru_cache(maxsize=4000)
def _remembered(
    conclusion: Relation, assumptions: tuple[Relation, ...], facts: tuple[Implication, ...], seconds: float
) -> Answer:
    return _answered(conclusion, assumptions, facts, seconds)


def _asked_once(
    conclusion: Relation, assumptions: Sequence[Relation], facts: Sequence[Implication], seconds: float
) -> Answer:
    """What z3 says, from memory where the very same was asked before: mutants of one claim share most questions."""
    return _remembered(conclusion, tuple(assumptions), tuple(facts), seconds)


def _attack_briefly(goal: Goal, *, seed: int = 0) -> Attack:
    """The attack before something counts as proved; a mutant was attacked before its proof was run."""
    return attack(goal, seed=seed, points=12, seconds=0.2)


@contextmanager
def in_haste(seconds: float) -> Iterator[None]:
    """Within, z3 has ``seconds`` for each question that names no limit of its own, and no witness is looked for.

    That can only lose proofs, and the attack on what is proved is brief. It holds for the whole process.
    """
    instead: dict[tuple[Any, str], Any] = {
        (ptproof.proof.engines.reals, "SECONDS"): seconds,
        (ptproof.proof.engines.reals, "_follows"): _asked_once,
        (ptproof.proof.engines.quantified, "_SECONDS"): seconds,
        (ptproof.proof.settling, "SEARCH_SECONDS"): 0.0,
        (ptproof.proof.settling, "attack"): _attack_briefly,
    }
    usual = {place: getattr(*place) for place in instead}
    try:
        for (module, name), value in instead.items():
            setattr(module, name, value)
        yield
    finally:
        for (module, name), value in usual.items():
            setattr(module, name, value)
