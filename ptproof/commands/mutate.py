"""``ptproof mutate``: corrupt every proved claim and see that nothing false is proved."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import click

from ptproof.commands import options
from ptproof.commands.papers import opened, qualified, shared

if TYPE_CHECKING:
    from ptproof.proof.mutation.outcomes import Mutation


@click.command()
@options.derivations
@options.as_json
@options.jobs
@options.timeout("one step with one corrupted claim", 8.0)
@click.option("-k", "select", default="", metavar="TEXT", help="Only claims that contain TEXT.")
def mutate(paths: tuple[str, ...], as_json: bool, jobs: int | None, timeout: float, select: str) -> int:
    """Corrupt every claim below each PATH that is expected to be proved (the shipped ones where left out).

    Each corrupted claim is attacked, given to the proof of its original, and held against the original.
    Exit status 1 if one that is false is proved.
    """
    from ptproof.commands.mutation_tables import mutation_progress, mutation_tables
    from ptproof.errors import InputError
    from ptproof.proof.mutation.running import corruptible
    from ptproof.proof.mutation.running import mutate as run

    found: dict[str, Mutation] = {}
    with opened(paths, select=select) as papers:
        for paper in papers:
            assert paper.derivation is not None  # nothing is remembered of mutants
            try:
                total = len(corruptible(paper.derivation.claims, select))
            except InputError:
                if paper is papers[-1] and not found:
                    raise
                continue
            with mutation_progress(total) as progress:
                found[paper.name] = run(
                    paper.derivation, workers=jobs, timeout=timeout, select=select, progress=progress
                )
        if as_json:
            options.print_json(_together(found))
        else:
            mutation_tables(found)
    return 0 if all(item.sound for item in found.values()) else 1


def _together(found: Mapping[str, Mutation]) -> dict[str, Any]:
    """The JSON of all papers; an id that stands in two of them is written ``paper:id``."""
    from ptproof.proof.mutation.outcomes import summed

    data = {name: item.to_json() for name, item in found.items()}
    twice = shared({name: list(item["claims"]) for name, item in data.items()})
    claims = {
        qualified(id, name, twice): {**counts, "paper": name}
        for name, item in data.items()
        for id, counts in item["claims"].items()
    }
    return {"claims": claims, "summary": summed(list(found.values()))}
