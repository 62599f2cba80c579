"""A cover of the plane by boxes, refined where that sharpens a bound: rates on bands of levels, and distances.

All levels are treated at once. A box and a band of |q| touch the bands of levels in their range of W, and what they
bound counts for each of these. A box is quartered as long as it says more than the middles do (within a tolerance);
whatever is left at the end counts as it is, so that the result holds in any case.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ptproof.balls.arrays import Array, Intervals
from ptproof.certify.loop.boxes import Boxes, Mask
from ptproof.certify.loop.levels import Indices, Levels, largest_over, smallest_within
from ptproof.certify.loop.model import Model, across

_CHUNK = 512
_CLASS = 1 / 16  # the slopes κ are multiples of this part of the typical one
_MOST = 150_000  # boxes, after which nothing is refined any more
_SLACK = 2.0**-44
_RADII, _ANGLES = 48, 16
_FINEST = 1 / 32  # of δ: half the side of boxes that are not quartered any more


def guide(model: Model, levels: Levels, half: float, time: Intervals) -> Array:
    """Per band about the largest rate, from points alone: where to look closely, and never a bound."""
    points = Boxes.circles(np.geomspace(model.reach / 10, half, _RADII), _ANGLES)
    look = _Look.at(model, points, levels, np.zeros(2), time)
    seen = np.full(levels.bands, -np.inf)
    np.maximum.at(seen, look.place, look.reached)
    filled = np.isfinite(seen)
    at = np.arange(levels.bands)
    return np.asarray(np.interp(at, at[filled], seen[filled]))


def rates(
    model: Model, levels: Levels, filter_bands: Array, half: float, time: Intervals, window: tuple[float, float],
    seen: Array, slack: float,
) -> Array:  # fmt: skip
    """Per band of levels a bound of dW/dτ over [−half, half]², all headings and all |q| ≤ the last of ``filter_bands``.

    It is −∞ where W has no such level.

    Parameters
    ----------
    window
        The levels about which sharp bounds are wanted; others get what comes for nothing.
    seen, slack
        What :func:`guide` says, and by how much a bound may be above it without refinement, as a part of the level.
    """
    found = np.full(levels.bands, -np.inf)
    wanted = (levels.edges[1:] >= window[0]) & (levels.edges[:-1] <= window[1])
    count, seen, boxes, unit = 0, seen.copy(), Boxes.square(half), model.typical * _CLASS
    while len(boxes):
        looks = [(part, _Look.at(model, part, levels, filter_bands, time)) for part in boxes.parts(_CHUNK)]
        for _, look in looks:
            np.maximum.at(seen, look.place, look.value)
        enough = np.where(wanted, seen + slack * levels.edges[1:], np.inf)
        count += len(boxes)
        fine = boxes.half < model.reach * _FINEST or count > _MOST
        rest = []
        for part, look in looks:
            split = np.zeros(len(part), bool) if fine else look.above(enough, levels, unit)
            np.maximum(found, look.largest(~split, levels, unit), out=found)
            rest.append(part.chosen(split).quarters())
        boxes = Boxes.joined(rest)
    return found


@dataclass(frozen=True)
class Tried:
    """What one box said of one band of levels, at the worst of the bands of |q|.

    Attributes
    ----------
    place, half
        The middle of the box, and half its side.
    filter
        The band of |q|.
    level, rate
        The band of levels, and the bound of dW/dτ on it.
    middle
        About the largest rate at the middle with q = 0: no bound.
    """

    place: tuple[float, float]
    half: float
    filter: tuple[float, float]
    level: tuple[float, float]
    rate: float
    middle: float


def tried(
    model: Model, boxes: Boxes, levels: Levels, filter_bands: Array, time: Intervals, band: int | None
) -> list[Tried]:
    """What boxes say of a band of levels, for those that it touches; with no ``band``, of the lowest that each has."""
    found, unit = [], model.typical * _CLASS
    for part in boxes.parts(_CHUNK):
        look = _Look.at(model, part, levels, filter_bands, time)
        at = np.full(look.first.shape, band) if band is not None else np.minimum(look.first, levels.bands - 1)
        kappa = look.slopes * unit
        value = look.rates - np.minimum(kappa * levels.edges[at], kappa * levels.edges[at + 1])
        touched = (look.first <= at) & (at < look.last) if band is not None else look.first < levels.bands
        order = np.where(touched, value if band is not None else -at, -np.inf)
        worst = order.argmax(axis=0)
        for i in np.flatnonzero(np.isfinite(order.max(axis=0))):
            q, j = worst[i], at[worst[i], i]
            found.append(
                Tried(
                    (float(part.middles[0, i]), float(part.middles[1, i])), part.half,
                    (float(filter_bands[q]), float(filter_bands[q + 1])),
                    (float(levels.edges[j]), float(levels.edges[j + 1])), float(value[q, i]), float(look.value[i]),
                )
            )  # fmt: skip
    return found


def farthest(model: Model, wanted: Array, filter_bands: Array, half: float, time: Intervals, tolerance: float) -> Array:
    """For each of the increasing levels ``wanted`` a bound of |y| where W is not above it, for y in [−half, half]².

    W ≥ base + g·d on a box, for all headings and q, with d in [−1, 1]²: W ≤ c leaves a half-plane of it.
    """
    found, seen = np.zeros((2, len(wanted)))
    count, boxes = 0, Boxes.square(half)
    while len(boxes):
        looks = []
        for part in boxes.parts(_CHUNK):
            waves = model.still(part, time)[0]
            upright = waves.upright().ranges()
            base = np.min([upright.below(*pair) for pair in pairwise(filter_bands)], axis=0)
            looks.append((part, part.cut(waves.mean().slopes[:2], wanted[:, np.newaxis] - base)))
            inside = wanted[:, np.newaxis] >= upright.least[0]
            seen = np.maximum(seen, np.where(inside, np.hypot(*part.middles), 0.0).max(axis=1))
        enough = np.maximum.accumulate(seen) * (1 + tolerance)
        count += len(boxes)
        fine = boxes.half < model.reach * _FINEST / 4 or count > _MOST
        rest = []
        for part, reach in looks:
            split: Mask = np.asarray((reach > enough[:, np.newaxis]).any(axis=0) & (not fine))
            found = np.maximum(found, reach[:, ~split].max(axis=1, initial=0.0))
            rest.append(part.chosen(split).quarters())
        boxes = Boxes.joined(rest)
    return np.asarray(np.maximum.accumulate(found))


@dataclass(frozen=True, eq=False)
class _Look:
    """What boxes say: per band of |q| and box the bands of levels touched and ``rates`` r, and per box ``slopes`` κ.

    On level c the rate is at most r − κc: both depend on where a box is cut by the level, and the difference hardly.
    """

    first: Indices
    last: Indices
    rates: Array
    slopes: Indices
    place: Indices
    value: Array
    reached: Array

    @staticmethod
    def at(model: Model, boxes: Boxes, levels: Levels, filter_bands: Array, time: Intervals) -> _Look:
        function, rate = model.both(boxes, time)
        slopes = across(function, rate, model.typical * _CLASS)
        kappa: Array = np.asarray(slopes * (model.typical * _CLASS), dtype=np.float64)
        size, both = function.ranges(), rate.plus(kappa, function).ranges()
        rows = []
        for pair in pairwise(filter_bands):
            rows.append((*levels.touched(size.below(*pair), size.above(*pair)), both.above(*pair)))
        first, last, found = (np.stack(column) for column in zip(*rows, strict=True))
        at_rest = function.mean().middle
        place = np.clip(np.searchsorted(levels.edges, at_rest) - 1, 0, levels.bands - 1)
        there = both.expected() - kappa * at_rest, both.reached() - kappa * at_rest
        return _Look(first, last, found, slopes, place, *there)

    def above(self, enough: Array, levels: Levels, unit: float) -> Mask:
        """The boxes that say more than ``enough`` on some band that they touch."""
        found = np.zeros(self.slopes.shape, bool)
        for slope in np.unique(self.slopes):
            at = self.slopes == slope
            allowed = enough + levels.shift(slope * unit)
            found[at] = (self.rates[:, at] > smallest_within(self.first[:, at], self.last[:, at], allowed)).any(axis=0)
        return found

    def largest(self, keep: Mask, levels: Levels, unit: float) -> Array:
        """Per band of levels the largest rate on the kept boxes."""
        found = np.full(levels.bands, -np.inf)
        for slope in np.unique(self.slopes[keep]):
            at = keep & (self.slopes == slope)
            first, last, values = self.first[:, at].ravel(), self.last[:, at].ravel(), self.rates[:, at].ravel()
            most = largest_over(first, last, values, levels.bands)
            some = np.isfinite(most)
            shift = levels.shift(slope * unit)[some]
            value = most[some] - shift + (np.abs(most[some]) + np.abs(shift)) * _SLACK
            found[some] = np.maximum(found[some], value)
        return found
