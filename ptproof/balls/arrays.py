"""Intervals in arrays: one tape run on many boxes at once, every end rounded outward.

Sums and products are NumPy's, moved outward by one place. Everything else is a ball's own function, called once for
each pair of ends that differs: no accuracy of NumPy's elementary functions is relied on.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial, reduce
from typing import Any, TypeAlias

import numpy as np
from flint import arb
from numpy.typing import NDArray

from ptproof.balls.arithmetic import Ring, Undefined
from ptproof.balls.ball import BALLS, interval
from ptproof.balls.rounding import down, up
from ptproof.balls.tape import Tape

Array: TypeAlias = NDArray[np.float64]


def lower(value: Array) -> Array:
    """The next floats below."""
    return np.asarray(np.nextafter(value, -np.inf))


def upper(value: Array) -> Array:
    """The next floats above."""
    return np.asarray(np.nextafter(value, np.inf))


@dataclass(frozen=True, eq=False)
class Intervals(Ring):
    """Intervals [low, high] side by side, in arrays of one shape (or of shapes that broadcast)."""

    low: Array
    high: Array

    __array_ufunc__ = None  # so that a ball or an array on the left asks us

    @staticmethod
    def point(value: float | Array) -> Intervals:
        """The intervals that hold these floats alone."""
        ends = np.asarray(value, dtype=np.float64)
        return Intervals(ends, ends)

    @staticmethod
    def around(ball: arb) -> Intervals:
        """One interval that contains a ball."""
        return Intervals(np.asarray(down(ball)), np.asarray(up(ball)))

    def __neg__(self) -> Intervals:
        return Intervals(-self.high, -self.low)

    def __add__(self, other: Any) -> Intervals:
        other = _read(other)
        return Intervals(lower(self.low + other.low), upper(self.high + other.high))

    def __mul__(self, other: Any) -> Intervals:
        other = _read(other)
        ends = [a * b for a in (self.low, self.high) for b in (other.low, other.high)]
        return Intervals(lower(reduce(np.minimum, ends)), upper(reduce(np.maximum, ends)))

    def magnitude(self) -> Array:
        """The largest absolute values."""
        return np.asarray(np.maximum(np.abs(self.low), np.abs(self.high)))

    def widened(self, reach: float) -> Intervals:
        """The intervals with ``reach`` at both ends."""
        return Intervals(lower(self.low - reach), upper(self.high + reach))


def _read(value: Any) -> Intervals:
    if isinstance(value, Intervals):
        return value
    return Intervals.around(value if isinstance(value, arb) else arb(value))


class _Arrays:
    """The arithmetic of :class:`Intervals`."""

    def constant(self, value: arb) -> Intervals:
        return Intervals.around(value)

    def call(self, name: str, value: Intervals) -> Intervals:
        return _one_by_one(partial(BALLS.call, name), value)

    def integer_power(self, base: Intervals, exponent: int) -> Intervals:
        if exponent < 0:
            return _one_by_one(lambda ball: BALLS.integer_power(ball, exponent), base)
        if exponent == 0:
            return Intervals.point(1.0)
        if exponent % 2:
            return base if exponent == 1 else base * self.integer_power(base, exponent - 1)
        if exponent > 2:
            return self.integer_power(self.integer_power(base, exponent // 2), 2)
        a, b = base.low * base.low, base.high * base.high
        inside = (base.low <= 0) & (base.high >= 0)
        low = np.where(inside, 0.0, np.maximum(lower(np.minimum(a, b)), 0.0))
        return Intervals(low, upper(np.maximum(a, b)))

    def root(self, base: Intervals, numerator: int, denominator: int, nonnegative: bool) -> Intervals:
        return _one_by_one(lambda ball: BALLS.root(ball, numerator, denominator, nonnegative), base)

    def power(self, base: Intervals, exponent: Intervals) -> Intervals:
        return _one_by_one(BALLS.power, base, exponent)

    def absolute(self, value: Intervals) -> Intervals:
        return _one_by_one(BALLS.absolute, value)

    def sign(self, value: Intervals) -> Intervals:
        return _one_by_one(BALLS.sign, value)

    def maximum(self, left: Intervals, right: Intervals) -> Intervals:
        return Intervals(np.maximum(left.low, right.low), np.maximum(left.high, right.high))

    def minimum(self, left: Intervals, right: Intervals) -> Intervals:
        return Intervals(np.minimum(left.low, right.low), np.minimum(left.high, right.high))

    def floor(self, value: Intervals) -> Intervals:
        return Intervals(np.floor(value.low), np.floor(value.high))

    def angle(self, y: Intervals, x: Intervals) -> Intervals:
        return _one_by_one(BALLS.angle, y, x)

    def either(self, values: Sequence[Intervals]) -> Intervals:
        return Intervals(
            reduce(np.minimum, (value.low for value in values)), reduce(np.maximum, (value.high for value in values))
        )

    def order(self, value: Intervals) -> int | None:
        for known, relation in ((1, operator.gt), (-1, operator.lt), (0, operator.eq)):
            if relation(value.low, 0).all() and relation(value.high, 0).all():
                return known
        return None


ARRAYS = _Arrays()


def _one_by_one(function: Callable[..., arb], *values: Intervals) -> Intervals:
    """A function of balls on each interval, called once for equal ones."""
    ends = np.broadcast_arrays(*(end for value in values for end in (value.low, value.high)))
    shape = ends[0].shape
    rows, back = np.unique(np.stack([end.ravel() for end in ends], axis=1), axis=0, return_inverse=True)
    if not np.isfinite(rows).all():
        raise Undefined("an interval without finite ends")
    found = np.empty((len(rows), 2))
    for at, row in enumerate(rows.tolist()):
        ball = function(*(interval(*pair) for pair in zip(row[::2], row[1::2], strict=True)))
        found[at] = down(ball), up(ball)
    low, high = found[back.ravel()].T
    return Intervals(low.reshape(shape), high.reshape(shape))


def run(tape: Tape, values: Sequence[Intervals]) -> list[Intervals]:
    """The tape on boxes, one :class:`Intervals` per symbol; raises :class:`Undefined` where one box has no value."""
    found = tape.run(values, ARRAYS)
    if not all(np.isfinite(value.low).all() and np.isfinite(value.high).all() for value in found):
        raise Undefined("an expression has no finite value on some box")
    return found
