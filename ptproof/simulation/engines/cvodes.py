"""CasADi with CVODES: the default engine.

Time is normalised, dx/ds = L·rhs(a + L·s, x) with s in [0, 1], so that start, length and parameters are arguments of
one integrator and a run with other values builds nothing. A call that fails is repeated in pieces, which are halved
until they succeed or can't be told apart.
"""

from __future__ import annotations

import math
import time as clock
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from ptproof.simulation.plan import Array, Batch, Finals, Outcome, Plan, Run, one_by_one, stopped
from ptproof.simulation.translate import casadi_expressions
from ptproof.system import System

_STEPS_A_CALL = 20_000
_FIRST_STEPS = 2_000_000
_CHUNK = 32


@lru_cache(maxsize=128)
def integrator(system: System, intervals: int, rtol: float, atol: float, max_steps: int) -> Any:
    """CasADi's integrator with inputs x0 (n), p = (parameters, start, length), and ``intervals`` output columns.

    ``max_steps`` is CVODES' limit between two outputs.
    """
    import casadi as ca

    time, x, p, rhs = casadi_expressions(system)
    s, start, length = ca.SX.sym("s"), ca.SX.sym("start"), ca.SX.sym("length")
    rate = ca.Function("rate", [time, x, p], [rhs])
    dae = {"x": x, "t": s, "p": ca.vertcat(p, start, length), "ode": length * rate(start + length * s, x, p)}
    options = {
        "reltol": rtol, "abstol": atol, "max_num_steps": max_steps, "min_step_size": 1e-15,
        "disable_internal_warnings": True, "show_eval_warnings": False,
    }  # fmt: skip
    grid = [i / intervals for i in range(1, intervals + 1)]
    return ca.integrator("run", "cvodes", dae, 0.0, grid, options)


def local_tolerances(plan: Plan) -> tuple[float, float]:
    """CVODES keeps each step's error below its tolerance; a fiftieth keeps the whole near what was asked (measured)."""
    return max(plan.rtol / 50 * plan.tightening, 1e-14), max(plan.atol / 50, 1e-18)


@dataclass(frozen=True)
class _Solver:
    """The integrators of one plan for one parameter vector; a call that fails returns None."""

    plan: Plan
    parameters: list[float]

    def __call__(self, x: Array, grid: Array, max_steps: int = _STEPS_A_CALL) -> Array | None:
        """The states at ``grid[1:]``, evenly spaced, from ``x`` at ``grid[0]``."""
        rtol, atol = local_tolerances(self.plan)
        run = integrator(self.plan.system, len(grid) - 1, rtol, atol, max_steps)
        try:
            result = np.array(run(x0=x, p=[*self.parameters, grid[0], grid[-1] - grid[0]])["xf"])
        except RuntimeError:
            return None
        return result if np.all(np.isfinite(result)) else None


class _CVODES:
    name = "casadi"

    def trajectory(self, plan: Plan, member: Batch) -> Run:
        """One run with samples; see :class:`ptproof.simulation.plan.Engine`."""
        deadline = clock.monotonic() + plan.time_limit
        solve = _Solver(plan, member.parameters[:, 0].tolist())
        start = member.initial[:, 0]
        times, columns = [member.edges[0, 0]], [start]
        pieces = member.pieces()
        total = pieces[-1][1] - pieces[0][0]
        for a, b in pieces:
            grid = np.linspace(a, b, max(1, math.ceil(plan.samples * (b - a) / total - 1e-9)) + 1)
            reached, size = 0, len(grid) - 1
            while reached < len(grid) - 1:
                size = min(size, len(grid) - 1 - reached)
                ahead = grid[reached : reached + size + 1]
                # As many samples as possible in one call, since each call starts the method afresh; the step limit
                # keeps even a hopeless call short.
                block = (
                    None if size == 1 else solve(columns[-1], ahead, min(_STEPS_A_CALL, max(500, _FIRST_STEPS // size)))
                )
                if block is not None and np.all(plan.distance(block) <= plan.radius):
                    times.extend(ahead[1:])
                    columns.extend(block.T)
                    reached, size = reached + size, 2 * size
                    continue
                if size > 1 and clock.monotonic() <= deadline:
                    size //= 2
                    continue
                end = _advance(plan, solve, times[-1], columns[-1], float(ahead[1]), deadline, total)
                if end.time > times[-1]:
                    times.append(end.time)
                    columns.append(end.x)
                if end.reason:
                    if plan.distance(end.x) > plan.radius:
                        outcome, message = Outcome.ESCAPED, f"left the ball of radius {plan.radius:.3g}"
                    else:
                        outcome, message = stopped(plan, start, end.x, end.reason)
                    return Run(np.array(times), np.stack(columns, axis=1), outcome, message)
                reached, size = reached + 1, 2
        return Run(np.array(times), np.stack(columns, axis=1), Outcome.REACHED)

    def finals(self, plan: Plan, batch: Batch, workers: int = 1) -> Finals:
        """End states of many; chunks of a fixed size go through CasADi's own map, failing ones one by one."""
        return Finals.join(
            [
                self._chunk(plan, batch.slice(i, min(i + _CHUNK, batch.size)), workers)
                for i in range(0, batch.size, _CHUNK)
            ]
        )

    def _chunk(self, plan: Plan, batch: Batch, workers: int) -> Finals:
        x = batch.initial
        if batch.size == 1 or batch.edges.shape[0] > 4:
            return one_by_one(self, plan, batch)
        rtol, atol = local_tolerances(plan)
        for a, b in zip(batch.edges[:-1], batch.edges[1:], strict=True):
            if not np.all(b > a):
                return one_by_one(self, plan, batch)
            run = mapped(plan.system, batch.size, rtol, atol, workers)
            try:
                x = np.array(run(x0=x, p=np.vstack([batch.parameters, a, b - a]))["xf"])
            except RuntimeError:
                return one_by_one(self, plan, batch)
            if not np.all(plan.distance(x) <= plan.radius):
                return one_by_one(self, plan, batch)
        return Finals(batch.edges[-1].copy(), x, (Outcome.REACHED,) * batch.size)


@lru_cache(maxsize=32)
def mapped(system: System, size: int, rtol: float, atol: float, workers: int) -> Any:
    """:func:`integrator` for ``size`` members in one call, on ``workers`` threads of CasADi's own.

    One integrator must not be shared by Python's threads: it keeps its memory in itself.
    """
    run = integrator(system, 1, rtol, atol, _FIRST_STEPS // 10)
    return run.map(size) if workers == 1 or size == 1 else run.map(size, "thread", min(workers, size))


@dataclass(frozen=True)
class _End:
    time: float
    x: Array
    reason: str = ""


def _advance(plan: Plan, solve: _Solver, time: float, x: Array, target: float, deadline: float, total: float) -> _End:
    """Go from ``time`` to ``target`` in pieces that are halved where they fail and doubled where they don't."""
    step = target - time
    smallest = max(total * 1e-13, abs(target) * 4e-16)
    while time < target:
        if clock.monotonic() > deadline:
            return _End(time, x, f"time limit of {plan.time_limit:g} s")
        goal = target if time + step >= target else time + step
        block = solve(x, np.array([time, goal]))
        if block is None or plan.distance(block[:, -1]) > plan.radius:
            if goal - time <= smallest:
                if block is not None:
                    return _End(goal, block[:, -1], "escaped")
                return _End(time, x, "the solver can't continue: the rates are infinite or change without bound")
            step = (goal - time) / 2
            continue
        time, x = goal, block[:, -1]
        step = 2 * step
    return _End(target, x)


CVODES = _CVODES()
