"""``ptproof coverage``: show which labels of a paper the claims cover."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from ptproof.commands import options

if TYPE_CHECKING:
    from ptproof.report.coverage import Coverage


@click.command()
@click.argument("paper", metavar="PAPER.tex")
@options.derivations
@options.as_json
def coverage(paper: str, paths: tuple[str, ...], as_json: bool) -> int:
    """Show which equations of PAPER.tex the claims below each PATH cover (the shipped derivation where left out).

    Exit status 1 if a label of an equation is not covered, or a claim names a label that the paper does not have.
    """
    from ptproof.errors import InputError
    from ptproof.reading.latex.source import read_paper
    from ptproof.report.coverage import coverage as match
    from ptproof.report.labels import all_labels, equation_labels

    source = read_paper(paper)
    labels = equation_labels(source)
    if not labels:
        raise InputError(rf"{paper}: no \label stands in an equation; name the LaTeX source of the paper")
    with options.loaded(paths) as derivation:
        found = match(labels, [*derivation.claims, *derivation.definitions], all_labels(source))
        for label, ids in found.stale:
            click.echo(f"ptproof: {paper} has no label {label}, which is named by {', '.join(ids)}", err=True)
        if as_json:
            options.print_json(found.to_json())
        else:
            _show(found)
    return 0 if found.complete else 1


def _show(found: Coverage) -> None:
    from rich.text import Text

    from ptproof.commands.terminal import output, plain_table

    console = output()
    rows = [(Text(label, style="green"), Text(", ".join(ids), style="dim")) for label, ids in found.covered]
    rows += [(Text(label, style="bold red"), Text("nothing", style="red")) for label in found.missing]
    console.print(plain_table(("equation", "covered by"), rows))
    total = len(found.covered) + len(found.missing)
    console.print(f"{len(found.covered)} of {total} labelled equations are covered, {len(found.missing)} missing")
