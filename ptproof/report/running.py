"""The relations in a paper's running text against everything that its derivation states.

Nothing in the text says which claim a relation belongs to. It is therefore looked up by what it says: *equal* is what a
claim or definition states, *restates* what is assumed somewhere, or what the notation says; the rest is *not claimed*,
which is no fault. *Different* is said only of a relation whose place the table of notation names for a claim.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
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
    said = _Everything(source, (*derivation.definitions, *derivation.claims), {})
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
    stating = [said.stating(formula, pair) for pair in pairs]
    if pairs and all(stating):
        all_of_it = [says for says in stating[0] if all(says in found for found in stating)]
        saying = all_of_it or list({says.id: says for found in stating for says in found}.values())
        whole = [says.id for says in saying if _states_no_more(says, pairs)]
        return Running(formula, "equal", tuple(says.id for says in saying), "", statement, tuple(whole))
    restating = [said.restating(formula, pair) for pair in pairs]
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
class _Everything:
    """All that a derivation states, by the numbers of its sides, for each meaning that the letters have."""

    source: Printed
    items: tuple[Item, ...]
    kept: dict[tuple[int, ...], tuple[dict[str, list[Stated]], list[Stated]]]

    def _at(self, formula: Formula) -> tuple[dict[str, list[Stated]], list[Stated]]:
        """By sides, and apart from them what takes letters of the paper for something else."""
        key = context(self.source.table, formula.place)
        if key not in self.kept:
            table: dict[str, list[Stated]] = {}
            special: list[Stated] = []
            plain = self.source.meaning(formula)
            for item in self.items:
                says = None if getattr(item, "corrects", None) else stated(item, formula, self.source)
                if says is not None and says.meaning is not plain:
                    special.append(says)
                elif says is not None:
                    for own in (*says.pairs, *says.given):
                        for side in (own.left, own.right):
                            entries = table.setdefault(number(side), [])
                            if not entries or entries[-1] is not says:
                                entries.append(says)
            self.kept[key] = table, special
        return self.kept[key]

    def _meeting(self, formula: Formula, pair: Pair) -> Iterator[Stated]:
        """What has this relation, or each of its sides in one, as far as their numbers say."""
        table, special = self._at(formula)
        plain = self.source.meaning(formula)
        left, right = number(plain(pair.left)), number(plain(pair.right))
        second = {says.id for says in table.get(right, [])}
        yield from (says for says in table.get(left, []) if says.id in second)
        yield from special

    def empty(self, formula: Formula, pair: Pair) -> bool:
        """Whether both sides are the same number."""
        plain = self.source.meaning(formula)
        left, right = plain(pair.left), plain(pair.right)
        return pair.sign == "=" and left == right and not left.free_symbols

    def stating(self, formula: Formula, pair: Pair) -> list[Stated]:
        """What states this relation itself, in one step or by a chain of equalities."""
        return [
            says for says in self._meeting(formula, pair)
            if says.parts(pair) or (says.says(pair) is None and says.implies(pair))
        ]  # fmt: skip

    def restating(self, formula: Formula, pair: Pair) -> list[str] | None:
        """What states or assumes it; nothing where the notation says it, None where nobody does."""
        found = [says.id for says in self._meeting(formula, pair) if says.says(pair)]
        plain = self.source.meaning(formula)
        left, right = plain(pair.left), plain(pair.right)
        if not found and pair.sign == "=" and same(left, right):
            return []
        declared = {">": "is_positive", ">=": "is_nonnegative", "<": "is_negative", "<=": "is_nonpositive"}
        if not found and right == 0 and left.is_Symbol and getattr(left, declared.get(pair.sign, ""), None):
            return []
        return found or None
