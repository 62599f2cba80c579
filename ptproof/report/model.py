"""The content of the report as data: everything that the pages show, in the order in which they show it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property

from ptproof.proof import erratum
from ptproof.proof.verdict import Evidence
from ptproof.reading.latex.typeset import rows
from ptproof.report.content import Figure, Table
from ptproof.report.difference import marked
from ptproof.report.formula import Line, width
from ptproof.report.graph import Node
from ptproof.report.instruments.view import View
from ptproof.report.letters import Letter
from ptproof.report.read import ReadSide
from ptproof.report.ref import Ref as Ref
from ptproof.report.status import Status
from ptproof.report.witness import WitnessView

_HALF_PAGE = 36.0  # characters


def _set(formulas: Iterable[str]) -> tuple[Line, ...]:
    """Formulas line by line as the paper prints them; a row that goes on with the one before is indented."""
    return tuple(Line(row, 2 * goes_on) for latex in formulas for row, goes_on in rows(latex))


@dataclass(frozen=True)
class Said:
    """What is said: the statement line by line, or in words, and what became of its printed side."""

    lines: tuple[Line, ...]
    words: str
    read: ReadSide | None = field(default=None, kw_only=True)  # where its printed side was looked for

    @cached_property
    def printed(self) -> tuple[Line, ...]:
        """The formula as the paper prints it, where that was read and is what is said."""
        return _set(self.read.latex if self.read is not None and self.read.read == "equal" else ())

    @property
    def unread(self) -> tuple[Line, ...]:
        """What the paper prints of it where that was not read, or says more or less than it."""
        return _set(self.read.unread if self.read is not None else ())

    @property
    def whole(self) -> bool:
        """Whether the printed formula says all of it."""
        return self.read is not None and bool(self.printed) and self.read.whole

    @property
    def shown(self) -> tuple[Line, ...]:
        """The formula as a reader meets it."""
        return self.printed or self.lines


@dataclass(frozen=True)
class ClaimView(Said):
    """Everything that the report says of one claim."""

    ref: Ref
    status: Status
    expected: str
    labels: tuple[str, ...]
    place: str
    kind: str
    same: bool
    domain: tuple[str, ...]
    given: tuple[tuple[Line, ...], ...]
    evidence: tuple[Evidence, ...]
    witness: WitnessView | None
    uses: tuple[Ref, ...]
    used_by: tuple[Ref, ...]
    rests_on: tuple[Ref, ...]
    corrects: Ref | None
    corrected_by: tuple[Ref, ...]
    prose: str
    erratum: erratum.Erratum | None
    unlike: tuple[str, ...]  # glyphs of the notation that stand for something else in it


@dataclass(frozen=True)
class DefinitionView(Said):
    """A displayed definition."""

    ref: Ref
    labels: tuple[str, ...]
    prose: str
    unlike: tuple[str, ...]


@dataclass(frozen=True)
class Section:
    """A part of the derivation."""

    title: str
    anchor: str
    definitions: tuple[DefinitionView, ...]
    claims: tuple[ClaimView, ...]
    counts: tuple[tuple[Status, int], ...]


@dataclass(frozen=True)
class Erratum:
    """A printed claim that is refuted, or that is corrected, and its corrections."""

    printed: ClaimView
    corrections: tuple[ClaimView, ...]

    @property
    def in_paper(self) -> bool:
        """Whether the paper prints it: it has a label or a place there."""
        return bool(self.printed.labels or self.printed.place)

    @property
    def rank(self) -> int:
        """Its place among the errata: by weight, and those without a grade last."""
        return self.printed.erratum.grade.rank if self.printed.erratum else len(erratum.Grade)

    @property
    def formulas(self) -> tuple[tuple[str, ...], ...]:
        """The printed formula and its corrections as MathML by lines; the difference of the first two is marked."""
        if not self.corrections:
            return (marked(self.printed.shown, ())[0],)
        return (
            *marked(self.printed.shown, self.corrections[0].shown),
            *(marked(item.shown, ())[0] for item in self.corrections[1:]),
        )

    @property
    def narrow(self) -> bool:
        """Whether the formulas are short enough to stand side by side."""
        lines = [line for claim in (self.printed, *self.corrections) for line in claim.shown]
        return all(width(line.latex) + 3 * line.indent < _HALF_PAGE for line in lines)


@dataclass(frozen=True)
class Report:
    """The content of the pages."""

    title: str
    sections: tuple[Section, ...]
    errata: tuple[Erratum, ...]
    besides: tuple[Erratum, ...]
    cited: tuple[ClaimView, ...]
    unexpected: tuple[ClaimView, ...]
    labels: tuple[tuple[str, tuple[Ref, ...]], ...]
    counts: tuple[tuple[Status, int], ...]
    total: int
    definitions: int
    letters: tuple[Letter, ...]
    versions: tuple[tuple[str, str], ...]
    figures: tuple[Figure, ...]
    appendix: tuple[Table, ...]
    notes: tuple[str, ...]
    instruments: tuple[View, ...] = ()

    @property
    def claims(self) -> tuple[ClaimView, ...]:
        return tuple(claim for section in self.sections for claim in section.claims)

    @property
    def read(self) -> dict[str, tuple[Ref, ...]]:
        """The claims and definitions whose printed side was looked for in the paper's source, by what became of it."""
        items: list[ClaimView | DefinitionView] = []
        for section in self.sections:
            items += [*section.definitions, *section.claims]
        found: dict[str, list[Ref]] = {}
        for item in items:
            if item.read is not None:
                found.setdefault(item.read.read, []).append(item.ref)
        return {word: tuple(found[word]) for word in ("different", "equal", "not read") if word in found}

    def nodes(self) -> tuple[Node, ...]:
        """The claims as nodes of the graph."""
        return tuple(
            Node(claim.ref.id, claim.ref.anchor, claim.ref.title, section.title, claim.status,
                 tuple(ref.id for ref in claim.uses), claim.corrects.id if claim.corrects else "")
            for section in self.sections for claim in section.claims
        )  # fmt: skip
