"""What people hand to an assertion becomes exact expressions and relations, or an error that says what is wrong."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Any

import sympy as sp
from sympy.core.relational import Relational

from ptproof.errors import InputError
from ptproof.proof.statement import All, ForAll, Relation
from ptproof.proof.statement import eq as eq
from ptproof.proof.statement import ge as ge
from ptproof.proof.statement import gt as gt
from ptproof.proof.statement import le as le
from ptproof.proof.statement import lt as lt
from ptproof.reading.expressions import parse

_SIGNS: Mapping[str, Any] = {"==": "=", "!=": "!=", "<=": "<=", "<": "<", ">=": ">=", ">": ">"}


def expression(value: Any, where: str, names: Mapping[str, Any] | None = None) -> sp.Expr:
    """One exact expression: a SymPy expression, an integer, a fraction, or text over ``names``."""
    if isinstance(value, str):
        return parse(value, names or {}, where=where)
    if isinstance(value, bool | float | complex):
        raise InputError(f"{where}: {value!r} is not exact; give an integer, a fraction or decimal text")
    if isinstance(value, int | Fraction):
        return sp.Rational(value)
    if not isinstance(value, sp.Expr):
        raise TypeError(f"{where}: expected an expression, got {type(value).__name__}")
    if value.has(sp.Float):
        number = min(value.atoms(sp.Float), key=str)
        raise InputError(f"{where}: contains the floating-point number {number}; give a fraction or decimal text")
    if value.has(sp.nan, sp.zoo):
        raise InputError(f"{where}: contains {sp.nan if value.has(sp.nan) else sp.zoo}, which is not a number")
    return value


def side(value: Any, where: str, names: Mapping[str, Any] | None = None) -> Any:
    """One side of an equality: an expression, or a column from a sequence or matrix of expressions."""
    if isinstance(value, sp.MatrixBase):
        return sp.ImmutableDenseMatrix(
            value.rows, value.cols, [expression(e, f"{where}[{i}]") for i, e in enumerate(value)]
        )
    if isinstance(value, Sequence) and not isinstance(value, str):
        return sp.ImmutableDenseMatrix([expression(e, f"{where}[{i}]", names) for i, e in enumerate(value)])
    return expression(value, where, names)


def relation(value: Any, where: str) -> Relation | All:
    """A relation, a conjunction of them, or SymPy's own relation that is still unevaluated."""
    if isinstance(value, Relation | All):
        for part in value.parts if isinstance(value, All) else (value,):
            side(part.left, where), side(part.right, where)
        return value
    if isinstance(value, Relational):
        return Relation(expression(value.lhs, where), _SIGNS[value.rel_op], expression(value.rhs, where))
    if isinstance(value, sp.And):
        parts = [relation(part, where) for part in sorted(value.args, key=sp.default_sort_key)]
        return All(tuple(part for part in parts if isinstance(part, Relation)))
    if value is True or value is False or value in (sp.true, sp.false):
        raise InputError(
            f"{where}: this relation was evaluated to {value} before it could be checked; "
            "write it with le, lt, ge, gt or eq of ptproof.testing, which keep both sides"
        )
    raise TypeError(f"{where}: expected a relation such as le(left, right), got {type(value).__name__}")


def assumptions(given: Any) -> tuple[Relation | ForAll, ...]:
    """The assumptions of an assertion: one relation or several."""
    items: Iterable[Any] = [given] if isinstance(given, Relation | All | ForAll | Relational) else given
    if isinstance(items, str) or not isinstance(items, Iterable):
        raise TypeError(f"given: expected relations such as ge(x, 0), got {type(given).__name__}")
    found: list[Relation | ForAll] = []
    for i, item in enumerate(items):
        if isinstance(item, ForAll):
            found.append(item)
            continue
        read = relation(item, f"given[{i}]")
        found += list(read.parts) if isinstance(read, All) else [read]
    return tuple(found)
