"""The formulas of a paper, as a machine reads them, against what the claims and definitions that cover them say.

A formula is *equal* to what is claimed if each relation in it is a relation of a claim or definition that covers it,
both sides the same by exact algebra, up to sides swapped. A correction counts for nothing here.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Literal

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.errors import InputError
from ptproof.proof.algebra import NotAlgebraic, is_zero
from ptproof.proof.claim import Claim, Definition
from ptproof.proof.load import Derivation
from ptproof.proof.statement import All, ForAll, Relation, relations_of
from ptproof.reading.latex.formulas import Formula, Formulas
from ptproof.reading.latex.grammar import Grammar
from ptproof.reading.latex.notation import Table, meanings, notation, read_table, says_of, vocabulary
from ptproof.reading.latex.rewrite import Rules, Vocabulary, rules
from ptproof.reading.latex.statements import Pair, Reading, read_formula, read_tokens
from ptproof.reading.latex.tokens import NotUnderstood, Token, read
from ptproof.reading.tables import read_file

TABLE = "notation.toml"
Read = Literal["equal", "different", "not read"]
_MIRRORED = {"<=": ">=", "<": ">", ">=": "<=", ">": "<", "=": "=", "!=": "!="}
Item = Claim | Definition


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
    """

    formula: Formula
    claims: tuple[str, ...]
    read: Read
    kind: str = ""
    detail: str = ""
    statement: str = ""

    def to_json(self) -> dict[str, Any]:
        return {
            "place": self.formula.place, "labels": list(self.formula.labels), "line": self.formula.line,
            "claims": list(self.claims), "read": self.read, "kind": self.kind, "detail": self.detail,
            "statement": self.statement,
        }  # fmt: skip


@dataclass(frozen=True)
class Printed:
    """The notation of a derivation, and its claims and definitions by the labels and places that they name."""

    table: Table
    names: Vocabulary
    where: str
    items: Mapping[str, tuple[Item, ...]]

    def covering(self, formula: Formula) -> tuple[Item, ...]:
        """What names a label of the formula, or its place."""
        found = [item for key in (*formula.labels, formula.place) for item in self.items.get(key, ())]
        return tuple({item.id: item for item in found}.values())


def printed(derivation: Derivation) -> Printed:
    """The notation of ``derivation``, from the table beside it, and what its claims say.

    Raises
    ------
    InputError
        If there is no table, or it is wrong.
    """
    for package in derivation.packages:
        folder = Path(str(getattr(package, "__file__", ""))).parent
        if (folder / TABLE).is_file():
            module = __import__("sys").modules.get(f"{package.__name__}.notation")
            symbols = {value.name: value for value in vars(module).values() if isinstance(value, sp.Symbol)} if module else {}
            return with_table(derivation, read_file(folder / TABLE, "a table of notation"), str(folder / TABLE), symbols)
    raise InputError(f"no {TABLE} stands beside the derivation, so that no formula can be read")


def with_table(derivation: Derivation, text: str, where: str, symbols: Mapping[str, sp.Symbol]) -> Printed:
    """The claims of ``derivation`` with the notation that the table ``text`` says."""
    table = read_table(text, where)
    items: dict[str, list[Item]] = {}
    everything: list[Item] = [*derivation.definitions, *derivation.claims]
    for item in everything:
        for key in dict.fromkeys([*item.labels, getattr(item, "place", "")]):
            if key:
                items.setdefault(key, []).append(item)
    return Printed(table, vocabulary(table, symbols), where, {key: tuple(found) for key, found in items.items()})


def compare_all(formulas: Formulas, source: Printed) -> tuple[Compared, ...]:
    """What becomes of each displayed formula, in the order of the text; one that fails keeps no other from being read."""
    return tuple(compare(formula, formulas, source) for formula in formulas.displayed)


