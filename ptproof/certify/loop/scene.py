"""What is proved about, set up: W on each phase, the square, the levels, and the stretches of time with their tasks."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import sympy as sp

from ptproof.balls.arrays import Array, Intervals
from ptproof.balls.ball import ball_from
from ptproof.balls.rounding import up
from ptproof.certify.loop.boxes import Boxes
from ptproof.certify.loop.cover import guide, rates
from ptproof.certify.loop.levels import Levels, Slice, fallen
from ptproof.certify.loop.model import Model
from ptproof.certify.loop.setup import Phase, models, phases, slices
from ptproof.problem import Problem

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


ORDERS = 3, 1, 3
NEAR = 6  # radii of the circle: a bound above that and above the start's distance is none
_WEIGHT = 0.02


@dataclass(frozen=True, eq=False)
class Scene:
    """A problem made ready for a proof.

    Attributes
    ----------
    spans, prepared
        The phases of the gain, and W with its rate on each.
    stage
        Square, bands and levels.
    work
        The stretches of time, each with the model of its phase.
    typical
        About how large −(dW/dτ)/W is.
    """

    spans: tuple[Phase, ...]
    prepared: tuple[Model, ...]
    stage: Stage
    work: tuple[tuple[Model, Slice], ...]
    typical: float

    @staticmethod
    def of(problem: Problem, radius: sp.Expr, gap: sp.Expr, shape: str) -> Scene:
        """From a problem, the radius of the starts, the filter's gap and the shape of V.

        Raises :class:`NoCertificate` where the levels around the start are not closed.
        """
        spans = phases(problem)
        tuning = problem.tuning
        omega = ball_from(tuning.omega)
        reach = up(ball_from(radius) + 1 / omega.sqrt())
        filter_start = up(ball_from(gap) / (ball_from(tuning.mu) * omega.sqrt()))
        tallest, steepest = _sizes(problem, reach, shape)
        m = float(tuning.mu * tuning.omega)
        typical = float(tuning.k) / (2 * (1 + m**2)) * steepest / tallest  # of −(dW/dτ)/W
        prepared = models(problem, spans, shape, ORDERS, _WEIGHT * tallest / steepest, typical)
        stage = set_stage(prepared, spans, reach, filter_start)
        work = [(model, part) for model, span in zip(prepared, spans, strict=True) for part in slices(problem, span)]
        return Scene(spans, prepared, stage, tuple(work), typical)

    def place(self, at: int, level: float) -> Place:
        """Where a proof fails on the stretch of that number."""
        model, part = self.work[at]
        return Place(model, self.stage, part.interval, part.start, part.end, level)

    @property
    def still(self) -> bool:
        """Whether one bound of the rates serves for all stretches."""
        return len({id(model) for model, _ in self.work}) == 1 and all(part.steady for _, part in self.work)


def _sizes(problem: Problem, reach: float, shape: str) -> tuple[float, float]:
    """About how large V and ‖∇F‖² are at a distance from the source; any positive numbers would do."""
    angles = np.linspace(0, 2 * np.pi, 64, endpoint=False)
    field = sp.lambdify(problem.variables, [problem.peak - problem.field.expression, *problem.field.gradient], "numpy")
    around = (float(c) + reach * f(angles) for c, f in zip(problem.source, (np.cos, np.sin), strict=True))
    with np.errstate(all="ignore"):
        height, first, second = (np.broadcast_to(item, angles.shape) for item in field(*around))
        tallest, steepest = float(np.max(np.abs(height))), float(np.max(first**2 + second**2))
    if not (0 < tallest < math.inf and 0 < steepest < math.inf):
        raise NoCertificate("the field has no slope or no value around the start")
    return (tallest, steepest) if shape == "field" else (reach**2 / 2, reach * math.sqrt(steepest))


@dataclass(frozen=True, eq=False)
class Task:
    """The rates of one stretch of time, to be bounded apart from the others."""

    model: Model
    part: Slice
    stage: Stage
    window: tuple[float, float] = (0.0, math.inf)
    seen: Array | None = None
    slack: float = math.inf

    def expected(self) -> Array:
        """About what the rates are."""
        return guide(self.model, self.stage.levels, self.stage.half, self.part.interval)

    def bounds(self) -> Array:
        """Bounds of the rates."""
        stage, seen = self.stage, self.expected() if self.seen is None else self.seen
        return rates(
            self.model, stage.levels, stage.filter_bands, stage.half, self.part.interval, self.window, seen, self.slack
        )


def tasks(scene: Scene, slack: float) -> list[Task]:
    """One for each stretch of time, or one alone, sharp about the levels at which W is expected there."""
    stage, work = scene.stage, scene.work
    if scene.still:
        task = Task(*work[0], stage, slack=slack)
        seen = task.expected()
        rest = hover(stage.levels, seen + 2 * slack * stage.levels.edges[1:], stage.start)
        return [replace(task, seen=seen, window=(rest or 0.0, 1.05 * stage.start))]
    level, passed, found = stage.start, 0.0, []
    for at, (model, part) in enumerate(work):
        task = Task(model, part, stage, slack=slack)
        seen = task.expected()
        after = min(fallen(level, seen, stage.levels, part.shortest, part.longest), float(stage.levels.edges[-1]))
        passed += min(part.longest, 1e6)
        if part.steady:
            after = max(after, hover(stage.levels, seen + 2 * slack * stage.levels.edges[1:], level) or 0.0)
        worse = math.exp(min(slack * passed, 5.0))
        found.append(replace(task, seen=seen, window=(0.8 * min(level, after), 1.1 * worse * max(level, after))))
        if not after < stage.levels.edges[-1]:
            raise NoCertificate(
                f"nothing keeps W from leaving its largest level at t = {part.end:.4g}: a larger omega, a smaller "
                "start or a weaker drift would help",
                scene.place(at, level),
            )
        level = after
    return found


def held(levels: Levels, found: Array, level: float) -> bool:
    """Whether W is kept from rising at a level: it falls in the band below or above."""
    at = int(np.searchsorted(levels.edges, level, side="left"))
    return bool((found[max(at - 1, 0) : at + 1] < 0).any())


def hover(levels: Levels, found: Array, level: float) -> float | None:
    """The level to which W falls from ``level`` in the end if a stretch goes on; None where it does not fall."""
    falling = found < 0
    band = min(int(np.searchsorted(levels.edges, level, side="left")) - 1, levels.bands - 1)
    if band < 0 or not falling[band]:
        return None
    while band > 0 and falling[band - 1]:
        band -= 1
    return float(levels.edges[band])


def no_long_run(scene: Scene) -> str:
    """Why there is no distance for the long run, for the end of a sentence; empty where there is one."""
    if math.isinf(scene.work[-1][1].longest):
        return "; nothing is said of a long run, since the gain is infinite at T, where this bound ends"
    if not scene.work[-1][1].steady:
        return "; nothing is said of a long run, since the drift changes with time or the gain grows until T"
    return ""


def reached_distance(scene: Scene, level: float, shape: str) -> float:
    """About how far the vehicle is where W is at a level: as if W were V, and V quadratic."""
    start = scene.stage.half / 1.25
    away = math.sqrt(2 * level) if shape == "distance" else start * math.sqrt(level / scene.stage.start)
    return away + scene.prepared[0].reach
