"""Asking Coq's kernel about claims: restated, in files of several, in parallel, each with a time limit."""

from __future__ import annotations

import os
import tempfile
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal, TypeAlias

from ptproof.proof.claim import Claim
from ptproof.proof.kernel import coq
from ptproof.proof.kernel.hints.portfolio import script
from ptproof.proof.kernel.terms import NoTranslation
from ptproof.proof.kernel.theorem import Proposition, proposition
from ptproof.proof.result import Result
from ptproof.proof.verdict import Evidence, Verdict

SECONDS_PER_CLAIM = 40.0
# Most of a file's time goes into reading the libraries and finding the axioms, at 2 to 7 s however many claims it has;
# fewer than these are left to one process, and not more, so that what comes in is seen.
_IN_A_FILE = (6, 24)
_TO_START = 30.0


@dataclass(frozen=True)
class Confirmation:
    """What Coq's kernel says of one claim: whether it has checked a proof of it as restated, and if not, the reason.

    ``proposition`` is the claim in Coq's words, where it has a translation. ``seconds`` is how long the file took that
    the claim stood in, shared among its claims. [s]
    """

    confirmed: bool
    reason: str = ""
    proposition: str = ""
    seconds: float = 0.0


Progress = Callable[[Claim, Confirmation], None]
Effort: TypeAlias = Literal["quick", "thorough"]
EFFORTS: tuple[Effort, ...] = ("quick", "thorough")
Stated = tuple[Claim, Proposition, coq.Theorem]


def check(
    claims: Iterable[Claim], *, workers: int | None = None, timeout: float = SECONDS_PER_CLAIM,
    progress: Progress | None = None, keep: Path | None = None, efforts: Sequence[Effort] = EFFORTS,
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

    Returns
    -------
    dict
        By the claims' ids. A claim of which Coq has found no proof may be true all the same.
    """
    wanted = list(claims)
    answers: dict[str, Confirmation] = {}
    lock = threading.Lock()

    def answer(claim: Claim, confirmation: Confirmation) -> None:
        with lock:
            answers[claim.id] = confirmation
            if progress is not None:
                progress(claim, confirmation)

    if lacking := coq.missing():
        for claim in wanted:
            answer(claim, Confirmation(False, lacking))
        return answers
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary) if keep is None else keep
        folder.mkdir(parents=True, exist_ok=True)
        coq.prepare(folder)
        processes = workers or os.cpu_count() or 1
        least, most = _IN_A_FILE
        size = min(max(least, -(-len(wanted) // processes)), most)

        def work(number: int) -> None:
            part = wanted[number * size : (number + 1) * size]
            for claim, confirmation in _answers(folder, number, part, timeout, efforts):
                answer(claim, confirmation)

        with ThreadPoolExecutor(processes) as pool:
            for _ in pool.map(work, range(-(-len(wanted) // size))):
                pass
    return {claim.id: answers[claim.id] for claim in wanted}


def _answers(
    folder: Path, number: int, claims: Sequence[Claim], timeout: float, efforts: Sequence[Effort]
) -> Iterator[tuple[Claim, Confirmation]]:
    """What Coq says of these claims; those at which it stops are asked again, with more hints."""
    left: list[Stated] = []
    for claim in claims:
        try:
            said = proposition(claim)
        except NoTranslation as error:
            yield claim, Confirmation(False, str(error))
        else:
            left.append((claim, said, _theorem(said, f"{said.name}_{number}", efforts[0])))
    run = 0
    tries = dict.fromkeys((claim.id for claim, *_ in left), 1)
    while left:
        theorems = [theorem for *_, theorem in left]
        file = folder / f"claims_{number:03d}{f'_{run}' if run else ''}.v"
        file.write_text(coq.source(theorems, timeout), encoding="utf-8")
        start = time.perf_counter()
        printed = coq.ask(folder, file.name, _TO_START + 2 * timeout * len(left))
        heard = coq.heard(printed.output, theorems)
        # What was proved before Coq was ended, and has not been looked at to the end, is asked again.
        there = coq.proved(printed.output, theorems)
        reasons = {
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
                yield claim, Confirmation(False, reason or "Coq gave no answer", said.text, seconds)
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


def second_opinion(
    results: Sequence[Result], *, workers: int | None = None, keep: Path | None = None, progress: Progress | None = None
) -> tuple[tuple[Result, ...], Mapping[str, Confirmation]]:  # fmt: skip
    """The results, with the evidence ``coq`` where the kernel confirmed a proved claim, and all that it said.

    The parameters are those of :func:`check`.
    """
    proved = [result.claim for result in results if result.verdict is Verdict.PROVED]
    said = check(proved, workers=workers, keep=keep, progress=progress)
    return tuple(_with(result, said.get(result.claim.id)) for result in results), said


def _with(result: Result, said: Confirmation | None) -> Result:
    if said is None or not said.confirmed:
        return result
    detail = "restated for Coq with what has to be defined, and its proof checked by Coq's kernel"
    return replace(result, evidence=(*result.evidence, Evidence("coq", Verdict.PROVED, detail, said.seconds)))
