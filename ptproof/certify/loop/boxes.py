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
