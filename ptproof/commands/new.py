"""``ptproof new``: write a small derivation to start from."""

from __future__ import annotations

import click

from ptproof.commands import options


@click.command()
@click.argument("folder", metavar="DIR")
@options.as_json
def new(folder: str, as_json: bool) -> int:
    """Write a small derivation into the new or empty folder DIR: letters, three claims, tests and two problem files.

    One of the claims is false, and recorded as false: it shows what a witness looks like.
    """
    from ptproof.commands.starter import write_starter

    files = write_starter(folder)
    if as_json:
        options.print_json({"folder": folder, "files": [file.name for file in files]})
        return 0
    click.echo(f"{folder} holds {', '.join(file.name for file in files)}. Next:")
    for command, purpose in (
        (f"ptproof verify {folder}", "decide its three claims"),
        (f"ptproof report {folder} --out {folder}/report", "write them up"),
        (f"pytest --ptproof {folder}", "the claims and the tests, in pytest"),
        (f"ptproof average {folder}/dither.toml", "average a dither system"),
        (f"ptproof simulate {folder}/seeker.toml", "let the vehicle drive"),
    ):
        click.echo(f"  {command:<48} {purpose}")
    return 0
