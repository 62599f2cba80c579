"""What the pages look up: an index for searching, and formulas; scripts, since a file may not fetch another."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from ptproof.report.formula import mathml
from ptproof.report.model import Report


def search_index(report: Report, places: Mapping[str, str]) -> str:
    """A script that sets ``PTPROOF`` to the pages and to what is found: claims, definitions, instruments and figures.

    ``places`` says on which page each anchor stands.
    """
    pages = list(dict.fromkeys(places.values()))
    number = {page: place for place, page in enumerate(pages)}
    entries = [[number[places[anchor]], anchor, *rest] for anchor, *rest in _entries(report)]
    sections = [[number[places[item.anchor]], item.anchor, item.title] for item in report.sections]
    data = {"pages": pages, "entries": entries, "sections": sections}
    return _script("PTPROOF", data)


def formulas(found: Mapping[str, str]) -> str:
    """A script that sets ``PTPROOF_FORMULAS`` to statements as they are set, by the anchors of their claims."""
    return _script("PTPROOF_FORMULAS", dict(found))


def meanings(report: Report) -> str:
    """A script that sets ``PTPROOF_LETTERS`` to letters by their spelling: as set, and what they stand for."""
    found: dict[str, list[str]] = {}
    for item in report.letters:
        glyph, *said = found.get(item.key, [mathml(item.glyph)])  # two letters may share a glyph
        found[item.key] = [
            glyph,
            *said,
            f"{item.meaning} [{item.unit}]" if item.unit not in ("", "1") else item.meaning,
        ]
    found.pop("", None)
    return _script("PTPROOF_LETTERS", found)


def _script(name: str, data: Any) -> str:
    # Nothing in it may end the script, also where it is put into a page, and no line may be broken in a text.
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":"))
    for found, escaped in (("</", r"<\/"), ("<!", r"<\u0021"), ("\u2028", r"\u2028"), ("\u2029", r"\u2029")):
        text = text.replace(found, escaped)
    return f"window.{name} = {text};\n"


def _entries(report: Report) -> Iterator[list[Any]]:
    for section in report.sections:
        for item in section.definitions:
            yield [item.ref.anchor, item.ref.id, item.ref.title, "", _words(item.labels, item.words, item.prose)]
        for claim in section.claims:
            said = (claim.erratum.wrong, claim.erratum.survives) if claim.erratum else ()
            words = _words(claim.labels, claim.place, claim.words, claim.prose, *said)
            yield [claim.ref.anchor, claim.ref.id, claim.ref.title, claim.status.key, words]
    for view in report.instruments:
        moved = [control.meaning for control in view.controls]
        shown = [*(row.title for row in view.rows), *(picture.title for picture in view.pictures)]
        words = _words((), view.instrument.prose, *moved, *shown)
        yield [f"i-{view.instrument.name}", "instrument", view.instrument.title, "instrument", words]
    for figure in report.figures:
        yield [f"figure-{figure.name}", "figure", figure.title, "figure", _words((), figure.caption)]


def _words(labels: tuple[str, ...], *texts: str) -> str:
    return " ".join(" ".join([*labels, *texts]).split())
