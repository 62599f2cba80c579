"""``ptproof average``: average a dither system and check its assumptions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click

from ptproof.commands import options

if TYPE_CHECKING:
    from ptproof.averaging import Average


@dataclass(frozen=True)
class Outcome:
    """What people and programs are told about one dither system."""

    data: dict[str, Any]
    as_expected: bool
    latex: str = ""
    state: tuple[str, ...] = ()
    gradient: str = ""
    caveats: tuple[str, ...] = ()
    reason: str = ""


@click.command()
@click.argument("file", metavar="FILE.toml")
@options.as_json
@click.option("--timeout", type=float, default=60.0, show_default=True, help="Time limit, in seconds.")
def average(file: str, as_json: bool, timeout: float) -> int:
    """Average the dither system in FILE.toml, and examine every assumption of the theorem.

    Exit status 1 if the theorem does not cover the system, the average is not known, or the average that FILE
    claims is not proved.
    """
    outcome = _studied(file, timeout)
    if outcome.reason:
        click.echo(f"ptproof: {outcome.reason}", err=True)
    if as_json:
        options.print_json(outcome.data)
    else:
        _show(outcome)
    return 0 if outcome.as_expected else 1


def _studied(path: str, seconds: float) -> Outcome:
    """The outcome for a TOML file from a process of its own; out of time it says so, and nothing in it is claimed."""
    from ptproof.errors import InputError
    from ptproof.reading.limits import Answered, Unanswered, Why, apart, check_seconds

    check_seconds(seconds, "--timeout")
    match apart(seconds, _study, path):
        case Answered(outcome):
            return outcome
        case Unanswered(error=InputError() as error):
            raise error
        case Unanswered(Why.TIME):
            reason = f"{path}: no answer within {seconds:g} s; a longer --timeout may help"
        case Unanswered(_, reason):
            reason = f"{path}: nothing is claimed: {reason}"
    data: dict[str, Any] = {"average": None, "v": {}, "assumptions": {}, "expected": None}
    return Outcome(data, as_expected=False, reason=reason)


def _study(path: str) -> Outcome:
    from ptproof.averaging import load_dither_system, study

    problem = load_dither_system(path)
    found = study(problem)
    gradient = found.gradient
    return Outcome(
        found.to_json(),
        found.as_expected,
        found.latex(),
        tuple(str(symbol) for symbol in problem.system.state),
        f"drift + ({gradient[0]}) * grad {gradient[1]}" if gradient else "",
        found.caveats if found.system is not None else (),
        _reason(found),
    )


def _reason(found: Average) -> str:
    """Why there is no average, in one line."""
    if found.system is not None:
        return ""
    if found.refusals:
        return "; ".join(f"refused, {text}" for text in found.refusals)
    return "; ".join(f"undecided, {text}" for text in found.caveats)


def _show(outcome: Outcome) -> None:
    from rich.text import Text

    from ptproof.commands.terminal import COLOURS, output, plain_table

    console, data = output(), outcome.data
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
    rows = [
        (letter, Text(entry["verdict"], style=COLOURS[entry["verdict"]]), Text(entry["detail"], style="dim"))
        for letter, entry in data["assumptions"].items()
    ]
    console.print(plain_table(("assumption", "verdict", "detail"), rows))
    for caveat in outcome.caveats:
        console.print(Text(f"The average holds if this does, which was not shown: {caveat}", style="yellow"))
    _show_expected(console, data["expected"])


def _show_expected(console: Any, expected: dict[str, Any] | None) -> None:
    from rich.text import Text

    from ptproof.commands.terminal import COLOURS

    if expected is None:
        return
    verdict = expected["verdict"]
    console.print(Text(f"the expected average: {verdict}", style=COLOURS[verdict]))
    if expected["witness"]:
        witness = expected["witness"]
        values = ", ".join(f"{name} = {value}" for name, value in witness["values"].items())
        console.print(Text(f"  at {values}: derived {witness['left']}, expected {witness['right']}"))
