"""SciPy's integrators as peers: independent codes from the same expressions, on one thread."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import sympy as sp

from ptproof.errors import InputError
from ptproof.simulation.plan import Batch, Engine, Plan, Run, Samples
from ptproof.simulation.settings import Budget, Limit
from ptproof.system import System

_EXTRA = {"sign": lambda value: math.copysign(1.0, value) if value else 0.0}


@lru_cache(maxsize=64)
def lambdified(system: System) -> Callable[..., Any]:
    """The right-hand side as a Python function f(time, x, p) of floats."""
    if system.undefined_functions:
        raise InputError(f"{system.name}: has undefined functions; put expressions in for them before simulating")
    parameters = system.parameters or ()
    return sp.lambdify([system.time, system.state, parameters], list(system.rhs), modules=[_EXTRA, "math"], cse=True)


class _Stopped(Exception):
    def __init__(self, limit: Limit, time: float) -> None:
        self.limit, self.time = limit, time


@dataclass(frozen=True)
class SciPy(Engine):
    """``solve_ivp`` with one of its methods."""

    method: str

    def trajectory(self, plan: Plan, member: Batch) -> Run:
        """One run with samples; four calls of the right-hand side count as a step."""
        from scipy.integrate import solve_ivp

        settings = plan.settings
        function, values = lambdified(plan.system), member.parameters[:, 0].tolist()
        budget, calls = Budget(settings), 0

        def rhs(time: float, x: Any) -> Any:
            nonlocal calls
            calls += 1
            if calls % 256 == 0:
                budget.steps -= 64
                if limit := budget.spent:
                    raise _Stopped(limit, time)
            try:
                return function(time, x.tolist(), values)
            except (OverflowError, ZeroDivisionError, ValueError):
                return [math.nan] * len(x)

        def border(_: float, x: Any) -> float:
            return plan.radius - plan.away(x)

        border.terminal = True  # type: ignore[attr-defined]
        samples, start = Samples(member), member.initial[:, 0]
        tolerances = {
            "rtol": max(settings.rtol / 10 * plan.tightening, 3e-14), "atol": max(settings.absolute / 10, 1e-18),
        }  # fmt: skip
        for grid in member.grids(plan.settings.samples):
            span = (grid[0], grid[-1])
            try:
                solution = solve_ivp(
                    rhs, span, samples.state, method=self.method, t_eval=grid[1:], events=border, **tolerances
                )
            except _Stopped as stopped:
                return samples.run(plan.at_limit(stopped.limit, stopped.time, float(member.edges[-1, 0])))
            except (ValueError, FloatingPointError) as error:
                return samples.run(plan.broken(start, samples.state, str(error)))
            if len(solution.t):
                samples.add(solution.t, solution.y)
            if solution.status == 1:
                samples.add(solution.t_events[0][:1], solution.y_events[0][:1].T)
                return samples.run(plan.escaped)
            if solution.status != 0 or not np.all(np.isfinite(solution.y)):
                return samples.run(plan.broken(start, samples.state, solution.message))
        return samples.run()
