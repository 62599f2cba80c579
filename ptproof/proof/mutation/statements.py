"""Changes of what a claim states: of each side of each row, of the relation, of quantifiers and orders."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import sympy as sp

from ptproof.proof.claim import Claim
from ptproof.proof.mutation.edits import Edit, Letters, edits
from ptproof.proof.mutation.mutant import Candidate, Place
from ptproof.proof.statement import (
    All,
    Exists,
    Relation,
    RelationSign,
    Smooth,
    Statement,
    free_symbols,
    undefined_functions,
)

_STRICTNESS: dict[str, RelationSign] = {"<=": "<", "<": "<=", ">=": ">", ">": ">="}
_DIRECTION: dict[str, RelationSign] = {"<=": ">=", "<": ">", ">=": "<=", ">": "<", "=": "!=", "!=": "="}


def changed_statements(claim: Claim) -> Iterator[Candidate]:
    """Every change of the statement of the claim that has a kind here."""
    letters = letters_of(claim)
    match claim.statement:
        case Relation() as relation:
            yield from _of_parts(claim, (relation,), lambda parts: parts[0], letters)
        case All(parts):
            yield from _of_parts(claim, parts, lambda parts: All(tuple(parts)), letters)
        case Exists(body=body) as statement:
            yield from _of_parts(claim, body, lambda parts: replace(statement, body=tuple(parts)), letters)
            yield from _quantifiers(claim, statement)
        case Smooth() as statement:
            yield from _smoothness(claim, statement, letters)


def letters_of(claim: Claim) -> Letters:
    """The symbols and undefined functions that the claim speaks of, in the order of their names."""
    spoken_of = [claim.statement, *claim.assumptions]
    return sorted([*free_symbols(spoken_of), *undefined_functions(spoken_of)], key=str)


def _of_parts(
    claim: Claim, parts: Sequence[Relation], whole: Callable[[Sequence[Relation]], Statement], letters: Letters
) -> Iterator[Candidate]:
    for position, part in enumerate(parts):

        def put(changed: Relation, position: int = position) -> Claim:
            return replace(claim, statement=whole([*parts[:position], changed, *parts[position + 1 :]]))

        named = f"part {position + 1}, " if len(parts) > 1 else ""
        for kind, row, words, make in relation_changes(part, letters):
            yield Candidate(
                kind,
                (position, *row),
                lambda words=words, named=named: named + words(),
                lambda make=make, put=put: put(make()),
            )


def relation_changes(
    relation: Relation, letters: Letters
) -> Iterator[tuple[str, Place, Callable[[], str], Callable[[], Relation]]]:
    """Each change of a relation: kind, row, words, and the changed relation when asked for."""
    if not isinstance(relation.left, sp.MatrixBase):
        if relation.sign in _STRICTNESS:
            sign = _STRICTNESS[relation.sign]
            yield "strictness", (0,), partial("{} → {}".format, relation.sign, sign), partial(_signed, relation, sign)
        sign = _DIRECTION[relation.sign]
        yield "direction", (0,), partial("{} → {}".format, relation.sign, sign), partial(_signed, relation, sign)
        if relation.sign == "=":
            yield "direction", (0,), lambda: "= → <", partial(_signed, relation, "<")
    for side in ("left", "right"):
        value: Any = getattr(relation, side)
        for row, entry in enumerate(value if isinstance(value, sp.MatrixBase) else [value]):
            where = f"{side}, row {row + 1}: " if isinstance(value, sp.MatrixBase) else f"{side}: "
            for edit in edits(entry, letters):
                yield (
                    edit.kind,
                    (row,),
                    lambda where=where, edit=edit: where + edit.words,
                    partial(_edited, relation, side, row, edit),
                )


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


def _smoothness(claim: Claim, statement: Smooth, letters: Letters) -> Iterator[Candidate]:
    """The order raised, a variable exchanged or added, a kink or a pole added to each expression, and each edited."""

    def changed(**changes: Any) -> Claim:
        return replace(claim, statement=replace(statement, **changes))

    def with_row(row: int, expression: sp.Expr) -> Claim:
        rows = (*statement.expressions[:row], expression, *statement.expressions[row + 1 :])
        return changed(expressions=rows)

    for more in (1, 2):
        order = statement.order + more
        yield Candidate("order", ("order",), partial("order {}".format, order), partial(changed, order=order))
    outside = [letter for letter in letters if isinstance(letter, sp.Symbol) and letter not in statement.variables]
    for symbol in outside:
        variables = (*statement.variables, symbol)
        yield Candidate(
            "variables", ("variables",), partial("in {} too".format, symbol), partial(changed, variables=variables)
        )
    for position, (applied, order) in enumerate(statement.assumed):
        rest = (*statement.assumed[:position], *statement.assumed[position + 1 :])
        yield Candidate(
            "assumption dropped",
            ("assumed", position),
            partial("{} not assumed smooth".format, applied),
            partial(changed, assumed=rest),
        )
        less = (*statement.assumed[:position], (applied, order - 1), *statement.assumed[position + 1 :])
        yield Candidate(
            "assumption weakened",
            ("assumed", position),
            partial("{} of order {}".format, applied, order - 1),
            partial(changed, assumed=less),
        )
    for row, expression in enumerate(statement.expressions):
        for symbol in statement.variables:
            for words, term in _kinks(symbol, statement.order):
                yield Candidate(
                    "kink",
                    (row,),
                    partial("row {}: plus {}".format, row + 1, words),
                    partial(with_row, row, expression + term),
                )
        # Most changes of a smooth expression leave a smooth one: one of each kind is enough of those.
        for edit in {edit.kind: edit for edit in edits(expression, letters)}.values():
            yield Candidate(
                edit.kind, (row,), lambda row=row, edit=edit: f"row {row + 1}: {edit.words}",
                lambda row=row, edit=edit, expression=expression: with_row(row, edit.apply(expression)),
            )  # fmt: skip


def _kinks(symbol: sp.Symbol, order: int) -> Iterator[tuple[str, sp.Expr]]:
    """What has fewer continuous derivatives than ``order``, as far as the values of the symbol go."""
    kink = symbol ** (order - 1) * sp.Abs(symbol) if symbol.is_nonnegative is None else None
    if kink is not None:
        yield str(kink), kink
    yield f"|{symbol} - 1|", sp.Abs(symbol - 1)
    yield f"max({symbol}, 2)", sp.Max(symbol, 2)
    yield (
        f"|{symbol} - 1/2|**{order - 1}·|{symbol} - 1/2|",
        (symbol - sp.Rational(1, 2)) ** (order - 1) * sp.Abs(symbol - sp.Rational(1, 2)),
    )
    yield f"√|{symbol} - 1|", sp.sqrt(sp.Abs(symbol - 1))
    yield f"1/({symbol} - 1)", 1 / (symbol - 1)
