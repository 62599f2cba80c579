"""``ptproof verify``: verify the claims of a derivation."""

from __future__ import annotations

from pathlib import Path

import click

from ptproof.commands import opinion, options


@click.command()
@options.derivations
@options.as_json
@options.jobs
@options.cluster
@options.timeout("one claim")
@click.option("-k", "select", default="", metavar="TEXT", help="Only claims that contain TEXT, and what they use.")
@opinion.kernel
@opinion.keep
def verify(
    paths: tuple[str, ...], as_json: bool, jobs: int | None, cluster: str | None, timeout: float, select: str,
    kernel: bool, keep: Path | None,
) -> int:  # fmt: skip
    """Verify the claims below each PATH (the shipped derivation of the paper where left out).

    Exit status 1 if a claim did not come out as its author recorded.
    """
    from ptproof.commands.terminal import claim_progress, verification_table
    from ptproof.proof.run import Interrupted
    from ptproof.proof.run import verify as run

    opinion.available(kernel, keep)
    status = None
    with options.loaded(paths) as derivation:
        try:
            with options.connected(cluster) as client, claim_progress(len(derivation.select(select))) as progress:
                verification = run(
                    derivation, workers=jobs, client=client, timeout=timeout, select=select, progress=progress
                )
        except Interrupted as interrupted:
            verification, status = interrupted.verification, options.interrupted(interrupted)
        if kernel and status is None:
            verification = opinion.confirmed(verification, jobs, keep)
        if as_json:
            options.print_json(verification.to_json())
        else:
            verification_table(verification)
    return status if status is not None else 0 if verification.as_expected else 1
