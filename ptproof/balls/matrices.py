"""Small matrices of balls: magnitudes, and what a linear differential inequality lets grow."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import flint
import numpy as np
from flint import arb, arb_mat

from ptproof.balls.tape import Undefined

Vector = list[arb]
_BITS = 64  # bounds need no more


def matrix(rows: Any) -> arb_mat:
    """A matrix of balls from an array of floats (n × m)."""
    entries = np.asarray(rows, dtype=float)
    return arb_mat(*entries.shape, entries.ravel().tolist())


def column(entries: Sequence[arb]) -> arb_mat:
    """A column of balls."""
    return arb_mat(len(entries), 1, list(entries))


def identity(size: int) -> arb_mat:
    """The identity (n × n)."""
    return arb_mat(size, size, [arb(int(i == j)) for i in range(size) for j in range(size)])


def magnitudes(balls: arb_mat) -> arb_mat:
    """For each entry a number that no value of it exceeds in absolute value."""
    return arb_mat([[entry.abs_upper() for entry in row] for row in balls.tolist()])


def floats(balls: arb_mat) -> Any:
    """The midpoints, rounded to floats (n × m); they prove nothing."""
    return np.array([float(entry.mid()) for entry in balls.entries()]).reshape(balls.nrows(), balls.ncols())


def times(balls: arb_mat, radii: Sequence[arb]) -> Vector:
    """The product of a matrix of magnitudes with a column of them, from above."""
    return [entry.upper() for entry in (balls * column(radii)).entries()]


def inverse(balls: arb_mat) -> arb_mat:
    """The inverse; raises :class:`Undefined` where the matrix may be singular."""
    try:
        return balls.inv()
    except ZeroDivisionError:
        raise Undefined("a matrix that may be singular") from None


@dataclass(frozen=True)
class Growth:
    """What u does not exceed, entry by entry: at the end, and on the way (the end included)."""

    end: Vector
    over: Vector


def grown(rates: arb_mat, source: Sequence[arb], start: Sequence[arb], duration: Any) -> Growth:
    """Bounds of every continuous u >= 0 with u(0) <= start and D⁺u <= rates·u + source, entry by entry.

    ``rates`` (n × n, exact) has no negative entry off its diagonal, so that u stays below the solution of the linear
    system with equality (Müller's comparison theorem): its value at the end comes from the exponential of a matrix.
    With the negative entries of the diagonal replaced by zero that solution increases, so that its end bounds u on the
    way.

    Raises :class:`Undefined` where a bound is not finite.
    """
    over = grown_over(rates, source, start, duration)
    with flint.ctx.workprec(_BITS):
        end = _solved(rates.tolist(), source, start, duration)
    if not all(entry.is_finite() for entry in end):
        raise Undefined("growth beyond all bounds")
    return Growth(end, [a.max(b).upper() for a, b in zip(end, over, strict=True)])


def grown_over(rates: arb_mat, source: Sequence[arb], start: Sequence[arb], duration: Any) -> Vector:
    """What the same u do not exceed on the way alone."""
    rows = rates.tolist()
    if any(entry < 0 for i, row in enumerate(rows) for j, entry in enumerate(row) if i != j):
        raise ValueError("the rates off the diagonal must not be negative")
    with flint.ctx.workprec(_BITS):
        over = _solved([[entry.max(arb(0)) for entry in row] for row in rows], source, start, duration)
    if not all(entry.is_finite() for entry in over):
        raise Undefined("growth beyond all bounds")
    return over


def _solved(rates: list[Vector], source: Sequence[arb], start: Sequence[arb], duration: Any) -> Vector:
    """The solution of u' = rates·u + source from ``start`` (a constant 1 carries the source), from above."""
    rows = [[*row, entry] for row, entry in zip(rates, source, strict=True)]
    whole = (arb_mat([*rows, [arb(0)] * (len(rows) + 1)]) * duration).exp()
    return [entry.upper() for entry in (whole * column([*start, arb(1)])).entries()[:-1]]
