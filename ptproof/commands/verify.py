"""``ptproof verify``: verify the claims of one or more derivations."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ptproof.commands import opinion, options
from ptproof.commands.papers import Opened, opened
from ptproof.commands.shown import Shown, together

if TYPE_CHECKING:
    from ptproof.proof.load import Derivation
    from ptproof.proof.memory import Memory
    from ptproof.proof.result import Verification


@click.command()
@options.derivations
@options.as_json
@options.jobs
@options.cluster
@options.timeout("one claim")
@click.option("-k", "select", default="", metavar="TEXT", help="Only claims that contain TEXT, and what they use.")
@options.fresh
@opinion.kernel
@opinion.keep
def verify(
    paths: tuple[str, ...], as_json: bool, select: str, fresh: bool, kernel: bool, keep: Path | None, **how: Any
) -> int:
    """Verify the claims below each PATH (the shipped derivations where left out), one paper after the other.

    Of a derivation that was written from a paper it also says how many formulas are gaps, of which nothing is stated.
    What an earlier run has decided is not decided again while every file that it depends on is the same. Exit status 1
    if a claim did not come out as its author recorded.
    """
    opinion.available(kernel, keep)

    def known(memory: Memory) -> Shown | None:
        return Shown.again(None if kernel or how["cluster"] is not None else memory.run(select))

    begin, found = time.perf_counter(), {}
    with opened(paths, fresh, select, known) as papers:
        status = 0
        for paper in papers:
            folder = keep / paper.name if keep is not None and len(papers) > 1 else keep
            found[paper.name], new = _paper(paper, select, kernel, folder, begin, how)
            begin, status = time.perf_counter(), max(status, new)
            if new not in (0, 1):  # interrupted
                break
        _print(found, as_json)
    return status


def _paper(
    paper: Opened, select: str, kernel: bool, keep: Path | None, begin: float, how: dict[str, Any]
) -> tuple[Shown, int]:
    """What there is to show of a paper, and its exit status."""
    if paper.derivation is None:
        known: Shown = replace(paper.known, seconds=time.perf_counter() - begin)
        return known, 0 if known.as_expected else 1
    verification, status = _decided(paper.derivation, paper.memory, select, **how)
    shown = Shown.of(verification)
    if status not in (0, 1):  # interrupted
        return shown, status
    paper.memory.keep_run(select, shown.data, paper.memory.lasts(verification))
    if kernel:
        verification, ended = opinion.confirmed(verification, how["jobs"], keep, paper.memory)
        shown, status = Shown.of(verification), status if ended is None else ended
    return shown, status


def _decided(
    derivation: Derivation, memory: Memory, select: str, jobs: int | None, cluster: str | None, timeout: float
) -> tuple[Verification, int]:
    """What came out, and the exit status."""
    from ptproof.commands.terminal import claim_progress
    from ptproof.proof.run import Interrupted
    from ptproof.proof.run import verify as run

    try:
        with options.connected(cluster) as client, claim_progress(len(derivation.select(select))) as progress:
            verification = run(
                derivation, workers=jobs, client=client, timeout=timeout, select=select, progress=progress,
                memory=memory,
            )  # fmt: skip
    except Interrupted as interrupted:
        return interrupted.verification, options.interrupted(interrupted)
    if not select:
        verification = replace(verification, gaps=len(derivation.gaps))
    return verification, 0 if verification.as_expected else 1


def _print(found: dict[str, Shown], as_json: bool) -> None:
    if as_json:
        options.print_json(together(found))
    else:
        from ptproof.commands.terminal import verification_tables

        verification_tables(found)
