"""``ptproof report``: verify, simulate, and write the pages and figures."""

from __future__ import annotations

import os
from dataclasses import replace
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ptproof.commands import guard, options, streams
from ptproof.commands.made import Made
from ptproof.commands.papers import Opened, opened
from ptproof.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from ptproof.commands.parts import Figures
    from ptproof.proof.load import Derivation
    from ptproof.proof.result import Verification
    from ptproof.report.drawn import Drawn
    from ptproof.report.model import Report
    from ptproof.report.read import ReadSide
    from ptproof.report.typeset import Typeset


@click.command()
@options.derivations
@click.option("--out", default="reports", show_default=True, metavar="FOLDER", help="Where to write the report.")
@options.jobs
@options.cluster
@options.timeout("one claim")
@options.fresh
@click.option("--no-figures", is_flag=True, help="Leave out the simulations and their figures.")
@click.option(
    "--paper", "sources", multiple=True, metavar="FILE.tex", help="A paper's LaTeX, to read its printed sides from."
)
@click.option("--single", is_flag=True, help="Also write report.html: all of it in one file, for mailing.")
@click.option("--pdf", is_flag=True, help="Also write report.pdf, printed by Chromium, which has to be installed.")
def report(
    paths: tuple[str, ...],
    out: str,
    fresh: bool,
    no_figures: bool,
    sources: tuple[str, ...],
    single: bool,
    pdf: bool,
    **how: Any,
) -> int:
    """Verify the claims below each PATH (the shipped derivations where left out) and write the report.

    Writes index.html and the pages that it leads to, report.md, graph.svg and figures/ into FOLDER; of several papers
    each into a folder of its own name in it, and a page above them. With --paper each card says whether what the paper
    prints was read from its source and is what is claimed. Exit status 1 if a claim did not come out as its author
    recorded, a figure could not be drawn, or what is printed is something else; the report is written all the same.
    """
    from ptproof.commands.beside import Beside
    from ptproof.commands.parts import Figures, Sides, set_statements
    from ptproof.reading.garbage import collecting
    from ptproof.reading.latex.source import read_paper
    from ptproof.report.printing import browser
    from ptproof.report.versions import SETTING, versions
    from ptproof.report.writing import check_place

    place, printer = check_place(out), browser() if pdf else ""
    whole = options.memory_of(paths, fresh)
    asked = " ".join(
        map(str, ("report", no_figures, single, *map(Path.resolve, map(Path, sources)), versions(SETTING)))
    )
    if not pdf and (made := Made.again(whole.run(asked))) is not None:
        return _show(place, made, single, pdf)
    decided: dict[str, Verification] = {}
    count = how["jobs"] or os.cpu_count() or 1
    with collecting(False), whole.loading(), Beside(at_once=count > 1) as beside:
        tex = {name: read_paper(name) for name in sources}
        figures = None if no_figures else Figures(beside, paths, fresh, max(count - 1, 1))
        with opened(paths, fresh) as papers:
            sides = Sides(beside, papers, max(count - 1, 1))
            if figures is not None:
                figures.loaded()
            read = cache(partial(sides.read, tex))
            settings = set_statements(beside, papers, count)
            left = any(paper.memory.recall(claim) is None for paper in papers for claim in _derivation(paper).claims)
            if left:  # a proof's limit of time is one of time alone
                read()
                beside.rest()
            if (status := _all_decided(papers, decided, how)) is not None:
                return status
            try:
                made, drawn = _made(papers, decided, read, settings, figures, single, printer)
            except KeyboardInterrupt:  # nothing is half written, and what is decided is shown
                _say(_sums(decided))
                if guard.own_interrupt():
                    raise InputError("the derivation raised KeyboardInterrupt while the report was written") from None
                raise
    status = _show(place, made, single, pdf)
    whole.keep_run(asked, made.data, drawn and all(item.memory.lasts(decided[item.name]) for item in papers))
    return status


def _all_decided(papers: Sequence[Opened], decided: dict[str, Verification], how: Mapping[str, Any]) -> int | None:
    """Each paper's verdicts are added to ``decided``; an exit status where the user has had enough."""
    from ptproof.proof.run import Interrupted
    from ptproof.reading.garbage import collecting

    for paper in papers:
        try:
            with collecting(True):
                decided[paper.name] = _decided(paper, **how)
        except Interrupted as interrupted:
            status = options.interrupted(interrupted)
            _say(_sums({**decided, paper.name: interrupted.verification}))
            return status
    return None


def _decided(paper: Opened, jobs: int | None, cluster: str | None, timeout: float) -> Verification:
    from ptproof.commands.terminal import claim_progress
    from ptproof.proof.run import verify as run

    derivation = _derivation(paper)
    with options.connected(cluster) as client, claim_progress(len(derivation.claims)) as progress:
        return run(
            derivation, workers=jobs, client=client, timeout=timeout, progress=progress, memory=paper.memory
        )  # fmt: skip


def _derivation(paper: Opened) -> Derivation:
    assert paper.derivation is not None  # nothing is known of a paper without loading it
    return paper.derivation


