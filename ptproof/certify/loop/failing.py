"""Where a proof fails, and what would help: a smaller start, a larger ω, by points and never proved.

Where it fails is told by a few of the boxes on which W is not shown to fall, the worst first.
Each box is one that was tried: its bound is a bound, only not a negative one. Which are shown is decided by looking
closer at the worst of them, so that there may be worse ones.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import sympy as sp

from ptproof.balls.arithmetic import Undefined
from ptproof.balls.ball import ball_from
from ptproof.balls.rounding import up
from ptproof.certify.loop.boxes import Boxes
from ptproof.certify.loop.cover import Tried, tried
from ptproof.certify.loop.levels import fallen
from ptproof.certify.loop.scene import NEAR, NoCertificate, Place, Scene, Task, held, reached_distance
from ptproof.certify.loop.setup import Unfit, drift_factor
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


_LARGER, _SMALLER = (4, 16, 64), (2, 4, 16)
_GUIDED = 6  # stretches of time at which the rates are looked at
_MARGIN = 0.25  # of a typical rate, given away


@dataclass(frozen=True)
class Advice:
    """What would probably be proved, from rates at points: no promise.

    Attributes
    ----------
    omega, mu
        A larger ω, with μ such that μω stays what it is; None where none of those that were tried helps.
    radius
        A smaller radius of the starts, at the problem's own ω; None likewise.
    """

    omega: float | None
    mu: float | None
    radius: float | None

    def to_json(self) -> dict[str, Any]:
        """As the command prints it."""
        return dict(vars(self))

    def __str__(self) -> str:
        if self.omega is None and self.radius is None:
            return (
                f"at points, neither an omega {max(_LARGER)} times as large nor a start within 1/{max(_SMALLER)} "
                "of the radius helps: the drift may win, there may be another maximum within reach, or mu*omega be too "
                "large"
            )
        found = []
        if self.omega is not None:
            found.append(f"omega = {self.omega:.6g} with mu = {self.mu:.4g}")
        if self.radius is not None:
            found.append(f"a start within {self.radius:.4g}")
        return f"what would probably be proved, from points: {', or '.join(found)}"


def advice(problem: Problem, radius: sp.Expr, gap: sp.Expr, shape: str) -> Advice:
    """Look for a larger ω and for a smaller start among a few."""

    def at(factor: int) -> Problem:
        tuning = problem.tuning
        return replace(problem, tuning=replace(tuning, omega=tuning.omega * factor, mu=tuning.mu / factor))

    larger = next((n for n in _LARGER if promising(at(n), radius, gap, shape)), None)
    smaller = next((n for n in _SMALLER if radius and promising(problem, radius / n, gap, shape)), None)
    if larger == 4 and promising(at(2), radius, gap, shape):
        larger = 2
    tuning = None if larger is None else at(larger).tuning
    return Advice(
        None if tuning is None else float(tuning.omega), None if tuning is None else float(tuning.mu),
        None if smaller is None else float(radius / smaller),
    )  # fmt: skip


def promising(problem: Problem, radius: sp.Expr, gap: sp.Expr, shape: str) -> bool:
    """Whether a proof is to be expected: the comparison with rates at points and a few times, with a margin."""
    try:
        scene = Scene.of(problem, radius, gap, shape)
    except (NoCertificate, Unfit, Undefined):
        return False
    stage, step, seen, level = scene.stage, max(1, math.ceil(len(scene.work) / _GUIDED)), None, scene.stage.start
    slack = _MARGIN * scene.typical * stage.levels.edges[1:]
    for at, part in enumerate(scene.work):
        if seen is None or at % step == 0 or at == len(scene.work) - 1:
            seen = Task(*part, stage).expected() + slack
        level = fallen(level, seen, stage.levels, part[1].shortest, part[1].longest)
        if not level < stage.levels.edges[-1]:
            return False
    assert seen is not None
    if level > stage.start and not held(stage.levels, seen, level):
        return False
    near = max(up(ball_from(radius)), NEAR * scene.prepared[0].reach)
    return reached_distance(scene, level, shape) <= near
