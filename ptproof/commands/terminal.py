"""What the commands show in a terminal: a live progress bar on standard error, tables on standard output."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

from rich.console import Console
from rich.padding import Padding
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from ptproof.proof.claim import Claim, Result
    from ptproof.proof.run import Verification
    from ptproof.proof.verdict import Evidence

COLOURS = {"proved": "green", "refuted": "red", "undecided": "yellow", "cited": "blue", "observed": "magenta"}


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
    bar = Progress(
        TextColumn("{task.description}"), BarColumn(bar_width=20), MofNCompleteColumn(), TimeElapsedColumn(),
        TextColumn("{task.fields[words]}"), console=Console(stderr=True), transient=True,
    )  # fmt: skip
    with bar:
        task = bar.add_task(what, total=total, words="")
        yield lambda done, words="": bar.update(task, advance=done, words=words)


@contextmanager
def claim_progress(total: int) -> Iterator[Callable[[Claim, Evidence], None]]:
    """A bar with the verdicts so far; gives the function to call with each claim that is done."""
    counts = dict.fromkeys(COLOURS, 0)
    with progress("verifying", total) as advance:

        def done(claim: Claim, evidence: Evidence) -> None:
            counts[str(evidence.verdict)] += 1
            shown = "  ".join(f"[{COLOURS[word]}]{number} {word}[/]" for word, number in counts.items() if number)
            advance(1, shown)

        yield done


def verification_table(verification: Verification) -> None:
    """The claims with their verdicts, grouped by section, then the witnesses of what is false."""
    console = Console(soft_wrap=False, highlight=False)
    sections: dict[str, list[Result]] = {}
    for result in verification.results:
        sections.setdefault(result.claim.section, []).append(result)
    # One width for the ids of all tables, so that the columns stand under each other.
    longest = max((len(result.claim.id) for result in verification.results), default=0)
    for section, results in sections.items():
        console.print(_section_table(section or "Claims", results, min(longest, console.width * 2 // 5)))
        console.print()
    for result in verification.results:
        _print_witness(console, result)
    _print_summary(console, verification)


def _section_table(title: str, results: Sequence[Result], id_width: int) -> Table:
    table = Table(
        title=title, title_justify="left", title_style="bold", box=None, pad_edge=False, show_header=False, expand=True,
    )  # fmt: skip
    table.add_column(width=len("undecided"), no_wrap=True)
    table.add_column(ratio=1)
    table.add_column(width=id_width, style="dim", overflow="fold")
    for result in results:
        word = str(result.verdict)
        shown = Text(word, style=COLOURS[word])
        if word == "proved" and not result.fully_proved:
            shown.append("*")
        claim = Text(result.claim.title)
        if not result.as_expected:
            claim.append(f"  (expected {result.claim.expected})", style="bold red")
        table.add_row(shown, claim, result.claim.id)
    return table


def _print_witness(console: Console, result: Result) -> None:
    """Why a claim is false: where, and what the two sides are there; or why it is open though it should not be."""
    for item in result.evidence:
        if item.witness is not None:
            heading = Text("✗ ", style="red").append(result.claim.title, style="red")
            console.print(heading.append(f" ({result.claim.id})", style="dim"))
            console.print(Padding(Text(where(item.witness.values)), (0, 0, 0, 4)))
            console.print(Padding(Text(f"left side   {item.witness.left}"), (0, 0, 0, 4)))
            console.print(Padding(Text(f"right side  {item.witness.right}"), (0, 0, 0, 4)))
            console.print()
        elif str(result.verdict) == "undecided" and not result.as_expected:
            console.print(Text("? ", style="yellow").append(f"{result.claim.id}: {item.detail}", style="yellow"))
            console.print()


def where(values: Mapping[str, str]) -> str:
    """The values of a witness in words: symbols that may be anything come first."""
    free = [name for name, value in values.items() if value == "any"]
    fixed = [f"{name} = {value}" for name, value in values.items() if value != "any"]
    words = f"for every {', '.join(free)}: " if free else "at "
    return words + ", ".join(fixed) if fixed else "at all values" if not free else words.rstrip(": ")


def _print_summary(console: Console, verification: Verification) -> None:
    summary = verification.summary()
    words = Text(", ").join(Text(f"{summary[word]} {word}", style=COLOURS[word]) for word in COLOURS if summary[word])
    if any(str(item.verdict) == "proved" and not item.fully_proved for item in verification.results):
        console.print("* proved from citations or open claims that it uses", style="dim")
    line = Text(f"{summary['total']} claims in {verification.seconds:.1f} s: ").append_text(words)
    line.append(f"; {summary['fully_proved']} fully proved, ")
    line.append(f"{summary['unexpected']} not as expected", style="bold red" if summary["unexpected"] else "")
    console.print(line)