def _made(
    papers: Sequence[Opened],
    decided: dict[str, Verification],
    read: Callable[[], Mapping[str, Mapping[str, ReadSide]]],
    settings: Mapping[str, Typeset],
    figures: Figures | None,
    single: bool,
    printer: str,
) -> tuple[Made, bool]:
    """The report, and whether everything in it could be drawn."""
    from ptproof.report.pages import all_files
    from ptproof.report.site import cards_of

    guard.doing("while the report was made; none is written")
    begun = [_Begun(paper, decided[paper.name], settings[paper.name]) for paper in papers]
    composed = {item.paper.name: item.composed(read().get(item.paper.name, {})) for item in begun}
    cards = {name: cards_of(found) for name, (found, _) in composed.items()}
    if figures is not None:
        composed = {paper.name: _illustrated(figures.of(paper), *composed[paper.name]) for paper in papers}
    reports = {name: found for name, (found, _) in composed.items()}
    files = all_files(reports, single=single, browser=printer, cards=cards)
    several, notes = len(composed) > 1, []
    for name, (found, failures) in composed.items():
        of = f"{name}: " if several else ""
        for claim in found.unexpected:
            notes.append(f"{of}{claim.ref.id}: expected {claim.expected}, came out {claim.status.word}")
        notes += [f"{of}{ref.id}: what is printed is something else" for ref in found.read.get("different", ())]
        notes += [f"{of}{note}" for note in failures]
    drawn = not any(failures for _, failures in composed.values())
    same = not any("different" in found.read for found, _ in composed.values())
    status = 0 if all(found.as_expected for found in decided.values()) and drawn and same else 1
    return Made(files, tuple(composed) if several else (), _sums(decided), tuple(notes), status), drawn


def _show(place: Path, made: Made, single: bool, pdf: bool) -> int:
    """Write the report, say what came out and where it is, and give the exit status."""
    from ptproof.report.writing import write_report

    write_report(place, made.files)
    _say(made.sums)
    for note in made.notes:
        click.echo(f"ptproof: {note}", err=True)
    _name_places(place, made.folders, single, pdf)
    return made.status


class _Begun:
    """The content of a paper's report but for figures and for what became of printed sides, which others find out."""

    def __init__(self, paper: Opened, verification: Verification, typeset: Typeset) -> None:
        from ptproof.report.drawn import tried
        from ptproof.report.instruments import instruments_of
        from ptproof.report.views import views_of

        self.paper, self._verification = paper, verification
        derivation = _derivation(paper)
        self._views = views_of(verification, derivation, typeset)
        self._tools, failure = tried("instruments", lambda: tuple(instruments_of(derivation)))
        self._failures = (failure,) if failure else ()

    def composed(self, read: Mapping[str, ReadSide]) -> tuple[Report, tuple[str, ...]]:
        """The content, and what could not be drawn."""
        from ptproof.report.compose import compose
        from ptproof.report.letters import notation_of, title_of
        from ptproof.report.versions import versions

        derivation = _derivation(self.paper)
        content = compose(
            self._verification, derivation, title=title_of(derivation), notation=notation_of(derivation),
            versions=versions(), notes=self._failures, read=read, instruments=self._tools or (), views=self._views,
        )  # fmt: skip
        return content, self._failures


def _illustrated(drawn: Drawn, content: Report, failures: tuple[str, ...]) -> tuple[Report, tuple[str, ...]]:
    """The report with its figures, or with a note why there are none."""
    failed = (drawn.failed,) if drawn.failed else ()
    own = content.notes[: len(content.notes) - len(failures)]
    notes = (*own, *failed, *failures)
    return replace(content, figures=drawn.figures, appendix=drawn.tables, notes=notes), (*failed, *failures)


def _name_places(place: Path, names: Sequence[str], single: bool, pdf: bool) -> None:
    """Where the report is, and that of each paper."""
    if names:
        click.echo(f"{place / 'index.html'}  the page above the papers, for a browser", file=streams.out())
    for folder in [place / name for name in names] or [place]:
        click.echo(f"{folder / 'index.html'}  the report, for a browser", file=streams.out())
        click.echo(f"{folder / 'report.md'}  the same as Markdown", file=streams.out())
        if single:
            click.echo(f"{folder / 'report.html'}  the same in one file", file=streams.out())
        if pdf:
            click.echo(f"{folder / 'report.pdf'}  the same on paper", file=streams.out())


def _sums(decided: Mapping[str, Verification]) -> tuple[str, ...]:
    from ptproof.commands.terminal import COLOURS

    sums = []
    for name, verification in decided.items():
        summary = verification.summary()
        words = ", ".join(f"{summary[word]} {word}" for word in COLOURS if summary[word])
        of = f"{name}: " if len(decided) > 1 else ""
        sums.append(f"{of}{summary['total']} claims: {words}; {summary['fully_proved']} fully proved")
    return tuple(sums)


def _say(lines: Sequence[str]) -> None:
    for line in lines:
        click.echo(line, file=streams.out())
