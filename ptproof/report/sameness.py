"""Whether two expressions are the same: a number that differs says no, exact algebra says yes."""

from __future__ import annotations

import hashlib
from functools import lru_cache
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.algebra import NotAlgebraic, is_zero


def same(left: sp.Expr, right: sp.Expr) -> bool:
    """Whether two expressions are equal by exact algebra; a number that differs says no before that is asked."""
    if left == right:
        return True
    if isinstance(left, sp.Piecewise) or isinstance(right, sp.Piecewise):
        return _same_cases(left, right)
    if number(left) != number(right):
        return False
    try:
        return is_zero(left - right) or is_zero(_logarithms(left) - _logarithms(right))
    except (NotAlgebraic, sp.PolynomialError, NotImplementedError):
        return False


def _logarithms(expression: sp.Expr) -> sp.Expr:
    """The expression with what stands in its logarithms multiplied out."""
    return expression.replace(sp.log, lambda *values: sp.log(*map(sp.expand, values)))


def _same_cases(left: sp.Expr, right: sp.Expr) -> bool:
    """Whether two distinctions of cases have the same values under the same conditions, in the same order."""
    if not (isinstance(left, sp.Piecewise) and isinstance(right, sp.Piecewise)) or len(left.args) != len(right.args):
        return False
    return all(
        same(mine.expr, other.expr) and _same_condition(mine.cond, other.cond)
        for mine, other in zip(left.args, right.args, strict=True)
    )


def _same_condition(left: Any, right: Any) -> bool:
    if left == right:
        return True
    one, other = (
        value.canonical if isinstance(value, sp.core.relational.Relational) else value for value in (left, right)
    )
    return (
        isinstance(one, sp.core.relational.Relational)
        and one.func == other.func
        and same(one.lhs - one.rhs, other.lhs - other.rhs)
    )


@lru_cache(maxsize=8192)
def number(expression: sp.Expr) -> str:
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
