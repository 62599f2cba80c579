"""What Coq's kernel confirmed, as evidence beside that of the engines."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from ptproof.proof.claim import Claim
from ptproof.proof.kernel.check import SECONDS_PER_CLAIM, Confirmation, check
from ptproof.proof.result import Result
from ptproof.proof.verdict import Evidence, Verdict


def second_opinion(
    results: Sequence[Result], *, workers: int | None = None, timeout: float | None = None, keep: Path | None = None,
    progress: Callable[[Claim, Confirmation], None] | None = None,
) -> tuple[tuple[Result, ...], Mapping[str, Confirmation]]:  # fmt: skip
    """The results, with the evidence ``coq`` where the kernel confirmed a proved claim, and all that it said.

    The parameters are those of :func:`ptproof.proof.kernel.check.check`.
    """
    proved = [result.claim for result in results if result.verdict is Verdict.PROVED]
    seconds = SECONDS_PER_CLAIM if timeout is None else timeout
    said = check(proved, workers=workers, keep=keep, progress=progress, timeout=seconds)
    return tuple(_with(result, said.get(result.claim.id)) for result in results), said


def _with(result: Result, said: Confirmation | None) -> Result:
    if said is None or not said.confirmed:
        return result
    detail = "restated for Coq with what has to be defined, and its proof checked by Coq's kernel"
    return replace(result, evidence=(*result.evidence, Evidence("coq", Verdict.PROVED, detail, said.seconds)))
