"""What claims and definitions say in the words of the paper that they cover, by its table of notation."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.claim import Claim, Definition
from ptproof.proof.load import Derivation
from ptproof.proof.statement import All, ForAll, Relation, relations_of
from ptproof.reading.latex.formulas import Formula, Formulas
from ptproof.reading.latex.grammar import Grammar
from ptproof.reading.latex.notation import Notation, Table, context, meanings, notation, read_table, says_of, vocabulary
from ptproof.reading.latex.rewrite import Rules, Vocabulary, rules
from ptproof.reading.latex.statements import Pair, read_tokens
from ptproof.reading.latex.tokens import NotUnderstood, Token, read
from ptproof.reading.tables import read_file
from ptproof.report.sameness import same

TABLE = "notation.toml"
MIRRORED = {"<=": ">=", "<": ">", ">=": "<=", ">": "<", "=": "=", "!=": "!="}
Item = Claim | Definition


@dataclass(frozen=True)
class Printed:
    """The notation of a derivation, and its claims and definitions by the labels and places that they name."""

    table: Table
    names: Vocabulary
    where: str
    items: Mapping[str, tuple[Item, ...]]
    known: bool = True

    @cached_property
    def _kept(self) -> dict[Any, Any]:
        return {}

    def letters(self, formula: Formula) -> Notation:
        """What letters mean in the formula."""
        key = context(self.table, formula.place)
        if key not in self._kept:
            self._kept[key] = notation(self.table, self.names, formula.place, self.where)
        found: Notation = self._kept[key]
        return found

    def meaning(self, formula: Formula, takes: Mapping[str, str] | None = None, who: str = "") -> Rules:
        """What names stand for in the formula, for a claim that ``takes`` some letters for others."""
        key = (context(self.table, formula.place), tuple(sorted((takes or {}).items())))
        if key not in self._kept:
            where = f"{self.where}, {who}" if who else self.where
            self._kept[key] = meanings(self.table, self.names, formula.place, takes or {}, where)
        found: Rules = self._kept[key]
        return found

    def covering(self, formula: Formula) -> tuple[Item, ...]:
        """What names a label of the formula, or its place."""
        found = [item for key in (*formula.labels, formula.place) for item in self.items.get(key, ())]
        return tuple({item.id: item for item in found}.values())


def places_missing(source: Printed, formulas: Formulas) -> tuple[str, ...]:
    """The places that the table names and the paper does not have."""
    everything = (*formulas.displayed, *formulas.running)
    known = {key for formula in everything for key in (formula.place, *formula.labels)}
    return tuple(dict.fromkeys(place for says in source.table.says for place in says.at if place not in known))


def printed(derivation: Derivation) -> Printed:
    """The notation of ``derivation``, from the table beside it, and what its claims say.

    Where there is no table nothing is ``known``, and nothing will be read.

    Raises
    ------
    InputError
        If the table is wrong.
    """
    for package in derivation.packages:
        folder = Path(str(getattr(package, "__file__", None) or "")).parent
        if (folder / TABLE).is_file():
            known = vars(sys.modules.get(f"{package.__name__}.notation", sys))
            symbols = {value.name: value for value in known.values() if isinstance(value, sp.Symbol)}
            matrices = {name: value for name, value in known.items() if isinstance(value, sp.MatrixBase)}
            text = read_file(folder / TABLE, "a table of notation")
            return with_table(derivation, text, str(folder / TABLE), {**matrices, **symbols})
    return replace(with_table(derivation, "", f"no {TABLE} stands beside the derivation", {}), known=False)


def with_table(derivation: Derivation, text: str, where: str, known: Mapping[str, Any]) -> Printed:
    """The claims of ``derivation`` with the notation that the table ``text`` says.

    ``known`` are the symbols and matrices of the derivation's own notation.
    """
    table = read_table(text, where)
    items: dict[str, list[Item]] = {}
    everything: list[Item] = [*derivation.definitions, *derivation.claims]
    for item in everything:
        for key in dict.fromkeys([*item.labels, getattr(item, "place", ""), *says_of(table, item.id).at]):
            if key:
                items.setdefault(key, []).append(item)
    return Printed(table, vocabulary(table, known), where, {key: tuple(found) for key, found in items.items()})


@dataclass(frozen=True)
class Stated:
    """What one claim says in the words of the paper, with what the paper's letters mean for it."""

    id: str
    pairs: tuple[Pair, ...]
    given: tuple[Pair, ...]
    meaning: Rules

    def spoken(self, pair: Pair) -> Pair:
        """A relation of the paper with its letters as this claim takes them."""
        return Pair(self.meaning(pair.left), pair.sign, self.meaning(pair.right))

    def says(self, wanted: Pair) -> bool | None:
        """Whether the claim states or assumes this relation of the paper, its sides in either order.

        False where it has the two sides in another relation, None where it says nothing of them.
        """
        found: bool | None = None
        for _, agrees in self._meeting(wanted):
            if agrees:
                return True
            found = False
        return found

    def states(self, wanted: Pair) -> bool:
        """Whether the claim itself states this, and not only assumes it: in one step or by a chain of equalities."""
        return bool(self.parts(wanted)) or (self.says(wanted) is None and self.implies(wanted))

    def implies(self, wanted: Pair) -> bool:
        """Whether the claim has the sides equal by a chain of its equalities.

        What is the same number need not be meant by each other: no chain passes through one.
        """
        if wanted.sign != "=":
            return False
        pair = self.spoken(wanted)
        equal = [own for own in (*self.pairs, *self.given) if own.sign == "="]
        first, last = (pair.left, pair.right) if pair.left.free_symbols else (pair.right, pair.left)
        sides: list[sp.Expr] = [first]
        for side in sides:
            if not side.free_symbols:
                continue
            for own in equal:
                for mine, other in ((own.left, own.right), (own.right, own.left)):
                    if same(mine, side) and not any(other == known for known in sides):
                        sides.append(other)
        return len(sides) > 1 and any(same(side, last) for side in sides[1:])

    def knows(self, side: sp.Expr) -> bool:
        """Whether a relation of the claim has this side."""
        spoken = self.meaning(side)
        return any(same(spoken, mine) for own in (*self.pairs, *self.given) for mine in (own.left, own.right))

    def parts(self, wanted: Pair) -> frozenset[int]:
        """Which of the relations that the claim itself states this is, by number."""
        return frozenset(n for n, agrees in self._meeting(wanted) if agrees and n < len(self.pairs))

    def _meeting(self, wanted: Pair) -> Iterator[tuple[int, bool]]:
        """The relations stated or assumed that have these two sides, and whether they stand in this relation."""
        pair = self.spoken(wanted)
        for number, own in enumerate((*self.pairs, *self.given)):
            if same(own.left, pair.left) and same(own.right, pair.right):
                yield number, own.sign == pair.sign
            elif same(own.left, pair.right) and same(own.right, pair.left):
                yield number, own.sign == MIRRORED[pair.sign]

    def nearness(self, own: Pair, wanted: Pair) -> int:
        """How near one relation of the claim comes to a relation of the paper."""
        pair = self.spoken(wanted)
        sides = any(same(mine, theirs) for mine in (own.left, own.right) for theirs in (pair.left, pair.right))
        return 2 * sides + (own.sign in (pair.sign, MIRRORED[pair.sign]))


