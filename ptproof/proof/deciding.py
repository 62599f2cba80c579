"""Deciding one claim: its proof is run, what it says is held against the claim, and what it leaves open is attacked."""

from __future__ import annotations

import time
from dataclasses import replace

from ptproof.proof.claim import Claim, Goal
from ptproof.proof.settling import with_witness
from ptproof.proof.verdict import Evidence, Verdict


def run_one(claim: Claim) -> Evidence:
    """Run one proof; an exception in it makes the claim undecided, with the exception as what was tried."""
    start = time.perf_counter()
    try:
        evidence = _examined(claim)
    except Exception as error:
        evidence = Evidence("crash", Verdict.UNDECIDED, f"{type(error).__name__}: {error}")
    return replace(evidence, certifies=None, found={}, suspect=None, seconds=time.perf_counter() - start)


def _examined(claim: Claim) -> Evidence:
    """What the claim's proof says, if it is about the claim, or a witness against what it leaves open."""
    evidence = claim.prove(claim.goal())
    if not isinstance(evidence, Evidence):
        return Evidence("crash", Verdict.UNDECIDED, f"the proof returned {type(evidence).__name__}, not evidence")
    if reason := _mismatch(claim, evidence):
        return Evidence("mismatch", Verdict.UNDECIDED, reason)
    return with_witness(claim.goal(), evidence)


def _mismatch(claim: Claim, evidence: Evidence) -> str:
    """Why the evidence is not about this claim; empty if it is."""
    goal = evidence.certifies
    if not isinstance(goal, Goal):
        return "the evidence does not come from an engine"
    if goal.statement != claim.statement:
        return f"the evidence is about another statement: {goal.statement}"
    if not set(goal.assumptions) <= set(claim.assumptions):
        return "the evidence assumes more than the claim does"
    if evidence.verdict is Verdict.REFUTED and set(goal.assumptions) != set(claim.assumptions):
        return "the refutation leaves out an assumption of the claim"
    if not all(used in claim.uses for used in goal.uses):
        return "the evidence uses claims that the claim does not name"
    return ""
