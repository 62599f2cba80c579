"""Asking Coq's kernel about claims: restated, in files of several, in parallel, each with a time limit."""

from __future__ import annotations

import os
import tempfile
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypeAlias

from ptproof.proof.claim import Claim
from ptproof.proof.kernel import coq, remembered
from ptproof.proof.kernel.hints.portfolio import script
from ptproof.proof.kernel.remembered import Confirmation
from ptproof.proof.kernel.terms import NoTranslation
from ptproof.proof.kernel.theorem import Proposition, proposition
from ptproof.proof.result import Result
from ptproof.proof.verdict import Evidence, Verdict

if TYPE_CHECKING:
    from ptproof.proof.memory import Memory

SECONDS_PER_CLAIM = 40.0
# Most of a file's time goes into reading the libraries and finding the axioms, at 2 to 7 s however many claims it has;
# fewer than these are left to one process, and not more, so that what comes in is seen.
_IN_A_FILE = (6, 24)
_TO_START = 30.0


Progress = Callable[[Claim, Confirmation], None]
Effort: TypeAlias = Literal["quick", "thorough"]
EFFORTS: tuple[Effort, ...] = ("quick", "thorough")
Asked: TypeAlias = tuple[Claim, Proposition]
Stated: TypeAlias = tuple[Claim, Proposition, coq.Theorem]


def check(
    claims: Iterable[Claim], *, workers: int | None = None, timeout: float = SECONDS_PER_CLAIM,
    progress: Progress | None = None, keep: Path | None = None, efforts: Sequence[Effort] = EFFORTS,
    memory: Memory | None = None,
) -> dict[str, Confirmation]:  # fmt: skip
    """Have Coq's kernel check each claim.

    Parameters
    ----------
    claims
        Those that were proved; whether they were is not looked at here.
    workers
        How many processes of Coq at a time (the number of processors where left out).
    timeout
        The time limit of one claim. [s]
    progress
        Called with each claim and what became of it, as it comes in.
    keep
        A folder in which the files for Coq are left.
    efforts
        What is tried one after the other while Coq finds no proof: "quick" hints, and "thorough" ones, which take
        longer to find.
    memory
        Where answers are kept as they come in, but for those that were late. Nothing is recalled where files are to
        be left in ``keep``.

    Returns
    -------
    dict
        By the claims' ids. A claim of which Coq has found no proof may be true all the same.

    Raises
    ------
    KeyboardInterrupt
        If it comes while Coq works, which ends at once; what ``progress`` was called with is what is known.
    """
    wanted = list(claims)
    answers: dict[str, Confirmation] = {}
    lock = threading.Lock()

    def answer(claim: Claim, confirmation: Confirmation) -> None:
        with lock:
            answers[claim.id] = confirmation
            if progress is not None:
                progress(claim, confirmation)

    lacking, asked = coq.missing(), list[Asked]()
    for claim in wanted:
        try:
            said = None if lacking else proposition(claim)
        except NoTranslation as error:
            answer(claim, Confirmation(False, str(error)))
            continue
        if said is None:
            answer(claim, Confirmation(False, lacking))
        elif memory and keep is None and (known := remembered.recall(memory, said.text, efforts)):
            answer(claim, known)
        else:
            asked.append((claim, said))

    def learn(claim: Claim, confirmation: Confirmation) -> None:
        if memory is not None:
            remembered.keep(memory, confirmation, efforts)
        answer(claim, confirmation)

    if asked:
        _ask(asked, workers or os.cpu_count() or 1, timeout, efforts, keep, learn)
    return {claim.id: answers[claim.id] for claim in wanted}


