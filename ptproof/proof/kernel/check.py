"""Asking Coq's kernel about claims: restated, in files of several, in parallel, each with a time limit."""

from __future__ import annotations

import os
import tempfile
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from ptproof.proof.claim import Claim
from ptproof.proof.kernel import coq, remembered
from ptproof.proof.kernel.asking import EFFORTS, Asking, Effort, Question
from ptproof.proof.kernel.lemmas import Noted, has_steps, settled
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
_IN_A_FILE = (6, 12)


Progress = Callable[[Claim, Confirmation], None]


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
        Called with each claim and what became of it, as it comes in: what follows from lemmas is not confirmed yet, and
        is so by :func:`ptproof.proof.kernel.lemmas.settled` of all that is known.
    keep
        A folder in which the files for Coq are left.
    efforts
        What is tried one after the other while Coq finds no proof: "quick" hints, the claims that this one uses as
        "lemmas", and "thorough" hints, which take longer to find.
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

    asked: list[tuple[Claim, Proposition]] = []
    for claim, known in _known(wanted, None if keep else memory, efforts):
        if isinstance(known, Confirmation):
            answer(claim, known)
        else:
            asked.append((claim, known))
    if asked:
        learn = partial(_learn, answer, memory, efforts)
        _ask(asked, workers or os.cpu_count() or 1, timeout, efforts, keep, learn)
    answers = settled(answers)
    return {claim.id: answers[claim.id] for claim in wanted}


def _learn(
    answer: Progress, memory: Memory | None, efforts: Sequence[Effort], claim: Claim, confirmation: Confirmation
) -> None:  # fmt: skip
    if memory is not None:
        remembered.keep(memory, confirmation, efforts)
    answer(claim, confirmation)


def _known(
    claims: Iterable[Claim], memory: Memory | None, efforts: Sequence[Effort]
) -> Iterator[tuple[Claim, Confirmation | Proposition]]:
    """What is known of each claim before Coq is asked, or what Coq is to be asked."""
    lacking = coq.missing()
    for claim in claims:
        try:
            said = None if lacking else proposition(claim)
        except NoTranslation as error:
            yield claim, Confirmation(False, str(error))
            continue
        if said is None:
            yield claim, Confirmation(False, lacking)
        else:
            yield claim, (memory and remembered.recall(memory, said.text, efforts)) or said


def _ask(
    asked: Sequence[tuple[Claim, Proposition]], processes: int, timeout: float, efforts: Sequence[Effort],
    keep: Path | None, answer: Progress,
) -> None:  # fmt: skip
    """What Coq says of each, with one effort after the other: all that the first one confirms comes in first."""
    left = [Question(claim, said) for claim, said in asked]
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as temporary:
        folder = Path(temporary) if keep is None else keep
        folder.mkdir(parents=True, exist_ok=True)
        coq.prepare(folder)
        for position, effort in enumerate(efforts):
            # Where a proof puts nothing to use, there is nothing to ask about with lemmas.
            now = [question for question in left if effort != "lemmas" or has_steps(question.claim)]
            passed = [question for question in left if question not in now]
            left, more = list[Question](), len(efforts) > position + 1
            say = partial(_say, answer, left if more else None)
            for question in passed:
                say(question, Confirmation(False, "it uses no claim that Coq could be told", question.said.text))
            _ask_once(now, effort, processes, timeout, folder, say)


def _say(answer: Progress, left: list[Question] | None, question: Question, said: Confirmation) -> None:
    """Give the answer, or keep the question, if it may be asked again and what was said is not the last word."""
    late = said.late or question.late
    if said.confirmed or said.given:
        answer(question.claim, said)
    elif left is None:
        answer(question.claim, replace(said, late=late))
    else:
        left.append(replace(question, late=late))


def _ask_once(
    asked: Sequence[Question], effort: Effort, processes: int, timeout: float, folder: Path,
    say: Callable[[Question, Confirmation], None],
) -> None:  # fmt: skip
    """What Coq says of each with one effort, in files of several; meanwhile the steps of proofs are noted."""
    least, most = _IN_A_FILE
    size = min(max(least, -(-len(asked) // processes)), most)
    stop = coq.Stop()
    noted = Noted([question.claim for question in asked] if effort == "lemmas" else [], processes, timeout)
    asking = Asking(folder, timeout, stop, noted.of)

    def work(number: int) -> None:
        some = asked[number * size : (number + 1) * size]
        for question, confirmation in asking.answers(f"{effort}_{number:03d}", effort, some):
            say(question, confirmation)

    pool = ThreadPoolExecutor(processes)
    try:
        working = [pool.submit(work, number) for number in range(-(-len(asked) // size))]
        noted.take()
        for part in working:
            part.result()
    finally:
        # A search for hints cannot be stopped, and is not waited for if this ends before its time.
        stop.set()
        noted.stop()
        pool.shutdown(wait=False, cancel_futures=True)


def with_opinion(results: Sequence[Result], said: Mapping[str, Confirmation]) -> tuple[Result, ...]:
    """The results, with the evidence ``coq`` where the kernel has confirmed a proved claim."""
    return tuple(_with(result, said.get(result.claim.id)) for result in results)


def _with(result: Result, said: Confirmation | None) -> Result:
    if said is None or not said.confirmed or result.verdict is not Verdict.PROVED:
        return result
    detail = "restated for Coq with what has to be defined, and its proof checked by Coq's kernel"
    if said.given:
        detail += f", with {len(said.given)} of the claims that it uses as lemmas, which Coq has confirmed"
    return replace(result, evidence=(*result.evidence, Evidence("coq", Verdict.PROVED, detail, said.seconds)))
