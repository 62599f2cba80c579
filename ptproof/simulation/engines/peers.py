"""SciPy's integrators as peers: an independent code from the same expressions."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.errors import InputError
from ptproof.simulation.plan import Batch, Finals, Outcome, Plan, Run, one_by_one, stopped
from ptproof.system import System

_METHODS = {"lsoda": "LSODA", "radau": "Radau", "dop853": "DOP853"}
_EXTRA = {"sign": lambda value: math.copysign(1.0, value) if value else 0.0}


@lru_cache(maxsize=64)
def lambdified(system: System) -> Callable[..., Any]:
    """The right-hand side as a Python function f(time, x, p) of floats."""
    if any(entry.has(AppliedUndef) for entry in system.rhs):
        raise InputError(f"{system.name}: has undefined functions; put expressions in for them before simulating")
    parameters = system.parameters or ()
    return sp.lambdify([system.time, system.state, parameters], list(system.rhs), modules=[_EXTRA, "math"], cse=True)


class _OutOfTime(Exception):
    pass


@dataclass(frozen=True)
class SciPy:
    """``solve_ivp`` with LSODA, Radau or DOP853."""

    name: str

    def trajectory(self, plan: Plan, member: Batch) -> Run:
        """One run with samples; see :class:`ptproof.simulation.plan.Engine`."""
        from scipy.integrate import solve_ivp

        function, values = lambdified(plan.system), member.parameters[:, 0].tolist()
        deadline, calls = clock.monotonic() + plan.time_limit, 0

        def rhs(time: float, x: Any) -> Any:
            nonlocal calls
            calls += 1
            if calls > 4 * plan.max_steps or (calls % 256 == 0 and clock.monotonic() > deadline):
                raise _OutOfTime
            try:
                return function(time, x.tolist(), values)
            except (OverflowError, ZeroDivisionError, ValueError):
                return [math.nan] * len(x)

        def border(_: float, x: Any) -> float:
            return float(plan.radius - plan.distance(x))

        border.terminal = True  # type: ignore[attr-defined]
        start = member.initial[:, 0]
        times, columns = [member.edges[0, 0]], [start]
        pieces = member.pieces()
        total = pieces[-1][1] - pieces[0][0]
        rtol, atol = max(plan.rtol / 10 * plan.tightening, 3e-14), max(plan.atol / 10, 1e-18)
        for a, b in pieces:
            grid = np.linspace(a, b, max(1, math.ceil(plan.samples * (b - a) / total - 1e-9)) + 1)
            try:
                solution = solve_ivp(
                    rhs, (a, b), columns[-1], method=_METHODS[self.name], rtol=rtol, atol=atol, t_eval=grid[1:],
                    events=border,
                )  # fmt: skip
            except (_OutOfTime, ValueError, FloatingPointError) as error:
                reason = f"time limit of {plan.time_limit:g} s" if isinstance(error, _OutOfTime) else str(error)
                outcome, message = stopped(plan, start, columns[-1], reason)
                return Run(np.array(times), np.stack(columns, axis=1), outcome, message)
            times.extend(solution.t)
            columns.extend(solution.y.T)
            if solution.status == 1:
                times.append(float(solution.t_events[0][0]))
                columns.append(solution.y_events[0][0])
                message = f"left the ball of radius {plan.radius:.3g}"
                return Run(np.array(times), np.stack(columns, axis=1), Outcome.ESCAPED, message)
            if solution.status != 0 or not np.all(np.isfinite(solution.y)):
                outcome, message = stopped(plan, start, columns[-1], solution.message)
                return Run(np.array(times), np.stack(columns, axis=1), outcome, message)
        return Run(np.array(times), np.stack(columns, axis=1), Outcome.REACHED)

    def finals(self, plan: Plan, batch: Batch, workers: int = 1) -> Finals:
        """End states of many, in a loop on one thread."""
        return one_by_one(self, plan, batch)
