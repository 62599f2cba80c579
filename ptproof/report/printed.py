"""The formulas of a paper, as a machine reads them, against what the claims and definitions that cover them say.

A formula is *equal* to what is claimed if each relation in it is a relation of a claim or definition that covers it,
both sides the same by exact algebra, up to sides swapped. A correction counts for nothing here.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Literal

from sympy.core.function import AppliedUndef

from ptproof.reading.latex.formulas import Formula, Formulas
from ptproof.reading.latex.notation import context
from ptproof.reading.latex.rewrite import Rules
from ptproof.reading.latex.statements import Pair, Reading, read_formula
from ptproof.reading.latex.tokens import NotUnderstood
from ptproof.reading.latex.typeset import pieces, typeset
from ptproof.report.sameness import same
from ptproof.report.stated import Item, Printed, Stated, stated

Read = Literal["equal", "different", "not read"]


@dataclass(frozen=True)
class Part:
    """Which of a claim's own relations, by number, a formula is; how many there are; and that as LaTeX."""

    parts: frozenset[int]
    of: int
    latex: str = ""


@dataclass(frozen=True)
class Compared:
    """What became of one formula.

    Attributes
    ----------
    formula
        The formula, with its place and its line.
    claims
        What covers it; where it is equal, what says it.
    read
        Whether it was read, and if so whether it is what is claimed.
    kind
        Of a formula that was not read: what kind of thing was in the way.
    detail
        In words: what was not understood and where, or both sides of what is different.
    statement
        What was read.
    covered
        All that covers it.
    said
        What each claim or definition that says it says of it.
    beside
        Of a formula that is different: what comes nearest.
    apart
        The letters that mean something here that they do not mean elsewhere.
    """

    formula: Formula
    claims: tuple[str, ...]
    read: Read
    kind: str = ""
    detail: str = ""
    statement: str = ""
    covered: tuple[str, ...] = ()
    said: Mapping[str, Part] = field(default_factory=dict)
    beside: str = ""
    apart: tuple[str, ...] = ()

    def to_json(self) -> dict[str, Any]:
        return {
            "place": self.formula.place, "labels": list(self.formula.labels), "line": self.formula.line,
            "claims": list(self.claims), "read": self.read, "kind": self.kind, "detail": self.detail,
            "statement": self.statement,
        }  # fmt: skip


def compare_all(formulas: Formulas, source: Printed) -> tuple[Compared, ...]:
    """What becomes of each displayed formula, in the order of the text; one that fails stops no other."""
    return tuple(compare(formula, formulas, source) for formula in formulas.displayed)


def compare(formula: Formula, formulas: Formulas, source: Printed) -> Compared:
    """Read one formula and hold it against what covers it."""
    items = source.covering(formula)
    found = _compared(formula, formulas, source, items)
    here = [source.table.where[number] for number in context(source.table, formula.place)]
    apart = dict.fromkeys(letter for item in here for letter in (*item.letters, *item.functions))
    return replace(found, covered=tuple(item.id for item in items), apart=tuple(apart))


def _compared(formula: Formula, formulas: Formulas, source: Printed, items: tuple[Item, ...]) -> Compared:
    ids = tuple(item.id for item in items)
    if not source.known:
        return Compared(formula, ids, "not read", "notation", f"{source.where}, so that no letter means anything")
    meaning, shown = source.letters(formula), replace(formula, text=typeset(formula.text, formulas.macros))
    try:
        reading = read_formula(formula, formulas.macros, meaning)
    except NotUnderstood as error:
        return Compared(shown, ids, "not read", error.kind, str(error))
    return _Comparison(shown, items, reading, source).judged()


def compare_correction(claim: Item, formula: Formula, source: Printed) -> Compared:
    """Read what a claim says ought to be printed, and hold it against that claim alone."""
    try:
        reading = read_formula(formula, {}, source.letters(formula))
    except NotUnderstood as error:
        return Compared(formula, (claim.id,), "not read", error.kind, str(error))
    found = _Comparison(formula, (claim,), reading, source, corrections=True).judged()
    if found.read == "equal" and claim.id not in found.said:
        found = replace(found, read="not read", detail="the claim does not state it itself")
    return replace(found, covered=(claim.id,))


