"""Where a proof fails: a few of the boxes on which W is not shown to fall, the worst first.

Each box is one that was tried: its bound is a bound, only not a negative one. Which are shown is decided by looking
closer at the worst of them, so that there may be worse ones.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ptproof.certify.loop.boxes import Boxes
from ptproof.certify.loop.cover import Tried, tried
from ptproof.certify.loop.setup import drift_factor
from ptproof.certify.loop.stage import Place
from ptproof.problem import Problem

_SHOWN = 3
_KEPT = 256  # of the worst boxes, to be quartered
_FINEST = 1 / 8  # of δ
_APART = 1 / 20  # of the square, so that neighbours are not shown


@dataclass(frozen=True)
class Failing:
    """A box on which W is not shown to fall: for what it fails.

    Attributes
    ----------
    shape
        The V that W corrects.
    time
        Ends in t.
    position
        Ends in each coordinate of the centre of the vehicle's circle, 1/√ω from the vehicle.
    heading
        All of them: they are bounded together.
    filter
        How far F − z is from where it settles, at least and at most.
    drift_factor
        dt/dτ = 1/K, by which the drift counts in τ, at least and at most.
    level
        Ends of the level of W.
    rate
        The bound of dW/dτ there, which should be negative; None where the level is not shown to be closed instead.
    middle
        About what dW/dτ is at the box's middle, at the worst heading: no bound. A finer cover helps where it is
        negative.
    """

    shape: str
    time: tuple[float, float]
    position: tuple[tuple[float, float], ...]
    heading: tuple[float, float]
    filter: tuple[float, float]
    drift_factor: tuple[float, float]
    level: tuple[float, float]
    rate: float | None
    middle: float | None

    def to_json(self) -> dict[str, Any]:
        """As the command prints it."""
        return dict(vars(self))

    def __str__(self) -> str:
        sides = ", ".join(_range(side) for side in self.position)
        where = (
            f"t in {_range(self.time)}, circle's centre in {sides}, every heading, filter {_range(self.filter)} off, "
            f"drift factor {_range(self.drift_factor)}, W in {_range(self.level)}"
        )
        if self.rate is None:
            return f"{where}: this level is not shown to be closed"
        about = "" if self.middle is None else f" (about {self.middle:.3g} at its middle)"
        return f"{where}: dW/dtau is at most {self.rate:.3g}{about}"


def _range(ends: Sequence[float]) -> str:
    return f"[{ends[0]:.4g}, {ends[1]:.4g}]"


def failing(problem: Problem, shape: str, place: Place) -> tuple[Failing, ...]:
    """The worst boxes of a place."""
    looked = _border(place) if place.level is None else _inside(place, place.level)
    unit = float(problem.tuning.mu) * math.sqrt(float(problem.tuning.omega))
    factor = drift_factor(place.model.jets, place.start, place.end)
    source = [float(value) for value in problem.source]
    found = []
    for item in _spread(looked, _APART * place.stage.half):
        position = tuple((c + a - item.half, c + a + item.half) for c, a in zip(source, item.place, strict=True))
        found.append(
            Failing(
                shape, (place.start, place.end), position, (0.0, 2 * math.pi),
                (item.filter[0] * unit, item.filter[1] * unit), factor, item.level,
                None if place.level is None else item.rate, None if place.level is None else item.middle,
            )
        )  # fmt: skip
    return tuple(found)


def _inside(place: Place, level: float) -> list[Tried]:
    """Boxes that the band of a level touches, by the bound of the rate on it."""
    stage, levels = place.stage, place.stage.levels
    band = int(np.clip(np.searchsorted(levels.edges, level, side="right") - 1, 0, levels.bands - 1))
    boxes, last = Boxes.square(stage.half), list[Tried]()
    while len(boxes):
        found = tried(place.model, boxes, levels, stage.filter_bands, place.time, band)
        found.sort(key=lambda item: -item.rate)
        last = [item for item in found if item.rate >= 0] or last
        if boxes.half < place.model.reach * _FINEST:
            break
        boxes = Boxes(np.array([item.place for item in found[:_KEPT]]).T, boxes.half).quarters()
    return last


def _border(place: Place) -> list[Tried]:
    """Boxes on the border of the square, by the lowest level of W there."""
    stage = place.stage
    found = tried(place.model, Boxes.border(stage.half, 64), stage.levels, stage.filter_bands, place.time, None)
    return sorted(found, key=lambda item: item.level[0])


def _spread(items: Sequence[Tried], apart: float) -> list[Tried]:
    """The first few that are not next to each other."""
    found: list[Tried] = []
    for item in items:
        if all(math.dist(item.place, other.place) > apart for other in found):
            found.append(item)
        if len(found) == _SHOWN:
            break
    return found
