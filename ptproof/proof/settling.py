"""Settling a goal: the time that a proof takes, and the witness against what it leaves open."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace

from ptproof.proof.claim import Goal
from ptproof.proof.engines.witnesses import DIFFER, check_witness, search
from ptproof.proof.statement import All, Relation, relations_of
from ptproof.proof.verdict import Evidence, Verdict

SEARCH_SECONDS = 4.0


def settle(goal: Goal, proof: Callable[[Goal], Evidence], *, seconds: float | None = None) -> Evidence:
    """What ``proof`` says about the goal, in how many seconds; for relations that it leaves open a witness is sought.

    Parameters
    ----------
    goal
        What is to be shown.
    proof
        An engine, or what calls one.
    seconds
        The time limit of the search for a witness; with 0 only what the engine suspects is checked. [s]
    """
    start = time.perf_counter()
    evidence = with_witness(goal, proof(goal), seconds=seconds)
    return replace(evidence, seconds=time.perf_counter() - start)


def with_witness(goal: Goal, tried: Evidence, *, seconds: float | None = None) -> Evidence:
    """Evidence that is undecided, turned into a refutation of the goal if a witness is found."""
    if tried.verdict is not Verdict.UNDECIDED or not isinstance(goal.statement, Relation | All):
        return tried
    if tried.suspect is not None:
        witness, reason = check_witness(goal, tried.suspect)
        if witness is not None:
            return replace(tried, verdict=Verdict.REFUTED, witness=witness)
        tried = replace(tried, detail=f"{tried.detail}, but that is no witness: {reason}")
    seconds = SEARCH_SECONDS if seconds is None else seconds
    if seconds <= 0:
        return tried
    parts = (part.map(lambda side: side.xreplace(dict(tried.found))) for part in relations_of(goal.statement))
    witness, count = search(replace(goal, statement=All(tuple(parts))), seconds)
    if witness is not None:
        return Evidence("witness", Verdict.REFUTED, DIFFER, witness=witness, certifies=tried.certifies)
    return replace(tried, detail=f"{tried.detail}; no witness among {count} points")
