"""Squares in the plane, in arrays, whose ends are exact floats."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptproof.balls.arrays import Array, Intervals

Mask = NDArray[np.bool_]
_START = 16


@dataclass(frozen=True, eq=False)
class Boxes:
    """Squares of one size around ``middles`` (2 × boxes); all ends are exact floats."""

    middles: Array
    half: float

    @staticmethod
    def square(half: float, pieces: int = _START) -> Boxes:
        """[−half, half]² in pieces × pieces squares: a power of two, and ``half`` a float of a few binary digits."""
        marks = half * (np.arange(pieces) * 2.0 + 1 - pieces) / pieces
        return Boxes(np.stack(np.meshgrid(marks, marks)).reshape(2, -1), half / pieces)

    @staticmethod
    def border(half: float, pieces: int) -> Boxes:
        """Boxes that cover the border of [−half, half]², with ``pieces`` on each side."""
        marks = np.linspace(-half, half, pieces + 1)
        along, edge = (marks[1:] + marks[:-1]) / 2, np.full(pieces, half)
        middles = np.concatenate([[along, edge], [along, -edge], [edge, along], [-edge, along]], axis=1)
        return Boxes(middles, 2.0 ** math.ceil(math.log2(half / pieces)))

    @staticmethod
    def circles(radii: Array, angles: int) -> Boxes:
        """Points on circles around the origin."""
        turns = np.linspace(0, 2 * np.pi, angles, endpoint=False)
        return Boxes(np.stack([np.outer(radii, f(turns)).ravel() for f in (np.cos, np.sin)]), 0.0)

    def __len__(self) -> int:
        return self.middles.shape[1]

    def sides(self) -> tuple[Intervals, ...]:
        """The boxes as intervals, one for each coordinate."""
        return tuple(Intervals(side - self.half, side + self.half) for side in self.middles)

    def farthest(self) -> Array:
        """The largest distance from the origin, from above."""
        return np.asarray(np.hypot(*(np.abs(self.middles) + self.half)) * (1 + 1e-14))

    def nearest(self) -> Array:
        """The smallest distance from the origin, from below."""
        return np.asarray(np.hypot(*np.maximum(np.abs(self.middles) - self.half, 0.0)) * (1 - 1e-14))

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
                place = [middle + self.half * end for middle, end in zip(self.middles, ends, strict=True)]
                at_corner = np.hypot(*(self.middles + self.half * np.array(corner)[:, np.newaxis]))
                size_there = np.maximum(np.hypot(*place), at_corner)
                found = np.where(room >= 0, np.maximum(found, size_there), found)
        return np.asarray(found * (1 + 1e-12) + np.where(found > 0, self.half * 1e-11, 0.0))

    def chosen(self, mask: Mask) -> Boxes:
        """Some of the boxes."""
        return Boxes(self.middles[:, mask], self.half)

    def quarters(self) -> Boxes:
        """Each box in four."""
        half = self.half / 2
        steps = [np.array([[a * half], [b * half]]) for a in (-1, 1) for b in (-1, 1)]
        return Boxes(np.concatenate([self.middles + step for step in steps], axis=1), half)

    @staticmethod
    def joined(parts: Sequence[Boxes]) -> Boxes:
        """Boxes of one size, put together."""
        return Boxes(np.concatenate([part.middles for part in parts], axis=1), parts[0].half)

    def parts(self, size: int) -> list[Boxes]:
        """The boxes in portions."""
        return [Boxes(self.middles[:, i : i + size], self.half) for i in range(0, len(self), size)]
