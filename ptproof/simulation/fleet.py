"""Many vehicles side by side with their whole way: for pictures over a certificate, and to attack one.

Ensembles keep where vehicles end; here the largest distance in between counts as well. The averaged system, simulated
from many starts at one distance, is what a bound is compared with, and never a bound.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import sympy as sp

from ptproof.problem import Problem
from ptproof.problem.smooth import roughness
from ptproof.simulation.plan import Array
from ptproof.simulation.question import Question
from ptproof.simulation.run import prepared, simulate
from ptproof.simulation.settings import Outcome, Settings

RTOL = 1e-7
UNCLIPPED_END = 0.1
"""The ν up to which a vehicle is followed whose gain is infinite at the end."""
_AGAIN = 8  # vehicles that are run again, to see the error
_SHARPER = 1e-3


@dataclass(frozen=True, eq=False)
class Fleet:
    """Distances from the source at times t (vehicles × times); NaN from where on a vehicle could not be followed.

    Attributes
    ----------
    error
        The largest change of a distance when the first vehicles are run again with tolerances a thousand times
        smaller: about how exact the distances are.
    engine
        What integrated them.
    """

    times: Array
    distances: Array
    error: float
    engine: str


def fleet(
    problem: Problem, size: int, *, radius: float, filter_gap: float = 0.0, seed: int | tuple[int, ...] = 0,
    samples: int = 400, workers: int | None = None, rtol: float = RTOL,
) -> Fleet:  # fmt: skip
    """``size`` vehicles of the prescribed-time seeker, started within ``radius`` of the source with any heading.

    Half of them start at that distance exactly, and a third with their filter as far from the field as ``filter_gap``
    allows. They are integrated in τ, with error control, by the engine that fits an ensemble. Where the gain is not
    clipped they are followed to ν = 0.1.

    Parameters
    ----------
    samples
        About how many times the distance is taken, evenly in τ.
    workers
        Threads (left out: one per processor); they don't change the numbers.
    rtol
        The relative error asked for.
    """
    question = Question(problem, "pt", "tau", nu_end=None if problem.tuning.nu_min is not None else UNCLIPPED_END)
    settings = Settings(rtol=rtol, samples=samples)
    threads = workers or os.cpu_count() or 1
    start = starts(problem, size, radius, filter_gap, seed)
    found, times, engine = _distances(question, settings, start, threads)
    few = {name: values[:_AGAIN] for name, values in start.items()}
    sharp, _, _ = _distances(question, replace(settings, rtol=max(rtol * _SHARPER, 1e-14)), few, threads)
    change = np.abs(sharp - found[:_AGAIN])
    return Fleet(times, found, float(np.max(change, initial=0.0, where=np.isfinite(change))), engine)


def _distances(
    question: Question, settings: Settings, start: dict[str, Array], workers: int
) -> tuple[Array, Array, str]:
    """Distances (vehicles × times), times in t, and the engine."""
    setup, size = question.setup(), len(next(iter(start.values())))
    job = prepared(question, settings, setup, size, start)
    ways = job.way(workers)
    assert setup.to_t is not None
    return job.plan.distance(ways.x), setup.to_t(ways.time, setup.defaults), job.engine


def starts(problem: Problem, size: int, radius: float, gap: float, seed: int | tuple[int, ...]) -> dict[str, Array]:
    """Random positions, headings and filter states by name (N each)."""
    draw, names = np.random.default_rng(seed), problem.states
    far = radius * np.where(np.arange(size) % 2, 1.0, np.sqrt(draw.random(size)))
    angle, heading = (draw.random(size) * 2 * np.pi for _ in range(2))
    field = sp.lambdify(problem.variables, problem.field.expression, "numpy")
    position = [float(c) + far * f(angle) for c, f in zip(problem.source, (np.cos, np.sin), strict=True)]
    off = np.clip(1.5 * (2 * draw.random(size) - 1), -1, 1)
    found = {symbol.name: value for symbol, value in zip(problem.variables, position, strict=True)}
    return found | {names.heading.name: heading, names.filter.name: field(*position) + gap * off}


_RTOL = 1e-11  # where a bound is attained exactly, a coarser run would seem to violate it
_ATOL = 1e-18


@dataclass(frozen=True)
class Simulated:
    """The worst distance at t₀ + T over the starts, None with the reason where it was not simulated.

    ``curves`` are pairs (t, distance) for a few of the starts.
    """

    worst: float | None
    curves: tuple[Any, ...] = ()
    why: str = ""


def worst_distance(problem: Problem, distance: sp.Expr, *, starts: int = 64, drawn: int = 8) -> Simulated:
    """Simulate the average from ``starts`` points at ``distance`` from the source, evenly spread over the circle."""
    if problem.tuning.nu_min is None:
        return Simulated(None, (), "without a clip no run reaches t0 + T")
    if (n := problem.field.dimension) != 2:
        return Simulated(None, (), f"the seeker moves in the plane, but the field has {n} variable{'s' * (n > 1)}")
    if (reason := roughness(problem.field.expression, problem.variables, 2)) is not None:
        return Simulated(None, (), f"there is no average to simulate: {reason}")
    source = np.array([float(value) for value in problem.source])
    names = [symbol.name for symbol in problem.variables]
    runs = []
    for angle in 2 * np.pi * np.arange(starts) / starts:
        point = source + float(distance) * np.array([np.cos(angle), np.sin(angle)])
        start = dict(zip(names, point, strict=True))
        run = simulate(problem, model="average", initial=start, samples=100, rtol=_RTOL, atol=_ATOL)
        if run.outcome is not Outcome.REACHED:
            return Simulated(None, (), f"a run of the average ended early: {run.outcome}")
        away = np.hypot(*(run[name] - centre for name, centre in zip(names, source, strict=True)))
        runs.append((run.t, away))
    worst = max(float(away[-1]) for _, away in runs)
    curves = tuple(runs[:: max(1, len(runs) // drawn)])
    if worst <= _ATOL:  # beside a bound it would be the integrator's noise that is compared
        return Simulated(None, curves, f"every run ended within {_ATOL:g} of the source, closer than a run can tell")
    return Simulated(worst, curves)
