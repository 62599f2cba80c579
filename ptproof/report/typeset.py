"""The statements of a derivation in the letters of its paper, each set once, a part of them by another process."""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree.ElementTree import Element

from ptproof.proof.load import Derivation, load
from ptproof.proof.statement import Assumption, Statement
from ptproof.report.formula import Line, Names, converted, statement_lines, width
from ptproof.report.letters import notation_of

Lines = tuple[Line, ...]


class Typeset:
    """Statements as they are set: many claims share an assumption."""

    def __init__(self, names: Names) -> None:
        self.names = names
        self._set: dict[Statement | Assumption, Lines] = {}

    def lines(self, statement: Statement | Assumption) -> Lines:
        """The lines of :func:`statement_lines`."""
        if statement not in self._set:
            self._set[statement] = statement_lines(statement, self.names)
        return self._set[statement]

    def marked_up(self) -> None:
        """Convert what is set to MathML, which the pages then find; for a time in which there is nothing else to do."""
        for lines in self._set.values():
            for line in lines:
                width(line.latex)

    def part(self, derivation: Derivation, place: int, count: int) -> list[Lines]:
        """Set every ``count``-th of what the claims of the derivation say and assume, from that ``place`` on."""
        return [self.lines(statement) for statement in _said(derivation)[place::count]]

    def take(self, derivation: Derivation, place: int, count: int, found: Sequence[Lines]) -> None:
        """Take over such a part that was set elsewhere."""
        self._set.update(zip(_said(derivation)[place::count], found, strict=True))


def _said(derivation: Derivation) -> list[Statement | Assumption]:
    of_claims = (item for claim in derivation.claims for item in (claim.statement, *claim.assumptions))
    return [*dict.fromkeys([*of_claims, *(item.statement for item in derivation.definitions)])]


def set_part(
    derivations: Sequence[Sequence[str]], place: int, count: int
) -> tuple[list[list[Lines]], dict[str, Element | None]]:
    """For other processes: a part of each of the derivations below these paths, and its formulas as MathML."""
    loaded = [load(paths) for paths in derivations]
    parts = [Typeset(notation_of(item).glyphs).part(item, place, count) for item in loaded]
    return parts, converted({line.latex for part in parts for lines in part for line in lines})
