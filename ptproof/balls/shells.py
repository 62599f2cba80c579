"""Shells around the source in pieces, and floats that enclose balls."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import product
from typing import Any


def up(ball: Any) -> float:
    """A float that is at least every number of the ball; inf where there is none."""
    value = float(ball.upper())
    return math.nextafter(value, math.inf) if math.isfinite(value) else math.inf


def down(ball: Any) -> float:
    """A float that is at most every number of the ball; −inf where there is none."""
    value = float(ball.lower())
    return math.nextafter(value, -math.inf) if math.isfinite(value) else -math.inf


def exact(value: float) -> Any:
    from flint import arb

    return arb(value)


@dataclass(frozen=True)
class Piece:
    """A part of a shell: radii [low, high] and the directions c/‖c‖ with c on a box of one face of the cube."""

    low: float
    high: float
    axis: int
    side: int
    box: tuple[tuple[float, float], ...]
    level: int = 0

    def direction(self) -> list[Any]:
        from ptproof.balls.ball import interval

        inner = [interval(exact(a), exact(b)) for a, b in self.box]
        norm = (1 + sum((c * c for c in inner), exact(0.0))).sqrt()
        entries = [c / norm for c in inner]
        entries.insert(self.axis, exact(float(self.side)) / norm)
        return entries

    def halves(self) -> tuple[Piece, Piece]:
        widths = [b - a for a, b in self.box]
        radial = (self.high - self.low) / self.high if self.low > 0 else 0.0
        if not widths or radial > max(widths):
            middle = (self.low + self.high) / 2
            cuts = [(self.low, middle, self.box), (middle, self.high, self.box)]
        else:
            i = widths.index(max(widths))
            a, b = self.box[i]
            middle = (a + b) / 2
            cuts = [
                (self.low, self.high, (*self.box[:i], part, *self.box[i + 1 :])) for part in ((a, middle), (middle, b))
            ]
        first, second = (Piece(lo, hi, self.axis, self.side, box, self.level + 1) for lo, hi, box in cuts)
        return first, second

    def middle(self) -> tuple[Any, list[Any]]:
        """A radius and a direction in the piece, both positive and thin."""
        r = self.high if self.low == 0 else (self.low + self.high) / 2
        box = tuple(((a + b) / 2,) * 2 for a, b in self.box)
        return exact(r), Piece(r, r, self.axis, self.side, box).direction()


def faces(dimension: int, low: float, high: float) -> list[Piece]:
    cuts = [(-1.0, -0.5), (-0.5, 0.0), (0.0, 0.5), (0.5, 1.0)]
    boxes = list(product(cuts, repeat=dimension - 1))
    return [Piece(low, high, axis, side, box) for axis in range(dimension) for side in (-1, 1) for box in boxes]