def _ask(
    asked: Sequence[Asked], processes: int, timeout: float, efforts: Sequence[Effort], keep: Path | None,
    answer: Progress,
) -> None:  # fmt: skip
    """What Coq says of each, in files of several."""
    least, most = _IN_A_FILE
    size = min(max(least, -(-len(asked) // processes)), most)
    stop = threading.Event()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as temporary:
        folder = Path(temporary) if keep is None else keep
        folder.mkdir(parents=True, exist_ok=True)
        coq.prepare(folder)

        def work(number: int) -> None:
            part = asked[number * size : (number + 1) * size]
            for claim, confirmation in _answers(folder, number, part, timeout, efforts, stop):
                answer(claim, confirmation)

        pool = ThreadPoolExecutor(processes)
        try:
            for _ in pool.map(work, range(-(-len(asked) // size))):
                pass
        finally:
            # A search for hints cannot be stopped, and is not waited for if this ends before its time.
            stop.set()
            pool.shutdown(wait=False, cancel_futures=True)


def _answers(
    folder: Path, number: int, asked: Sequence[Asked], timeout: float, efforts: Sequence[Effort], stop: threading.Event
) -> Iterator[tuple[Claim, Confirmation]]:
    """What Coq says of these claims; those at which it stops are asked again, with more hints."""
    left = [(claim, said, _theorem(said, f"{said.name}_{number}", efforts[0])) for claim, said in asked]
    run = 0
    tries = dict.fromkeys((claim.id for claim, *_ in left), 1)
    while left and not stop.is_set():
        theorems = [theorem for *_, theorem in left]
        file = folder / f"claims_{number:03d}{f'_{run}' if run else ''}.v"
        file.write_text(coq.source(theorems, timeout), encoding="utf-8")
        start = time.perf_counter()
        printed = coq.ask(folder, file.name, _TO_START + 2 * timeout * len(left), stop)
        if stop.is_set():
            return
        heard = coq.heard(printed.output, theorems)
        # What was proved before Coq was ended, and has not been looked at to the end, is asked again.
        there = coq.proved(printed.output, theorems)
        reasons: dict[str, coq.Refusal | None] = {
            theorem.name: None if theorem.name in there else printed.stopped(theorem)
            for theorem in theorems
            if theorem.name not in heard
        }
        moved = bool(heard) or any(reason is not None for reason in reasons.values())
        seconds = (time.perf_counter() - start) / len(left)
        again: list[Stated] = []
        for claim, said, theorem in left:
            if (against := heard.get(theorem.name)) is not None:
                yield claim, Confirmation(not against, against, said.text, seconds)
                continue
            reason = reasons[theorem.name]
            if reason is None and moved:  # Coq was ended before it came to this one
                again.append((claim, said, theorem))
            elif reason is not None and tries[claim.id] < len(efforts):
                again.append((claim, said, _theorem(said, theorem.name, efforts[tries[claim.id]])))
                tries[claim.id] += 1
            else:
                why = reason or coq.Refusal("Coq gave no answer", late=True)
                yield claim, Confirmation(False, why.reason, said.text, seconds, late=why.late)
        left = again
        run += 1


def _theorem(said: Proposition, name: str, effort: Effort) -> coq.Theorem:
    """The proposition with its tactics; where the search for hints fails, Coq is told so in their place."""
    try:
        tactics = script(said, thorough=effort == "thorough")
    except Exception as error:  # SymPy's, of whatever kind: the claim is without hints, the others are not
        reason = f"{type(error).__name__} in the search for hints: {error}".replace('"', "'")
        tactics = f'fail 0 "at" "{" ".join(reason.split())}"'
    return coq.Theorem(name, said.text, tactics)


def with_opinion(results: Sequence[Result], said: Mapping[str, Confirmation]) -> tuple[Result, ...]:
    """The results, with the evidence ``coq`` where the kernel has confirmed a proved claim."""
    return tuple(_with(result, said.get(result.claim.id)) for result in results)


def _with(result: Result, said: Confirmation | None) -> Result:
    if said is None or not said.confirmed or result.verdict is not Verdict.PROVED:
        return result
    detail = "restated for Coq with what has to be defined, and its proof checked by Coq's kernel"
    return replace(result, evidence=(*result.evidence, Evidence("coq", Verdict.PROVED, detail, said.seconds)))
