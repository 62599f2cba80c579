"""``ptproof coverage``: show which formulas of a paper the claims cover, and which are read and equal."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence, Set
from typing import TYPE_CHECKING

import click

from ptproof.commands import options
from ptproof.commands.papers import Opened, opened
from ptproof.errors import InputError

if TYPE_CHECKING:
    from ptproof.proof.load import Derivation
    from ptproof.report.coverage import Coverage
    from ptproof.report.printed import Compared
    from ptproof.report.running import Running


@click.command()
@click.argument("paper", metavar="PAPER.tex")
@options.derivations
@options.as_json
@click.option("--keep", is_flag=True, help="Write its formulas beside the derivation (printed.toml), for the report.")
def coverage(paper: str, paths: tuple[str, ...], as_json: bool, keep: bool) -> int:
    """Show which equations of PAPER.tex the claims below each PATH cover (the shipped derivations where left out).

    Where there are several derivations, the one that names most labels of the paper is taken for its own.

    Each displayed formula is read from the source, by the table notation.toml beside the derivation, and held against
    what the claims that cover it say: equal, different, or not read and why. A relation in running text is looked up
    among all that the derivation states or assumes.

    With --keep the formulas that something covers, and nothing else of the paper, are written into printed.toml beside
    the derivation: the report reads them there, and shows what a claim says as the paper prints it.

    Exit status 1 if a label of an equation is not covered, a claim or the table names a label or a place that the paper
    does not have, or a formula that was read is different from what is claimed.
    """
    from ptproof.reading.latex.formulas import find_formulas
    from ptproof.reading.latex.source import read_paper
    from ptproof.report.coverage import coverage as match
    from ptproof.report.kept import keep as write
    from ptproof.report.labels import all_labels, equation_labels
    from ptproof.report.printed import compare_all
    from ptproof.report.running import hold_running
    from ptproof.report.stated import places_missing, printed

    source = read_paper(paper)
    labels, formulas = equation_labels(source), find_formulas(source)
    if not labels and not formulas.displayed:
        raise InputError(rf"{paper}: no \label stands in an equation; name the LaTeX source of the paper")
    with opened(paths) as papers:
        name, derivation = own(papers, {*labels, *all_labels(source)}, paper)
        found = match(labels, derivation.items, all_labels(source))
        for label, ids in found.stale:
            click.echo(f"ptproof: {paper} has no label {label}, which is named by {', '.join(ids)}", err=True)
        notation = printed(derivation)
        missing = places_missing(notation, formulas)
        for place in missing:
            click.echo(f"ptproof: {paper} has no formula {place}, which {notation.where} names", err=True)
        if keep:
            click.echo(f"{write(derivation, formulas, notation)} holds the formulas of {paper}", err=True)
        compared = compare_all(formulas, notation)
        running = hold_running(formulas, notation, derivation)
        if as_json:
            count = {
                "found": len(running),
                "read": sum(item.read != "not read" for item in running),
                "equal": sum(item.read == "equal" for item in running),
                "items": [item.to_json() for item in running],
            }
            read = {"formulas": [item.to_json() for item in compared], "running": count}
            options.print_json({**found.to_json(), "paper": name, **read})
        else:
            if len(papers) > 1:
                click.echo(f"{paper} is held against {name}", err=True)
            _show(found)
            _show_formulas(compared, running)
    held: list[Compared | Running] = [*compared, *running]
    return 0 if found.complete and not missing and all(item.read != "different" for item in held) else 1


def own(papers: Sequence[Opened], labels: Set[str], tex: str) -> tuple[str, Derivation]:
    """The derivation that names most of the labels, with its name; if there is but one, that one."""
    derivations = {paper.name: paper.derivation for paper in papers if paper.derivation is not None}
    spoken = {name: {label for item in found.items for label in item.labels} for name, found in derivations.items()}
    named = {name: len(labels & found) for name, found in spoken.items()}
    best = [name for name, number in named.items() if number == max(named.values())]
    if len(best) > 1:
        raise InputError(f"{tex}: {', '.join(best)} name as many of its labels; name the folder that is about it")
    return best[0], derivations[best[0]]


def _show(found: Coverage) -> None:
    from rich.text import Text

    from ptproof.commands.terminal import output, plain_table

    console = output()
    rows = [(Text(label, style="green"), Text(", ".join(ids), style="dim")) for label, ids in found.covered]
    rows += [(Text(label, style="bold red"), Text("nothing", style="red")) for label in found.missing]
    console.print(plain_table(("equation", "covered by"), rows))
    total = len(found.covered) + len(found.missing)
    console.print(f"{len(found.covered)} of {total} labelled equations are covered, {len(found.missing)} missing")


def _show_formulas(compared: Sequence[Compared], running: Sequence[Running]) -> None:
    """How many formulas were read, and those that are not equal with what stood in the way."""
    from rich.text import Text

    from ptproof.commands.terminal import output, plain_table

    console = output()
    count = Counter(item.read for item in compared)
    styles = {"different": "bold red", "not read": "yellow"}
    others: list[Compared | Running] = [
        *(item for item in compared if item.read != "equal"),
        *(r for r in running if r.read == "different"),
    ]
    rows = [
        (Text(item.formula.place), Text(str(item.formula.line)), Text(item.read, styles[item.read]), Text(item.detail))
        for item in others
    ]
    if rows:
        console.print(plain_table(("formula", "line", "", "what was in the way"), rows))
    console.print(
        f"{len(compared)} displayed formulas: {count['equal']} read and equal, {count['different']} read and "
        f"different, {count['not read']} not read"
    )
    text = Counter(item.read for item in running)
    console.print(
        f"{len(running)} relations in running text: {text['equal']} read and equal to what is claimed, "
        f"{text['restates']} restate what is assumed, {text['different']} different, "
        f"{text['not claimed']} not claimed, {text['not read']} not read (--json lists them)"
    )
