"""``ptproof report``: verify, simulate, and write the pages and figures."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import click

from ptproof.commands import guard, options, streams
from ptproof.errors import InputError
from ptproof.reading.outcomes import in_words

if TYPE_CHECKING:
    from pathlib import Path

    from ptproof.proof.load import Derivation
    from ptproof.proof.result import Verification
    from ptproof.report.content import Figure, Table


@click.command()
@options.derivations
@click.option("--out", default="reports", show_default=True, metavar="FOLDER", help="Where to write the report.")
@options.jobs
@options.cluster
@options.timeout("one claim")
@options.fresh
@click.option("--no-figures", is_flag=True, help="Leave out the simulations and their figures.")
def report(
    paths: tuple[str, ...],
    out: str,
    jobs: int | None,
    cluster: str | None,
    timeout: float,
    fresh: bool,
    no_figures: bool,
) -> int:
    """Verify the claims below each PATH (the shipped derivation of the paper where left out) and write the report.

    Writes index.html, report.md, graph.svg and figures/ into FOLDER. Exit status 1 if a claim did not come out as
    its author recorded, or a figure could not be drawn; the report is written all the same.
    """
    from ptproof.commands.terminal import claim_progress
    from ptproof.proof.run import Interrupted
    from ptproof.proof.run import verify as run
    from ptproof.report.writing import check_place

    place = check_place(out)
    memory = options.memory_of(paths, fresh)
    with options.loaded(paths, memory) as derivation:
        try:
            with options.connected(cluster) as client, claim_progress(len(derivation.claims)) as progress:
                verification = run(
                    derivation, workers=jobs, client=client, timeout=timeout, progress=progress, memory=memory
                )
        except Interrupted as interrupted:
            status = options.interrupted(interrupted)
            _summarize(interrupted.verification)
            return status
        try:
            return _write(place, derivation, verification, no_figures)
        except KeyboardInterrupt:  # nothing is half written, and what is decided is shown
            _summarize(verification)
            if guard.own_interrupt():
                raise InputError("the derivation raised KeyboardInterrupt while the report was written") from None
            raise


def _write(place: Path, derivation: Derivation, verification: Verification, no_figures: bool) -> int:
    from ptproof.report.compose import compose
    from ptproof.report.letters import notation_of, title_of
    from ptproof.report.pages import report_files
    from ptproof.report.versions import versions
    from ptproof.report.writing import write_report

    guard.doing("while the report was made; none is written")
    figures, tables, notes = ((), (), ()) if no_figures else _drawn(derivation)
    content = compose(
        verification, derivation, title=title_of(derivation), notation=notation_of(derivation),
        versions=versions(), figures=figures, appendix=tables, notes=notes,
    )  # fmt: skip
    write_report(place, report_files(content))
    _summarize(verification)
    for claim in content.unexpected:
        click.echo(f"ptproof: {claim.ref.id}: expected {claim.expected}, came out {claim.status.word}", err=True)
    for note in notes:
        click.echo(f"ptproof: {note}", err=True)
    click.echo(f"{place / 'index.html'}  the report, for a browser", file=streams.out())
    click.echo(f"{place / 'report.md'}  the same as Markdown", file=streams.out())
    return 0 if verification.as_expected and not notes else 1


def _summarize(verification: Verification) -> None:
    from ptproof.commands.terminal import COLOURS

    summary = verification.summary()
    words = ", ".join(f"{summary[word]} {word}" for word in COLOURS if summary[word])
    click.echo(f"{summary['total']} claims: {words}; {summary['fully_proved']} fully proved", file=streams.out())


def _drawn(derivation: Derivation) -> tuple[tuple[Figure, ...], tuple[Table, ...], tuple[str, ...]]:
    """The figures and tables of the derivation; one that fails is named in the report instead of ending it."""
    from ptproof.report.content import brought

    if any(f"{package.__name__}.figures" in sys.modules for package in derivation.packages):
        click.echo("simulating and drawing the figures", err=True)
    try:
        return tuple(brought(derivation, "figures")), tuple(brought(derivation, "tables")), ()
    except KeyboardInterrupt:
        raise
    except Exception as error:
        return (), (), (f"The figures could not be drawn: {type(error).__name__}: {error}",)
    except BaseException as error:
        return (), (), (f"The figures could not be drawn: their code {in_words(error)}",)