def stated(item: Item, formula: Formula, source: Printed) -> Stated | None:
    """What ``item`` says of the formula in the paper's words, or None where it states no relation."""
    if not isinstance(item.statement, Relation | All):
        return None
    says = says_of(source.table, item.id)
    where = f"{source.where}, {item.id}"
    has = rules([says.has], source.names, where)
    meaning = source.meaning(formula, says.takes, item.id)

    def spoken(part: Relation) -> Pair:
        return Pair(meaning(has(part.left)), part.sign, meaning(has(part.right)))

    def side(value: sp.Expr) -> sp.Expr:
        return meaning(has(_inner(value) if says.inside else value))

    parts = relations_of(item.statement)
    left, right = (list(_heads(item.id, texts, formula, source, meaning)) for texts in (says.left, says.right))
    pairs = [spoken(part) for part in parts] if says.both or not (left or right) else []
    named: list[Pair] = []
    for heads, values in ((left, [part.left for part in parts]), (right, [part.right for part in parts])):
        for (before, head), part, value in zip(heads, parts, values, strict=False):
            pairs += before
            if head is None:
                continue
            if part.sign == "=" or heads is right:
                pairs.append(Pair(head, "=", side(value)))
            else:  # the left side under its printed name, which says no more than what the name is for
                named.append(Pair(head, "=", side(value)))
                pairs.append(Pair(head, part.sign, spoken(part).right))
    given = named + [
        spoken(part)
        for held in getattr(item, "assumptions", ())
        for part in (held.relation if isinstance(held, ForAll) else held).components()
    ]
    return Stated(item.id, tuple(pairs), tuple(given), meaning)


def _inner(side: sp.Expr) -> sp.Expr:
    """What a side differentiates, takes the limit of or puts a value in."""
    return side.args[0] if isinstance(side, sp.Derivative | sp.Subs | sp.Limit) else side


_Head = tuple[list[Pair], sp.Expr | None]


def _heads(id: str, texts: Sequence[str], formula: Formula, source: Printed, meaning: Rules) -> Iterator[_Head]:
    """What sides are printed as, entry by entry, each with the relations that come before it in a chain."""
    letters = source.letters(formula)
    for text in texts:
        try:
            tokens = read(text, 0, {})
            if not tokens:
                yield [], None
            elif _is_chain(tokens):
                for pair in read_tokens(tokens, letters).pairs:
                    said = Pair(meaning(pair.left), pair.sign, meaning(pair.right))
                    yield [said], said.right
            else:
                value = Grammar(tokens, letters).inner(tokens)
                for entry in value if isinstance(value, sp.MatrixBase) else [value]:
                    yield [], meaning(entry)
        except NotUnderstood as error:
            raise InputError(f"{source.where}: {text!r}, which {id} is printed as: {error.reason}") from None


def _is_chain(tokens: Sequence[Token]) -> bool:
    depth = 0
    for token in tokens:
        depth += (token.text == "{") - (token.text == "}")
        if token.text == "=" and depth == 0:
            return True
    return False
