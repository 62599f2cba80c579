"""Changes of what a claim states: of each side of each row, of the relation, of quantifiers."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import sympy as sp

from ptproof.proof.claim import Claim
from ptproof.proof.mutation.edits import Edit, Letters, edits, with_item
from ptproof.proof.mutation.mutant import Candidate, letters_of, restated
from ptproof.proof.mutation.smoothness import changed_smoothness
from ptproof.proof.statement import All, Exists, Relation, RelationSign, Runs, Smooth, free_symbols

_STRICTNESS: dict[str, RelationSign] = {"<=": "<", "<": "<=", ">=": ">", ">": ">="}
_DIRECTION: dict[str, RelationSign] = {"<=": ">=", "<": ">", ">=": "<=", ">": "<", "=": "!=", "!=": "="}


def changed_statements(claim: Claim) -> Iterator[Candidate[Claim]]:
    """Every change of the statement of the claim that has a kind here."""
    letters = letters_of(claim)
    match claim.statement:
        case Relation() as relation:
            yield from _of_parts((relation,), lambda parts: replace(claim, statement=parts[0]), letters)
        case All(parts):
            yield from _of_parts(parts, lambda parts: restated(claim, parts=parts), letters)
        case Exists() as statement:
            yield from _of_parts(statement.body, lambda body: restated(claim, body=body), letters)
            yield from _quantifiers(claim, statement)
        case Smooth() as statement:
            yield from changed_smoothness(claim, statement, letters)
        case Runs() as statement:
            yield from _runs(claim, statement)


def _runs(claim: Claim, statement: Runs) -> Iterator[Candidate[Claim]]:
    """Changes of what is said of runs; those of starts and of rates, which mean new runs, are one kind each."""
    letters = statement.letters
    yield from _of_parts(statement.parts, lambda parts: restated(claim, parts=parts), letters)
    starts = _of_parts(statement.starts, lambda starts: restated(claim, starts=starts), letters)
    equations = [Relation(x, "=", rate) for x, rate in zip(statement.state, statement.rates, strict=True)]
    rates = _of_parts(equations, lambda parts: restated(claim, rates=tuple(part.right for part in parts)), letters)
    for name, items in (("start", starts), ("rate", rates)):
        for item in items:
            yield replace(item.within(lambda changed: changed, (name,), f"{name}: "), kind=name)


def _of_parts(
    parts: Sequence[Relation], whole: Callable[[tuple[Relation, ...]], Claim], letters: Letters
) -> Iterator[Candidate[Claim]]:
    for position, part in enumerate(parts):

        def put(changed: Relation, position: int = position) -> Claim:
            return whole(with_item(parts, position, changed))

        named = f"part {position + 1}, " if len(parts) > 1 else ""
        for change in relation_changes(part, letters):
            yield change.within(put, (position, *change.row), named)


def relation_changes(relation: Relation, letters: Letters) -> Iterator[Candidate[Relation]]:
    """Each change of a relation: its sign, and each side of each row."""
    if not isinstance(relation.left, sp.MatrixBase):
        signs = [("direction", _DIRECTION[relation.sign])]
        if relation.sign in _STRICTNESS:
            signs.append(("strictness", _STRICTNESS[relation.sign]))
        if relation.sign == "=":
            signs.append(("direction", "<"))
        for kind, sign in signs:
            words = partial("{} → {}".format, relation.sign, sign)
            yield Candidate(kind, (0,), words, partial(replace, relation, sign=sign))
    for side in ("left", "right"):
        value: Any = getattr(relation, side)
        for row, entry in enumerate(value if isinstance(value, sp.MatrixBase) else [value]):
            where = f"{side}, row {row + 1}: " if isinstance(value, sp.MatrixBase) else f"{side}: "
            for edit in edits(entry, letters):
                make = partial(_edited, relation, side, row, edit)
                yield Candidate(edit.kind, (row,), partial(edit.said, where), make)


def _edited(relation: Relation, side: str, row: int, edit: Edit) -> Relation:
    value: Any = getattr(relation, side)
    if isinstance(value, sp.MatrixBase):
        changed = value.as_mutable()
        changed[row] = edit.apply(value[row])
        return replace(relation, **{side: changed})
    return replace(relation, **{side: edit.apply(value)})


def _quantifiers(claim: Claim, statement: Exists) -> Iterator[Candidate[Claim]]:
    """A variable that is given instead of chosen, one that comes before instead of after, and the other way round."""

    def candidate(words: str, **changes: Any) -> Candidate[Claim]:
        return Candidate("quantifier", ("quantifier",), lambda: words, lambda: restated(claim, **changes))

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
