"""Asking Coq's kernel about claims: restated, in files of several, in parallel, each with a time limit."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import tempfile
import threading
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from ptproof.proof.claim import Claim
from ptproof.proof.kernel import coq
from ptproof.proof.kernel.portfolio import script
from ptproof.proof.kernel.terms import NoTranslation
from ptproof.proof.kernel.theorem import Proposition, proposition

_IN_A_FILE = 6
_STARTING = 20.0


@dataclass(frozen=True)
class Confirmation:
    """What Coq's kernel says of one claim.

    Attributes
    ----------
    confirmed
        Whether the kernel has checked a proof of the claim as restated.
    reason
        Why not; or the claims that were used, themselves confirmed.
    proposition
        The claim in Coq's words, where it has a translation.
    seconds
        How long the file took that the claim stood in, shared among its claims. [s]
    """

    confirmed: bool
    reason: str = ""
    proposition: str = ""
    seconds: float = 0.0


Progress = Callable[[Claim, Confirmation], None]


def check(
    claims: Iterable[Claim], *, workers: int | None = None, timeout: float = 30.0, progress: Progress | None = None,
    keep: Path | None = None,
) -> dict[str, Confirmation]:  # fmt: skip
    """Have Coq's kernel check each claim.

    Parameters
    ----------
    claims
        Those that were proved; nothing else is asked.
    workers
        How many processes of Coq at a time (the number of processors where left out).
    timeout
        The time limit of one claim. [s]
    progress
        Called with each claim and what became of it, as it comes in.
    keep
        A folder that the files for Coq are left in.

    Returns
    -------
    dict
        By the claims' ids. A claim of which Coq found no proof may be true all the same.
    """
    wanted = list(claims)
    answers: dict[str, Confirmation] = {}

    def answer(claim: Claim, confirmation: Confirmation) -> None:
        answers[claim.id] = confirmation
        if progress is not None:
            progress(claim, confirmation)

    if lacking := coq.missing():
        for claim in wanted:
            answer(claim, Confirmation(False, lacking))
        return answers
    stated: list[tuple[Claim, Proposition]] = []
    for claim in wanted:
        try:
            stated.append((claim, proposition(claim)))
        except NoTranslation as error:
            answer(claim, Confirmation(False, str(error)))
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary) if keep is None else keep
        folder.mkdir(parents=True, exist_ok=True)
        coq.prepare(folder)
        lock = threading.Lock()

        def work(number: int, part: Sequence[tuple[Claim, Proposition]]) -> None:
            for claim, confirmation in _answers(folder, number, part, timeout):
                with lock:
                    answer(claim, confirmation)

        parts = [stated[start : start + _IN_A_FILE] for start in range(0, len(stated), _IN_A_FILE)]
        with ThreadPoolExecutor(workers or os.cpu_count() or 1) as pool:
            for done in [pool.submit(work, number, part) for number, part in enumerate(parts)]:
                done.result()
    return {claim.id: answers[claim.id] for claim in wanted}


def _answers(folder, number, part, timeout):
    rest = list(part)
    run = 0
    while rest:
        propositions = {item.name: item.text for _, item in rest}
        theorems = [coq.Theorem(item.name, item.text, script(item)) for claim, item in rest]
        file = folder / f"claims_{number:03d}_{run}.v"
        run += 1
        file.write_text(coq.source(propositions, theorems, int(timeout)))
        start = time.perf_counter()
        output, error, late = _coqc(folder, file.name, _STARTING + 2 * timeout * len(rest))
        seconds = (time.perf_counter() - start) / len(rest)
        heard = list(coq.heard(output, theorems))
        for (claim, item), (_, said) in zip(rest, heard):
            yield claim, Confirmation(not said.reason, said.reason, item.text, seconds)
        rest = rest[len(heard):]
        if rest:
            claim, item = rest.pop(0)
            yield claim, Confirmation(False, "time limit" if late or "Timeout" in error else "no tactic proved it: " + error[-300:], item.text, seconds)


def _coqc(folder: Path, file: str, seconds: float) -> tuple[str, str, bool]:
    with subprocess.Popen(coq.command(file), cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          start_new_session=True) as process:  # fmt: skip
        try:
            output, error = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            output, error = process.communicate()
            return output, error, True
    return output, error, False
