"""Levels of W: the largest rate on each band of levels, and the comparison in time that follows from it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptproof.balls.arrays import Array, Intervals

Indices = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Levels:
    """Increasing levels c₀ < … < c_n; band j is [c_j, c_(j+1)]."""

    edges: Array

    @property
    def bands(self) -> int:
        """How many there are."""
        return len(self.edges) - 1

    def touched(self, low: Array, high: Array) -> tuple[Indices, Indices]:
        """The bands first, …, last − 1 that a range [low, high] of W touches; none where first = last."""
        first = np.searchsorted(self.edges, low, side="left") - 1
        last = np.searchsorted(self.edges, high, side="right")
        return np.clip(first, 0, self.bands), np.clip(last, 0, self.bands)

    def shift(self, slope: float) -> Array:
        """The smallest value of ``slope`` · c on each band, from below."""
        found = slope * (self.edges[:-1] if slope >= 0 else self.edges[1:])
        return np.asarray(found - np.abs(found) * 2.0**-50)


def largest_over(first: Indices, last: Indices, values: Array, size: int) -> Array:
    """For each of ``size`` places the largest value whose range first ≤ place < last contains it (−∞ without one)."""
    steps = max(size.bit_length(), 1)
    table = np.full((steps, size), -np.inf)
    some = last > first
    first, last, values = first[some], last[some], values[some]
    scale = np.frexp(last - first)[1] - 1  # the largest power of two that fits
    np.maximum.at(table, (scale, first), values)
    np.maximum.at(table, (scale, last - (1 << scale)), values)
    for k in range(steps - 1, 0, -1):
        half, reach = 1 << (k - 1), size - (1 << k) + 1
        if reach > 0:
            np.maximum(table[k - 1, :reach], table[k, :reach], out=table[k - 1, :reach])
            np.maximum(table[k - 1, half : half + reach], table[k, :reach], out=table[k - 1, half : half + reach])
    return table[0]


def smallest_within(first: Indices, last: Indices, values: Array) -> Array:
    """For each range first ≤ place < last the smallest of ``values`` there (∞ where the range is empty)."""
    size = len(values)
    table = [values]
    while (1 << len(table)) <= size:
        half = 1 << (len(table) - 1)
        table.append(np.minimum(table[-1][:-half], table[-1][half:]))
    found = np.full(first.shape, np.inf)
    scale = np.frexp(np.maximum(last - first, 1))[1] - 1
    for k, row in enumerate(table):
        at = (last > first) & (scale == k)
        found[at] = np.minimum(row[first[at]], row[last[at] - (1 << k)])
    return found


@dataclass(frozen=True)
class Slice:
    """A stretch of time on which the rates on all bands hold.

    Attributes
    ----------
    start, end
        Its ends in t, as floats for people.
    interval
        It in t, from outside.
    shortest, longest
        Bounds of its length in τ; infinite where the gain is.
    steady
        Whether nothing in it depends on time.
    parts
        Shorter ones that it consists of, where a curve is to have more points; empty where it is one itself.
    """

    start: float
    end: float
    interval: Intervals
    shortest: float
    longest: float
    steady: bool
    parts: tuple[Slice, ...] = ()


def fallen(level: float, rates: Array, levels: Levels, shortest: float, longest: float) -> float:
    """A level that W is not above at the end of a slice if it was not above ``level`` at its start; ∞ if none is.

    While W is in band j, dW/dτ ≤ ``rates[j]``. Where the rate is negative W falls through the band in the time that
    this takes at most; where it is not, W does not rise faster than that, and not beyond the bottom of a band in which
    it falls. Times to fall are counted against the ``shortest`` length of the slice, times to rise against the
    ``longest``.
    """
    edges = levels.edges
    if not level <= edges[-1]:
        return float("inf")
    level = max(level, float(edges[0]))
    band = min(int(np.searchsorted(edges, level, side="right")) - 1, levels.bands - 1)
    left = shortest
    if rates[band] < 0:
        while band >= 0 and rates[band] < 0:
            needed = (level - edges[band]) / -rates[band] * (1 + 1e-12)
            if needed > left:
                return min(level, float((level + rates[band] * left * (1 - 1e-12)) * (1 + 1e-12)))
            left, level, band = left - needed, float(edges[band]), band - 1
        return level
    left = longest
    while rates[band] >= 0:
        needed = (edges[band + 1] - level) / rates[band] * (1 - 1e-12) if rates[band] > 0 else float("inf")
        if needed > left:
            return float((level + rates[band] * left) * (1 + 1e-12))
        left, level, band = left - needed, float(edges[band + 1]), band + 1
        if band == levels.bands:
            return float("inf")
    return level
