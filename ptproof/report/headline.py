"""The result of a report in a sentence or two, made from the verdicts."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ptproof.report import status
from ptproof.report.model import ClaimView, Report

_RESULT = re.compile(r"(?:Theorem|Proposition|Lemma|Corollary)(?: [0-9A-Z][\w.]*)?(?=([:,]|$)|\s)")
_LABEL = re.compile(r"(thm|theorem|prop|proposition|lem|lemma|cor|corollary)([:_-].*)?")
_KINDS = {"t": "the Theorem", "p": "the Proposition", "l": "the Lemma", "c": "the Corollary"}
_MOST = 3  # cited statements that are named


@dataclass(frozen=True)
class Piece:
    """Some words, and the anchor that they lead to; empty for plain words."""

    words: str
    anchor: str = ""


def headline(report: Report) -> tuple[Piece, ...]:
    """How much is proved, what is false, and which results stand on what.

    A result of the paper, such as Theorem 2, is what those claims say that are not printed falsely and have its label,
    such as ``thm:main``, or its name as their title up to a colon; it stands if all of them are proved, given what is
    cited, and may be cited itself.
    """
    parts = [*_proved(report), *_false(report)]
    for mark in (status.UNDECIDED, status.OBSERVED):
        if number := _number(report, mark):
            parts += [Piece("; "), Piece(f"{number} {mark.word}", list_anchor(mark))]
    return (*parts, *_results(report.claims), Piece("."))


def list_anchor(mark: status.Status) -> str:
    """Where the claims of one verdict are listed."""
    return f"claims-{mark.key}"


def plain(pieces: Sequence[Piece]) -> str:
    """The words alone."""
    return "".join(piece.words for piece in pieces)


def _number(report: Report, mark: status.Status) -> int:
    return dict(report.counts).get(mark, 0)


def _proved(report: Report) -> Iterator[Piece]:
    full, modulo, open_ = (
        _number(report, mark) for mark in (status.FULLY, status.MODULO_CITATIONS, status.MODULO_OPEN)
    )
    every = f"{full + modulo + open_} of {counted(report.total, 'statement')}"
    yield Piece(every, "claims")
    yield Piece(" is proved" if report.total == 1 else " are proved")
    besides = [
        Piece(f"{number} given what is {word}", list_anchor(mark))
        for number, word, mark in (
            (modulo, "cited", status.MODULO_CITATIONS),
            (open_, "still open", status.MODULO_OPEN),
        )
        if number
    ]
    for place, piece in enumerate(besides):
        yield Piece(", " if place else " (")
        yield piece
    if besides:
        yield Piece(")")


def _false(report: Report) -> Iterator[Piece]:
    if not report.errata:
        return
    false = [item for item in report.errata if item.printed.status == status.REFUTED]
    mended = [item for item in false if any(other.status.proved for other in item.corrections)]
    yield Piece("; ")
    yield Piece(f"{len(false)} printed {'one is' if len(false) == 1 else 'ones are'} false", "errata")
    if mended and len(mended) == len(false):
        yield Piece(", and what holds instead is proved")
    elif mended:
        yield Piece(f", and for {len(mended)} of them what holds instead is proved")


def _named(claims: Sequence[ClaimView]) -> dict[str, list[ClaimView]]:
    """The results by name; where no title and no place of the claims of a label begins with one, by their kind."""
    stated = [claim for claim in claims if claim.status != status.REFUTED]
    kinds = {label: _KINDS[label[0]] for claim in stated for label in claim.labels if _LABEL.fullmatch(label)}
    names = dict(kinds)
    for claim in reversed(stated):
        found = _RESULT.match(claim.ref.title) or _RESULT.fullmatch(claim.place)
        names.update({label: found[0] for label in claim.labels if label in kinds and found is not None})
    named: dict[str, list[ClaimView]] = {}
    for claim in stated:
        found = _RESULT.match(claim.ref.title)
        titled = found[0] if found and found[1] is not None else ""
        if name := next((names[label] for label in claim.labels if label in names), titled):
            named.setdefault(name, []).append(claim)
    return named


def _results(claims: Sequence[ClaimView]) -> Iterator[Piece]:
    for name, inside in _named(claims).items():
        yield Piece("; ")
        yield Piece(name, inside[0].ref.anchor)
        if not all(claim.status.proved for claim in inside):
            yield Piece(
                " rests on what is cited" if any(claim.status == status.CITED for claim in inside) else " is open"
            )
            continue
        yield Piece(" stands")
        given = {ref.anchor: ref for claim in inside for ref in claim.rests_on}
        if any(claim.status == status.MODULO_OPEN for claim in inside):
            yield Piece(" if what is open holds")
        elif given:
            yield Piece(", given ")
            for place, ref in enumerate([*given.values()][:_MOST]):
                yield Piece(" and " if place and place + 1 == len(given) else ", " if place else "")
                yield Piece(f"“{ref.title}”", ref.anchor)
            if len(given) > _MOST:
                yield Piece(f" and {len(given) - _MOST} more")


def counted(number: int, word: str) -> str:
    """``1 claim``, ``2 claims``."""
    return f"{number} {word}" if number == 1 else f"{number} {word}s"