def compare(formula: Formula, formulas: Formulas, source: Printed) -> Compared:
    """Read one formula and hold it against what covers it."""
    items = source.covering(formula)
    ids = tuple(item.id for item in items)
    meaning = notation(source.table, source.names, formula.place, source.where)
    try:
        reading = read_formula(formula, formulas.macros, meaning)
    except NotUnderstood as error:
        return Compared(formula, ids, "not read", error.kind, str(error))
    stated = [found for item in items if not getattr(item, "corrects", None) and (found := _stated(item, formula, source))]
    if not stated:
        detail = "read, but nothing that covers it states a relation" if items else "read, but nothing covers it"
        return Compared(formula, ids, "not read", "not stated", detail, str(reading))
    return _judged(formula, ids, reading, stated, source)


@dataclass(frozen=True)
class _Stated:
    """What one claim says in the words of the paper, with what the paper's letters mean for it."""

    id: str
    pairs: tuple[Pair, ...]
    given: tuple[Pair, ...]
    meaning: Rules


def _stated(item: Item, formula: Formula, source: Printed) -> _Stated | None:
    statement = item.statement
    if not isinstance(statement, Relation | All):
        return None
    says = says_of(source.table, item.id)
    has = rules([says.has], source.names, f"{source.where}, {item.id}")
    meaning = meanings(source.table, source.names, formula.place, says.takes, f"{source.where}, {item.id}")

    def spoken(part: Relation) -> Pair:
        return Pair(meaning(has(part.left)), part.sign, meaning(has(part.right)))

    parts = relations_of(statement)
    pairs = [spoken(part) for part in parts]
    if says.left or says.right:
        sides = ((says.left, [part.left for part in parts]), (says.right, [part.right for part in parts]))
        pairs = [
            pair for heads, given in sides
            for pair in _with_heads(item.id, heads, [meaning(has(_inner(e) if says.inside else e)) for e in given], formula, source, meaning)
        ] + [
            Pair(pair.left, part.sign, spoken(part).right)
            for part, pair in zip(parts, _with_heads(item.id, says.left, [part.left for part in parts], formula, source, meaning), strict=False)
            if part.sign != "=" and len(says.left) == len(parts)
        ]
    given = [
        spoken(part)
        for held in getattr(item, "assumptions", ())
        for part in (held.relation if isinstance(held, ForAll) else held).components()
    ]
    return _Stated(item.id, tuple(pairs), tuple(given), meaning)


def _inner(side: sp.Expr) -> sp.Expr:
    """What a side differentiates, takes the limit of or puts a value in."""
    return side.args[0] if isinstance(side, sp.Derivative | sp.Subs | sp.Limit) else side


def _with_heads(
    id: str, texts: Sequence[str], printed_sides: Sequence[sp.Expr], formula: Formula, source: Printed, meaning: Rules
) -> Iterator[Pair]:
    """The sides that a claim gives alone, each with what the table says that it is printed as."""
    letters = notation(source.table, source.names, formula.place, source.where)
    heads: list[tuple[list[Pair], sp.Expr | None]] = []
    for text in texts:
        try:
            tokens = read(text, 0, {})
            if not tokens:
                heads.append(([], None))
            elif _is_chain(tokens):
                heads += _chained(read_tokens(tokens, letters).pairs, meaning)
            else:
                value = Grammar(tokens, letters).inner(tokens)
                heads += [([], meaning(entry)) for entry in (value if isinstance(value, sp.MatrixBase) else [value])]
        except NotUnderstood as error:
            raise InputError(f"{source.where}: {text!r}, which {id} is printed as: {error.reason}") from None
    for (before, head), side in zip(heads, printed_sides, strict=False):
        yield from before
        if head is not None:
            yield Pair(head, "=", side)


def _is_chain(tokens: Sequence[Token]) -> bool:
    depth = 0
    for token in tokens:
        depth += (token.text == "{") - (token.text == "}")
        if token.text == "=" and depth == 0:
            return True
    return False


