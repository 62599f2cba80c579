"""Changes of what a claim states: of each side of each row, of the relation, of quantifiers."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import sympy as sp

from ptproof.proof.claim import Claim
from ptproof.proof.mutation.edits import Edit, Letters, edits
from ptproof.proof.mutation.mutant import Candidate, Place, letters_of
from ptproof.proof.mutation.smoothness import changed_smoothness
from ptproof.proof.statement import All, Exists, Relation, RelationSign, Runs, Smooth, free_symbols

_STRICTNESS: dict[str, RelationSign] = {"<=": "<", "<": "<=", ">=": ">", ">": ">="}
_DIRECTION: dict[str, RelationSign] = {"<=": ">=", "<": ">", ">=": "<=", ">": "<", "=": "!=", "!=": "="}


def changed_statements(claim: Claim) -> Iterator[Candidate]:
    """Every change of the statement of the claim that has a kind here."""
    letters = letters_of(claim)
    match claim.statement:
        case Relation() as relation:
            yield from _of_parts((relation,), lambda parts: replace(claim, statement=parts[0]), letters)
        case All(parts):
            yield from _of_parts(parts, lambda parts: replace(claim, statement=All(parts)), letters)
        case Exists() as statement:
            yield from _of_parts(statement.body, partial(_with_body, claim, statement), letters)
            yield from _quantifiers(claim, statement)
        case Smooth() as statement:
            yield from changed_smoothness(claim, statement, letters)
        case Runs() as statement:
            yield from _runs(claim, statement)


def _runs(claim: Claim, statement: Runs) -> Iterator[Candidate]:
    """Changes of what is said of runs; those of starts and of rates, which mean new runs, are one kind each."""

    def said(parts: tuple[Relation, ...]) -> Claim:
        return replace(claim, statement=replace(statement, parts=parts))

    def starting(starts: tuple[Relation, ...]) -> Claim:
        return replace(claim, statement=replace(statement, starts=starts))

    def moving(rates: tuple[Relation, ...]) -> Claim:
        return replace(claim, statement=replace(statement, rates=tuple(rate.right for rate in rates)))

    letters = statement.letters
    yield from _of_parts(statement.parts, said, letters)
    rates = tuple(Relation(x, "=", rate) for x, rate in zip(statement.state, statement.rates, strict=True))
    for name, rows, put in (("start", statement.starts, starting), ("rate", rates, moving)):
        for item in _of_parts(rows, put, letters):
            yield replace(item, kind=name, row=(name,), words=partial(_of, name, item.words))


def _of(name: str, words: Callable[[], str]) -> str:
    return f"{name}: {words()}"


def _with_body(claim: Claim, statement: Exists, body: tuple[Relation, ...]) -> Claim:
    return replace(claim, statement=replace(statement, body=body))


def _of_parts(
    parts: Sequence[Relation], whole: Callable[[tuple[Relation, ...]], Claim], letters: Letters
) -> Iterator[Candidate]:
    for position, part in enumerate(parts):
        put = partial(_with_part, whole, tuple(parts), position)
        named = f"part {position + 1}, " if len(parts) > 1 else ""
        for change in relation_changes(part, letters):
            yield Candidate(
                change.kind, (position, *change.row), partial(change.said, named), partial(_made, put, change)
            )


def _with_part(
    whole: Callable[[tuple[Relation, ...]], Claim], parts: tuple[Relation, ...], position: int, changed: Relation
) -> Claim:
    return whole((*parts[:position], changed, *parts[position + 1 :]))


def _made(put: Callable[[Relation], Claim], change: RelationChange) -> Claim:
    return put(change.make())


@dataclass(frozen=True)
class RelationChange:
    """A change of a relation: its kind, the row that it touches, and its words and what it makes when asked for."""

    kind: str
    row: Place
    words: Callable[[], str]
    make: Callable[[], Relation]

    def said(self, before: str) -> str:
        """The words, with others before them."""
        return before + self.words()


def relation_changes(relation: Relation, letters: Letters) -> Iterator[RelationChange]:
    """Each change of a relation: its sign, and each side of each row."""
    if not isinstance(relation.left, sp.MatrixBase):
        signs = [("direction", _DIRECTION[relation.sign])]
        if relation.sign in _STRICTNESS:
            signs.append(("strictness", _STRICTNESS[relation.sign]))
        if relation.sign == "=":
            signs.append(("direction", "<"))
        for kind, sign in signs:
            words = partial("{} → {}".format, relation.sign, sign)
            yield RelationChange(kind, (0,), words, partial(_signed, relation, sign))
    for side in ("left", "right"):
        value: Any = getattr(relation, side)
        for row, entry in enumerate(value if isinstance(value, sp.MatrixBase) else [value]):
            where = f"{side}, row {row + 1}: " if isinstance(value, sp.MatrixBase) else f"{side}: "
            for edit in edits(entry, letters):
                make = partial(_edited, relation, side, row, edit)
                yield RelationChange(edit.kind, (row,), partial(edit.said, where), make)


def _signed(relation: Relation, sign: RelationSign) -> Relation:
    return Relation(relation.left, sign, relation.right)


def _edited(relation: Relation, side: str, row: int, edit: Edit) -> Relation:
    value: Any = getattr(relation, side)
    if isinstance(value, sp.MatrixBase):
        changed = value.as_mutable()
        changed[row] = edit.apply(value[row])
        return replace(relation, **{side: changed})
    return replace(relation, **{side: edit.apply(value)})


def _quantifiers(claim: Claim, statement: Exists) -> Iterator[Candidate]:
    """A variable that is given instead of chosen, one that comes before instead of after, and the other way round."""

    def candidate(words: str, **changes: Any) -> Candidate:
        return Candidate(
            "quantifier",
            ("quantifier",),
            lambda: words,
            lambda: replace(claim, statement=replace(statement, **changes)),
        )

    names = ", ".join(map(str, statement.over))
    for symbol in statement.variables:
        rest = tuple(item for item in statement.variables if item != symbol)
        if rest:
            yield candidate(f"for all {symbol} that come first", variables=rest)
            yield candidate(f"for all {symbol} that come after", variables=rest, over=(*statement.over, symbol))
    if statement.over:
        yield candidate(f"the choice may depend on {names}", over=())
        yield candidate(f"{names} chosen too", variables=(*statement.variables, *statement.over), over=())
    outer = sorted(free_symbols(statement.body) - {*statement.variables, *statement.over}, key=str)
    for symbol in outer:
        yield candidate(f"one choice for all {symbol}", over=(*statement.over, symbol))
