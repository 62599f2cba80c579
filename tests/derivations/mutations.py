"""Corrupted twins, made by machine: one coefficient, sign, exponent or index changed, or one assumption dropped."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import sympy as sp

from ptproof.proof.claim import Claim
from ptproof.proof.statement import All, Exists, Relation, Smooth, Statement, free_symbols

_FLIPPED: dict[str, Any] = {"<=": ">=", "<": ">", ">=": "<=", ">": "<", "=": "!="}


_INDEXED = (("a1", "a2"), ("b1", "b2"), ("c_kappa1", "c_kappa2"), ("c1", "c2"), ("E12", "E21"), ("V", "V0"))
_SCALED = (("k", 2), ("T", sp.Rational(1, 2)), ("mu", 2), ("E_norm", sp.Rational(1, 2)), ("d", sp.Rational(1, 2)))


def swapped(claim: Claim) -> Iterator[tuple[str, Claim]]:
    """The claim with two indices exchanged, or one letter scaled, on one side of one of its relations."""
    statement = claim.statement
    if not isinstance(statement, Relation | All):
        return
    parts = (statement,) if isinstance(statement, Relation) else statement.parts
    letters = {symbol.name: symbol for symbol in free_symbols([statement])}
    for word, change in _letter_changes(letters):
        for position, part in enumerate(parts):
            for side in ("left", "right"):
                old = getattr(part, side)
                new = old.subs(change, simultaneous=True)
                if new == old:
                    continue
                twin = replace(part, **{side: new})
                whole = twin if len(parts) == 1 else All((*parts[:position], twin, *parts[position + 1 :]))
                yield f"part {position}, {side}: {word}", replace(claim, statement=whole)


def _letter_changes(letters: dict[str, sp.Symbol]) -> Iterator[tuple[str, dict[sp.Symbol, sp.Expr]]]:
    for first, second in _INDEXED:
        if first in letters and second in letters:
            a, b = letters[first], letters[second]
            yield f"{first} and {second} exchanged", {a: b, b: a}
    for name, factor in _SCALED:
        if name in letters:
            yield f"{name} times {factor}", {letters[name]: factor * letters[name]}


def without_assumptions(claim: Claim) -> Iterator[tuple[str, Claim]]:
    """The claim with one of its assumptions dropped."""
    for position, dropped in enumerate(claim.assumptions):
        rest = claim.assumptions[:position] + claim.assumptions[position + 1 :]
        yield f"without the assumption {dropped}", replace(claim, assumptions=rest)


def mutants(claim: Claim) -> Iterator[tuple[str, Claim]]:
    """Changed claims, each with a word for the change; the same ones in the same order each time."""
    for word, statement in _statements(claim.statement):
        yield word, replace(claim, statement=statement)
    yield from without_assumptions(claim)


def _statements(statement: Statement) -> Iterator[tuple[str, Statement]]:
    match statement:
        case Relation():
            yield from _relations(statement)
        case All(parts):
            for position, part in enumerate(parts):
                for word, changed in _relations(part):
                    yield f"part {position}: {word}", All((*parts[:position], changed, *parts[position + 1 :]))
        case Exists(body=body):
            for position, part in enumerate(body):
                for word, changed in _relations(part):
                    yield (
                        f"part {position}: {word}",
                        replace(statement, body=(*body[:position], changed, *body[position + 1 :])),
                    )
        case Smooth(expressions=expressions, variables=variables):
            kink = expressions[0] + sp.Abs(variables[0])
            yield "with a kink", replace(statement, expressions=(kink, *expressions[1:]))


def _relations(relation: Relation) -> Iterator[tuple[str, Relation]]:
    if isinstance(relation.left, sp.MatrixBase):
        for index in range(len(relation.left)):
            for word, entry in _changes(relation.left[index], relation.sign, relation.right[index]):
                left = relation.left.as_mutable()
                left[index] = entry
                yield f"entry {index}: {word}", Relation(left, relation.sign, relation.right)
        return
    yield "direction", Relation(relation.left, _FLIPPED[relation.sign], relation.right)
    sides = ("right",) if isinstance(relation.left, sp.Limit) else ("left", "right")
    for side in sides:
        other = relation.right if side == "left" else relation.left
        for word, changed in _changes(getattr(relation, side), relation.sign, other):
            yield f"{side}: {word}", replace(relation, **{side: changed})


def _changes(expression: sp.Expr, sign: str, other: sp.Expr) -> Iterator[tuple[str, sp.Expr]]:
    """A term added, doubled or negated; an exponent raised; a factor halved.

    Against 0 the doubled side says the same, and so does the negated side of an equality.
    """
    yield "plus one", expression + 1
    if other != 0:
        yield "doubled", 2 * expression
    if other != 0 or sign not in ("=", "!="):
        yield "negated", -expression
    for term in sp.Add.make_args(expression)[:4]:
        if term != expression:
            yield f"sign of {term}", expression - 2 * term
            yield f"half of {term}", expression - term / 2
    powers = sorted(expression.atoms(sp.Pow), key=sp.default_sort_key)
    for node in powers[:4]:
        yield f"exponent of {node}", expression.xreplace({node: node.base ** (node.exp + 1)})
