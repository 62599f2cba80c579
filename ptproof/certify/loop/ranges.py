"""What a polynomial in the vehicle's variables is on boxes of slow variables: for all headings, for bands of |q|.

On a box each coefficient of exp(ins) q^p is an interval. Over the headings, the sum of the moduli bounds what
oscillates; over a band of |q|, each power by itself.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from flint import arb

from ptproof.balls.around import Around, Matrix
from ptproof.balls.arrays import Array, Intervals
from ptproof.balls.rounding import up
from ptproof.certify.loop.polynomials import Letter, Polynomial

_SLACK = 2.0**-44  # more than the rounding of the few hundred sums and products below


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

    def values(self, enclosures: Mapping[Letter, Intervals], boxes: int) -> Around:
        """All products on all boxes (products × boxes)."""
        shape = len(self.products), boxes
        middle, radius = np.empty(shape), np.empty(shape)
        known = {letter: Around.of(value) for letter, value in enclosures.items()}
        for at, item in enumerate(self.products):
            if not item:
                middle[at], radius[at] = 1.0, 0.0
                continue
            before = self.index[item[:-1]]
            value = Around(middle[before], radius[before]).times(known[item[-1]])
            middle[at], radius[at] = value.middle, value.radius
        return Around(middle, radius)


@dataclass(frozen=True, eq=False)
class Bounds:
    """Of Σ_p c_p(s) q^p on each box: the range of each c_p over all headings (powers × boxes)."""

    low: Array
    high: Array

    def within(self, nearest: float, farthest: float) -> tuple[Array, Array]:
        """A lower and an upper bound for all headings and all q with ``nearest`` ≤ |q| ≤ ``farthest``."""
        low, high, size = self.low[0].copy(), self.high[0].copy(), np.maximum(np.abs(self.low[0]), np.abs(self.high[0]))
        for p in range(1, len(self.low)):
            near, far = nearest**p, farthest**p
            a, b = self.low[p], self.high[p]
            top = np.maximum(np.abs(a), np.abs(b)) * far
            size += top
            if p % 2:
                low -= top
                high += top
            else:
                low += np.minimum(a * near, a * far)
                high += np.maximum(b * near, b * far)
        slack = size * _SLACK + 1e-280
        return low - slack, high + slack

    def size(self) -> Array:
        """The largest absolute value of the part without q."""
        return np.asarray(np.maximum(np.abs(self.low[0]), np.abs(self.high[0])))


@dataclass(frozen=True, eq=False)
class Form:
    """A real polynomial as a matrix over the products of letters, with the number δ put in."""

    turns: tuple[int, ...]
    powers: tuple[int, ...]
    matrix: Matrix

    @staticmethod
    def of(polynomial: Polynomial, delta: arb, columns: Columns) -> Form:
        """``polynomial`` is real: only the turns n ≥ 0 are kept, and what is opposite to them is their conjugate."""
        sums: dict[tuple[int, int], dict[int, Any]] = {}
        for (grade, n, p, letters), value in polynomial.items():
            if n >= 0:
                row = sums.setdefault((n, p), {})
                at = columns.index[letters]
                row[at] = row.get(at, 0) + value * delta**grade
        modes = sorted(sums)
        shape = 2 * len(modes), len(columns.products)
        middle, radius = np.zeros(shape), np.zeros(shape)
        for at, mode in enumerate(modes):
            for column, value in sums[mode].items():
                for part, ball in enumerate((value.real, value.imag)):
                    row_at = at + part * len(modes)
                    middle[row_at, column] = float(ball.mid())
                    radius[row_at, column] = up(abs(ball - arb(float(ball.mid()))))
        return Form(tuple(n for n, _ in modes), tuple(p for _, p in modes), Matrix.of(middle, radius))

    def bounds(self, values: Around) -> tuple[Bounds, Bounds]:
        """The ranges of the coefficients on boxes, and those at the boxes' middles alone, for orientation."""
        found = self.matrix.times(values)
        return self._gathered(found.middle, found.radius), self._gathered(found.middle, np.zeros(found.middle.shape[1]))

    def alone(self, values: Around) -> Around:
        """A form without headings and filter, on boxes."""
        if any(self.turns) or any(self.powers):
            raise ValueError("the form depends on the heading or the filter")
        if not self.turns:
            nothing = np.zeros(values.middle.shape[1])
            return Around(nothing, nothing)
        found = self.matrix.times(values)
        return Around(found.middle[0], found.radius[0])

    def _gathered(self, middle: Array, radius: Array) -> Bounds:
        half, boxes = len(self.turns), middle.shape[1]
        radius = np.broadcast_to(radius, middle.shape)
        low, high = (np.zeros((max(self.powers, default=0) + 1, boxes)) for _ in range(2))
        for at, (n, p) in enumerate(zip(self.turns, self.powers, strict=True)):
            if n == 0:
                low[p] += middle[at] - radius[at]
                high[p] += middle[at] + radius[at]
            else:
                parts = (np.abs(middle[i]) + radius[i] for i in (at, at + half))
                size = 2 * np.hypot(*parts) * (1 + _SLACK)
                low[p] -= size
                high[p] += size
        slack = (np.abs(low) + np.abs(high)) * _SLACK + 1e-280
        return Bounds(low - slack, high + slack)
