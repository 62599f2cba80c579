"""``ptproof mutate``: corrupt every proved claim and see that nothing false is proved."""

from __future__ import annotations

import click

from ptproof.commands import options


@click.command()
@options.derivations
@options.as_json
@options.jobs
@options.timeout("one step with one corrupted claim", 8.0)
@click.option("-k", "select", default="", metavar="TEXT", help="Only claims that contain TEXT.")
def mutate(paths: tuple[str, ...], as_json: bool, jobs: int | None, timeout: float, select: str) -> int:
    """Corrupt every claim below each PATH that is expected to be proved (the shipped derivation where left out).

    Each corrupted claim is attacked, given to the proof of its original, and held against the original.
    Exit status 1 if one that is false is proved.
    """
    from ptproof.commands.mutation_tables import mutation_progress, mutation_tables
    from ptproof.proof.mutation.running import corruptible
    from ptproof.proof.mutation.running import mutate as run

    with options.loaded(paths) as derivation:
        with mutation_progress(len(corruptible(derivation.claims, select))) as progress:
            found = run(derivation, workers=jobs, timeout=timeout, select=select, progress=progress)
        if as_json:
            options.print_json(found.to_json())
        else:
            mutation_tables(found)
    return 0 if found.sound else 1
