"""Directions as points on the faces of a cube, boxes over them, and the faces that suffice by symmetry."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp
from flint import arb

from ptproof.balls.ball import interval
from ptproof.balls.jet import Side
from ptproof.balls.rest import expandable


@dataclass(frozen=True)
class Face:
    """Directions: coordinate ``axis`` of u is ``sign``, the others range over ``sides``."""

    axis: int
    sign: int
    sides: tuple[tuple[int, int], ...]

    def cube_point(self, v: Sequence[Any]) -> list[Any]:
        """The point u of the cube for the coordinates v."""
        return [*v[: self.axis], arb(self.sign), *v[self.axis :]]


@dataclass(frozen=True)
class Box:
    """A piece of the domain: ``outer`` chooses the chart, ``sides`` are those of t and of the coordinates v."""

    face: Face
    outer: bool
    sides: tuple[Side, ...]

    def balls(self) -> list[arb]:
        """One ball per side."""
        return [interval(*side) if side[0] is not side[1] else side[0] for side in self.sides]

    def split(self, index: int) -> tuple[Box, Box]:
        """The two halves along coordinate ``index``."""
        low, high = self.sides[index]
        cut = ((low + high) / 2).mid()
        if index == 0 and low > 0 and high > 4 * low:
            cut = (low * high).sqrt().mid()
        first, second = (
            Box(self.face, self.outer, (*self.sides[:index], side, *self.sides[index + 1 :]))
            for side in ((low, cut), (cut, high))
        )
        return first, second


def reduced_faces(drop: sp.Expr, offsets: Sequence[sp.Symbol]) -> tuple[Face, ...]:
    """Faces of the cube that suffice, by symmetries of ``drop`` that hold identically."""
    n = len(offsets)
    if n > 1 and _rotational(drop, offsets):
        return (Face(0, 1, ((0, 0),) * (n - 1)),)
    even = [_same(drop, drop.subs(y, -y)) for y in offsets]
    swapped = [
        i == 0 or _same(drop, drop.subs({offsets[0]: offsets[i], offsets[i]: offsets[0]}, simultaneous=True))
        for i in range(n)
    ]
    whole = not any(even) and _same(drop, drop.subs({y: -y for y in offsets}, simultaneous=True))
    faces = []
    for axis in range(n):
        if axis and swapped[axis]:
            continue  # the swap with the first coordinate maps this face to that of the first
        others = [i for i in range(n) if i != axis]
        sides = tuple((0, 1) if even[i] else (-1, 1) for i in others)
        faces.append(Face(axis, 1, sides))
        if not even[axis] and not whole:
            faces.append(Face(axis, -1, sides))
    return tuple(faces)


def _same(left: sp.Expr, right: sp.Expr) -> bool:
    return bool(left == right) or (expandable(left, 3) and bool(sp.expand(left - right) == 0))


def _rotational(drop: sp.Expr, offsets: Sequence[sp.Symbol]) -> bool:
    if not expandable(drop, 3):
        return False
    first, *rest = offsets
    turned = (first * sp.diff(drop, y) - y * sp.diff(drop, first) for y in rest)
    return all(sp.expand(item) == 0 for item in turned)
