"""Proofs that may give up early: most of what they are asked about here is false."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import ptproof.proof.engines.quantified
import ptproof.proof.engines.reals
import ptproof.proof.settling
from ptproof.proof.attack import Attack, attack
from ptproof.proof.claim import Goal


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
