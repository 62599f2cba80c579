"""Guarantees for the vehicle in closed loop: a bound of its distance for every start, heading and filter state.

Theorem. Let F and the drift be smooth where they are enclosed, and let the seeker be the prescribed-time one with the
gain K(t), clipped or not. Let W(y, s, q, τ) be any polynomial in the letters of :mod:`ptproof.certify.loop.flow`,
c₀ < … < c_n levels, and B = [−h, h]², Q > 0 such that W > c_n on the boundary of B × {|q| ≤ Q}. On a stretch of time
let dW/dτ ≤ R_j wherever y ∈ B, |q| ≤ Q and W ∈ [c_j, c_(j+1)]. If a vehicle starts with y ∈ B, |q| ≤ Q and
W ≤ w₀ ≤ c_n, and the solution w of the comparison (:func:`ptproof.certify.loop.levels.fallen`) stays below c_n, then it
exists on the whole stretch and W ≤ w. Its distance from the source is at most δ + max{|y| : y ∈ B, W(y, ·) ≤ w}.

Proof. As long as (y, q) stays inside, W ≤ w by comparison; W < c_n keeps it from the boundary; F and the drift are
smooth on a neighbourhood of B, so a solution that stays in a compact set exists. And x − x* = y + δn, |n| = 1. ∎

W is a corrected V (:mod:`ptproof.certify.loop.lyapunov`), but nothing rests on where it came from. The hypotheses are
checked in ball arithmetic on covers of B, for all headings and all |q| ≤ Q.
"""

from __future__ import annotations

import math
import os
import time as clock
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

import numpy as np
import sympy as sp

from ptproof.balls.arithmetic import Undefined
from ptproof.balls.arrays import Array
from ptproof.balls.ball import ball_from, precision
from ptproof.balls.rounding import up
from ptproof.certify.loop.certificate import LoopCertificate
from ptproof.certify.loop.cover import farthest, guide, rates
from ptproof.certify.loop.levels import Levels, Slice, fallen
from ptproof.certify.loop.model import Model
from ptproof.certify.loop.setup import Phase, Unfit, models, phases, slices
from ptproof.certify.loop.stage import NoCertificate, Stage, set_stage
from ptproof.errors import InputError
from ptproof.problem import Problem
from ptproof.problem.model import number
from ptproof.proof.verdict import Verdict

_ORDERS = 3, 1, 3
_NEAR = 6  # radii of the circle: a bound above that and above the start's distance is none
_CLOSE = 0.005
_ROUNDING = 1e-9  # covers that times are shown as floats
_WEIGHT = 0.02
SHAPES = "distance", "field"
_NAMES = {"distance": "half the squared distance", "field": "the field below its peak"}


# Times, distances, the distance in the long run where there is one, and how it was proved.
_Curve: TypeAlias = tuple[tuple[float, ...], tuple[float, ...], float | None, str]


def certify_loop(
    problem: Problem, radius: Any = None, *, filter_gap: Any = 0, tolerance: float = 0.12, workers: int | None = None,
    client: Any = None, shapes: Sequence[str] | None = None,
) -> LoopCertificate:  # fmt: skip
    """Bound the distance of the prescribed-time seeker from the source over [t₀, t₀ + T], whatever its heading.

    Parameters
    ----------
    problem
        With its own ω, μ, k, T, clip, clock, field and drift.
    radius
        |x(t₀) − x*| is at most this, an exact number; that of the problem's start if left out.
    filter_gap
        |F(x(t₀)) − z(t₀)| is at most this.
    tolerance
        How much of a rate may be given away to save time.
    shapes
        What V is tried: half the squared distance from the source, F(x*) − F; the first that leads to a proof counts.
        Left out: both, F(x*) − F first where the drift goes along the field's slope.
    workers, client
        Threads (left out: one per processor), or a ``distributed.Client``.

    Returns
    -------
    LoopCertificate
        ``proved`` with its curve, or ``undecided`` with the reason.

    Raises
    ------
    InputError
        For bad input, such as a negative radius or a field that is not smooth.

    Examples
    --------
    >>> import ptproof
    >>> found = certify_loop(ptproof.example("saturated"), tolerance=0.5)
    >>> str(found.verdict), found.final < 0.7
    ('proved', True)
    """
    begin = clock.perf_counter()
    size = start_distance(problem) if radius is None else number(sp.sympify(radius), "radius")
    gap = number(sp.sympify(filter_gap), "filter_gap")
    for where, value in (("radius", size), ("filter_gap", gap)):
        if not value >= 0:
            raise InputError(f"{where}: must not be negative, got {value}")
    reasons, tuning = [], problem.tuning
    found: _Curve | None = None
    for shape in _shapes(problem) if shapes is None else shapes:
        try:
            with precision(128):
                found = _curve(problem, size, gap, shape, tolerance, workers, client)
            break
        except (NoCertificate, Unfit, Undefined) as error:
            reasons.append(f"with V {_NAMES[shape]}: {error}")
    verdict = Verdict.UNDECIDED if found is None else Verdict.PROVED
    times, distances, hover, detail = ((), (), None, "; ".join(reasons)) if found is None else found
    return LoopCertificate(
        verdict, float(tuning.omega), float(tuning.mu), float(size), float(gap), times, distances, hover, detail,
        clock.perf_counter() - begin,
    )  # fmt: skip


