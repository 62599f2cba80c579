"""``ptproof verify``."""

from __future__ import annotations

import json

import click


@click.command()
@click.argument("paths", nargs=-1, metavar="[PATH]...")
@click.option("--json", "as_json", is_flag=True, help="Print JSON on standard output.")
@click.option("--jobs", type=int, default=None, help="Worker processes (default: the number of processors).")
@click.option("--timeout", type=float, default=60.0, show_default=True, help="Time limit of one claim, in seconds.")
@click.option("-k", "select", default="", metavar="TEXT", help="Only claims that contain TEXT, and what they use.")
def verify(paths: tuple[str, ...], as_json: bool, jobs: int | None, timeout: float, select: str) -> int:
    """Verify the claims below each PATH (the shipped derivation of the paper where left out).

    Exit status 1 if a claim did not come out as its author recorded.
    """
    from ptproof.commands.terminal import claim_progress, verification_table
    from ptproof.proof.load import load
    from ptproof.proof.run import verify as run

    derivation = load(paths)
    with claim_progress(len(derivation.select(select))) as progress:
        verification = run(derivation, jobs=jobs, timeout=timeout, select=select, progress=progress)
    if as_json:
        click.echo(json.dumps(verification.to_json(), indent=2, ensure_ascii=False))
    else:
        verification_table(verification)
    return 0 if verification.as_expected else 1
