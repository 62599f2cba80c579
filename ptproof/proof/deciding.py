"""Deciding one claim: its proof is run, and counts only if its evidence is an engine's and about this very claim."""

from __future__ import annotations

import time
from dataclasses import replace

from ptproof.proof.claim import Certificate, Claim
from ptproof.proof.settling import settled
from ptproof.proof.verdict import Evidence, Verdict


def run_one(claim: Claim) -> Evidence:
    """Run one proof; an exception in it makes the claim undecided, with the exception as what was tried."""
    start = time.perf_counter()
    try:
        evidence = _examined(claim)
    except Exception as error:
        evidence = Evidence("crash", Verdict.UNDECIDED, f"{type(error).__name__}: {error}")
    seconds = time.perf_counter() - start
    return replace(evidence, certifies=None, found={}, suspect=None, facts=(), seconds=seconds, content=claim.content)


def _examined(claim: Claim) -> Evidence:
    """What the claim's proof says, if it is about the claim, or a witness against what it leaves open."""
    evidence = claim.prove(claim.goal())
    if not isinstance(evidence, Evidence):
        return Evidence("crash", Verdict.UNDECIDED, f"the proof returned {type(evidence).__name__}, not evidence")
    if reason := _mismatch(claim, evidence):
        return Evidence("mismatch", Verdict.UNDECIDED, reason)
    return settled(claim.goal(), evidence.certifies.says)


def _mismatch(claim: Claim, evidence: Evidence) -> str:
    """Why the evidence is not about this claim; empty if it is."""
    certificate = evidence.certifies
    if not isinstance(certificate, Certificate) or not certificate.genuine:
        return "the evidence does not come from an engine"
    if certificate.says != replace(evidence, certifies=None):
        return f"the engine said {certificate.says.verdict}, {certificate.says.detail}, and the proof rewrote it"
    goal = certificate.goal
    if goal.statement != claim.statement:
        return f"the evidence is about another statement: {goal.statement}"
    if goal.where_defined and not claim.where_defined:
        return "the evidence is about where both sides are defined, and the claim is not"
    if not set(goal.assumptions) <= set(claim.assumptions):
        return "the evidence assumes more than the claim does"
    if evidence.verdict is Verdict.REFUTED and set(goal.assumptions) != set(claim.assumptions):
        return "the refutation leaves out an assumption of the claim"
    if not {used.content for used in goal.uses} <= {used.content for used in claim.uses}:
        return "the evidence uses claims that the claim does not name"
    return ""
