"""The parts of a report that other processes make: figures, from the start, and what became of printed sides."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from ptproof.commands.beside import Beside
from ptproof.errors import InputError
from ptproof.proof.papers import papers_of
from ptproof.reading import hashes
from ptproof.reading.outcomes import Answered, Unanswered, Why
from ptproof.report.drawn import Drawing, Drawn, draw
from ptproof.report.formula import knows
from ptproof.report.kept import keeps, kept_json, kept_sides
from ptproof.report.letters import notation_of
from ptproof.report.read import ReadSide, read_sides
from ptproof.report.typeset import Typeset, set_part

if TYPE_CHECKING:
    from ptproof.commands.papers import Opened
    from ptproof.proof.load import Derivation

T = TypeVar("T")


class Figures:
    """The figures and tables of the papers below the paths, drawn beside this process in up to ``count`` others.

    Those of the paper that is loaded last are begun at once. The others wait until the papers are loaded: copies of
    this process have then what they need.
    """

    def __init__(self, beside: Beside, paths: Sequence[str], fresh: bool, count: int) -> None:
        self._beside, self._fresh = beside, fresh
        self._known: dict[Drawing, Drawn] = {}
        self._begun: dict[Drawing, tuple[Drawing, ...]] = {}
        self._count = count
        drawings = [drawing for paper in papers_of(paths) if (drawing := self._drawing(paper.paths))]
        wanted = [drawing for drawing in drawings if not self._knows(drawing)]
        if wanted:
            click.echo("simulating and drawing the figures", err=True)
        self._begin(wanted[-1:])
        self._left = wanted[:-1]

    def loaded(self) -> None:
        """The papers are loaded: begin what is left."""
        self._begin(self._left)

    def of(self, paper: Opened) -> Drawn:
        """What is drawn of a paper that is loaded."""
        wanted = self._drawing(paper.paths, [*_bringing(paper)])
        if wanted is None:
            return Drawn()
        if wanted not in self._begun and not (wanted in self._known or self._knows(wanted)):
            self._begin([wanted])  # of a folder a file alone was named
        if wanted not in self._known:
            group = self._begun[wanted]
            self._known.update(zip(group, _made(self._beside.outcome(group), len(group)), strict=True))
        drawn = self._known[wanted]
        if drawn.interrupted:
            raise KeyboardInterrupt
        hashes.also_opened(drawn.files)
        return drawn

    def _drawing(self, paths: Sequence[Path], files: Sequence[str] | None = None) -> Drawing | None:
        drawing = Drawing.of(paths, self._fresh, files)
        return drawing if drawing.files else None

    def _knows(self, drawing: Drawing) -> bool:
        if (known := drawing.known()) is not None:
            self._known[drawing] = known
        return known is not None

    def _begin(self, drawings: Sequence[Drawing]) -> None:
        for group in spread(drawings, self._count):
            self._begun.update(dict.fromkeys(group, group))
            self._beside.begin(group, draw, group)


def _bringing(paper: Opened) -> Iterable[str]:
    for package in _loaded(paper).packages:
        module = sys.modules.get(f"{package.__name__}.figures")
        if file := getattr(module, "__file__", None):
            yield str(file)


def _loaded(paper: Opened) -> Derivation:
    assert paper.derivation is not None
    return paper.derivation


def _made(outcome: Answered[Any] | Unanswered, count: int) -> list[Drawn]:
    match outcome:
        case Answered(list(drawn)):
            return drawn
        case Unanswered(why=Why.DIED, reason=reason):
            raise InputError(f"{reason} while the report was made; none is written")
        case Unanswered(reason=reason):
            return [Drawn(failed=f"The figures could not be drawn: {reason}")] * count
    raise InputError("the process that draws the figures gave no figures; no report is written")


def spread(items: Sequence[T], count: int) -> list[tuple[T, ...]]:
    """The items in at most ``count`` groups, in turn.

    >>> spread("abcde", 2), spread("a", 2)
    ([('a', 'c', 'e'), ('b', 'd')], [('a',)])
    """
    return [tuple(items[place::count]) for place in range(min(count, len(items)))]


class Sides:
    """What became of the printed sides of each paper, by its name: of its source, or of what is kept of it."""

    def __init__(self, beside: Beside, papers: Sequence[Opened], count: int) -> None:
        self._beside, self._papers = beside, papers
        self._begun: dict[str, tuple[tuple[tuple[str, ...], ...], int]] = {}
        left = [paper for paper in papers if keeps(_loaded(paper)) and paper.memory.known(_KEPT) is None]
        for group in spread(left, count):
            paths = tuple(tuple(map(str, paper.paths)) for paper in group)
            self._beside.begin(paths, kept_json, paths)
            self._begun.update({paper.name: (paths, place) for place, paper in enumerate(group)})

    def read(self, tex: Mapping[str, str]) -> dict[str, Mapping[str, ReadSide]]:
        """Each, with the LaTeX of papers by the names of their files."""
        from ptproof.commands.coverage import own
        from ptproof.report.labels import all_labels

        found: dict[str, Mapping[str, ReadSide]] = {}
        for file, source in tex.items():
            name, derivation = own(self._papers, {*all_labels(source)}, file)
            if name in found:
                raise InputError(f"--paper: {file} is about {name}, and so is another that is given")
            found[name] = read_sides(source, derivation)
        for paper in self._papers:
            known = paper.memory.value(_KEPT, partial(self._plain, paper))
            kept = {id: ReadSide.from_json(side) for id, side in known.items()}
            found[paper.name] = {**kept, **found.get(paper.name, {})}
        return found

    def _plain(self, paper: Opened) -> dict[str, Any]:
        if paper.name in self._begun:
            key, place = self._begun[paper.name]
            match self._beside.outcome(key):
                case Answered(list(sides)):
                    return dict(sides[place])
        # What is wrong with a file or its table is said here.
        return {id: side.to_json() for id, side in kept_sides(_loaded(paper)).items()}


_KEPT = "kept sides"


def set_statements(beside: Beside, papers: Sequence[Opened], count: int) -> dict[str, Typeset]:
    """What the claims of each paper say, set by this process and the others together, up to ``count`` of them."""
    paths = tuple(tuple(map(str, paper.paths)) for paper in papers)
    settings = [Typeset(notation_of(_loaded(paper)).glyphs) for paper in papers]
    count = min(count, _MOST)
    others = range(1, count if sum(len(_loaded(paper).claims) for paper in papers) > _MANY else 1)
    for place in others:
        beside.begin((set_part, place), set_part, paths, place, count)
    for paper, typeset in zip(papers, settings, strict=True):
        typeset.part(_loaded(paper), 0, len(others) + 1)
        typeset.marked_up()
    for place in others:
        match beside.outcome((set_part, place)):
            case Answered((list(found), dict(formulas))):  # what a process did not do is set where it is shown
                knows(formulas)
                for paper, typeset, lines in zip(papers, settings, found, strict=True):
                    typeset.take(_loaded(paper), place, count, lines)
    return {paper.name: typeset for paper, typeset in zip(papers, settings, strict=True)}


_MOST = 4  # processes that share this, each of which has to be copied
_MANY = 50  # claims; fewer are set before another process has begun
