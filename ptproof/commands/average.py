"""``ptproof average``: average a dither system and check its assumptions."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from ptproof.averaging.limited import Outcome

_STYLES = {"proved": "green", "refuted": "bold red", "undecided": "yellow"}


@click.command()
@click.argument("file", metavar="FILE.toml")
@click.option("--json", "as_json", is_flag=True, help="Print JSON on standard output.")
@click.option("--timeout", type=float, default=60.0, show_default=True, help="Time limit, in seconds.")
def average(file: str, as_json: bool, timeout: float) -> int:
    """Average the dither system in FILE.toml, and examine every assumption of the theorem.

    Exit status 1 if the theorem does not cover the system, the average is not known, or the average that FILE
    claims is not proved.
    """
    from ptproof.averaging.limited import study_file

    outcome = study_file(file, timeout)
    if outcome.reason:
        click.echo(f"ptproof: {outcome.reason}", err=True)
    if as_json:
        click.echo(json.dumps(outcome.data, indent=2, ensure_ascii=False))
    else:
        _show(outcome)
    return 0 if outcome.as_expected else 1


def _show(outcome: Outcome) -> None:
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    console, data = Console(), outcome.data
    if data["average"] is not None:
        for symbol, entry in zip(outcome.state, data["average"], strict=True):
            console.print(Text(f"d{symbol}/dtau = {entry}", style="bold"))
        if outcome.gradient:
            console.print(Text(outcome.gradient))
        console.print(Text(outcome.latex, style="dim"))
        values = {key: value for key, value in data["v"].items() if value != "0"}
        shown = ", ".join(f"v_{key} = {value}" for key, value in list(values.items())[:12])
        more = f", and {len(values) - 12} more" if len(values) > 12 else ""
        console.print(Text(f"coefficients that do not vanish: {shown or 'none'}{more}"))
    else:
        console.print(Text("There is no average.", style="bold red"))
    table = Table(box=None, pad_edge=False)
    for column in ("assumption", "verdict", "detail"):
        table.add_column(column, overflow="fold")
    for letter, entry in data["assumptions"].items():
        verdict = entry["verdict"]
        table.add_row(letter, Text(verdict, style=_STYLES.get(verdict, "")), Text(entry["detail"], style="dim"))
    console.print(table)
    for caveat in outcome.caveats:
        console.print(Text(f"The average holds if this does, which was not shown: {caveat}", style="yellow"))
    _show_expected(console, data["expected"])


def _show_expected(console: Any, expected: dict[str, Any] | None) -> None:
    from rich.text import Text

    if expected is None:
        return
    verdict = expected["verdict"]
    console.print(Text(f"the expected average: {verdict}", style=_STYLES.get(verdict, "")))
    if expected["witness"]:
        witness = expected["witness"]
        values = ", ".join(f"{name} = {value}" for name, value in witness["values"].items())
        console.print(Text(f"  at {values}: derived {witness['left']}, expected {witness['right']}"))
