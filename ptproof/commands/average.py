"""``ptproof average``: average a dither system and check its assumptions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import click

from ptproof.commands import options

if TYPE_CHECKING:
    from ptproof.averaging import Average


_LONGEST = 300


@dataclass(frozen=True)
class Outcome:
    """What people and programs are told about one dither system."""

    data: dict[str, Any]
    as_expected: bool
    latex: str = ""
    state: tuple[str, ...] = ()
    gradient: str = ""
    caveats: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    reason: str = ""


@click.command()
@click.argument("file", metavar="FILE.toml")
@options.as_json
@click.option(
    "--order", type=int, default=None, metavar="N", help="Also the averages of the orders 1 to N in 1/sqrt(omega)."
)
@click.option("--timeout", type=float, default=60.0, show_default=True, help="Time limit, in seconds.")
def average(file: str, as_json: bool, order: int | None, timeout: float) -> int:
    """Average the dither system in FILE.toml, and examine every assumption of the theorem.

    Dithers may have powers of omega and frequencies of their own (power = "1 - p", frequency = "2"); with order = 2
    brackets of three fields count too, and limits are decided for all powers that are allowed.

    With --order N: the averages of dX/dtau = A1(X) + A2(X)/sqrt(omega) + ..., the change of variables that leads to
    them, and what is left, put back into the system and checked.

    Exit status 1 if the theorem does not cover the system, the average is not known, or the average that FILE
    claims is not proved.
    """
    outcome = _studied(file, timeout, order)
    if outcome.reason:
        click.echo(f"ptproof: {outcome.reason}", err=True)
    if as_json:
        options.print_json(outcome.data)
    else:
        _show(outcome)
    return 0 if outcome.as_expected else 1


def _studied(path: str, seconds: float, order: int | None) -> Outcome:
    """The outcome for a TOML file from a process of its own; out of time it says so, and nothing in it is claimed."""
    from ptproof.averaging.orders import check_order
    from ptproof.errors import InputError
    from ptproof.reading.limits import Answered, Unanswered, Why, apart, check_seconds

    check_seconds(seconds, "--timeout")
    if order is not None:
        check_order(order, "--order")
    match apart(seconds, _study, path, order):
        case Answered(outcome):
            return outcome
        case Unanswered(error=InputError() as error):
            raise error
        case Unanswered(Why.TIME):
            reason = f"{path}: no answer within {seconds:g} s; a longer --timeout may help"
        case Unanswered(_, reason):
            reason = f"{path}: nothing is claimed: {reason}"
    data: dict[str, Any] = {"average": None, "v": {}, "assumptions": {}, "expected": None}
    if order is not None:
        data |= {"orders": None, "remainder": None}
    return Outcome(data, as_expected=False, reason=reason)


def _study(path: str, order: int | None) -> Outcome:
    from ptproof.averaging import load_dither_system, study

    problem = load_dither_system(path)
    found = study(problem, order)
    gradient = found.gradient
    return Outcome(
        found.to_json(),
        found.as_expected,
        found.latex(),
        tuple(str(symbol) for symbol in problem.system.state),
        f"drift + ({gradient[0]}) * grad {gradient[1]}" if gradient else "",
        found.caveats if found.system is not None else (),
        found.notes,
        f"{path}: {found.unexpanded}" if found.unexpanded else _reason(found, path),
    )


def _reason(found: Average, path: str) -> str:
    """Why there is no average, in one line."""
    if found.system is not None:
        return ""
    if found.refusals:
        return f"{path}: " + "; ".join(f"refused, {text}" for text in found.refusals)
    return f"{path}: " + "; ".join(f"undecided, {text}" for text in found.caveats)


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
        if "gamma" in data:
            _show_powers(console, data)
        else:
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
    for note in outcome.notes:
        console.print(Text(f"The cited theorem asks for more, the limit holds without it: {note}", style="yellow"))
    _show_expected(console, data["expected"])
    if data.get("orders"):
        _show_orders(console, outcome)


def _show_powers(console: Any, data: dict[str, Any]) -> None:
    """The coefficients with their powers of omega, and what becomes of them."""
    from rich.text import Text

    values = {key: value for key, value in data["gamma"].items() if value["value"] != "0"}
    console.print(Text(f"coefficients that do not vanish for every omega: {'none' if not values else ''}".rstrip()))
    for key, entry in list(values.items())[:24]:
        limit = "no limit" if entry["limit"] is None else f"tends to {entry['limit']}"
        console.print(Text(f"  gamma_{key} = {entry['value']}: {limit} ({entry['condition']})"))
    if len(values) > 24:
        console.print(Text(f"  and {len(values) - 24} more"))


def _show_orders(console: Any, outcome: Outcome) -> None:
    """The averages of each order with the first correctors; long ones are for --json."""
    from rich.text import Text

    from ptproof.commands.terminal import COLOURS

    data = outcome.data
    for entry in data["orders"]:
        power = f"omega^(-{entry['order'] - 1}/2) * " if entry["order"] > 1 else ""
        console.print(Text(f"order {entry['order']}: dX/dtau has {power or 'the average'}", style="bold"))
        for symbol, mean in zip(outcome.state, entry["average"], strict=True):
            console.print(Text(f"  {symbol}: {_cut(mean)}"))
        for symbol, corrector in zip(outcome.state, entry["correctors"], strict=True):
            console.print(Text(f"  {symbol}: X has omega^(-{entry['order']}/2) * ({_cut(corrector)})", style="dim"))
    for letter, meaning in data["remainder"]["fast"].items():
        console.print(Text(f"  {letter} = {meaning}", style="dim"))
    verdict = data["remainder"]["verdict"]
    console.print(Text(f"put back into the system: {verdict}", style=COLOURS[verdict]), end=" ")
    console.print(
        Text(f"({data['remainder']['detail']}; what is left is of order omega^({data['remainder']['power']}))")
    )


def _cut(text: str) -> str:
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}… (whole with --json)"


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
