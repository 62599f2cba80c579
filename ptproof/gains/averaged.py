"""The averaged system simulated from many starts at one distance: what a bound is compared with, never a bound."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import sympy as sp

from ptproof.problem import Problem


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
    import numpy as np

    from ptproof.simulation import Outcome, Trajectory, simulate

    if len(problem.variables) != 2:
        return Simulated(None, (), "simulated in the plane only")
    if problem.tuning.nu_min is None:
        return Simulated(None, (), "without a clip no run reaches t0 + T")
    radius = float(distance)
    source = np.array([float(value) for value in problem.source])
    names = [symbol.name for symbol in problem.variables]
    runs = []
    for i in range(starts):
        angle = 2 * math.pi * i / starts
        start = source + radius * np.array([math.cos(angle), math.sin(angle)])
        run = simulate(problem, model="average", initial=dict(zip(names, start, strict=True)), samples=100)
        assert isinstance(run, Trajectory)
        if run.outcome is not Outcome.REACHED:
            return Simulated(None, (), f"a run of the average ended early: {run.outcome}")
        runs.append(run)
    worst = max(float(run.final_distance) for run in runs)
    step = max(1, starts // drawn)
    curves = tuple((run.t, np.hypot(run[names[0]] - source[0], run[names[1]] - source[1])) for run in runs[::step])
    return Simulated(worst, curves)
