"""Verifying claims: in parallel, each with a time limit, and each crash its own."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ptproof.errors import InputError
from ptproof.proof.claim import Claim, Goal, Result
from ptproof.proof.load import Derivation, load
from ptproof.proof.settling import with_witness
from ptproof.proof.verdict import Evidence, Verdict
from ptproof.reading.limits import Answered, Unanswered, Why, Workers

SECONDS_PER_CLAIM = 60.0


@dataclass(frozen=True)
class Verification:
    """The outcome of every claim, in the order of the derivation."""

    results: tuple[Result, ...]
    seconds: float

    @property
    def as_expected(self) -> bool:
        """Whether every claim came out as its author recorded."""
        return all(result.as_expected for result in self.results)

    def summary(self) -> dict[str, int]:
        """How many claims ended in each verdict, and how many are fully proved or not as expected."""
        counts = {str(verdict): 0 for verdict in Verdict}
        for result in self.results:
            counts[str(result.verdict)] += 1
        counts["total"] = len(self.results)
        counts["fully_proved"] = sum(result.fully_proved for result in self.results)
        counts["unexpected"] = sum(not result.as_expected for result in self.results)
        return counts

    def to_json(self) -> dict[str, Any]:
        return {"claims": [result.to_json() for result in self.results], "summary": self.summary()}


def run_one(claim: Claim) -> Evidence:
    """Run one proof; an exception in it makes the claim undecided, with the exception as what was tried."""
    start = time.perf_counter()
    try:
        evidence = _examined(claim)
    except Exception as error:
        evidence = Evidence("crash", Verdict.UNDECIDED, f"{type(error).__name__}: {error}")
    return replace(evidence, certifies=None, seconds=time.perf_counter() - start)


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


def conclude(claims: Sequence[Claim], evidence: dict[str, Evidence]) -> tuple[Result, ...]:
    """Verdicts after looking at the ancestors.

    A proof that uses a refuted claim shows nothing, so it counts as undecided. ``fully_proved`` says that the
    claim and everything it uses, all the way, is proved.
    """
    results: dict[str, Result] = {}

    def result_of(claim: Claim) -> Result:
        if claim.id in results:
            return results[claim.id]
        used = [result_of(item) for item in claim.uses]
        own = evidence[claim.id]
        verdict = own.verdict
        items = [own]
        false = [item.claim.id for item in used if item.verdict is Verdict.REFUTED]
        if verdict is Verdict.PROVED and false:
            verdict = Verdict.UNDECIDED
            items.append(Evidence("ancestors", verdict, f"the proof uses what is refuted: {', '.join(false)}"))
        open_ones = tuple(
            dict.fromkeys(
                name for item in used for name in (() if item.fully_proved else (item.rests_on or (item.claim.id,)))
            )
        )
        fully = verdict is Verdict.PROVED and not open_ones
        rests = open_ones if verdict is Verdict.PROVED else (claim.id,)
        results[claim.id] = Result(claim, verdict, tuple(items), fully, () if fully else rests)
        return results[claim.id]

    return tuple(result_of(claim) for claim in claims)


_loaded: dict[str, Claim] = {}


def _start_worker(paths: tuple[str, ...]) -> None:
    _loaded.update({claim.id: claim for claim in load(paths).claims})


def _run_by_id(id: str) -> Evidence:
    return run_one(_loaded[id])


def verify(
    derivation: Derivation, *, jobs: int | None = None, timeout: float = SECONDS_PER_CLAIM, select: str = "",
    progress: Callable[[Claim, Evidence], None] | None = None,
) -> Verification:  # fmt: skip
    """Run every proof in worker processes and draw the conclusions.

    Parameters
    ----------
    derivation
        From :func:`ptproof.proof.load.load`.
    jobs
        How many processes (the number of processors where left out).
    timeout
        The time limit of one claim. [s]
    select
        Only claims that contain this text, and what they use.
    progress
        Called with each claim and its own evidence as it comes in.

    Raises
    ------
    InputError
        For a number of jobs below 1, a time limit that is not positive, or a selection that is empty.
    """
    if jobs is not None and jobs < 1:
        raise InputError(f"--jobs takes a number of at least 1, got {jobs}")
    if not 0 < timeout < 1e6:
        raise InputError(f"--timeout takes a positive number of seconds, got {timeout}")
    claims = derivation.select(select)
    if not claims:
        raise InputError(f"no claim contains {select!r} in its id, title, section or labels")
    start = time.perf_counter()
    evidence: dict[str, Evidence] = {}
    for claim, found in _in_workers(claims, derivation.paths, jobs or os.cpu_count() or 1, timeout):
        evidence[claim.id] = found
        if progress is not None:
            progress(claim, found)
    return Verification(conclude(claims, evidence), time.perf_counter() - start)


def _in_workers(
    claims: Sequence[Claim], paths: tuple[str, ...], jobs: int, timeout: float
) -> Iterator[tuple[Claim, Evidence]]:
    """Each claim with its evidence, as they finish; a worker over its time is killed, and only its claim is lost."""
    by_id = {claim.id: claim for claim in claims}
    absolute = tuple(str(Path(path).resolve()) for path in paths)
    with Workers(min(jobs, len(claims)), start=_start_worker, arguments=(absolute,)) as workers:
        for id, outcome in workers.each(timeout, _run_by_id, {id: (id,) for id in by_id}):
            yield by_id[id], outcome_of(outcome, timeout)


def outcome_of(outcome: Answered[Evidence] | Unanswered, timeout: float) -> Evidence:
    """The evidence of a claim that ran in a worker; a claim without an answer is undecided."""
    match outcome:
        case Answered(evidence):
            return evidence
        case Unanswered(Why.TIME, reason):
            return Evidence("time limit", Verdict.UNDECIDED, reason, timeout)
        case Unanswered(_, reason):
            return Evidence("crash", Verdict.UNDECIDED, reason)
