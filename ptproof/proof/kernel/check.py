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
from ptproof.proof.kernel.lemmas import Noted, settled
from ptproof.proof.kernel.remembered import Confirmation
from ptproof.proof.kernel.rounds import Inquiry, Round, rounds
from ptproof.proof.kernel.terms import NoTranslation
from ptproof.proof.kernel.theorem import proposition
from ptproof.proof.result import Result
from ptproof.proof.verdict import Evidence, Verdict

if TYPE_CHECKING:
    from ptproof.proof.memory import Memory

# Of 507 proofs that Coq found in the first paper the longest took 17 s, and all but four less than 10.
SECONDS_PER_CLAIM = 25.0
# A file takes 2 to 7 s for reading the libraries and finding the axioms, however many claims it has. Where these are
# quick, fewer are left to one process, and not more, so that what comes in is seen; where they are not, no process
# shall have many left when the others are done.
_IN_A_FILE: dict[Effort, tuple[int, int]] = {"quick": (6, 12), "lemmas": (2, 4), "thorough": (2, 4)}


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
        Called with each claim and what became of it, as it comes in; again if there is a better answer later. What
        follows from lemmas is not confirmed yet, and is so by :func:`ptproof.proof.kernel.lemmas.settled` of all that
        is known.
    keep
        A folder in which the files for Coq are left.
    efforts
        What is tried one after the other while Coq finds no proof: "quick" hints, the claims that this one uses as
        "lemmas", and "thorough" hints, which take longer to find (:mod:`ptproof.proof.kernel.rounds`).
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

    asked = list[Question]()
    for claim, found in _known(wanted, None if keep else memory, efforts):
        if isinstance(found, Confirmation):
            answer(claim, found)
        else:
            asked.append(found)
    if asked:
        inquiry = Inquiry(asked, answers, partial(_learn, answer, memory, efforts))
        _ask(workers or os.cpu_count() or 1, timeout, efforts, keep, inquiry)
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
) -> Iterator[tuple[Claim, Confirmation | Question]]:
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
            continue
        known = None if memory is None else remembered.recall(memory, said.text, efforts)
        yield claim, known if known and not known.more else Question(claim, said, given=known)


def _ask(
    processes: int, timeout: float, efforts: Sequence[Effort], keep: Path | None,
    inquiry: Inquiry,
) -> None:  # fmt: skip
    """What Coq says of each, in one round after the other: all that the first one confirms comes in first."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as temporary:
        folder = Path(temporary) if keep is None else keep
        folder.mkdir(parents=True, exist_ok=True)
        coq.prepare(folder)
        asking = Asking(folder, coq.Stop())
        for round_ in rounds(efforts, timeout):
            _ask_once(inquiry.now(round_), round_, processes, asking, partial(inquiry.say, round_))
        inquiry.end()


def _ask_once(
    asked: Sequence[Question], now: Round, processes: int, asking: Asking,
    say: Callable[[Question, Confirmation], None],
) -> None:  # fmt: skip
    """What Coq says of each in one round, in files of several; meanwhile the steps of proofs are noted."""
    least, most = _IN_A_FILE[now.effort]
    size = min(max(least, -(-len(asked) // processes)), most)
    noted = Noted([question.claim for question in asked] if now.effort == "lemmas" else [], processes, now.seconds)
    name = f"{now.effort}_waiting" if now.waiting else now.effort

    def work(number: int) -> None:
        some = asked[number * size : (number + 1) * size]
        for question, confirmation in asking.answers(
            f"{name}_{number:03d}", now.effort, some, now.seconds, noted.of
        ):  # fmt: skip
            say(question, confirmation)

    pool = ThreadPoolExecutor(processes)
    try:
        working = [pool.submit(work, number) for number in range(-(-len(asked) // size))]
        noted.take()
        for part in working:
            part.result()
    except BaseException:
        # A search for hints cannot be stopped, and is not waited for if this ends before its time.
        asking.stop.set()
        raise
    finally:
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
