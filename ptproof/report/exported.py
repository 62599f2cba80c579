"""Everything in a report as plain data, for other programs; ``report.schema.json`` in the package says its form."""

from __future__ import annotations

import json
from collections.abc import Sequence
from math import isfinite
from typing import Any

from ptproof.report.formula import Line
from ptproof.report.headline import headline, plain
from ptproof.report.instruments.instrument import Condition, Plot, Quantity, Region, Vehicle, expressions_of
from ptproof.report.instruments.view import View
from ptproof.report.model import ClaimView, DefinitionView, Erratum, Ref, Section
from ptproof.report.read import ReadSide
from ptproof.report.site import Site
from ptproof.report.templating import text
from ptproof.report.witness import Value, WitnessView

VERSION = 1


def schema() -> dict[str, Any]:
    """The JSON Schema of :func:`exported`."""
    return dict(json.loads(text("report.schema.json")))


def exported(site: Site) -> dict[str, Any]:
    """The content of a report; ``page`` is where each claim or definition stands."""
    report = site.report
    return {
        "version": VERSION,
        "title": report.title,
        "result": plain(headline(report)),
        "counts": {mark.key: number for mark, number in report.counts},
        "sections": [_section(section, site) for section in report.sections],
        "errata": [_erratum(item) for item in (*report.errata, *report.besides)],
        "labels": {label: _ids(refs) for label, refs in report.labels},
        "notation": [{"latex": item.glyph, "unit": item.unit, "meaning": item.meaning} for item in report.letters],
        "instruments": [_instrument(view, site) for view in report.instruments],
        "figures": [{"file": f"figures/{item.file}", "caption": item.caption} for item in report.figures],
        "tables": [
            {"title": item.title, "caption": item.caption, "head": [*item.head], "rows": [[*row] for row in item.rows]}
            for item in report.appendix
        ],
        "notes": [*report.notes],
        "versions": dict(report.versions),
    }


def exported_json(site: Site) -> bytes:
    """The same as the text of a file."""
    return (json.dumps(exported(site), ensure_ascii=False, indent=1) + "\n").encode()


def _section(section: Section, site: Site) -> dict[str, Any]:
    return {
        "title": section.title,
        "page": site.address(section.anchor),
        "definitions": [_definition(item, site) for item in section.definitions],
        "claims": [_claim(item, site) for item in section.claims],
    }


def _definition(item: DefinitionView, site: Site) -> dict[str, Any]:
    return {
        "id": item.ref.id,
        "title": item.ref.title,
        "page": site.address(item.ref.anchor),
        "labels": [*item.labels],
        "statement": _statement(item.lines, item.words),
        "prose": item.prose,
        "read": _read(item.read),
    }


def _claim(item: ClaimView, site: Site) -> dict[str, Any]:
    return {
        "id": item.ref.id,
        "title": item.ref.title,
        "page": site.address(item.ref.anchor),
        "status": item.status.key,
        "expected": item.expected or None,
        "kind": item.kind,
        "labels": [*item.labels],
        "place": item.place,
        "statement": _statement(item.lines, item.words),
        "for_all": [*item.domain],
        "given": [_lines(lines) for lines in item.given],
        "evidence": [
            {"engine": found.engine, "verdict": str(found.verdict), "detail": found.detail} for found in item.evidence
        ],
        "witness": _witness(item.witness),
        "uses": _ids(item.uses),
        "used_by": _ids(item.used_by),
        "rests_on": _ids(item.rests_on),
        "corrects": item.corrects.id if item.corrects else None,
        "corrected_by": _ids(item.corrected_by),
        "prose": item.prose,
        "erratum": item.erratum.to_json() if item.erratum else None,
        "read": _read(item.read),
    }


def _instrument(view: View, site: Site) -> dict[str, Any]:
    return {
        "name": view.instrument.name,
        "title": view.instrument.title,
        "page": site.address(f"i-{view.instrument.name}"),
        "command": view.command,
        "sliders": [
            {"symbol": item.name, "latex": item.glyph, "unit": item.unit, "meaning": item.meaning,
             "lowest": item.lowest, "highest": item.highest, "start": item.start, "logarithmic": item.logarithmic}
            for item in view.controls
        ],
        "values": [
            {"title": row.title, "claim": row.ref.id, "expression": str(part.value), "key": row.key,
             "value": row.value if isinstance(row.value, bool | None) or isfinite(row.value) else None}
            for row, part in zip(view.rows, view.instrument.of(Quantity, Condition), strict=True)
        ],
        "pictures": [
            {"kind": item.kind, "title": item.title, "claims": _ids(item.refs), "expressions": [*expressions_of(part)]}
            for item, part in zip(view.pictures, view.instrument.of(Plot, Region, Vehicle), strict=True)
        ],
    }  # fmt: skip


def _erratum(item: Erratum) -> dict[str, Any]:
    return {
        "printed": item.printed.ref.id,
        "corrections": [claim.ref.id for claim in item.corrections],
        "in_paper": item.in_paper,
    }


def _statement(lines: Sequence[Line], words: str) -> dict[str, Any]:
    return {"latex": _lines(lines), "words": words}


def _lines(lines: Sequence[Line]) -> list[str]:
    return [line.latex for line in lines]


def _witness(found: WitnessView | None) -> dict[str, Any] | None:
    if found is None:
        return None
    return {"at": [_value(item) for item in found.values], "left": _value(found.left), "right": _value(found.right)}


def _value(item: Value) -> dict[str, str]:
    return {"text": item.text, "latex": item.latex}


def _read(found: ReadSide | None) -> dict[str, Any] | None:
    return found.to_json() if found is not None else None


def _ids(refs: Sequence[Ref]) -> list[str]:
    return [ref.id for ref in refs]
