"""The averaged system simulated from many starts at one distance: what a bound is compared with, never a bound."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sp

from ptproof.problem import Problem
from ptproof.problem.smooth import roughness
from ptproof.simulation.run import simulate
from ptproof.simulation.settings import Outcome

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
