"""Changes of what a claim assumes, of what its symbols are declared to be, and of the claims that it uses."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial

import sympy as sp

from ptproof.proof.claim import Claim
from ptproof.proof.declarations import declared
from ptproof.proof.mutation.mutant import Candidate, letters_of
from ptproof.proof.mutation.statements import relation_changes
from ptproof.proof.statement import All, Assumption, Exists, ForAll, Relation, RelationSign, Smooth, Statement

_OPENED: dict[str, RelationSign] = {"<": "<=", ">": ">="}
_CLOSED: dict[str, RelationSign] = {"<=": "<", ">=": ">"}
_SIGNS = ("positive", "nonnegative", "negative", "nonpositive", "nonzero", "integer")


def changed_hypotheses(claim: Claim, others: Sequence[Claim] = ()) -> Iterator[Candidate]:
    """Every change of assumptions, declarations and dependencies; ``others`` are claims that may be put in place."""
    yield from _assumptions(claim)
    yield from _declarations(claim)
    if claim.where_defined:
        yield Candidate(
            "domain", ("where",), lambda: "everywhere, defined or not", partial(replace, claim, where_defined=False)
        )
    yield from _dependencies(claim, others)


def _assumptions(claim: Claim) -> Iterator[Candidate]:
    for position, given in enumerate(claim.assumptions):

        def put(*instead: Assumption, position: int = position) -> Claim:
            rest = (*claim.assumptions[:position], *instead, *claim.assumptions[position + 1 :])
            return replace(claim, assumptions=rest)

        row = ("given", position)
        yield Candidate("assumption dropped", row, partial("without the assumption {}".format, given), put)
        for kind, changed in weakened(given):
            yield Candidate(kind, row, partial("{} → {}".format, given, changed), partial(put, changed))
        relation = given.relation if isinstance(given, ForAll) else given
        for change in relation_changes(relation, letters_of(claim)):
            make = partial(_with_relation, put, given, change.make)
            yield Candidate("assumption changed", row, partial(change.said, "in an assumption, "), make)


def _with_relation(put: Callable[[Assumption], Claim], given: Assumption, make: Callable[[], Relation]) -> Claim:
    return put(replace(given, relation=make()) if isinstance(given, ForAll) else make())


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
                domain = (*given.domain[:position], moved, *given.domain[position + 1 :])
                yield "domain", replace(given, domain=domain)
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


def _declarations(claim: Claim) -> Iterator[Candidate]:
    """A symbol of a declared sign or kind taken as any real number."""
    for symbol in letters_of(claim):
        if isinstance(symbol, sp.Symbol) and any(word in declared(symbol) for word in _SIGNS):
            real = sp.Symbol(symbol.name, real=True)
            words = partial("{} any real number".format, symbol)
            yield Candidate("declaration", ("declared", symbol.name), words, partial(_renamed, claim, {symbol: real}))


def _renamed(claim: Claim, change: dict[sp.Symbol, sp.Symbol]) -> Claim:
    def apply(expression: sp.Expr) -> sp.Expr:
        return expression.xreplace(change)

    return replace(
        claim,
        statement=_mapped(claim.statement, apply, change),
        assumptions=tuple(_mapped_assumption(item, apply) for item in claim.assumptions),
    )


def _mapped(statement: Statement, apply: Callable[[sp.Expr], sp.Expr], change: dict[sp.Symbol, sp.Symbol]) -> Statement:
    match statement:
        case Relation():
            return statement.map(apply)
        case All(parts):
            return All(tuple(part.map(apply) for part in parts))
        case Exists(variables=variables, body=body, over=over):
            names = [tuple(change.get(symbol, symbol) for symbol in symbols) for symbols in (variables, over)]
            return Exists(names[0], tuple(part.map(apply) for part in body), names[1])
        case Smooth(expressions=expressions, variables=variables):
            return replace(
                statement,
                expressions=tuple(map(apply, expressions)),
                variables=tuple(change.get(symbol, symbol) for symbol in variables),
                assumed=tuple((apply(applied), order) for applied, order in statement.assumed),
            )
    return statement


def _mapped_assumption(item: Assumption, apply: Callable[[sp.Expr], sp.Expr]) -> Assumption:
    if isinstance(item, Relation):
        return item.map(apply)
    domain = tuple(part.map(apply) for part in item.domain)
    return ForAll(tuple(apply(symbol) for symbol in item.variables), item.relation.map(apply), domain)


def _dependencies(claim: Claim, others: Sequence[Claim]) -> Iterator[Candidate]:
    for position, used in enumerate(claim.uses):

        def put(*instead: Claim, position: int = position) -> Claim:
            return replace(claim, uses=(*claim.uses[:position], *instead, *claim.uses[position + 1 :]))

        row = ("uses", position)
        yield Candidate("dependency", row, partial("without the use of {}".format, used.id), put)
        for other in others:
            if other not in claim.uses and other.id != claim.id:
                words = partial("uses {} instead of {}".format, other.id, used.id)
                yield Candidate("dependency", row, words, partial(put, other))
