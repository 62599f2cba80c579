"""Boxes: intervals side by side, their middles and their halves."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from flint import arb

Side: TypeAlias = tuple[arb, arb]
"""The two ends of one coordinate of a box; each is exact, or a ball around an exact end."""
Sides: TypeAlias = tuple[Side, ...]

TINY = 2.0**-40
"""The relative width at which halving has become pointless."""


def middle(side: Side) -> arb:
    """An exact point strictly inside ``side``, if it has an inside."""
    return ((side[0] + side[1]) / 2).mid()


def centre(sides: Sequence[Side]) -> tuple[arb, ...]:
    """The middle of each side; a side that is a point stays as it is."""
    return tuple(side[0] if side[0] is side[1] else middle(side) for side in sides)


def widths(sides: Sequence[Side]) -> list[float]:
    """The widths, in floating-point numbers."""
    return [float(high - low) for low, high in sides]


def widest(sides: Sequence[Side]) -> int | None:
    """The coordinate with the widest side; None where there is nothing to halve."""
    index = max(range(len(sides)), key=widths(sides).__getitem__, default=None)
    if index is None:
        return None
    (low, high), cut = sides[index], middle(sides[index])
    return index if low < cut and cut < high else None


def is_tiny(sides: Sequence[Side]) -> bool:
    """Whether halving has become pointless."""
    return all(float(high - low) <= TINY * max(1.0, abs(float(high))) for low, high in sides)


def halves(sides: Sides, index: int, cut: arb | None = None) -> tuple[Sides, Sides]:
    """The lower and the upper half along coordinate ``index``, in the middle or at ``cut``."""
    low, high = sides[index]
    at = middle(sides[index]) if cut is None else cut
    before, after = sides[:index], sides[index + 1 :]
    return (*before, (low, at), *after), (*before, (at, high), *after)
