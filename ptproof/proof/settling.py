"""Settling a goal: what a proof says of it, whether that says anything, and the witness against what it leaves open.

A proof counts only if the goal says something under assumptions that can hold, if all that it speaks of is shown to be
defined, and if the attacker finds no exact point that contradicts it. That is asked here, whatever the engine.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace

from ptproof.proof.attack import attack, points_of
from ptproof.proof.claim import Goal
from ptproof.proof.definedness import domain_of
from ptproof.proof.engines.reals import Answer, are_met, contradictory
from ptproof.proof.engines.witnesses import DIFFER, at_example, check_witness, search
from ptproof.proof.facts import usable
from ptproof.proof.statement import All, Exists, Relation, relations_of
from ptproof.proof.verdict import Evidence, Verdict

SEARCH_SECONDS = 4.0
DEFINEDNESS, ATTACK = "definedness", "attack"
SEED = 0


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
    evidence = settled(goal, proof(goal), seconds=seconds)
    return replace(evidence, seconds=time.perf_counter() - start)


def settled(goal: Goal, evidence: Evidence, *, seconds: float | None = None) -> Evidence:
    """Evidence about the goal, turned into a refutation if a witness is found; proved only if that says something."""
    evidence = with_witness(goal, evidence, seconds=seconds)
    if evidence.verdict is not Verdict.PROVED:
        return evidence
    if reason := says_nothing(goal):
        return replace(evidence, verdict=Verdict.UNDECIDED, detail=f"{reason}; {evidence.engine}: {evidence.detail}")
    evidence = _defined(goal, evidence)
    return _attacked(goal, evidence) if evidence.verdict is Verdict.PROVED else evidence


def says_nothing(goal: Goal) -> str:
    """Why a proof of the goal would show nothing: it is empty, assumed, or speaks of no values at all."""
    statement, assumed = goal.statement, {part.standard() for part in goal.relations}
    parts = statement.body if isinstance(statement, Exists) else ()
    if isinstance(statement, Relation | All):
        parts = relations_of(statement)
        if parts and all(part.standard() in assumed for part in parts):
            return "what is claimed is one of the assumptions"
    if not parts and isinstance(statement, Exists | Relation | All):
        return "the claim is a conjunction of nothing"
    if contradictory(goal.relations):
        return "the assumptions contradict each other, so that everything follows from them"
    return ""


def _defined(goal: Goal, evidence: Evidence) -> Evidence:
    """The evidence, beside it whether both sides are shown to be defined; undecided where they are not."""
    notes = _as_written(goal)
    if goal.where_defined:
        note = Evidence(DEFINEDNESS, Verdict.PROVED, "claimed only where both sides are defined and real")
        return replace(evidence, besides=(*evidence.besides, note, *notes))
    start = time.perf_counter()
    answer = where_defined(goal, evidence)
    if not answer.how:
        return replace(evidence, besides=(*evidence.besides, *notes))
    verdict = Verdict.PROVED if answer.shown else Verdict.UNDECIDED
    detail = f"both sides are defined: {answer.how}" if answer.shown else answer.how
    item = Evidence(DEFINEDNESS, verdict, detail, time.perf_counter() - start)
    if answer.shown:
        return replace(evidence, besides=(*evidence.besides, item, *notes))
    detail = f"not shown to be defined for all values allowed: {answer.how}; {evidence.engine}: {evidence.detail}"
    return replace(evidence, verdict=Verdict.UNDECIDED, detail=detail, besides=(*evidence.besides, item))


def _attacked(goal: Goal, evidence: Evidence) -> Evidence:
    """The evidence, beside it what the attack met: where the goal fails at an exact point, nothing has proved it."""
    start = time.perf_counter()
    met = attack(goal, seed=SEED)

    def beside(verdict: Verdict, detail: str) -> tuple[Evidence, ...]:
        return (*evidence.besides, Evidence(ATTACK, verdict, detail, time.perf_counter() - start))

    if met.hit is not None:
        detail = f"{evidence.engine} shows what is false: {met.hit}"
        return replace(evidence, verdict=Verdict.UNDECIDED, detail=detail, besides=beside(Verdict.REFUTED, detail))
    if goal.example:
        holds, said = at_example(goal, dict(goal.example))
        if not holds:
            return replace(evidence, verdict=Verdict.UNDECIDED, detail=f"{said}; {evidence.detail}")
        return replace(evidence, besides=beside(Verdict.OBSERVED, f"{met.detail} (seed {SEED}), none is hit; {said}"))
    if met.points == 0 and goal.assumptions and next(points_of(goal, seed=SEED, points=1), None) is None:
        detail = f"no values are found that satisfy the assumptions, so that nothing may be claimed; {evidence.detail}"
        return replace(evidence, verdict=Verdict.UNDECIDED, detail=detail)
    said = f"{met.detail} (seed {SEED}), none is hit" if met.points else met.detail
    return replace(evidence, besides=beside(Verdict.OBSERVED, said))


def where_defined(goal: Goal, evidence: Evidence) -> Answer:
    """Whether both sides of all relations of the goal are shown to be defined and real, from its assumptions.

    What an existence statement or one of smoothness speaks of, their engines look after.
    """
    if not isinstance(goal.statement, Relation | All):
        return Answer(True, "")
    needs = [need for part in relations_of(goal.statement) for need in domain_of(part, evidence.found)]
    return are_met(list(dict.fromkeys(needs)), goal.relations, usable(goal, (*goal.facts, *evidence.facts)))


def _as_written(goal: Goal) -> tuple[Evidence, ...]:
    """A note where the two sides are one expression as SymPy writes them: then nothing is claimed but that."""
    if isinstance(goal.statement, Relation | All) and all(
        part.left == part.right for part in relations_of(goal.statement)
    ):
        return (Evidence("form", Verdict.OBSERVED, "as SymPy writes them, the two sides are one and the same"),)
    return ()


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
