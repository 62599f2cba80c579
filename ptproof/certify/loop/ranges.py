"""What a polynomial in the vehicle's variables is on boxes of slow variables: for all headings, for bands of |q|.

On a box each coefficient of exp(ins) q^p is a linear form with a rest. What oscillates is bounded over all headings by
the sum of its moduli or on a grid of headings, whichever is better; over a band of |q|, the first two powers together.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import groupby
from typing import Any

import numpy as np
from flint import arb

from ptproof.balls.arrays import Array
from ptproof.balls.linear import Linear, Matrix
from ptproof.balls.rounding import up
from ptproof.certify.loop.levels import Indices
from ptproof.certify.loop.polynomials import Letter, Polynomial

_SLACK = 2.0**-44  # more than the rounding of the few hundred sums and products below
_GRID = 32
_STEP = math.pi / _GRID * (1 + 1e-12)
_COSINES: Array = np.array([float((arb(2 * j) / _GRID).cos_pi()) for j in range(_GRID)])


@dataclass(frozen=True)
class Columns:
    """The products of letters that occur, each after the one that it is made of."""

    products: tuple[tuple[Letter, ...], ...]

    @staticmethod
    def of(*polynomials: Polynomial) -> Columns:
        """Those of some polynomials."""
        found = {key[3][:n] for part in polynomials for key in part for n in range(len(key[3]) + 1)}
        return Columns(tuple(sorted(found, key=lambda item: (len(item), item))))

    @cached_property
    def index(self) -> Mapping[tuple[Letter, ...], int]:
        """The place of each product."""
        return {item: at for at, item in enumerate(self.products)}

    @cached_property
    def letters(self) -> tuple[Letter, ...]:
        """The letters that occur."""
        return tuple(sorted({letter for item in self.products for letter in item}))

    @cached_property
    def steps(self) -> tuple[tuple[slice, Indices, Indices], ...]:
        """By length, which products are one of those before times which letter."""
        place = {letter: at for at, letter in enumerate(self.letters)}
        found: list[tuple[slice, Indices, Indices]] = []
        start = 0
        for _, group in groupby(self.products, key=len):
            items = list(group)
            if items[0]:
                before = np.array([self.index[item[:-1]] for item in items])
                found.append((slice(start, start + len(items)), before, np.array([place[item[-1]] for item in items])))
            start += len(items)
        return tuple(found)

    def values(self, letters: Linear) -> Linear:
        """All products on all boxes (products × boxes); ``letters`` are in the order of ours."""
        axes, shape = len(letters.slopes), (len(self.products), letters.middle.shape[1])
        found = Linear(np.ones(shape), np.zeros((axes, *shape)), np.zeros(shape))
        for rows, before, last in self.steps:
            new = found.rows(before).times(letters.rows(last))
            found.middle[rows], found.slopes[:, rows], found.radius[rows] = new.middle, new.slopes, new.radius
        return found


@dataclass(frozen=True, eq=False)
class Ranges:
    """Of Σ_p c_p(s) q^p on each box: the range of each c_p over all headings (powers × boxes).

    ``least`` and ``most`` are about the smallest and largest c_p at the box's middle: for orientation, and no bounds.
    """

    low: Array
    high: Array
    least: Array
    most: Array

    def above(self, nearest: float, farthest: float) -> Array:
        """An upper bound for all headings and all q with ``nearest`` ≤ |q| ≤ ``farthest``."""
        return _largest(self.low, self.high, nearest, farthest)

    def below(self, nearest: float, farthest: float) -> Array:
        """A lower bound, likewise."""
        return -_largest(-self.high, -self.low, nearest, farthest)

    def expected(self) -> Array:
        """About the largest value at the box's middle, where q is the worst of all: for orientation."""
        return _peak(self.least, self.most)

    def reached(self) -> Array:
        """About the largest value that is left possible, where q is the worst of all: for orientation."""
        return _peak(self.low, self.high)

    def size(self) -> Array:
        """The largest absolute value of the part without q."""
        return np.asarray(np.maximum(np.abs(self.low[0]), np.abs(self.high[0])))


def _peak(low: Array, high: Array) -> Array:
    if len(high) < 3:
        return np.asarray(high[0])
    steep = np.maximum(np.abs(low[1]), np.abs(high[1]))
    return np.asarray(high[0] + steep**2 / np.maximum(-4 * high[2], 1e-300) * (high[2] < 0))


def _largest(low: Array, high: Array, nearest: float, farthest: float) -> Array:
    """At most c_0 + max(a|q| + b q²) + the rest, each power by itself; the parabola is largest where 2b|q| = −a."""
    found, size = high[0].copy(), np.maximum(np.abs(low[0]), np.abs(high[0]))
    nothing = np.zeros_like(found)
    a = np.maximum(np.abs(low[1]), np.abs(high[1])) if len(low) > 1 else nothing
    b = high[2] if len(low) > 2 else nothing
    with np.errstate(all="ignore"):
        best = np.where(b < 0, np.clip(np.nan_to_num(-a / (2 * b), nan=farthest), nearest, farthest), farthest)
    found += a * best + b * best**2
    size += a * best + np.abs(b) * best**2
    for p in range(3, len(low)):
        near, far = nearest**p, farthest**p
        top = np.maximum(np.abs(low[p]), np.abs(high[p])) * far
        size += top
        found += top if p % 2 else np.maximum(high[p] * near, high[p] * far)
    return np.asarray(found + size * _SLACK + 1e-280)


