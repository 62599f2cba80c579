"""Guarantees for the vehicle in closed loop: a bound of its distance for every start, heading and filter state.

Theorem. Let F and the drift be smooth where they are enclosed, and let the seeker be the prescribed-time one with the
gain K(t), clipped or not. Let W(y, s, q, τ) be any polynomial in the letters of :mod:`ptproof.certify.loop.flow`,
c₀ < … < c_n levels, and B = [−h, h]², Q > 0 such that W > c_n on the boundary of B × {|q| ≤ Q}. On a stretch of time
let dW/dτ ≤ R_j wherever y ∈ B, |q| ≤ Q and W ∈ [c_j, c_(j+1)]. If a vehicle starts with y ∈ B, |q| ≤ Q and
W ≤ w₀ ≤ c_n, and the solution w of the comparison (:func:`ptproof.certify.loop.levels.fallen`) stays below c_n, then it
exists on the whole stretch and W ≤ w. Its distance from the source is at most δ + max{|y| : y ∈ B, W(y, ·) ≤ w}.

Proof. As long as (y, q) stays inside, W ≤ w by comparison; W < c_n keeps it from the boundary; F and the drift are
smooth on a neighbourhood of B, so a solution that stays in a compact set exists. And x − x* = y + δn, |n| = 1. ∎

W is a corrected V (:mod:`ptproof.certify.loop.flow`), but nothing rests on where it came from. The hypotheses are
checked in ball arithmetic on covers of B, for all headings and all |q| ≤ Q.
"""

from __future__ import annotations

import os
import time as clock
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeAlias

import numpy as np
import sympy as sp

from ptproof.balls.arithmetic import Undefined
from ptproof.balls.arrays import Array
from ptproof.balls.ball import ball_from, precision
from ptproof.balls.rounding import at_most, up
from ptproof.certify.loop.certificate import LoopCertificate
from ptproof.certify.loop.cover import farthest
from ptproof.certify.loop.failing import Advice, Failing, advice, failing
from ptproof.certify.loop.levels import fallen
from ptproof.certify.loop.model import Model
from ptproof.certify.loop.scene import (
    NEAR,
    ORDERS,
    NoCertificate,
    Place,
    Scene,
    Stage,
    Task,
    held,
    hover,
    no_long_run,
    tasks,
)
from ptproof.certify.loop.setup import Phase, Unfit
from ptproof.errors import InputError
from ptproof.problem import Problem
from ptproof.problem.model import number
from ptproof.proof.verdict import Verdict

_PRECISION = 128
_CLOSE = 0.005
_ROUNDING = 1e-9  # covers that times are shown as floats
SHAPES = "distance", "field"
_NAMES = {"distance": "half the squared distance", "field": "the field below its peak"}


# Times, distances, the distance in the long run where there is one, and how it was proved.
_Curve: TypeAlias = tuple[tuple[float, ...], tuple[float, ...], float | None, str]


