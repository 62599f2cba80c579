"""Which printed sides of a derivation a machine has read in the paper's own source, claim by claim."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from ptproof.proof.load import Derivation
from ptproof.reading.latex.formulas import find_formulas
from ptproof.report.printed import Compared, Read, compare_all
from ptproof.report.running import Running, hold_running
from ptproof.report.stated import Item, printed


@dataclass(frozen=True)
class ReadSide:
    """What became of the printed side of one claim or definition.

    Attributes
    ----------
    read
        ``equal`` if it says a formula of the paper and every formula that it covers was read and is what is claimed,
        ``different`` if a formula that it covers says something else, ``not read`` otherwise.
    places
        The formulas: those that it says, the one that is different, or those that were not read. A relation in running
        text has a place such as ``Section 2, text (3)``.
    detail
        Why it is not equal, or which part of a claim of several relations was met in the paper.
    latex
        Where it is equal: the formulas, or the parts of them that it states, as the paper prints them.
    unread
        Where it is not: the formulas that it covers, as the paper prints them, held against nothing.
    whole
        Whether they say all that the claim says, and not only what it assumes.
    apart
        The letters of the paper that mean something in these formulas that they do not mean elsewhere.
    """

    read: Read
    places: tuple[str, ...]
    detail: str = ""
    latex: tuple[str, ...] = ()
    whole: bool = True
    apart: tuple[str, ...] = ()
    unread: tuple[str, ...] = ()

    def to_json(self) -> dict[str, Any]:
        return {"read": self.read, "places": list(self.places), "detail": self.detail, "printed": list(self.latex),
                "whole": self.whole, "apart": list(self.apart), "unread": list(self.unread)}  # fmt: skip

    @staticmethod
    def from_json(data: Mapping[str, Any]) -> ReadSide:
        """The side that was written."""
        latex, apart = tuple(data["printed"]), tuple(data["apart"])
        unread = tuple(data["unread"])
        return ReadSide(data["read"], tuple(data["places"]), data["detail"], latex, data["whole"], apart, unread)


def read_sides(source: str, derivation: Derivation) -> Mapping[str, ReadSide]:
    """What a machine makes of each claim and definition that transcribes a formula of the paper.

    ``source`` is the LaTeX of the paper (:func:`ptproof.reading.latex.source.read_paper`). By id: all that cover a
    displayed formula, and what states a relation of the running text and nothing else. Corrections are left out.

    Raises
    ------
    InputError
        If the table of notation beside the derivation is wrong.
    """
    formulas, notation = find_formulas(source), printed(derivation)
    return sides(compare_all(formulas, notation), hold_running(formulas, notation, derivation), derivation)


def sides(compared: Iterable[Compared], running: Iterable[Running], derivation: Derivation) -> Mapping[str, ReadSide]:
    """The same from formulas that are compared already."""
    items: list[Item] = [*derivation.definitions, *derivation.claims]
    covering: dict[str, list[Compared]] = {item.id: [] for item in items if not getattr(item, "corrects", None)}
    for formula in compared:
        for id in formula.covered:
            if id in covering:
                covering[id].append(formula)
    in_text: dict[str, list[str]] = {}
    for relation in running:
        for id in relation.whole if relation.read == "equal" else ():
            in_text.setdefault(id, []).append(relation.formula.place)
    found = {id: side_of(id, formulas) for id, formulas in covering.items() if formulas}
    return found | {id: ReadSide("equal", tuple(places)) for id, places in in_text.items() if id not in found}


def side_of(id: str, formulas: list[Compared]) -> ReadSide:
    """What became of the formulas that one claim covers."""
    different = [item for item in formulas if item.read == "different" and item.beside == id]
    if different:
        return ReadSide("different", _places(different), different[0].detail)
    unread = [item for item in formulas if item.read != "equal"]
    if unread:
        return ReadSide("not read", _places(unread), unread[0].detail, unread=_texts(unread))
    said = [item for item in formulas if id in item.said]
    if not said:
        detail = "what it covers was read, and says something else of it"
        return ReadSide("not read", _places(formulas), detail, unread=_texts(formulas))
    met = frozenset().union(*(item.said[id].parts for item in said))
    of = said[0].said[id].of
    detail = f"{len(met)} of its {of} relations" if 0 < len(met) < of else ""
    latex = dict.fromkeys(item.said[id].latex for item in said)
    apart = dict.fromkeys(letter for item in said for letter in item.apart)
    return ReadSide("equal", _places(said), detail, tuple(latex), len(met) == of, tuple(apart))


def _places(formulas: Iterable[Compared]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(item.formula.place for item in formulas))


def _texts(formulas: Iterable[Compared]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(item.formula.text for item in formulas))
