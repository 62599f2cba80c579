"""Arithmetic of what formulas say: numbers, columns and matrices, refused where the kinds do not fit."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp

from ptproof.reading.guards import power_refused
from ptproof.reading.latex.tokens import NotUnderstood, Token


def entrywise(value: Any, change: Callable[[Any], Any]) -> Any:
    """A number changed, or each entry of a matrix."""
    return value.applyfunc(change) if isinstance(value, sp.MatrixBase) else change(value)


def add(left: Any, right: Any, at: Token) -> Any:
    """The sum of two numbers or of two matrices of one shape."""
    if getattr(left, "shape", None) != getattr(right, "shape", None):
        raise NotUnderstood("matrix", "a sum of things of different shapes", at.line)
    return left + right


def negate(value: Any) -> Any:
    return value * sp.Integer(-1)


def multiply(left: Any, right: Any, at: Token) -> Any:
    """A product; a row times a column is a number."""
    if isinstance(left, sp.MatrixBase) and isinstance(right, sp.MatrixBase):
        if left.cols != right.rows:
            raise NotUnderstood("matrix", f"a product of a {left.shape} and a {right.shape} matrix", at.line)
        value = sp.ImmutableDenseMatrix(left * right)
        return value[0, 0] if value.shape == (1, 1) else value
    return left * right


def power(value: Any, exponent: Any, at: Token) -> Any:
    """A power of a number."""
    if isinstance(value, sp.MatrixBase) or isinstance(exponent, sp.MatrixBase):
        raise NotUnderstood("matrix", "a power of a matrix, or division by one", at.line)
    if value == 0 and exponent.is_negative:
        raise NotUnderstood("grammar", "a division by 0", at.line)
    if refused := power_refused(value, exponent):
        raise NotUnderstood("grammar", refused, at.line)
    return value**exponent


NORMS = ("1", "2", r"\infty")


def norm(value: Any, at: Token, kind: str = "2") -> Any:
    """The norm of a column of the kind that its index says, the absolute value of a number."""
    if not isinstance(value, sp.MatrixBase):
        return sp.Abs(value)
    if 1 not in value.shape:
        raise NotUnderstood("norm", "the notation says nothing of this norm of a matrix", at.line)
    if kind == "1":
        return sum((sp.Abs(entry) for entry in value), sp.S.Zero)
    if kind == r"\infty":
        return sp.Max(*(sp.Abs(entry) for entry in value))
    return sp.sqrt(sum((entry**2 for entry in value), sp.S.Zero))


def integral(value: Any, limits: tuple[sp.Symbol, Any, Any], at: Token) -> Any:
    """The integral of a number, or of each entry, between two numbers."""
    if any(isinstance(limit, sp.MatrixBase) for limit in limits):
        raise NotUnderstood("integral", "the limits of an integral are numbers", at.line)
    return entrywise(value, lambda entry: sp.Integral(entry, limits))
