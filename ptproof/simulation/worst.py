"""The averaged system simulated from many starts at one distance: what a bound is compared with, never a bound."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import sympy as sp

from ptproof.problem import Problem
from ptproof.problem.model import TIME
from ptproof.system import System

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


def averaged_system(problem: Problem) -> System:
    """dx̄/dt = f + K(k/2)∇F in any dimension, with the clipped gain K of the problem (eq:LBA_reduced_model_t, eq:kt)."""
    tuning = problem.tuning
    nu = 1 - (TIME - tuning.t0) / tuning.T
    gain = 1 / (nu if tuning.nu_min is None else sp.Max(tuning.nu_min, nu)) ** 2
    rhs = tuple(f + gain * tuning.k / 2 * g for f, g in zip(problem.drift.rate, problem.field.gradient, strict=True))
    return System(TIME, problem.variables, rhs, name=f"average of {problem.name}")


def worst_distance(problem: Problem, distance: sp.Expr, *, starts: int = 64, drawn: int = 8) -> Simulated:
    """Simulate the average from up to ``starts`` points at ``distance`` from the source, evenly spread."""
    import numpy as np

    from ptproof.simulation import Outcome, Trajectory, simulate

    if problem.tuning.nu_min is None:
        return Simulated(None, (), "without a clip no run reaches t0 + T")
    n = len(problem.variables)
    if n > 3:
        return Simulated(None, (), "simulated in up to three dimensions only")
    source = np.array([float(value) for value in problem.source])
    names = [symbol.name for symbol in problem.variables]
    tuning = problem.tuning
    runs = []
    for direction in _directions(n, starts):
        start = dict(zip(names, source + float(distance) * np.array(direction), strict=True))
        if n == 2:  # the average that averaging itself derives
            run = simulate(problem, model="average", initial=start, samples=100, rtol=_RTOL, atol=_ATOL)
        else:
            span = (tuning.t0, tuning.t0 + tuning.T)
            run = simulate(averaged_system(problem), initial=start, span=span, samples=100, rtol=_RTOL, atol=_ATOL)
        assert isinstance(run, Trajectory)
        if run.outcome is not Outcome.REACHED:
            return Simulated(None, (), f"a run of the average ended early: {run.outcome}")
        away = np.sqrt(sum((run[name] - centre) ** 2 for name, centre in zip(names, source, strict=True)))
        runs.append((run.t, away))
    worst = max(float(away[-1]) for _, away in runs)
    return Simulated(worst, tuple(runs[:: max(1, len(runs) // drawn)]))


def _directions(n: int, count: int) -> list[tuple[float, ...]]:
    """Unit vectors spread evenly: both of the line, over the circle, or along a spiral on the sphere."""
    if n == 1:
        return [(1.0,), (-1.0,)]
    if n == 2:
        return [(math.cos(2 * math.pi * i / count), math.sin(2 * math.pi * i / count)) for i in range(count)]
    golden = math.pi * (3 - math.sqrt(5))
    heights = [1 - (2 * i + 1) / count for i in range(count)]
    return [
        (math.sqrt(1 - h * h) * math.cos(golden * i), math.sqrt(1 - h * h) * math.sin(golden * i), h)
        for i, h in enumerate(heights)
    ]
