"""What ``ptproof mutate`` shows in a terminal: false claims that were proved, and the counts of each section."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING

from rich.console import Console
from rich.padding import Padding
from rich.text import Text

from ptproof.commands.terminal import COLOURS, output, plain_table, print_sides, progress

if TYPE_CHECKING:
    from ptproof.proof.claim import Claim
    from ptproof.proof.mutation.outcomes import Mutation, Outcome

_COLOURS = {**COLOURS, "refuted": "green", "proved": "blue", "equivalent": "dim"}


@contextmanager
def mutation_progress(total: int) -> Iterator[Callable[[Claim, Outcome], None]]:
    """A bar with the outcomes so far; gives the function to call with each claim and the outcome of a mutant of it."""
    counts: dict[str, int] = {}
    claims: set[str] = set()
    with progress("mutating", total) as advance:

        def done(claim: Claim, outcome: Outcome) -> None:
            counts[outcome.word] = counts.get(outcome.word, 0) + 1
            new = claim.id not in claims
            claims.add(claim.id)
            advance(int(new), "  ".join(f"[{_COLOURS[word]}]{n} {word}[/]" for word, n in sorted(counts.items())))

        yield done


def mutation_tables(papers: Mapping[str, Mutation]) -> None:
    """Of each paper the false claims that were proved, the counts of each claim by section, and all of it in a line."""
    for name, found in papers.items():
        if len(papers) > 1:
            output(highlight=False).rule(Text(name, style="bold"), align="left")
        _table(found)


def _table(found: Mutation) -> None:
    console = output(highlight=False)
    for claim, outcome in found.alarms:
        _print_alarm(console, claim, outcome)
    sections: dict[str, list[Claim]] = {}
    for claim in found.claims:
        sections.setdefault(claim.section, []).append(claim)
    for section, claims in sections.items():
        rows = [[claim.id, *map(str, found.counts(claim.id).values())] for claim in claims]
        console.print(Text(section or "Claims", style="bold"))
        console.print(plain_table(["claim", "made", "equivalent", "refuted", "undecided", "proved"], rows))
        console.print()
    _print_summary(console, found)


def _print_alarm(console: Console, claim: Claim, outcome: Outcome) -> None:
    console.print(Text(f"✗ false, and proved: {claim.id}: {outcome.change}", style="bold red"))
    console.print(Padding(Text(outcome.statement), (0, 0, 0, 4)))
    if outcome.witness is not None:
        print_sides(console, **outcome.witness.to_json())
    console.print()


def _print_summary(console: Console, found: Mutation) -> None:
    summary = found.summary()
    line = Text(f"{summary['made']} corrupted claims of {summary['claims']} in {found.seconds:.0f} s: ")
    words = (
        Text(f"{summary[word]} {word}", style=_COLOURS[word])
        for word in ("refuted", "undecided", "equivalent", "proved")
    )
    line.append_text(Text(", ").join(words))
    alarms = summary["false_proved"]
    line.append(f"; {alarms} false and proved", style="bold red" if alarms else "")
    console.print(line)
