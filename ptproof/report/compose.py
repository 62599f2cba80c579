"""From the results of a verification to the content of the report: links, sections, errata, index."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

import sympy as sp

from ptproof.proof.claim import Claim, Definition
from ptproof.proof.load import Derivation
from ptproof.proof.result import Result, Verification
from ptproof.proof.statement import (
    All,
    Assumption,
    Exists,
    ForAll,
    Prose,
    Relation,
    Statement,
    expressions_of,
    free_symbols,
    relations_of,
    undefined_functions,
)
from ptproof.proof.verdict import Evidence
from ptproof.report import status
from ptproof.report.content import Figure, Table
from ptproof.report.formula import domain_of, latex
from ptproof.report.instruments.instrument import Instrument
from ptproof.report.instruments.view import viewed
from ptproof.report.letters import Notation, spelled
from ptproof.report.model import ClaimView, DefinitionView, Erratum, Ref, Report, Section
from ptproof.report.read import ReadSide
from ptproof.report.spoken import Letters, spoken
from ptproof.report.status import Status, status_of
from ptproof.report.typeset import Typeset
from ptproof.report.witness import witness_view


def compose(
    verification: Verification,
    derivation: Derivation,
    *,
    title: str = "",
    notation: Notation | None = None,
    versions: Sequence[tuple[str, str]] = (),
    figures: Sequence[Figure] = (),
    appendix: Sequence[Table] = (),
    notes: Sequence[str] = (),
    read: Mapping[str, ReadSide] = MappingProxyType({}),
    instruments: Sequence[Instrument] = (),
    typeset: Typeset | None = None,
) -> Report:
    """Put the content of the report together.

    Parameters
    ----------
    verification, derivation
        The results, whose claims the report shows, and where the definitions come from.
    title, notation
        Of the derivation: its title, and its letters and glyphs.
    versions
        Of the libraries.
    figures, appendix, notes, read, instruments, typeset
        Pictures and tables from elsewhere, what the reader has to know, such as a figure that could not be drawn,
        what became of printed sides in the paper's own source, by id, what a reader may move, and what is already set.
    """
    letters = notation or Notation()
    results = {result.claim.id: result for result in verification.results}
    refs = _refs(verification.results, derivation.definitions, results)
    composer = _Composer(results, refs, typeset or Typeset(letters.glyphs), read)
    views = {result.claim.id: composer.claim(result) for result in verification.results}
    sections = _sections(
        [views[result.claim.id] for result in verification.results],
        [result.claim.section for result in verification.results],
        [composer.definition(item) for item in derivation.definitions],
        [item.section for item in derivation.definitions],
    )
    shown = [claim for section in sections for claim in section.claims]
    errata = _errata(shown, views)
    return Report(
        title=title or "Derivation",
        sections=sections,
        errata=tuple(item for item in errata if item.in_paper),
        besides=tuple(item for item in errata if not item.in_paper),
        cited=tuple(claim for claim in shown if claim.status is status.CITED),
        unexpected=tuple(claim for claim in shown if claim.expected),
        labels=_labels(sections),
        counts=_counts(shown),
        total=len(shown),
        definitions=sum(len(section.definitions) for section in sections),
        letters=letters.letters,
        versions=tuple(versions),
        figures=tuple(figures),
        appendix=tuple(appendix),
        notes=(*_hits(verification), *notes),
        instruments=tuple(viewed(item, letters, refs) for item in instruments),
    )


def _errata(shown: Sequence[ClaimView], views: Mapping[str, ClaimView]) -> list[Erratum]:
    """What is refuted or corrected, the gravest first."""
    found = [
        Erratum(claim, tuple(views[ref.id] for ref in claim.corrected_by))
        for claim in shown
        if claim.status is status.REFUTED or claim.corrected_by
    ]
    return sorted(found, key=lambda item: item.rank)


def _labels(sections: Sequence[Section]) -> tuple[tuple[str, tuple[Ref, ...]], ...]:
    """Each label of the paper with what covers it, in the order of the sections."""
    found: dict[str, list[Ref]] = {}
    for section in sections:
        items: list[DefinitionView | ClaimView] = [*section.definitions, *section.claims]
        for item in items:
            for label in item.labels:
                found.setdefault(label, []).append(item.ref)
    return tuple((label, tuple(refs)) for label, refs in found.items())


class _Composer:
    def __init__(
        self,
        results: Mapping[str, Result],
        refs: Mapping[str, Ref],
        typeset: Typeset,
        read: Mapping[str, ReadSide],
    ) -> None:
        self.results, self.refs, self.read = results, refs, read
        self.lines, self.glyphs = typeset.lines, (glyphs := typeset.names)
        self.letters = Letters(glyphs)
        self.spellings = {spelled(glyph) for glyph in glyphs.values()}
        self.users: dict[str, list[str]] = {}
        self.corrections: dict[str, list[str]] = {}
        for result in results.values():
            for used in result.claim.uses:
                self.users.setdefault(used.id, []).append(result.claim.id)
            if result.claim.corrects is not None:
                self.corrections.setdefault(result.claim.corrects.id, []).append(result.claim.id)

    def links(self, ids: Sequence[str]) -> tuple[Ref, ...]:
        return tuple(self.refs[id] for id in dict.fromkeys(ids) if id in self.refs)

    def claim(self, result: Result) -> ClaimView:
        claim = result.claim
        witness = next((item.witness for item in result.evidence if item.witness is not None), None)
        corrects = self.links([claim.corrects.id]) if claim.corrects is not None else ()
        return ClaimView(
            ref=self.refs[claim.id],
            status=status_of(result, self.results),
            expected="" if result.as_expected else str(claim.expected),
            labels=claim.labels,
            place=claim.place,
            kind=claim.kind,
            lines=self.lines(claim.statement),
            words=claim.statement.text if isinstance(claim.statement, Prose) else "",
            same=_same(claim),
            domain=domain_of([claim.statement, *claim.assumptions], _bound(claim), self.glyphs),
            given=tuple(self.lines(item) for item in claim.assumptions),
            evidence=self.evidence(result),
            witness=None if witness is None else witness_view(witness, claim, self.glyphs),
            uses=self.links([used.id for used in claim.uses]),
            used_by=self.links(self.users.get(claim.id, [])),
            rests_on=self.links([id for id in result.rests_on if id != claim.id]),
            corrects=corrects[0] if corrects else None,
            corrected_by=self.links(self.corrections.get(claim.id, [])),
            prose=claim.prose,
            erratum=claim.erratum,
            unlike=self.unlike(claim.id, [claim.statement, *claim.assumptions]),
            read=self.read.get(claim.id),
        )

    def evidence(self, result: Result) -> tuple[Evidence, ...]:
        """What the engines said, in the letters of the paper."""
        claim = result.claim
        letters = self.letters.of([claim.statement, *claim.assumptions])
        used = [item.id for item in claim.uses]
        return tuple(
            replace(item, detail=spoken(_without_places(item.detail), letters, used)) for item in result.evidence
        )

    def definition(self, item: Definition) -> DefinitionView:
        words = item.statement.text if isinstance(item.statement, Prose) else ""
        return DefinitionView(
            self.lines(item.statement), words, self.refs[item.id], item.labels, item.prose,
            self.unlike(item.id, [item.statement]), read=self.read.get(item.id),
        )  # fmt: skip

    def unlike(self, id: str, statements: Sequence[Statement | Assumption]) -> tuple[str, ...]:
        """The glyphs that do not stand here for what the notation says: other letters, bound ones, functions."""
        quantified = [said for said in statements if isinstance(said, Exists | ForAll)]
        bound = {symbol for said in quantified for symbol in (*said.variables, *getattr(said, "over", ()))}
        free = free_symbols(statements) - (
            bound - free_symbols([said for said in statements if said not in quantified])
        )
        named = {symbol for said in expressions_of(statements) for symbol in said.atoms(sp.Symbol)}
        functions = {sp.Symbol(applied.func.__name__) for applied in undefined_functions(statements)}
        others = {item for item in named | functions if item not in self.glyphs or item not in free}
        read = self.read.get(id)
        glyphs = {*(latex(item, self.glyphs) for item in others), *(read.apart if read else ())}
        return tuple(sorted({spelled(glyph) for glyph in glyphs} & self.spellings))


def _hits(verification: Verification) -> tuple[str, ...]:
    """What the attacker hit although it was shown: the reader has to know it before anything else."""
    found = ((result.claim.id, result.hit) for result in verification.results)
    return tuple(f"{id}: {_without_places(hit.detail)}" for id, hit in found if hit is not None)


def _same(claim: Claim) -> bool:
    """Whether the two sides are one expression as they stand, which a reader should be told."""
    if not isinstance(claim.statement, Relation | All):
        return False
    return all(part.sign == "=" and part.left == part.right for part in relations_of(claim.statement))


def _bound(claim: Claim) -> tuple[object, ...]:
    return (*claim.statement.variables, *claim.statement.over) if isinstance(claim.statement, Exists) else ()


def _refs(results: Sequence[Result], definitions: Sequence[Definition], by_id: Mapping[str, Result]) -> dict[str, Ref]:
    """A link for each id; two ids that would become one anchor are told apart by a number."""
    taken: Counter[str] = Counter()
    found: dict[str, Ref] = {}

    def add(id: str, title: str, mark: Status | None) -> None:
        anchor = "c-" + (re.sub(r"[^A-Za-z0-9]+", "-", id).strip("-").lower() or "claim")
        taken[anchor] += 1
        if taken[anchor] > 1:
            anchor = f"{anchor}--{taken[anchor]}"
        found[id] = Ref(id, anchor, title, mark)

    for result in results:
        add(result.claim.id, result.claim.title, status_of(result, by_id))
    for item in definitions:
        add(item.id, item.title, None)
    return found


def _sections(
    claims: Sequence[ClaimView],
    places: Sequence[str],
    definitions: Sequence[DefinitionView],
    definition_places: Sequence[str],
) -> tuple[Section, ...]:
    titles = list(dict.fromkeys([*places, *definition_places]))
    titles.sort(key=_numbered)
    found = []
    for number, title in enumerate(titles, start=1):
        inside = tuple(claim for claim, place in zip(claims, places, strict=True) if place == title)
        defined = tuple(item for item, place in zip(definitions, definition_places, strict=True) if place == title)
        found.append(Section(title or "Claims", f"s-{number}", defined, inside, _counts(inside)))
    return tuple(found)


def _numbered(title: str) -> tuple[bool, tuple[int, ...]]:
    """Numbered sections in the order of their numbers, then the others as they come."""
    number = re.match(r"\d+(\.\d+)*", title)
    return number is None, tuple(map(int, number.group().split("."))) if number else ()


def _counts(claims: Sequence[ClaimView]) -> tuple[tuple[Status, int], ...]:
    counted = Counter(claim.status for claim in claims)
    return tuple((mark, counted[mark]) for mark in status.ALL if counted[mark])


def _without_places(text: str) -> str:
    """The text without folders and addresses of memory, which differ from machine to machine and run to run."""
    text = re.sub(r"(?<![\w/.])/(?:[\w.@+-]+/)+", "", text)
    return re.sub(r"0x[0-9a-fA-F]{6,}", "0x…", text)
