"""Changes of what a claim assumes, of what its symbols are declared to be, and of the claims that it uses."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import sympy as sp

from ptproof.proof.claim import Claim
from ptproof.proof.declarations import declared
from ptproof.proof.mutation.edits import with_item
from ptproof.proof.mutation.mutant import Candidate, letters_of
from ptproof.proof.mutation.statements import relation_changes
from ptproof.proof.statement import All, Assumption, Exists, ForAll, Relation, RelationSign, Smooth

_OPENED: dict[str, RelationSign] = {"<": "<=", ">": ">="}
_CLOSED: dict[str, RelationSign] = {"<=": "<", ">=": ">"}
_SIGNS = ("positive", "nonnegative", "negative", "nonpositive", "nonzero", "integer")


def changed_hypotheses(claim: Claim, others: Sequence[Claim] = ()) -> Iterator[Candidate[Claim]]:
    """Every change of assumptions, declarations and dependencies; ``others`` are claims that may be put in place."""
    yield from _assumptions(claim)
    yield from _declarations(claim)
    if claim.where_defined:
        yield Candidate(
            "domain", ("where",), lambda: "everywhere, defined or not", partial(replace, claim, where_defined=False)
        )
    yield from _dependencies(claim, others)


def _assumptions(claim: Claim) -> Iterator[Candidate[Claim]]:
    for position, given in enumerate(claim.assumptions):

        def put(*instead: Assumption, position: int = position) -> Claim:
            return replace(claim, assumptions=with_item(claim.assumptions, position, *instead))

        row = ("given", position)
        yield Candidate("assumption dropped", row, partial("without the assumption {}".format, given), put)
        for kind, changed in weakened(given):
            yield Candidate(kind, row, partial("{} → {}".format, given, changed), partial(put, changed))
        relation = given.relation if isinstance(given, ForAll) else given
        for change in relation_changes(relation, letters_of(claim)):
            whole = partial(_with_relation, put, given)
            yield replace(change.within(whole, row, "in an assumption, "), kind="assumption changed")


def _with_relation(put: Callable[[Assumption], Claim], given: Assumption, relation: Relation) -> Claim:
    return put(replace(given, relation=relation) if isinstance(given, ForAll) else relation)


def weakened(given: Assumption) -> Iterator[tuple[str, Assumption]]:
    """Assumptions that say less than this one or something else, each with the kind of the change.

    The end of a range is moved both ways, since only one of them weakens; what is then equivalent, or weaker than
    the original claim, is found out later.
    """
    if isinstance(given, ForAll):
        for kind, relation in _weaker_relations(given.relation):
            yield kind, replace(given, relation=relation)
        for position, part in enumerate(given.domain):
            for _, moved in _weaker_relations(part):
                yield "domain", replace(given, domain=with_item(given.domain, position, moved))
        return
    if isinstance(given.left, sp.MatrixBase):
        return
    yield from _weaker_relations(given)


def _weaker_relations(given: Relation) -> Iterator[tuple[str, Relation]]:
    left, sign, right = given.left, given.sign, given.right
    if sign == "=":
        yield "assumption weakened", Relation(left, "<=", right)
        yield "assumption weakened", Relation(left, ">=", right)
        yield "domain", Relation(left, sign, right + 1)
        return
    if sign == "!=":
        yield "domain", Relation(left, sign, right + 1)
        return
    if sign in _OPENED:
        yield "strictness", Relation(left, _OPENED[sign], right)
    else:
        yield "domain", Relation(left, _CLOSED[sign], right)
    outward = -1 if sign in (">=", ">") else 1
    yield "assumption weakened", Relation(left, sign, right + outward)
    if right != 0:
        yield "assumption weakened", Relation(left, sign, 2 * right)
        yield "domain", Relation(left, sign, right / 2)
    yield "domain", Relation(left, sign, right + outward * sp.Rational(1, 10))
    yield "direction", Relation(right, sign, left)


def _declarations(claim: Claim) -> Iterator[Candidate[Claim]]:
    """A symbol of a declared sign or kind taken as any real number."""
    for symbol in letters_of(claim):
        if isinstance(symbol, sp.Symbol) and any(word in declared(symbol) for word in _SIGNS):
            real = sp.Symbol(symbol.name, real=True)
            words = partial("{} any real number".format, symbol)
            yield Candidate("declaration", ("declared", symbol.name), words, partial(_renamed, claim, {symbol: real}))


def _renamed(claim: Claim, change: dict[sp.Symbol, sp.Symbol]) -> Claim:
    def apply(expression: sp.Expr) -> sp.Expr:
        return expression.xreplace(change)

    given = tuple(_mapped(item, apply) for item in claim.assumptions)
    return replace(claim, statement=_mapped(claim.statement, apply), assumptions=given)


def _mapped(statement: Any, apply: Callable[[sp.Expr], sp.Expr]) -> Any:
    """A statement or an assumption with every expression and every variable changed."""

    def each(parts: Sequence[Relation]) -> tuple[Relation, ...]:
        return tuple(part.map(apply) for part in parts)

    match statement:
        case Relation():
            return statement.map(apply)
        case All(parts):
            return All(each(parts))
        case Exists(variables=variables, body=body, over=over):
            return Exists(tuple(map(apply, variables)), each(body), tuple(map(apply, over)))
        case ForAll(variables=variables, relation=relation, domain=domain):
            return ForAll(tuple(map(apply, variables)), relation.map(apply), each(domain))
        case Smooth(expressions=expressions, variables=variables, assumed=assumed):
            known = tuple((apply(applied), order) for applied, order in assumed)
            rows, letters = tuple(map(apply, expressions)), tuple(map(apply, variables))
            return replace(statement, expressions=rows, variables=letters, assumed=known)
    return statement


def _dependencies(claim: Claim, others: Sequence[Claim]) -> Iterator[Candidate[Claim]]:
    for position, used in enumerate(claim.uses):

        def put(*instead: Claim, position: int = position) -> Claim:
            return replace(claim, uses=with_item(claim.uses, position, *instead))

        row = ("uses", position)
        yield Candidate("dependency", row, partial("without the use of {}".format, used.id), put)
        for other in others:
            if other not in claim.uses and other.id != claim.id:
                words = partial("uses {} instead of {}".format, other.id, used.id)
                yield Candidate("dependency", row, words, partial(put, other))
