"""From the results of a verification to the content of the report: links, sections, errata, index."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from types import MappingProxyType

from ptproof.proof.load import Derivation
from ptproof.proof.result import Verification
from ptproof.report import status
from ptproof.report.content import Figure, Table
from ptproof.report.instruments.instrument import Instrument
from ptproof.report.instruments.view import viewed
from ptproof.report.letters import Notation
from ptproof.report.model import ClaimView, DefinitionView, Erratum, Ref, Report, Section
from ptproof.report.read import ReadSide
from ptproof.report.status import Status
from ptproof.report.typeset import Typeset
from ptproof.report.views import Views, views_of, without_places


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
    views: Views | None = None,
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
    figures, appendix, notes, read, instruments, views
        Pictures and tables from elsewhere, what the reader has to know, such as a figure that could not be drawn,
        what became of printed sides in the paper's own source, by id, what a reader may move, and :func:`views_of` it.
    """
    letters = notation or Notation()
    known = views or views_of(verification, derivation, Typeset(letters.glyphs))
    claims = {id: known.beside(view, read.get(id)) for id, view in known.claims.items()}
    sections = _sections(
        [claims[result.claim.id] for result in verification.results],
        [result.claim.section for result in verification.results],
        [known.beside(view, read.get(view.ref.id)) for view in known.definitions],
        [item.section for item in derivation.definitions],
    )
    shown = [claim for section in sections for claim in section.claims]
    errata = _errata(shown, claims)
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
        instruments=tuple(viewed(item, letters, known.refs) for item in instruments),
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


def _hits(verification: Verification) -> tuple[str, ...]:
    """What the attacker hit although it was shown: the reader has to know it before anything else."""
    found = ((result.claim.id, result.hit) for result in verification.results)
    return tuple(f"{id}: {without_places(hit.detail)}" for id, hit in found if hit is not None)


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
