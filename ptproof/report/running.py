"""The relations in a paper's running text against everything that its derivation states.

Nothing in the text says which claim a relation belongs to. It is therefore looked up by what it says: *equal* is what a
claim or definition states, *restates* what is assumed somewhere, or what the notation says; the rest is *not claimed*,
which is no fault. *Different* is said only of a relation whose place the table of notation names for a claim.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any, Literal

from ptproof.proof.load import Derivation
from ptproof.reading.latex.formulas import Formula, Formulas
from ptproof.reading.latex.notation import context
from ptproof.reading.latex.statements import Pair, read_formula
from ptproof.reading.latex.tokens import NotUnderstood
from ptproof.report.printed import compare
from ptproof.report.sameness import number, same
from ptproof.report.stated import Item, Printed, Stated, stated

Held = Literal["equal", "restates", "different", "not claimed", "not read"]


@dataclass(frozen=True)
class Running:
    """What became of one relation in running text.

    Attributes
    ----------
    formula
        The relation, with its place and its line.
    read
        Whether it was read, and what it is to the derivation.
    claims
        What states or assumes it.
    detail
        Of one that was not read: what was in the way.
    statement
        What was read.
    whole
        Those of ``claims`` that state nothing else.
    """

    formula: Formula
    read: Held
    claims: tuple[str, ...] = ()
    detail: str = ""
    statement: str = ""
    whole: tuple[str, ...] = ()

    def to_json(self) -> dict[str, Any]:
        return {
            "place": self.formula.place, "line": self.formula.line, "text": " ".join(self.formula.text.split()),
            "read": self.read, "claims": list(self.claims), "detail": self.detail, "statement": self.statement,
        }  # fmt: skip


def hold_running(formulas: Formulas, source: Printed, derivation: Derivation) -> tuple[Running, ...]:
    """What becomes of each relation in running text, in the order of the text."""
    said = _Everything(source, (*derivation.definitions, *derivation.claims))
    return tuple(_held(formula, formulas, source, said) for formula in formulas.running)


def _held(formula: Formula, formulas: Formulas, source: Printed, said: _Everything) -> Running:
    if not source.known or source.covering(formula):
        found = compare(formula, formulas, source)
        whole = tuple(id for id, part in found.said.items() if len(part.parts) == part.of)
        return Running(formula, found.read, found.claims, found.detail, found.statement, whole)
    try:
        reading = read_formula(formula, formulas.macros, source.letters(formula))
    except NotUnderstood as error:
        return Running(formula, "not read", (), str(error))
    statement = str(reading)
    # An entry 0 = 0 of two matrices is said by anybody.
    pairs = [pair for pair in (*reading.pairs, *reading.conditions) if not said.empty(formula, pair)]
    meeting = [list(said.meeting(formula, pair)) for pair in pairs]
    stating = [[says for says in near if says.states(pair)] for near, pair in zip(meeting, pairs, strict=True)]
    if pairs and all(stating):
        all_of_it = [says for says in stating[0] if all(says in found for found in stating)]
        saying = all_of_it or list({says.id: says for found in stating for says in found}.values())
        no_more = tuple(says.id for says in saying if _states_no_more(says, pairs))
        return Running(formula, "equal", tuple(says.id for says in saying), "", statement, no_more)
    restating = [said.restating(formula, pair, near) for near, pair in zip(meeting, pairs, strict=True)]
    if all(found is not None for found in restating):
        ids = dict.fromkeys(id for found in restating if found is not None for id in found)
        detail = "" if ids else "the notation says it"
        return Running(formula, "restates", tuple(ids), detail, statement)
    return Running(formula, "not claimed", (), "", statement)


def _states_no_more(says: Stated, pairs: Iterable[Pair]) -> bool:
    met = frozenset[int]().union(*(says.parts(pair) for pair in pairs))
    rest = [own for n, own in enumerate(says.pairs) if n not in met]
    return bool(met) and all(own.left == own.right and not own.left.free_symbols for own in rest)


@dataclass(frozen=True)
class _Known:
    """All that a derivation states, by the numbers of its sides."""

    by_number: dict[str, list[Stated]] = field(default_factory=dict)
    special: list[tuple[Stated, set[str]]] = field(default_factory=list)  # what takes letters for something else

    def add(self, says: Stated, plain: bool) -> None:
        sides = {number(side) for own in (*says.pairs, *says.given) for side in (own.left, own.right)}
        if not plain:
            self.special.append((says, sides))
        else:
            for side in sides:
                self.by_number.setdefault(side, []).append(says)


@dataclass(frozen=True)
class _Everything:
    """All that a derivation states, for each meaning that the letters have somewhere."""

    source: Printed
    items: tuple[Item, ...]
    kept: dict[tuple[int, ...], _Known] = field(default_factory=dict)

    def _at(self, formula: Formula) -> _Known:
        key = context(self.source.table, formula.place)
        if key not in self.kept:
            found = self.kept[key] = _Known()
            for item in self.items:
                says = None if getattr(item, "corrects", None) else stated(item, formula, self.source)
                if says is not None:
                    found.add(says, says.meaning is self.source.meaning(formula))
        return self.kept[key]

    def meeting(self, formula: Formula, pair: Pair) -> Iterator[Stated]:
        """What has each side of this relation in some relation, as far as their numbers say."""
        known, plain = self._at(formula), self.source.meaning(formula)
        left, right = number(plain(pair.left)), number(plain(pair.right))
        second = {says.id for says in known.by_number.get(right, [])}
        yield from (says for says in known.by_number.get(left, []) if says.id in second)
        for says, sides in known.special:
            own = says.spoken(pair)
            if number(own.left) in sides and number(own.right) in sides:
                yield says

    def empty(self, formula: Formula, pair: Pair) -> bool:
        """Whether both sides are the same number."""
        plain = self.source.meaning(formula)
        left, right = plain(pair.left), plain(pair.right)
        return pair.sign == "=" and left == right and not left.free_symbols

    def restating(self, formula: Formula, pair: Pair, meeting: Iterable[Stated]) -> list[str] | None:
        """What states or assumes it; nothing where the notation says it, None where nobody does."""
        found = [says.id for says in meeting if says.says(pair)]
        plain = self.source.meaning(formula)
        left, right = plain(pair.left), plain(pair.right)
        if not found and pair.sign == "=" and same(left, right):
            return []
        declared = {">": "is_positive", ">=": "is_nonnegative", "<": "is_negative", "<=": "is_nonpositive"}
        if not found and right == 0 and left.is_Symbol and getattr(left, declared.get(pair.sign, ""), None):
            return []
        return found or None
