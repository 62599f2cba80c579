"""Squares in the plane, in arrays, whose ends are exact floats."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptproof.balls.arrays import Array, Intervals

Mask = NDArray[np.bool_]
_START = 16


@dataclass(frozen=True, eq=False)
class Boxes:
    """Squares of one size around middles; all ends are exact floats."""

    first: Array
    second: Array
    half: float

    @staticmethod
    def square(half: float, pieces: int = _START) -> Boxes:
        """[−half, half]² in pieces × pieces squares: a power of two, and ``half`` a float of a few binary digits."""
        marks = half * (np.arange(pieces) * 2.0 + 1 - pieces) / pieces
        first, second = np.meshgrid(marks, marks)
        return Boxes(first.ravel(), second.ravel(), half / pieces)

    def __len__(self) -> int:
        return len(self.first)

    def sides(self) -> tuple[Intervals, Intervals]:
        """The boxes as intervals."""
        first, second = (Intervals(side - self.half, side + self.half) for side in (self.first, self.second))
        return first, second

    def farthest(self) -> Array:
        """The largest distance from the origin, from above."""
        size = np.hypot(np.abs(self.first) + self.half, np.abs(self.second) + self.half)
        return np.asarray(size * (1 + 1e-14))

    def nearest(self) -> Array:
        """The smallest distance from the origin, from below."""
        sides = (np.maximum(np.abs(side) - self.half, 0.0) for side in (self.first, self.second))
        return np.asarray(np.hypot(*sides) * (1 - 1e-14))

    def cut(self, slopes: Array, bounds: Array) -> Array:
        """The largest distance from the origin where Σ slopes_i d_i ≤ bound on a box, d in [−1, 1]² on it.

        ``slopes`` is 2 × boxes, ``bounds`` any rows × boxes, as is what is found: 0 where there is nothing.

        A distance is convex, and so largest at a corner of what is left of the box. Such a corner is one of the box, or
        on one of its sides: on the way from a corner of the box that is left to one that is cut off.
        """
        size = np.abs(slopes).sum(axis=0)
        bounds = bounds + (np.abs(bounds) + size) * 2.0**-40
        found = np.zeros(np.broadcast_shapes(bounds.shape, size.shape))
        for corner in ((-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)):
            room = bounds - (corner[0] * slopes[0] + corner[1] * slopes[1])
            for axis in (0, 1):
                rise = -2 * corner[axis] * slopes[axis]
                with np.errstate(all="ignore"):
                    way = np.where(rise > 0, np.minimum(room / rise, 1.0), 1.0)
                ends = [np.broadcast_to(np.float64(value), way.shape) for value in corner]
                ends[axis] = corner[axis] * (1 - 2 * way)
                place = [middle + self.half * end for middle, end in zip((self.first, self.second), ends, strict=True)]
                size_there = np.maximum(np.hypot(*place), self._corner(corner))
                found = np.where(room >= 0, np.maximum(found, size_there), found)
        return np.asarray(found * (1 + 1e-12) + np.where(found > 0, self.half * 1e-11, 0.0))

    def _corner(self, corner: tuple[float, float]) -> Array:
        return np.asarray(np.hypot(self.first + self.half * corner[0], self.second + self.half * corner[1]))

    def chosen(self, mask: Mask) -> Boxes:
        """Some of the boxes."""
        return Boxes(self.first[mask], self.second[mask], self.half)

    def quarters(self) -> Boxes:
        """Each box in four."""
        half = self.half / 2
        steps = [(a * half, b * half) for a in (-1, 1) for b in (-1, 1)]
        first = np.concatenate([self.first + a for a, _ in steps])
        return Boxes(first, np.concatenate([self.second + b for _, b in steps]), half)

    @staticmethod
    def joined(parts: Sequence[Boxes]) -> Boxes:
        """Boxes of one size, put together."""
        first = np.concatenate([part.first for part in parts])
        return Boxes(first, np.concatenate([part.second for part in parts]), parts[0].half)

    def parts(self, size: int) -> list[Boxes]:
        """The boxes in portions."""
        return [
            Boxes(self.first[i : i + size], self.second[i : i + size], self.half) for i in range(0, len(self), size)
        ]
