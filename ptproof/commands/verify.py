"""``ptproof verify``: verify the claims of a derivation."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ptproof.commands import guard, opinion, options
from ptproof.commands.shown import Shown

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
    """Verify the claims below each PATH (the shipped derivation of the paper where left out).

    Of a derivation that was written from a paper it also says how many formulas are gaps, of which nothing is stated.
    What an earlier run has decided is not decided again while every file that it depends on is the same. Exit status 1
    if a claim did not come out as its author recorded.
    """
    start = time.perf_counter()
    opinion.available(kernel, keep)
    memory = options.memory_of(paths, fresh)
    kept = None if kernel or how["cluster"] is not None else memory.run(select)
    if (shown := Shown.again(kept)) is not None:
        _print(replace(shown, seconds=time.perf_counter() - start), as_json)
        return 0 if shown.as_expected else 1
    with options.loaded(paths, memory, select) as derivation:
        verification, status = _decided(derivation, memory, select, **how)
        if kernel and status in (0, 1):
            try:
                verification = opinion.confirmed(verification, how["jobs"], keep)
            except KeyboardInterrupt:
                click.echo("ptproof: interrupted before Coq had answered", err=True)
                status = guard.interrupt_status()
        _print(Shown.of(verification), as_json)
    return status


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
    memory.keep_run(select, Shown.of(verification).data, verification)
    return verification, 0 if verification.as_expected else 1


def _print(shown: Shown, as_json: bool) -> None:
    if as_json:
        options.print_json(shown.json)
    else:
        from ptproof.commands.terminal import verification_table

        verification_table(shown)
