"""``ptproof new``: write a small derivation to start from, or one drafted from a paper."""

from __future__ import annotations

from pathlib import Path

import click

from ptproof.commands import options


@click.command()
@click.argument("folder", metavar="DIR")
@click.option("--from", "paper", metavar="PAPER.tex", help="Draft the derivation from the LaTeX source of a paper.")
@options.as_json
def new(folder: str, paper: str | None, as_json: bool) -> int:
    """Write a small derivation into the new or empty folder DIR: letters, three claims, tests and two problem files.

    One of the claims is false, and recorded as false: it shows what a witness looks like.

    With --from it is drafted from a paper: a file for each section, each formula as a definition, a claim as it is
    printed, or a gap that says why it was not read. What letters mean is guessed, and everything says so.
    """
    if paper is not None:
        return _drafted(folder, paper, as_json)
    from ptproof.commands.starter import write_starter

    files = write_starter(folder)
    if as_json:
        options.print_json({"folder": folder, "files": [file.name for file in files]})
        return 0
    click.echo(f"{folder} holds {', '.join(file.name for file in files)}. Next:")
    _next(
        (f"ptproof verify {folder}", "decide its three claims"),
        (f"ptproof report {folder} --out {folder}/report", "write them up"),
        (f"pytest --ptproof {folder}", "the claims and the tests, in pytest"),
        (f"ptproof average {folder}/dither.toml", "average a dither system"),
        (f"ptproof simulate {folder}/seeker.toml", "let the vehicle drive"),
    )
    return 0


def _drafted(folder: str, paper: str, as_json: bool) -> int:
    """Write what the paper gives; what was not understood, with its place, goes to standard error."""
    from ptproof.commands.starter import check, write_files
    from ptproof.drafting.draft import draft

    check(Path(folder))
    found = draft(paper)
    files = write_files(folder, found.files)
    for name in found.absent:
        click.echo(f"ptproof: {paper} inputs {name}, which is not beside it; nothing of that was read", err=True)
    for item in found.gaps:
        click.echo(f"ptproof: {item.formula.place}: {item.why}", err=True)
    counts = found.counts
    if as_json:
        gaps = [
            {"id": item.id, "place": item.formula.place, "line": item.formula.line, "why": item.why}
            for item in found.gaps
        ]
        options.print_json({"folder": folder, "files": [file.name for file in files], "counts": counts, "gaps": gaps})
        return 0
    words = ", ".join(f"{number} {kind}{'s' * (number != 1)}" for kind, number in counts.items())
    click.echo(f"{folder} holds {len(files)} files with {words}. What letters mean is guessed. Next:")
    _next(
        (f"ptproof verify {folder}", "what can be decided as it stands"),
        (f"ptproof coverage {paper} {folder}", "the paper against what was written"),
        (f"ptproof report {folder} --no-figures", "write it up"),
        (f"pytest --ptproof {folder}", "the claims, in pytest"),
    )
    return 0


def _next(*steps: tuple[str, str]) -> None:
    for command, purpose in steps:
        click.echo(f"  {command:<48} {purpose}")