def _shapes(problem: Problem) -> tuple[str, ...]:
    """In the order in which they are tried. Along a slope all of a level set of F falls about equally fast."""
    return SHAPES if problem.drift.matrix is None else SHAPES[::-1]


def start_distance(problem: Problem) -> sp.Expr:
    """|x(t₀) − x*|."""
    squares = [(a - b) ** 2 for a, b in zip(problem.initial.x, problem.source, strict=True)]
    return sp.sqrt(sum(squares))


def _curve(
    problem: Problem, radius: sp.Expr, gap: sp.Expr, shape: str, tolerance: float, workers: int | None, client: Any
) -> _Curve:
    spans = phases(problem)
    tuning = problem.tuning
    omega = ball_from(tuning.omega)
    reach = up(ball_from(radius) + 1 / omega.sqrt())
    filter_start = up(ball_from(gap) / (ball_from(tuning.mu) * omega.sqrt()))
    tallest, steepest = _sizes(problem, reach, shape)
    m = float(tuning.mu * tuning.omega)
    typical = float(tuning.k) / (2 * (1 + m**2)) * steepest / tallest  # of −(dW/dτ)/W
    prepared = models(problem, spans, shape, _ORDERS, _WEIGHT * tallest / steepest, typical)
    stage = set_stage(prepared, spans, reach, filter_start)
    work = [(model, part) for model, span in zip(prepared, spans, strict=True) for part in slices(problem, span)]
    bounds = _all_rates(stage, work, tolerance * typical, workers, client)
    times, reached = _levels(stage, work, bounds)
    level, steady = reached[-1], work[-1][1].steady
    if level > stage.start and not _held(stage.levels, bounds[-1], level):
        raise NoCertificate(
            "no level of W is shown to decrease at the end: a larger omega or a smaller start would help"
        )
    hover_level = _hover(stage.levels, bounds[-1], level) if steady else None
    counts = [len(part.parts) or 1 for _, part in work]
    held = [model for (model, _), count in zip(work, counts, strict=True) for _ in range(count)]
    distances, hover = _distances(list(zip(prepared, spans, strict=True)), held, stage, reached, hover_level)
    near = max(up(ball_from(radius)), _NEAR * prepared[0].reach)
    if distances[-1] > near:
        raise NoCertificate(
            f"the vehicle is shown to stay within {max(distances):.4g}, but not to come "
            f"closer than {near:.4g}: a larger omega, k or T would help"
        )
    detail = (
        f"V is {_NAMES[shape]}, corrected to order {_ORDERS[0]} in 1/sqrt(omega); rates proved on {stage.levels.bands} "
        f"bands of levels, all headings and filter states, over {len(work)} stretches of time"
    )
    return times, distances, hover, detail


