"""Where a certificate is looked for: the square of positions, the bands of the filter's deviation, the levels of W."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ptproof.balls.arrays import Array, Intervals
from ptproof.certify.loop.boxes import Boxes
from ptproof.certify.loop.levels import Levels
from ptproof.certify.loop.model import Model
from ptproof.certify.loop.setup import Phase

_ROUNDS = 3
_BANDS = 150  # of levels, per factor of ten
_FILTER = np.concatenate([[0.0], 2.0 ** np.arange(-12, 1)])


@dataclass(frozen=True, eq=False)
class Stage:
    """Where everything happens: the squares' half side, the bands of |q|, the levels, and the level of the start."""

    half: float
    filter_bands: Array
    levels: Levels
    start: float


@dataclass(frozen=True, eq=False)
class Place:
    """Where a proof fails.

    Attributes
    ----------
    model, stage
        W, and where it is looked at.
    time, start, end
        The stretch of time, as an interval in t and as floats for people.
    level
        The level that W is not shown to leave downward; None where the levels around a start are not closed.
    """

    model: Model
    stage: Stage
    time: Intervals
    start: float
    end: float
    level: float | None = None


class NoCertificate(Exception):
    """Why there is none, in words, and where."""

    def __init__(self, why: str, place: Place | None = None) -> None:
        super().__init__(why)
        self.place = place


def set_stage(prepared: Sequence[Model], spans: Sequence[Phase], reach: float, filter_start: float) -> Stage:
    """A square with levels of W that are closed in it, above every start with |y| ≤ ``reach``, |g| ≤ ``filter_start``.

    Raises :class:`NoCertificate` where none are found.
    """
    half, tried = reach * 1.25, []
    for _ in range(5):
        half = math.ceil(half * 1024) / 1024
        start, deviation = _start(prepared[0], half, reach, filter_start, spans[0].interval())
        weight = prepared[0].weight
        if not 0 < start < math.inf:
            raise NoCertificate(f"W is {start:.4g} at the start: the field is not above its surroundings there")
        widest = math.sqrt(2 * max(start, 0) * 6 / weight) + 2 * deviation
        bands = _FILTER * widest
        top = min(_ceiling(model, half, bands, span.interval()) for model, span in zip(prepared, spans, strict=True))
        if top > 1.5 * start:
            top = min(top, 5 * start) * (1 - 1e-9)
            bottom = min(_bottom(prepared[0]), start / 10)
            count = math.ceil(_BANDS * math.log10(top / bottom))
            return Stage(half, bands, Levels(np.geomspace(bottom, top, count + 1)), start)
        tried.append((top, half, bands))
        half *= 1.3
    top, half, bands = max(tried, key=lambda item: item[0])
    # The border on which W is too small, with levels that show how small.
    levels, span = Levels(np.linspace(min(0.5 * top, 2 * top, 0.9 * start), 1.5 * start, 401)), spans[0]
    border = Stage(half, bands, levels, start)
    raise NoCertificate(
        f"the level sets of W around the start are not shown to be closed (W ≤ {start:.4g} at the start, ≥ {top:.4g} "
        "around it): a larger omega or a smaller start would help",
        Place(prepared[0], border, span.interval(), float(span.start), float(span.end)),
    )


def _start(model: Model, half: float, reach: float, filter_start: float, time: Intervals) -> tuple[float, float]:
    """What W and |q| are at most where |y| ≤ ``reach`` and |g| ≤ ``filter_start``."""
    boxes, level, deviation = Boxes.square(half, 64), -math.inf, 0.0
    for left in range(_ROUNDS, -1, -1):
        boxes = boxes.chosen(boxes.nearest() <= reach)
        waves, manifold = model.still(boxes, time)
        off = manifold.ranges().size() * (1 + 1e-9) + filter_start
        function = waves.ranges()
        parts = np.linspace(0, float(off.max()), 9)
        high = np.max([function.above(*pair) for pair in pairwise(parts)], axis=0)
        inside = boxes.farthest() <= reach
        best = float(function.most[0][inside].max()) if inside.any() else -math.inf
        split = (high > best * 1.001) & (left > 0)
        level = max(level, float(high[~split].max(initial=-math.inf)))
        deviation = max(deviation, float(off[~split].max(initial=0.0)))
        boxes = boxes.chosen(split).quarters()
        if not len(boxes):
            break
    return level, deviation


def _ceiling(model: Model, half: float, bands: Array, time: Intervals) -> float:
    """A level that W is above on the boundary of [−half, half]² × {|q| ≤ the last of ``bands``}."""
    function = model.still(Boxes.border(half, 512), time)[0].ranges()
    lowest = min(float(function.below(*pair).min()) for pair in pairwise(bands))
    function = model.still(Boxes.square(half, 64), time)[0].ranges()
    return min(lowest, float(function.below(bands[-1], bands[-1]).min()))


def _bottom(model: Model) -> float:
    """A level that is reached at a fifth of δ around the source or so, for orientation."""
    around = Boxes.circles(np.array([0.2 * model.reach]), 16)
    found = float(model.still(around, Intervals.point(0.0))[0].ranges().most[0].min())
    return found if found > 0 else math.inf
