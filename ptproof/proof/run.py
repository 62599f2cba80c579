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
from ptproof.proof.verdict import Evidence, Verdict

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
        evidence = claim.prove(claim.goal())
    except Exception as error:
        seconds = time.perf_counter() - start
        return Evidence("crash", Verdict.UNDECIDED, f"{type(error).__name__}: {error}", seconds)
    if not isinstance(evidence, Evidence):
        return Evidence("crash", Verdict.UNDECIDED, f"the proof returned {type(evidence).__name__}, not evidence")
    if reason := _mismatch(claim, evidence):
        return Evidence("mismatch", Verdict.UNDECIDED, reason, evidence.seconds)
    return replace(evidence, certifies=None)


def _mismatch(claim: Claim, evidence: Evidence) -> str:
    """Why the evidence is not about this claim; empty if it is."""
    goal = evidence.certifies
    if not isinstance(goal, Goal):
        return "the evidence does not come from an engine"
    if goal.statement != claim.statement:
        return f"the evidence is about another statement: {goal.statement}"
    if not set(goal.assumptions) <= set(claim.assumptions):
        return "the evidence assumes more than the claim does"
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
    import multiprocessing
    from concurrent.futures import FIRST_COMPLETED, wait

    from pebble import ProcessPool

    # Workers start afresh rather than as copies: a copy of a process with threads can hang.
    absolute = tuple(str(Path(path).resolve()) for path in paths)
    context = multiprocessing.get_context("spawn")
    with ProcessPool(max_workers=min(jobs, len(claims)), context=context,
                     initializer=_start_worker, initargs=(absolute,)) as pool:  # fmt: skip
        running = {pool.schedule(_run_by_id, args=(claim.id,), timeout=timeout): claim for claim in claims}
        while running:
            done, _ = wait(running, return_when=FIRST_COMPLETED)
            for future in done:
                claim = running.pop(future)
                yield claim, _outcome(future, timeout)


def _outcome(future: Any, timeout: float) -> Evidence:
    from concurrent.futures import TimeoutError as FutureTimeout

    try:
        found = future.result()
    except FutureTimeout:
        return Evidence("time limit", Verdict.UNDECIDED, f"no answer in {timeout:g} s", timeout)
    except Exception as error:
        return Evidence("crash", Verdict.UNDECIDED, f"the process ended: {type(error).__name__}: {error}")
    assert isinstance(found, Evidence)
    return found
