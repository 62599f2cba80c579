"""Verifying claims: in parallel, each with a time limit, and each crash its own."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeAlias

from ptproof.errors import InputError
from ptproof.proof.answering import INTERRUPTED, Decided, in_workers, on_cluster, run_here
from ptproof.proof.claim import Claim
from ptproof.proof.load import Derivation, homes_of, with_ancestors
from ptproof.proof.memory import Memory
from ptproof.proof.result import Result, Verification
from ptproof.proof.settling import ATTACK
from ptproof.proof.verdict import Evidence, Verdict

SECONDS_PER_CLAIM = 60.0
Progress: TypeAlias = Callable[[Claim, Evidence], None]


class NothingSelected(InputError):
    """No claim contains the text by which claims were to be chosen."""


class Interrupted(KeyboardInterrupt):
    """The run was ended from outside; ``verification`` holds what was decided by then, the rest as undecided."""

    def __init__(self, verification: Verification) -> None:
        super().__init__("interrupted")
        self.verification = verification


def conclude(claims: Sequence[Claim], evidence: Mapping[str, Evidence]) -> tuple[Result, ...]:
    """Verdicts after looking at the ancestors.

    Evidence counts for the claim that it was found for, by what that says and not by its id; so does a claim that is
    used. A proof that uses a refuted claim, or one that nobody decided, shows nothing, so it counts as undecided.
    ``fully_proved`` says that the claim and everything it uses, all the way, is proved.
    """
    decided = {claim.id: claim for claim in claims}
    results: dict[str, Result] = {}

    def result_of(claim: Claim) -> Result:
        if claim.id not in results:
            same = [item for item in claim.uses if item.id in decided and decided[item.id].content == item.content]
            used = [result_of(decided[item.id]) for item in same]
            others = [item.id for item in claim.uses if item not in same]
            results[claim.id] = _concluded(claim, evidence[claim.id], used, others)
        return results[claim.id]

    return tuple(result_of(claim) for claim in claims)


def _concluded(claim: Claim, own: Evidence, used: Sequence[Result], others: Sequence[str]) -> Result:
    """One claim's result from its own evidence, from what it uses, and from the ids that it uses but nobody decided."""
    sound = not others and all(item.fully_proved for item in used)
    verdict, items = own.verdict, [replace(own, besides=()), *(_blamed(item, sound) for item in own.besides)]
    false = [item.claim.id for item in used if item.verdict is Verdict.REFUTED]
    for engine, reason in (
        ("content", "what was decided is not what this claim says" if own.content != claim.content else ""),
        ("ancestors", f"the proof uses what is refuted: {', '.join(false)}" if false else ""),
        ("ancestors", f"the claims decided under these ids say something else than those that the proof uses: "
                      f"{', '.join(others)}" if others else ""),
    ):  # fmt: skip
        if reason and (verdict is Verdict.PROVED or (engine == "content" and verdict is not Verdict.UNDECIDED)):
            verdict = Verdict.UNDECIDED
            items.append(Evidence(engine, verdict, reason))
    unproved = (item for item in used if not item.fully_proved)
    open_ones = tuple(dict.fromkeys(name for item in unproved for name in item.rests_on or (item.claim.id,)))
    fully = verdict is Verdict.PROVED and not open_ones
    rests = open_ones if verdict is Verdict.PROVED else (claim.id,)
    return Result(claim, verdict, tuple(items), fully, () if fully else rests)


def _blamed(item: Evidence, sound: bool) -> Evidence:
    """A hit of the attacker with what is to blame: ptproof itself, or something unproved that the claim uses."""
    if (item.engine, item.verdict) != (ATTACK, Verdict.REFUTED):
        return item
    if sound:
        return replace(item, detail=f"ptproof contradicts itself; please report this: {item.detail}")
    return replace(
        item, verdict=Verdict.OBSERVED, detail=f"what it uses is not all proved, and is false: {item.detail}"
    )


def verify(
    derivation: Derivation, *, workers: int | None = None, client: Any = None, timeout: float = SECONDS_PER_CLAIM,
    select: str = "", progress: Progress | None = None, memory: Memory | None = None,
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
    memory
        Of earlier runs, and for later ones (:class:`ptproof.proof.memory.Memory`, which was told of the loading).

    Raises
    ------
    InputError
        For a number of workers below 1, a time limit that is not positive, or a selection that is empty
        (:class:`NothingSelected`).

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
    if select and not claims:
        raise NothingSelected(f"no claim contains {select!r} in its id, title, section or labels")
    workers = os.cpu_count() or 1 if workers is None else workers
    return _decided(claims, derivation.homes, workers, client, timeout, progress, memory)


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
    if workers is None and client is None:
        return _decided(chosen, {}, None, None, timeout, progress)
    homes = homes_of(chosen)
    if homeless := next((item.id for item in chosen if item.id not in homes), None):
        raise InputError(f"{homeless}: other processes read claims from files, and this one stands in none; "
                         "leave out workers and client")  # fmt: skip
    return _decided(chosen, homes, workers, client, timeout, progress)


def _decided(
    claims: Sequence[Claim], homes: Mapping[str, str], workers: int | None, client: Any, timeout: float,
    progress: Progress | None, memory: Memory | None = None,
) -> Verification:  # fmt: skip
    if workers is not None and workers < 1:
        raise InputError(f"workers takes a number of at least 1, got {workers}")
    if not 0 < timeout < 1e6:
        raise InputError(f"timeout takes a positive number of seconds, got {timeout}")
    start = time.perf_counter()
    # Only the files in which the claims stand are read again elsewhere.
    files = tuple(sorted({homes[claim.id] for claim in claims if claim.id in homes}))
    evidence: dict[str, Evidence] = {}
    if memory is not None:
        evidence = {claim.id: kept for claim in claims if (kept := memory.recall(claim)) is not None}
    remembered = frozenset(evidence)
    left = [claim for claim in claims if claim.id not in remembered]
    if client is not None:
        answers = on_cluster(left, files, client, timeout)
    elif workers is not None:
        answers = in_workers(left, files, workers, timeout)
    else:
        answers = ((claim, Decided("", run_here(claim, timeout))) for claim in left)
    try:
        for claim in claims:
            if progress is not None and claim.id in remembered:
                progress(claim, evidence[claim.id])
        for claim, found in answers:
            evidence[claim.id] = found.evidence
            if memory is not None:
                memory.keep(claim, found.evidence, found.files)
            if progress is not None:
                progress(claim, found.evidence)
    except KeyboardInterrupt:
        answers.close()
        open_ = Evidence(INTERRUPTED, Verdict.UNDECIDED, "interrupted before it was decided")
        known = {claim.id: evidence.get(claim.id, open_) for claim in claims}
        raise Interrupted(Verification(conclude(claims, known), time.perf_counter() - start, remembered)) from None
    return Verification(conclude(claims, evidence), time.perf_counter() - start, remembered)
