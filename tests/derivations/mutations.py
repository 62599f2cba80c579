"""Corrupted twins, made by machine: one coefficient, sign, exponent or index changed, or one assumption dropped."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import sympy as sp

from ptproof.proof.claim import Claim
from ptproof.proof.statement import All, Exists, Relation, Smooth, Statement

_FLIPPED: dict[str, Any] = {"<=": ">=", "<": ">", ">=": "<=", ">": "<", "=": "!="}


def mutants(claim: Claim) -> Iterator[tuple[str, Claim]]:
    """Changed claims, each with a word for the change; the same ones in the same order each time."""
    for word, statement in _statements(claim.statement):
        yield word, replace(claim, statement=statement)
    for position, dropped in enumerate(claim.assumptions):
        rest = claim.assumptions[:position] + claim.assumptions[position + 1 :]
        yield f"without the assumption {dropped}", replace(claim, assumptions=rest)


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
            for word, entry in _changes(relation.left[index]):
                left = relation.left.as_mutable()
                left[index] = entry
                yield f"entry {index}: {word}", Relation(left, relation.sign, relation.right)
        return
    yield "direction", Relation(relation.left, _FLIPPED[relation.sign], relation.right)
    sides = ("right",) if isinstance(relation.left, sp.Limit) else ("left", "right")
    for side in sides:
        for word, changed in _changes(getattr(relation, side)):
            yield f"{side}: {word}", replace(relation, **{side: changed})


def _changes(expression: sp.Expr) -> Iterator[tuple[str, sp.Expr]]:
    """A term added, doubled or negated; an exponent raised; a factor halved."""
    yield "plus one", expression + 1
    yield "doubled", 2 * expression
    yield "negated", -expression
    for term in sp.Add.make_args(expression)[:4]:
        if term != expression:
            yield f"sign of {term}", expression - 2 * term
            yield f"half of {term}", expression - term / 2
    powers = sorted(expression.atoms(sp.Pow), key=sp.default_sort_key)
    for node in powers[:4]:
        yield f"exponent of {node}", expression.xreplace({node: node.base ** (node.exp + 1)})
