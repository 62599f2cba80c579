"""What the commands show in a terminal: a live progress bar on standard error, tables on standard output."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from ptproof.proof.claim import Claim, Result
    from ptproof.proof.run import Verification
    from ptproof.proof.verdict import Evidence

COLOURS = {"proved": "green", "refuted": "red", "undecided": "yellow", "cited": "blue", "observed": "magenta"}


@contextmanager
def claim_progress(total: int) -> Iterator[Callable[[Claim, Evidence], None]]:
    """A bar with the verdicts so far; gives the function to call with each claim that is done."""
    counts = dict.fromkeys(COLOURS, 0)
    bar = Progress(
        TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(),
        TextColumn("{task.fields[counts]}"), console=Console(stderr=True), transient=True,
    )  # fmt: skip
    with bar:
        task = bar.add_task("verifying", total=total, counts="")

        def advance(claim: Claim, evidence: Evidence) -> None:
            counts[str(evidence.verdict)] += 1
            shown = "  ".join(f"[{COLOURS[word]}]{number} {word}[/]" for word, number in counts.items() if number)
            bar.update(task, advance=1, counts=shown)

        yield advance


def verification_table(verification: Verification) -> None:
    """The claims with their verdicts, grouped by section, then the witnesses of what is false."""
    console = Console(soft_wrap=False)
    sections: dict[str, list[Result]] = {}
    for result in verification.results:
        sections.setdefault(result.claim.section, []).append(result)
    for section, results in sections.items():
        table = Table(title=section or "Claims", title_justify="left", title_style="bold", box=None, pad_edge=False)
        table.add_column("verdict", no_wrap=True)
        table.add_column("claim", ratio=3)
        table.add_column("id", ratio=2, style="dim", overflow="fold")
        for result in results:
            word = str(result.verdict)
            shown = Text(word, style=COLOURS[word])
            if word == "proved" and not result.fully_proved:
                shown.append("*")
            title = Text(result.claim.title)
            if not result.as_expected:
                title.append(f"  (expected {result.claim.expected})", style="bold red")
            table.add_row(shown, title, result.claim.id)
        console.print(table)
        console.print()
    for result in verification.results:
        for item in result.evidence:
            if item.witness is not None:
                values = ", ".join(f"{name} = {value}" for name, value in item.witness.values.items())
                console.print(Text(f"✗ {result.claim.title} ({result.claim.id})", style="red"))
                console.print(Text(f"    at {values}:  {item.witness.left}  against  {item.witness.right}"))
            elif str(result.verdict) == "undecided" and not result.as_expected:
                console.print(Text(f"? {result.claim.id}: {item.detail}", style="yellow"))
    summary = verification.summary()
    words = ", ".join(f"{summary[word]} {word}" for word in COLOURS if summary[word])
    if summary["proved"] > summary["fully_proved"]:
        console.print("* modulo citations or open claims that it uses")
    console.print(
        f"{summary['total']} claims in {verification.seconds:.1f} s: {words}; "
        f"{summary['fully_proved']} fully proved, {summary['unexpected']} not as expected"
    )