def _levels(
    stage: Stage, work: Sequence[tuple[Model, Slice]], bounds: Sequence[Array]
) -> tuple[tuple[float, ...], list[float]]:
    """The times at the ends of the stretches, and levels that W is not above there."""
    times, reached = [work[0][1].start], [stage.start]
    for (_, part), found in zip(work, bounds, strict=True):
        for piece in part.parts or (part,):
            level = fallen(reached[-1], found, stage.levels, piece.shortest, piece.longest)
            if not level < stage.levels.edges[-1]:
                raise NoCertificate(
                    f"W is not shown to stay below {stage.levels.edges[-1]:.4g} at t = {piece.end:.4g}: "
                    "a larger omega or a smaller start would help, or a weaker drift"
                )
            times.append(piece.end)
            reached.append(level)
    return tuple(times), reached


def _distances(
    phased: Sequence[tuple[Model, Phase]], held: Sequence[Model], stage: Stage, reached: Sequence[float],
    hover: float | None,
) -> tuple[tuple[float, ...], float | None]:  # fmt: skip
    """|x − x*| where W is not above the levels reached, and at the one that is left in the end.

    ``held`` says which model holds on each stretch between two of the levels. A level at which two phases meet counts
    in both. Where two phases have one model, nothing in it depends on time.
    """
    found: Array = np.zeros(len(reached))
    last: float | None = None
    for model, span in {id(model): (model, span) for model, span in phased}.values():
        touched = [i for i, one in enumerate(held) if one is model]
        at = sorted({*touched, *(i + 1 for i in touched)})
        final = hover if model is phased[-1][0] else None
        asked = np.array(sorted({*(reached[i] for i in at), *([] if final is None else [final])}))
        away = farthest(model, asked, stage.filter_bands, stage.half, span.interval(), _CLOSE)
        away = (away + model.reach) * (1 + _ROUNDING)
        found[at] = np.maximum(found[at], away[np.searchsorted(asked, [reached[i] for i in at])])
        last = None if final is None else float(away[np.searchsorted(asked, final)])
    return tuple(found.tolist()), last


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
class _Task:
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


def _all_rates(
    stage: Stage, work: Sequence[tuple[Model, Slice]], slack: float, workers: int | None, client: Any
) -> list[Array]:
    """Bounds of the rates on all stretches, sharp about the levels at which W is expected there."""
    if len({id(model) for model, _ in work}) == 1 and all(part.steady for _, part in work):
        task = _Task(*work[0], stage, slack=slack)
        seen = task.expected()
        rest = _hover(stage.levels, seen + 2 * slack * stage.levels.edges[1:], stage.start)
        return [replace(task, seen=seen, window=(rest or 0.0, 1.05 * stage.start)).bounds()] * len(work)
    level, passed, tasks = stage.start, 0.0, []
    for model, part in work:
        task = _Task(model, part, stage, slack=slack)
        seen = task.expected()
        after = min(fallen(level, seen, stage.levels, part.shortest, part.longest), float(stage.levels.edges[-1]))
        passed += min(part.longest, 1e6)
        if part.steady:
            after = max(after, _hover(stage.levels, seen + 2 * slack * stage.levels.edges[1:], level) or 0.0)
        worse = math.exp(min(slack * passed, 5.0))
        tasks.append(replace(task, seen=seen, window=(0.8 * min(level, after), 1.1 * worse * max(level, after))))
        if not after < stage.levels.edges[-1]:
            raise NoCertificate(
                f"nothing keeps W from leaving its largest level at t = {part.end:.4g}: a larger omega, a smaller "
                "start or a weaker drift would help"
            )
        level = after
    if client is not None:
        return list(client.gather(client.map(_Task.bounds, tasks, pure=False)))
    with ThreadPoolExecutor(workers or os.cpu_count() or 1) as pool:
        return list(pool.map(_Task.bounds, tasks))


def _held(levels: Levels, found: Array, level: float) -> bool:
    """Whether W is kept from rising at a level: it falls in the band below or above."""
    at = int(np.searchsorted(levels.edges, level, side="left"))
    return bool((found[max(at - 1, 0) : at + 1] < 0).any())


def _hover(levels: Levels, found: Array, level: float) -> float | None:
    """The level to which W falls from ``level`` in the end if a stretch goes on; None where it does not fall."""
    falling = found < 0
    band = min(int(np.searchsorted(levels.edges, level, side="left")) - 1, levels.bands - 1)
    if band < 0 or not falling[band]:
        return None
    while band > 0 and falling[band - 1]:
        band -= 1
    return float(levels.edges[band])
