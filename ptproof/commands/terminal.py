"""What the commands show in a terminal: a live progress bar on standard error, tables on standard output."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TypeAlias

from rich.console import Console
from rich.padding import Padding
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table
from rich.text import Text

from ptproof.commands import streams
from ptproof.commands.shown import Shown

if TYPE_CHECKING:
    from ptproof.proof.claim import Claim as DecidedClaim
    from ptproof.proof.verdict import Evidence

Claim: TypeAlias = Mapping[str, Any]  # as it stands in the JSON
COLOURS = {"proved": "green", "refuted": "red", "undecided": "yellow", "cited": "blue", "observed": "magenta"}


def output(**options: Any) -> Console:
    """Where results are shown to people."""
    return Console(file=streams.out(), **options)


def plain_table(headings: Sequence[str], rows: Iterable[Sequence[str | Text]]) -> Table:
    """A table without lines, whose cells are folded where the terminal is narrow."""
    table = Table(box=None, pad_edge=False)
    for heading in headings:
        table.add_column(heading, overflow="fold")
    for row in rows:
        table.add_row(*(Text(cell) if isinstance(cell, str) else cell for cell in row))
    return table


@contextmanager
def progress(what: str, total: int) -> Iterator[Callable[..., None]]:
    """A bar that is gone at the end; gives the function to call with how many are newly done, and words beside it."""
    console = Console(stderr=True)
    bar = Progress(
        TextColumn("{task.description}"), BarColumn(bar_width=20), MofNCompleteColumn(), TimeElapsedColumn(),
        TextColumn("{task.fields[words]}"), console=console, transient=True, disable=not console.is_terminal,
    )  # fmt: skip
    with bar:
        task = bar.add_task(what, total=total, words="")
        yield lambda done, words="": bar.update(task, advance=done, words=words)


@contextmanager
def claim_progress(total: int) -> Iterator[Callable[[DecidedClaim, Evidence], None]]:
    """A bar with the verdicts so far; gives the function to call with each claim that is done."""
    counts = dict.fromkeys(COLOURS, 0)
    with progress("verifying", total) as advance:

        def done(claim: DecidedClaim, evidence: Evidence) -> None:
            counts[str(evidence.verdict)] += 1
            shown = "  ".join(f"[{COLOURS[word]}]{number} {word}[/]" for word, number in counts.items() if number)
            advance(1, shown)

        yield done


def verification_tables(found: Mapping[str, Shown]) -> None:
    """The claims of each paper with their verdicts."""
    console = output(highlight=False)
    for name, shown in found.items():
        if len(found) > 1:
            console.rule(Text(name, style="bold"), align="left")
        verification_table(shown)
        if len(found) > 1:
            console.print()
    if len(found) > 1:
        total = {word: sum(shown.json["summary"][word] for shown in found.values()) for word in ("total", "unexpected")}
        line = Text(f"{len(found)} papers, {total['total']} claims: ")
        line.append(f"{total['unexpected']} not as expected", style="bold red" if total["unexpected"] else "")
        console.print(line)


def verification_table(shown: Shown) -> None:
    """The claims with their verdicts, grouped by section, then the witnesses of what is false."""
    console = output(highlight=False)
    for claim in shown.claims:
        for item in claim["evidence"]:
            if (item["engine"], item["verdict"]) == ("attack", "refuted"):
                console.print(Text(f"{claim['id']}: {item['detail']}", style="bold white on red"))
                console.print()
    sections: dict[str, list[Claim]] = {}
    for claim in shown.claims:
        sections.setdefault(shown.sections[claim["id"]], []).append(claim)
    # One width for the ids of all tables, so that the columns stand under each other.
    longest = max((len(claim["id"]) for claim in shown.claims), default=0)
    for section, claims in sections.items():
        console.print(_section_table(section or "Claims", claims, min(longest, console.width * 2 // 5)))
        console.print()
    for claim in shown.claims:
        _print_witness(console, claim)
    _print_summary(console, shown)


def _section_table(title: str, claims: Sequence[Claim], id_width: int) -> Table:
    table = Table(
        title=title, title_justify="left", title_style="bold", box=None, pad_edge=False, show_header=False, expand=True,
    )  # fmt: skip
    table.add_column(width=len("undecided"), no_wrap=True)
    table.add_column(ratio=1)
    table.add_column(width=id_width, style="dim", overflow="fold")
    for claim in claims:
        word = claim["verdict"]
        verdict = Text(word, style=COLOURS[word])
        if word == "proved" and not claim["fully_proved"]:
            verdict.append("*")
        title_ = Text(claim["title"])
        if word != claim["expected"]:
            title_.append(f"  (expected {claim['expected']})", style="bold red")
        table.add_row(verdict, title_, claim["id"])
    return table


def _print_witness(console: Console, claim: Claim) -> None:
    """Why a claim is false: where, and what the two sides are there; or why it is open though it should not be."""
    if (witness := claim["witness"]) is not None:
        heading = Text("✗ ", style="red").append(claim["title"], style="red")
        console.print(heading.append(f" ({claim['id']})", style="dim"))
        print_sides(console, **witness)
        console.print()
    elif claim["verdict"] == "undecided" != claim["expected"]:
        for item in claim["evidence"]:
            console.print(Text("? ", style="yellow").append(f"{claim['id']}: {item['detail']}", style="yellow"))
            console.print()


def print_sides(console: Console, values: Mapping[str, str], left: str, right: str) -> None:
    """Where something is false, and what the two sides are there."""
    for line in (where(values), f"left side   {left}", f"right side  {right}"):
        console.print(Padding(Text(line), (0, 0, 0, 4)))


def where(values: Mapping[str, str]) -> str:
    """The values of a witness in words: symbols that may be anything come first."""
    free = [name for name, value in values.items() if value == "any"]
    fixed = [f"{name} = {value}" for name, value in values.items() if value != "any"]
    words = f"for every {', '.join(free)}: " if free else "at "
    return words + ", ".join(fixed) if fixed else "at all values" if not free else words.rstrip(": ")


def _print_summary(console: Console, shown: Shown) -> None:
    summary = shown.json["summary"]
    words = Text(", ").join(Text(f"{summary[word]} {word}", style=COLOURS[word]) for word in COLOURS if summary[word])
    if any(claim["verdict"] == "proved" and not claim["fully_proved"] for claim in shown.claims):
        console.print("* proved from citations or open claims that it uses", style="dim")
    known = f", {shown.remembered} remembered" if shown.remembered else ""
    line = Text(f"{summary['total']} claims in {shown.seconds:.1f} s{known}: ").append_text(words)
    line.append(f"; {summary['fully_proved']} fully proved, ")
    line.append(f"{summary['unexpected']} not as expected", style="bold red" if summary["unexpected"] else "")
    console.print(line)
    if gaps := summary.get("gaps", 0):
        console.print(
            f"{gaps} {'formula is a gap' if gaps == 1 else 'formulas are gaps'}: nothing is stated of them yet"
        )