@dataclass(frozen=True)
class _Comparison:
    """A formula that was read, and what may say it; what claims say is put in the paper's words one after the other."""

    formula: Formula
    items: tuple[Item, ...]
    reading: Reading
    source: Printed
    corrections: bool = False

    @cached_property
    def _stated(self) -> dict[str, Stated | None]:
        return {}

    @property
    def ids(self) -> tuple[str, ...]:
        return tuple(item.id for item in self.items)

    def candidates(self) -> Iterator[Stated]:
        for item in self.items:
            if getattr(item, "corrects", None) and not self.corrections:
                continue  # what ought to be printed is not what is printed
            if item.id not in self._stated:
                self._stated[item.id] = stated(item, self.formula, self.source)
            if (found := self._stated[item.id]) is not None:
                yield found

    def judged(self) -> Compared:
        used: dict[str, None] = {}
        for pair, condition in [
            *((p, False) for p in self.reading.pairs),
            *((p, True) for p in self.reading.conditions),
        ]:
            found = self.saying(pair)
            if found is not None:
                used[found.id] = None
            elif not self.by_notation(pair):
                return self.unsaid(pair, condition)
        if self.reading.unread:
            return Compared(self.formula, self.ids, "not read", "brace", self.reading.unread[0], str(self.reading))
        wrong = [brace for brace in self.reading.braces if self.contradicted(brace)]
        if wrong:
            return self.unsaid(wrong[0], False)
        said = [brace for brace in self.reading.braces if self.saying(brace) or self.by_notation(brace)]
        remarks = [
            f"no claim says what stands at a brace, {p}" for p in self.reading.braces if p not in said
        ]  # fmt: skip
        if not used:
            used = dict.fromkeys(self.ids)
            remarks.append("the table of notation says it")
        return Compared(
            self.formula, tuple(used), "equal", "", "; ".join(remarks), str(self.reading), said=self.said(used)
        )

    def by_notation(self, pair: Pair) -> bool:
        """Whether both sides are the same by what the table says of their letters, where something covers this."""
        return pair.sign == "=" and bool(self.items) and same(self._plain(pair.left), self._plain(pair.right))

    @cached_property
    def _plain(self) -> Rules:
        return self.source.meaning(self.formula)

    def contradicted(self, brace: Pair) -> bool:
        """Whether a brace gives a name to something else than what the table or a claim says of the name."""
        if self.saying(brace) is not None or self.by_notation(brace):
            return False
        name = self._plain(brace.left)
        unknown = name.has(AppliedUndef) or (name.is_Symbol and not brace.entry)
        return not unknown or any(says.knows(brace.left) for says in self.candidates())

    @property
    def everything(self) -> tuple[Pair, ...]:
        return (*self.reading.pairs, *self.reading.conditions, *self.reading.braces)

    def said(self, used: Iterable[str]) -> dict[str, Part]:
        """What each that says a relation of this formula says of it; ``used`` may say it among what it assumes."""
        found: dict[str, Part] = {}
        for says in self.candidates():
            parts = frozenset[int]().union(*map(says.parts, self.everything))
            if parts or says.id in used:
                found[says.id] = Part(parts, len(says.pairs), self.excerpt(says))
        return found

    def excerpt(self, says: Stated) -> str:
        """What of the formula this claim states, where that can be told apart from the rest."""
        mine = [text for text, pairs in self._pieces if any(says.parts(pair) for pair in pairs)]
        return r" \\ ".join(mine) if mine else self.formula.text

    @cached_property
    def _pieces(self) -> list[tuple[str, tuple[Pair, ...]]]:
        """What stands side by side in the formula; nothing where a part of it is not read by itself."""
        found = pieces(self.formula.text)
        if len(found) < 2:
            return []
        letters = self.source.letters(self.formula)
        try:
            each = [read_formula(replace(self.formula, text=text), {}, letters) for text in found]
        except NotUnderstood:
            return []
        return [(text, (*said.pairs, *said.conditions)) for text, said in zip(found, each, strict=True)]

    def saying(self, pair: Pair) -> Stated | None:
        """The first that has both sides of this relation, if it has them in this relation.

        Later claims about the same two sides may say what else can hold between them.
        """
        for says in self.candidates():
            verdict = says.says(pair)
            if verdict is not None:
                return says if verdict else None
        return next((says for says in self.candidates() if says.implies(pair)), None)

    def unsaid(self, pair: Pair, condition: bool) -> Compared:
        """A relation that no claim says, beside the one that comes nearest."""
        entries = [(says, claimed) for says in self.candidates() for claimed in says.pairs]
        if not entries:
            detail = "read, but nothing that covers it states a relation" if self.ids else "read, but nothing covers it"
            return Compared(self.formula, self.ids, "not read", "not stated", detail, str(self.reading))
        nearest, claimed = max(entries, key=lambda entry: entry[0].nearness(entry[1], pair))
        beside = f"for all {pair}" if condition else str(nearest.spoken(pair))
        detail = f"the paper: {beside}; {nearest.id}: {claimed}"
        return Compared(self.formula, self.ids, "different", "", detail, str(self.reading), beside=nearest.id)
