"""Directions as points on the faces of a cube, boxes over them, and the faces that suffice by symmetry.

Symmetries hold identically, shown by structure and by algebra. No derivative decides alone: that of a jump is 0 for
SymPy. Only a polynomial is differentiated.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise, product
from typing import Any

import sympy as sp
from flint import arb

from ptproof.balls.ball import BALLS, interval
from ptproof.balls.boxes import Sides, halves, widths
from ptproof.balls.rest import expandable


def same(left: sp.Expr, right: sp.Expr) -> bool:
    """Whether two expressions are seen to be equal when they are multiplied out."""
    return bool(left == right) or (expandable(left, 3) and bool(sp.expand(left - right) == 0))


def is_rotational(expression: sp.Expr, offsets: Sequence[sp.Symbol]) -> bool:
    """Whether every rotation about the origin leaves ``expression`` as it is, value and place of definition alike.

    Whatever is made of rotation-invariant parts, jumps included, is invariant: from the inside out, each such part is
    replaced by a letter, and what is left in the coordinates has to be a polynomial whose derivative along every
    rotation of two coordinates is identically 0, which for a polynomial is enough.

    Examples
    --------
    >>> x, y = sp.symbols("x y", real=True)
    >>> is_rotational(sp.exp(-(x**2) - y**2) * x**2 + y**2 * sp.exp(-(x**2) - y**2), [x, y])
    True
    >>> is_rotational((x**2 + y**2) * sp.Piecewise((1, y < 1), (2, True)), [x, y])
    False
    """
    if not expandable(expression, 3):
        return False
    rotations = _Rotations(tuple(offsets))
    # One exponential in the place of several: exp(-x²)·exp(-y²) turns as a whole.
    return not rotations.masked(sp.powsimp(expression, combine="exp")).free_symbols & rotations.own


class _Rotations:
    def __init__(self, offsets: tuple[sp.Symbol, ...]) -> None:
        self.offsets, self.own = offsets, frozenset(offsets)
        self._letters: dict[sp.Basic, sp.Dummy] = {}

    def masked(self, node: sp.Basic) -> sp.Basic:
        """``node`` with its invariant parts replaced by letters; it has no coordinate left where it is invariant."""
        if not node.free_symbols & self.own or node.is_Symbol:
            return node
        parts = [self.masked(argument) for argument in node.args]
        arithmetic = node.is_Add or node.is_Mul or (node.is_Pow and node.exp.is_Integer and node.exp > 0)
        if arithmetic:
            rebuilt = node.func(*parts)
            return self._letter(node) if self._is_invariant_polynomial(rebuilt) else rebuilt
        return self._letter(node) if not any(part.free_symbols & self.own for part in parts) else node

    def _letter(self, node: sp.Basic) -> sp.Dummy:
        return self._letters.setdefault(node, sp.Dummy("invariant"))

    def _is_invariant_polynomial(self, node: sp.Basic) -> bool:
        if not (isinstance(node, sp.Expr) and node.is_polynomial(*self.offsets)):
            return False
        first, *rest = self.offsets
        return all(sp.expand(first * sp.diff(node, y) - y * sp.diff(node, first)) == 0 for y in rest)


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
    sides: Sides

    def balls(self) -> list[arb]:
        """One ball per side."""
        return [interval(*side) if side[0] is not side[1] else side[0] for side in self.sides]

    def direction(self) -> list[arb]:
        """The unit vectors of the box, one ball per coordinate."""
        u = self.face.cube_point(self.balls()[1:])
        norm = sum((BALLS.integer_power(entry, 2) for entry in u), arb(0)).sqrt()
        return [entry / norm for entry in u]

    def at(self, point: Sequence[arb]) -> Box:
        """The box that is only ``point``."""
        return Box(self.face, self.outer, tuple((entry, entry) for entry in point))

    def split(self, index: int) -> tuple[Box, Box]:
        """The two halves along coordinate ``index``; of a radius that ranges widely, on a logarithmic scale."""
        low, high = self.sides[index]
        geometric = index == 0 and low > 0 and high > 4 * low
        lower, upper = halves(self.sides, index, (low * high).sqrt().mid() if geometric else None)
        return Box(self.face, self.outer, lower), Box(self.face, self.outer, upper)

    def widest(self) -> int:
        """The coordinate that ranges most widely, the radius in relation to its size."""
        sizes = widths(self.sides)
        if not self.sides[0][0].is_zero():
            sizes[0] /= float(self.sides[0][1])
        return max(range(len(sizes)), key=sizes.__getitem__)


def shell(faces: Sequence[Face], low: arb, high: arb, pieces: int = 1) -> list[Box]:
    """Boxes that cover ``low`` ≤ ‖y‖ ≤ ``high`` in the directions of ``faces``, ``pieces`` along a whole side."""
    ends = [arb(2 * i) / pieces - 1 for i in range(pieces + 1)]
    return [
        Box(face, False, ((low, high), *sides))
        for face in faces
        for sides in product(*(_cut(side, ends) for side in face.sides))
    ]


def _cut(side: tuple[int, int], ends: Sequence[arb]) -> list[tuple[arb, arb]]:
    """The side in pieces between its own ends and those of ``ends`` that lie certainly inside."""
    low, high = arb(side[0]), arb(side[1])
    if side[0] == side[1]:
        return [(low, high)]
    return list(pairwise([low, *(end for end in ends if low < end < high), high]))


def reduced_faces(drop: sp.Expr, offsets: Sequence[sp.Symbol]) -> tuple[Face, ...]:
    """Faces of the cube that suffice, by symmetries of ``drop`` that hold identically."""
    n = len(offsets)
    if n > 1 and is_rotational(drop, offsets):
        return (Face(0, 1, ((0, 0),) * (n - 1)),)
    even = [same(drop, drop.subs(y, -y)) for y in offsets]
    swapped = [
        i == 0 or same(drop, drop.subs({offsets[0]: offsets[i], offsets[i]: offsets[0]}, simultaneous=True))
        for i in range(n)
    ]
    whole = not any(even) and same(drop, drop.subs({y: -y for y in offsets}, simultaneous=True))
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