def certify_loop(
    problem: Problem, radius: Any = None, *, filter_gap: Any = 0, tolerance: float = 0.12, workers: int | None = None,
    client: Any = None, shapes: Sequence[str] | None = None, explain: bool = False,
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
        Threads (left out: one per processor), or a ``distributed.Client``; neither changes the result.
    explain
        Whether to look for the boxes that fail and for what would help where nothing is proved.

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
    size, gap = _sizes(problem, radius, filter_gap)
    reasons, places, tuning = [], dict[str, Place | None](), problem.tuning
    found: _Curve | None = None
    own = SHAPES if problem.drift.matrix is None else SHAPES[::-1]  # along a slope a level set of F falls about evenly
    for shape in own if shapes is None else shapes:
        try:
            with precision(_PRECISION):
                found = _curve(problem, size, gap, shape, tolerance, workers, client)
            break
        except (NoCertificate, Unfit, Undefined) as error:
            reasons.append(f"with V {_NAMES[shape]}: {error}")
            places[shape] = error.place if isinstance(error, NoCertificate) else None
    times, distances, resting, detail = ((), (), None, "; ".join(reasons)) if found is None else found
    boxes, help_ = _explained(problem, size, gap, places) if explain and found is None else ((), None)
    return LoopCertificate(
        Verdict.UNDECIDED if found is None else Verdict.PROVED, float(tuning.omega), float(tuning.mu), float(size),
        float(gap), times, distances, resting, detail, clock.perf_counter() - begin, boxes, help_,
    )  # fmt: skip


def _explained(
    problem: Problem, radius: sp.Expr, gap: sp.Expr, places: Mapping[str, Place | None]
) -> tuple[tuple[Failing, ...], Advice | None]:
    """The boxes that fail, and what would help where any of the shapes can be tried at all."""
    with precision(_PRECISION):
        boxes = [box for shape, place in places.items() if place for box in failing(problem, shape, place)]
        tried = next((shape for shape, place in places.items() if place), None)
        return tuple(boxes), None if tried is None else advice(problem, radius, gap, tried)


def _sizes(problem: Problem, radius: Any, filter_gap: Any) -> tuple[sp.Expr, sp.Expr]:
    """The radius and the gap as exact numbers; neither is negative."""
    size = start_distance(problem) if radius is None else number(sp.sympify(radius), "radius")
    gap = number(sp.sympify(filter_gap), "filter_gap")
    for where, value in (("radius", size), ("filter_gap", gap)):
        if not value >= 0:
            raise InputError(f"{where}: must not be negative, got {value}")
    return size, gap


def start_distance(problem: Problem) -> sp.Expr:
    """|x(t₀) − x*|."""
    squares = [(a - b) ** 2 for a, b in zip(problem.initial.x, problem.source, strict=True)]
    return sp.sqrt(sum(squares))


def _curve(
    problem: Problem, radius: sp.Expr, gap: sp.Expr, shape: str, tolerance: float, workers: int | None, client: Any
) -> _Curve:
    scene = Scene.of(problem, radius, gap, shape)
    prepared, stage, work = scene.prepared, scene.stage, scene.work
    bounds = _all_rates(scene, tolerance * scene.typical, workers, client)
    times, reached = _levels(scene, bounds)
    level, endless = reached[-1], no_long_run(scene)
    if level > stage.start and not held(stage.levels, bounds[-1], level):
        raise NoCertificate(
            "no level of W is shown to decrease at the end: a larger omega or a smaller start would help",
            scene.place(-1, level),
        )
    hover_level = None if endless else hover(stage.levels, bounds[-1], level)
    counts = [len(part.parts) or 1 for _, part in work]
    holding = [model for (model, _), count in zip(work, counts, strict=True) for _ in range(count)]
    phased = list(zip(prepared, scene.spans, strict=True))
    distances, last = _distances(phased, holding, stage, reached, hover_level)
    near = max(up(ball_from(radius)), NEAR * prepared[0].reach)
    if distances[-1] > near:
        raise NoCertificate(
            f"the vehicle is shown to stay within {at_most(max(distances))}, but not to come "
            f"closer than {at_most(near)}: a larger omega, k or T would help",
            scene.place(-1, level),
        )
    detail = (
        f"V is {_NAMES[shape]}, corrected to order {ORDERS[0]} in 1/sqrt(omega); rates proved on {stage.levels.bands} "
        f"bands of levels, all headings and filter states, over {len(work)} stretches of time{endless}"
    )
    return times, distances, last, detail


def _levels(scene: Scene, bounds: Sequence[Array]) -> tuple[tuple[float, ...], list[float]]:
    """The times at the ends of the stretches, and levels that W is not above there."""
    work, stage = scene.work, scene.stage
    times, reached = [work[0][1].start], [stage.start]
    for at, ((_, part), found) in enumerate(zip(work, bounds, strict=True)):
        for piece in part.parts or (part,):
            level = fallen(reached[-1], found, stage.levels, piece.shortest, piece.longest)
            if not level < stage.levels.edges[-1]:
                raise NoCertificate(
                    f"W is not shown to stay below {stage.levels.edges[-1]:.4g} at t = {piece.end:.4g}: "
                    "a larger omega or a smaller start would help, or a weaker drift",
                    scene.place(at, reached[-1]),
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


def _all_rates(scene: Scene, slack: float, workers: int | None, client: Any) -> list[Array]:
    """Bounds of the rates on all stretches of time."""
    asked = tasks(scene, slack)
    if scene.still:
        return [asked[0].bounds()] * len(scene.work)
    if client is not None:
        return list(client.gather(client.map(_elsewhere, asked, pure=False)))
    with ThreadPoolExecutor(workers or os.cpu_count() or 1) as pool:
        return list(pool.map(Task.bounds, asked))


def _elsewhere(task: Task) -> Array:
    """The rates of a stretch in another process, in the precision of this one; a function that a cluster can call."""
    with precision(_PRECISION):
        return task.bounds()
