"""Where a claim's proof runs: in this process, in others, or on a cluster; whatever it does there is evidence."""

from __future__ import annotations

import threading
from collections.abc import Generator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, TypeAlias

from ptproof.errors import InputError
from ptproof.proof.claim import Claim
from ptproof.proof.deciding import run_one
from ptproof.proof.load import claims_in, load
from ptproof.proof.statement import Prose, Runs
from ptproof.proof.verdict import Evidence, Verdict
from ptproof.reading.hashes import foreign, opened
from ptproof.reading.limits import Answered, OutOfTime, Stop, Unanswered, Why, Workers, within
from ptproof.reading.outcomes import in_words
from ptproof.reading.state import State

INTERRUPTED = "interrupted"
CRASH, TIME = "crash", "time limit"


@dataclass(frozen=True)
class Decided:
    """What a worker says of a claim: the hash of what the claim says there, and what its proof says.

    ``files`` are what the proof has read besides the files of Python, the libraries and ptproof.
    """

    content: str
    evidence: Evidence
    files: tuple[str, ...] = ()


Outcome: TypeAlias = Answered[Decided] | Unanswered
Found: TypeAlias = tuple[Claim, Decided]


def run_here(claim: Claim, timeout: float) -> Evidence:
    """What the proof of a claim says in this process, whose state is afterwards as it was.

    A proof that ends the process ends this one: for proofs that are not known, name workers.
    """
    before = State.now()
    try:
        return within(timeout, lambda: _contained(claim))
    except OutOfTime:
        return evidence_of(Unanswered(Why.TIME, f"no answer in {timeout:g} s"), timeout)
    finally:
        before.restore()


def _contained(claim: Claim) -> Evidence:
    """What the proof says; an exit or interrupt that it raises is its own and ends nothing else."""
    try:
        return run_one(claim)
    except Stop:
        raise
    except BaseException as error:
        return Evidence(CRASH, Verdict.UNDECIDED, f"the proof {in_words(error)}")


def in_workers(
    claims: Sequence[Claim], files: tuple[str, ...], workers: int, timeout: float
) -> Generator[Found, None, None]:
    """Each claim with its evidence, as they finish; a worker over its time is killed, and only its claim is lost."""
    # What may take longest comes first: the runs behind an observation, and those that are enclosed.
    ordered = sorted(claims, key=lambda claim: not isinstance(claim.statement, Prose | Runs))
    by_id = {claim.id: claim for claim in ordered}
    if not by_id:
        return
    for claim in ordered:
        _ = claim.content  # it is asked for here and there, and a copy of this process has it
    with Workers(min(workers, len(by_id)), start=read, arguments=(files,)) as processes:
        for id, outcome in processes.each(timeout, run_by_id, {id: (id,) for id in by_id}):
            yield by_id[id], decided(by_id[id], outcome, timeout)


def on_cluster(
    claims: Sequence[Claim], files: tuple[str, ...], client: Any, timeout: float
) -> Generator[Found, None, None]:
    """Each claim with its evidence, as the workers of a ``distributed.Client`` finish."""
    from distributed import as_completed

    running = {client.submit(_on_worker, files, claim.id, timeout, pure=False): claim for claim in claims}
    for future in as_completed(running):
        error, claim = future.exception(), running[future]
        lost = Unanswered(Why.DIED, f"the worker was lost: {type(error).__name__}: {error}")
        yield claim, decided(claim, Answered(future.result()) if error is None else lost, timeout)


def decided(claim: Claim, outcome: Outcome, timeout: float) -> Decided:
    """What was decided elsewhere, if it is this claim that was decided there."""
    match outcome:
        case Answered(Decided() as found) if found.content == claim.content:
            return found
        case Answered(Decided()):
            evidence = Evidence("mismatch", Verdict.UNDECIDED, "the worker decided another claim of this name")
        case Unanswered():
            evidence = evidence_of(outcome, timeout)
        case _:
            evidence = Evidence(CRASH, Verdict.UNDECIDED, "the worker's answer is no evidence")
    return Decided(claim.content, evidence)


def evidence_of(outcome: Unanswered, timeout: float) -> Evidence:
    """The evidence of a claim without an answer, which is undecided."""
    if outcome.why is Why.TIME:
        return Evidence(TIME, Verdict.UNDECIDED, outcome.reason, timeout)
    return Evidence(CRASH, Verdict.UNDECIDED, outcome.reason.replace("the work ", "the proof ", 1))


READ: dict[str, Claim] = {}  # in a worker
_one_at_a_time = threading.Lock()


def read(files: Sequence[str]) -> None:
    """In a worker: the claims of these files, so that they can be asked for by their ids."""
    READ.update(claims_in(files))


def import_apart(path: str) -> None:
    """In a worker: import a module, which may end its process; what is wrong with it is said where it is loaded."""
    with suppress(InputError):
        load([path])


def run_by_id(id: str) -> Decided:
    """In a worker: what a claim that was read says, and what its proof says."""
    claim = READ[id]
    says = claim.content
    with opened() as files:
        evidence = _contained(claim)
    if evidence.engine == CRASH and evidence.detail.startswith("MemoryError"):
        raise MemoryError
    return Decided(says, evidence, foreign(files))


def _on_worker(files: Sequence[str], id: str, timeout: float) -> Decided:
    with _one_at_a_time:  # a worker of a cluster may have threads, and z3 works with one
        if id not in READ:
            read(files)
        with opened() as found:
            evidence = run_here(READ[id], timeout)
        return Decided(READ[id].content, evidence, foreign(found))
