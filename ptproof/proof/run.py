"""Verifying claims: in parallel, each with a time limit, and each crash its own."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

from ptproof.errors import InputError
from ptproof.proof.claim import Claim, Result
from ptproof.proof.deciding import run_one
from ptproof.proof.load import Derivation, claims_in, homes_of, with_ancestors
from ptproof.proof.verdict import Evidence, Verdict
from ptproof.reading.limits import Answered, OutOfTime, Unanswered, Why, Workers, within

SECONDS_PER_CLAIM = 60.0
Progress: TypeAlias = Callable[[Claim, Evidence], None]


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
        items = [replace(own, besides=()), *own.besides]
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


def verify(
    derivation: Derivation, *, workers: int | None = None, client: Any = None, timeout: float = SECONDS_PER_CLAIM,
    select: str = "", progress: Progress | None = None,
) -> Verification:  # fmt: skip
    """Run every proof in worker processes, or on a cluster, and draw the conclusions.

    Parameters
    ----------
    derivation
        From :func:`ptproof.proof.load.load`.
    workers
        How many processes (the number of processors where left out).
    client
        A ``distributed.Client``: the claims are decided by its workers, which have to see the same files.
    timeout
        The time limit of one claim. [s]
    select
        Only claims that contain this text, and what they use.
    progress
        Called with each claim and its own evidence as it comes in.

    Raises
    ------
    InputError
        For a number of workers below 1, a time limit that is not positive, or a selection that is empty.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from ptproof.proof import load
    >>> lines = "import sympy as sp; from ptproof.proof import claim, eq, exact; x = sp.Symbol('x', real=True)"
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "claims.py").write_text(f"{lines}; one = claim('sum', 'A sum', eq(x + x, 2 * x))(exact)")
    ...     verify(load([folder]), workers=1).summary()["proved"]
    1
    """
    claims = derivation.select(select)
    if not claims:
        raise InputError(f"no claim contains {select!r} in its id, title, section or labels")
    return _decided(
        claims, derivation.homes, (os.cpu_count() or 1) if workers is None else workers, client, timeout, progress
    )


def decide(
    claims: Iterable[Claim], *, workers: int | None = None, client: Any = None, timeout: float = SECONDS_PER_CLAIM,
    progress: Progress | None = None,
) -> Verification:  # fmt: skip
    """Decide the claims and all that they use, in this process where neither workers nor a cluster are named.

    The parameters are those of :func:`verify`.

    Raises
    ------
    InputError
        As for :func:`verify`; and with ``workers`` or ``client`` for a claim that stands in no file, since another
        process could not read it.

    Examples
    --------
    >>> import sympy as sp
    >>> from ptproof.proof import claim, eq, exact
    >>> x = sp.Symbol("x", real=True)
    >>> false = claim("doubled", "A slip", eq((x + 1) ** 2, x**2 + 1), expected="refuted")(exact)
    >>> decide([false]).results[0].evidence[0].witness.values
    {'x': '1'}
    """
    chosen = with_ancestors(claims)
    ids = [item.id for item in chosen]
    if workers is None and client is None:
        return _decided(chosen, {}, None, None, timeout, progress)
    homes = homes_of(chosen)
    if homeless := next((id for id in ids if id not in homes), None):
        raise InputError(f"{homeless}: other processes read claims from files, and this one stands in none; "
                         "leave out workers and client")  # fmt: skip
    return _decided(chosen, homes, workers, client, timeout, progress)


def _decided(
    claims: Sequence[Claim], homes: Mapping[str, str], workers: int | None, client: Any, timeout: float,
    progress: Progress | None,
) -> Verification:  # fmt: skip
    if workers is not None and workers < 1:
        raise InputError(f"workers takes a number of at least 1, got {workers}")
    if not 0 < timeout < 1e6:
        raise InputError(f"timeout takes a positive number of seconds, got {timeout}")
    start = time.perf_counter()
    # Only the files in which the claims stand are read again elsewhere.
    files = tuple(sorted({homes[claim.id] for claim in claims if claim.id in homes}))
    if client is not None:
        answers = _on_cluster(claims, files, client, timeout)
    elif workers is not None:
        answers = _in_workers(claims, files, workers, timeout)
    else:
        answers = ((claim, _here(claim, timeout)) for claim in claims)
    evidence: dict[str, Evidence] = {}
    for claim, found in answers:
        evidence[claim.id] = found
        if progress is not None:
            progress(claim, found)
    return Verification(conclude(claims, evidence), time.perf_counter() - start)


def _here(claim: Claim, timeout: float) -> Evidence:
    try:
        return within(timeout, lambda: run_one(claim))
    except OutOfTime:
        return evidence_of(Unanswered(Why.TIME, f"no answer in {timeout:g} s"), timeout)


def _in_workers(
    claims: Sequence[Claim], files: tuple[str, ...], workers: int, timeout: float
) -> Iterator[tuple[Claim, Evidence]]:
    """Each claim with its evidence, as they finish; a worker over its time is killed, and only its claim is lost."""
    by_id = {claim.id: claim for claim in claims}
    with Workers(min(workers, len(claims)), start=read, arguments=(files,)) as processes:
        for id, outcome in processes.each(timeout, run_by_id, {id: (id,) for id in by_id}):
            yield by_id[id], evidence_of(outcome, timeout)


def _on_cluster(
    claims: Sequence[Claim], files: tuple[str, ...], client: Any, timeout: float
) -> Iterator[tuple[Claim, Evidence]]:
    from distributed import as_completed

    running = {client.submit(_on_worker, files, claim.id, timeout, pure=False): claim for claim in claims}
    for future in as_completed(running):
        error = future.exception()
        lost = Unanswered(Why.DIED, f"the worker was lost: {type(error).__name__}: {error}")
        yield running[future], future.result() if error is None else evidence_of(lost, timeout)


def evidence_of(outcome: Answered[Evidence] | Unanswered, timeout: float) -> Evidence:
    """The evidence of a claim that ran elsewhere; a claim without an answer is undecided."""
    match outcome:
        case Answered(evidence):
            return evidence
        case Unanswered(Why.TIME, reason):
            return Evidence("time limit", Verdict.UNDECIDED, reason, timeout)
        case Unanswered(_, reason):
            return Evidence("crash", Verdict.UNDECIDED, reason)


_read: dict[str, Claim] = {}
_one_at_a_time = threading.Lock()


def read(files: Sequence[str]) -> None:
    """In a worker: the claims of these files, so that they can be asked for by their ids."""
    _read.update(claims_in(files))


def run_by_id(id: str) -> Evidence:
    """In a worker: what the proof of a claim that was read says."""
    return run_one(_read[id])


def _on_worker(files: Sequence[str], id: str, timeout: float) -> Evidence:
    with _one_at_a_time:  # a worker of a cluster may have threads, and z3 works with one
        if id not in _read:
            read(files)
        return _here(_read[id], timeout)