@dataclass(frozen=True, eq=False)
class Waves:
    """Σ c_(n,p) exp(ins) q^p on boxes, real: the real parts of the coefficients n ≥ 0, then the imaginary ones."""

    turns: tuple[int, ...]
    powers: tuple[int, ...]
    parts: Linear

    def plus(self, factor: Array, other: Waves) -> Waves:
        """self + factor · other, with a factor per box."""
        if (self.turns, self.powers) != (other.turns, other.powers):
            raise ValueError("waves of other turns or powers")
        return Waves(self.turns, self.powers, self.parts.plus(factor, other.parts))

    def mean(self) -> Linear:
        """The part without heading and filter."""
        at = self._still()
        return Linear(self.parts.middle[at], self.parts.slopes[:, at], self.parts.radius[at])

    def _still(self) -> int:
        return list(zip(self.turns, self.powers, strict=True)).index((0, 0))

    def upright(self) -> Waves:
        """Without the slopes in y₁ and y₂ of the part without heading and filter."""
        slopes = self.parts.slopes.copy()
        slopes[:2, self._still()] = 0.0
        return Waves(self.turns, self.powers, Linear(self.parts.middle, slopes, self.parts.radius))

    def ranges(self) -> Ranges:
        """The ranges of the c_p(s), over all headings: the better of two bounds, for each box.

        One is the sum of the moduli. The other is the largest value on a grid of M headings, and what is missed there:
        at a maximum of f the derivative is zero, and a point of the grid is at most π/M away, so that
        f ≤ f(grid) + (π/M)²/2 · max|f″|, and |f″| is at most the sum of the moduli times n². It is used for each
        point of the box at once: f is linear on it, up to its radius.
        """
        found = [self._range(p) for p in range(max(self.powers, default=0) + 1)]
        return Ranges(*(np.stack(rows) for rows in zip(*found, strict=True)))

    def _range(self, power: int) -> tuple[Array, Array, Array, Array]:
        half, at = len(self.turns), [i for i, p in enumerate(self.powers) if p == power]
        boxes = self.parts.middle.shape[1]
        if not at:
            return np.zeros(boxes), np.zeros(boxes), np.zeros(boxes), np.zeros(boxes)
        rows = [*at, *(i + half for i in at)]
        turns = np.array([self.turns[i] for i in at])
        twice = np.where(turns == 0, 1.0, 2.0)
        middle, slopes, radius = self.parts.middle[rows], self.parts.slopes[:, rows], self.parts.radius[rows]
        few = len(at)
        rest = twice @ np.hypot(radius[:few], radius[few:])
        moduli = np.hypot(middle[:few], middle[few:]) + np.hypot(slopes[:, :few], slopes[:, few:]).sum(axis=0)
        whole = np.where(turns == 0, 0.0, twice) @ moduli
        missed = (twice * turns**2) @ moduli * (0.5 * _STEP**2)
        angles = np.outer(np.arange(_GRID), turns)
        parts = _COSINES[angles % _GRID], _COSINES[(angles + _GRID // 4) % _GRID]  # cos and −sin
        waves = np.concatenate([twice * part for part in parts], axis=1)
        values, reach = waves @ middle, np.zeros((_GRID, boxes))
        for part in slopes:
            moved = waves @ part
            reach += np.abs(moved, out=moved)
        steady = (turns == 0).astype(float)
        mean, wide = steady @ middle[:few], steady @ np.abs(slopes[:, :few]).sum(axis=0)
        slack = (twice @ moduli + rest) * _SLACK + 1e-280
        least, most = values.min(axis=0), values.max(axis=0)
        top = np.add(values, reach).max(axis=0)
        high = np.minimum(mean + wide + whole, top + missed) + rest + slack
        low = (
            np.maximum(mean - wide - whole, np.subtract(values, reach, out=values).min(axis=0) - missed) - rest - slack
        )
        return low, high, least, most


@dataclass(frozen=True, eq=False)
class Form:
    """A real polynomial as a matrix over the products of letters, with the number δ put in."""

    turns: tuple[int, ...]
    powers: tuple[int, ...]
    matrix: Matrix

    @staticmethod
    def of(polynomial: Polynomial, delta: arb, columns: Columns, like: Sequence[Polynomial] = ()) -> Form:
        """``polynomial`` is real: only the turns n ≥ 0 are kept, and what is opposite to them is their conjugate.

        It gets rows for the turns and powers of the polynomials ``like`` it too.
        """
        modes = sorted({(0, 0)} | {key[1:3] for part in (polynomial, *like) for key in part if key[1] >= 0})
        place = {mode: at for at, mode in enumerate(modes)}
        sums: dict[tuple[int, int], Any] = {}
        for (grade, n, p, letters), value in polynomial.items():
            if n >= 0:
                entry = place[n, p], columns.index[letters]
                sums[entry] = sums.get(entry, 0) + value * delta**grade
        shape = 2 * len(modes), len(columns.products)
        middle, radius = np.zeros(shape), np.zeros(shape)
        for (row, column), value in sums.items():
            for at, ball in ((row, value.real), (row + len(modes), value.imag)):
                middle[at, column] = float(ball.mid())
                radius[at, column] = up(abs(ball - arb(float(ball.mid()))))
        return Form(tuple(n for n, _ in modes), tuple(p for _, p in modes), Matrix.of(middle, radius))

    def on(self, values: Linear) -> Waves:
        """The polynomial on boxes."""
        return Waves(self.turns, self.powers, self.matrix.times(values))