def _chained(pairs: Sequence[Pair], meaning: Rules) -> list[tuple[list[Pair], sp.Expr | None]]:
    """A chain of two as the head of a side, entry by entry: the chain, and its end."""
    said = [Pair(meaning(pair.left), pair.sign, meaning(pair.right)) for pair in pairs]
    return [([pair], pair.right) for pair in said]


def _judged(
    formula: Formula, ids: tuple[str, ...], reading: Reading, stated: Sequence[_Stated], source: Printed
) -> Compared:
    used: dict[str, None] = {}
    remarks = list(reading.unread)
    for pair in reading.pairs:
        found = next((says for says in stated if _says((*says.pairs, *says.given), pair, says.meaning)), None)
        if found is None:
            detail = "; ".join([_side_by_side(pair, stated, source, formula), *_notes(source, formula)])
            return Compared(formula, ids, "different", "", detail, str(reading))
        used[found.id] = None
    for pair in reading.conditions:
        if not any(_says((*says.pairs, *says.given), pair, says.meaning) for says in stated):
            detail = f"for all {pair}: no claim says it, nor assumes it"
            return Compared(formula, ids, "different", "", detail, str(reading))
    for pair in reading.braces:
        if not any(_says(says.pairs, pair, says.meaning) for says in stated):
            remarks.append(f"no claim says what stands at a brace, {pair}")
    return Compared(formula, tuple(used), "equal", "", "; ".join(remarks), str(reading))


def _says(pairs: Iterable[Pair], wanted: Pair, meaning: Rules) -> bool:
    left, right = meaning(wanted.left), meaning(wanted.right)
    for pair in pairs:
        if pair.sign == wanted.sign and same(pair.left, left) and same(pair.right, right):
            return True
        if pair.sign == _MIRRORED[wanted.sign] and same(pair.left, right) and same(pair.right, left):
            return True
    return False


def _side_by_side(pair: Pair, stated: Sequence[_Stated], source: Printed, formula: Formula) -> str:
    """The relation that no claim says, and the one that comes nearest."""

    def nearness(entry: tuple[_Stated, Pair]) -> int:
        says, claimed = entry
        left, right = says.meaning(pair.left), says.meaning(pair.right)
        sides = (same(claimed.left, left), same(claimed.right, right), same(claimed.left, right), same(claimed.right, left))
        return 2 * any(sides) + (claimed.sign in (pair.sign, _MIRRORED[pair.sign]))

    nearest, claimed = max(((says, claimed) for says in stated for claimed in says.pairs), key=nearness)
    as_read = Pair(nearest.meaning(pair.left), pair.sign, nearest.meaning(pair.right))
    return f"the paper: {as_read}; {nearest.id}: {claimed}"


def _notes(source: Printed, formula: Formula) -> list[str]:
    return []


def same(left: sp.Expr, right: sp.Expr) -> bool:
    """Whether two expressions are equal by exact algebra; a number that differs says no before that is asked."""
    if left == right:
        return True
    if _number(left) != _number(right):
        return False
    try:
        return is_zero(left - right)
    except (NotAlgebraic, sp.PolynomialError, NotImplementedError):
        return False


@lru_cache(maxsize=8192)
def _number(expression: sp.Expr) -> str:
    """The value where every letter has a value of its own, in a few digits; equal expressions have equal ones."""
    nodes = {n for n in sp.preorder_traversal(expression) if isinstance(n, _OPAQUE)}
    values = {node: _value_of(node) for node in nodes}
    value = expression.xreplace(values).evalf(40)
    try:
        return f"{complex(value):.9e}"
    except (TypeError, ValueError):
        return ""


_OPAQUE = (sp.Symbol, AppliedUndef, sp.Derivative, sp.Subs, sp.Integral, sp.Limit)


def _value_of(node: sp.Basic) -> sp.Float:
    digest = hashlib.sha256(str(node).encode()).digest()
    return sp.Float(int.from_bytes(digest[:6], "big") / 2**48 + 0.25, 40)
