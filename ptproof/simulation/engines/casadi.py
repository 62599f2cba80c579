"""CasADi: the default engine, an explicit method of order 8 where one suits and CVODES elsewhere.

The explicit one is :mod:`ptproof.simulation.runge_kutta`. For CVODES time is normalised, dx/ds = L·rhs(a + L·s, x)
with s in [0, 1], so that start, length and parameters are arguments of one integrator and a run with other values
builds nothing. A call that fails is repeated in pieces, which are halved until they succeed or can't be told apart.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from ptproof.simulation import runge_kutta
from ptproof.simulation.plan import Array, Batch, Engine, Finals, Plan, Run, Samples
from ptproof.simulation.settings import Budget, Outcome, Stop
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
    settings = plan.settings
    return max(settings.rtol / 50 * plan.tightening, 1e-14), max(settings.absolute / 50, 1e-18)


@dataclass(frozen=True)
class _Solver:
    """The integrators of one plan for one parameter vector, and what is left of the limits on their work."""

    plan: Plan
    parameters: list[float]
    budget: Budget

    def __call__(self, x: Array, grid: Array, max_steps: int = _STEPS_A_CALL) -> Array | None:
        """The states at ``grid[1:]``, evenly spaced, from ``x`` at ``grid[0]``; None where they can't be had."""
        rtol, atol = local_tolerances(self.plan)
        run = integrator(self.plan.system, len(grid) - 1, rtol, atol, min(max_steps, self.plan.settings.max_steps))
        try:
            result = np.array(run(x0=x, p=[*self.parameters, grid[0], grid[-1] - grid[0]])["xf"])
        except RuntimeError:
            return None
        finally:
            self.budget.steps -= run.stats()["nsteps"]
        return result if np.isfinite(result).all() else None


class _CasADi(Engine):
    def trajectory(self, plan: Plan, member: Batch) -> Run:
        """One run with samples, by the explicit method as far as it goes and by CVODES from there."""
        samples, grids = Samples(member), list(member.grids(plan.settings.samples))
        budget = Budget(plan.settings)
        found = runge_kutta.through(plan, member, [len(grid) - 1 for grid in grids], budget)
        for grid, states in zip(grids, found, strict=False):
            samples.add(grid[1 : states.shape[1] + 1], states)
        rest, broken_off = grids[len(found) :], False
        if found and (reached := found[-1].shape[1]) < len(grids[len(found) - 1]) - 1:
            rest, broken_off = [grids[len(found) - 1][reached:], *rest], True
        return _by_cvodes(plan, samples, rest, budget, broken_off)

    def finals(self, plan: Plan, batch: Batch, workers: int = 1) -> Finals:
        """End states of many; chunks of a fixed size go through CasADi's own map, failing ones one by one."""
        chunks = [batch.slice(i, min(i + _CHUNK, batch.size)) for i in range(0, batch.size, _CHUNK)]
        return Finals.join([self._chunk(plan, chunk, workers) for chunk in chunks])

    def _chunk(self, plan: Plan, batch: Batch, workers: int) -> Finals:
        x = batch.initial
        if batch.size == 1 or batch.edges.shape[0] > 4 or not np.all(batch.edges[1:] > batch.edges[:-1]):
            return super().finals(plan, batch)
        rtol, atol = local_tolerances(plan)
        steps = min(_FIRST_STEPS // 10, plan.settings.max_steps)
        for a, b in zip(batch.edges[:-1], batch.edges[1:], strict=True):
            run = mapped(plan.system, batch.size, rtol, atol, steps, workers)
            try:
                x = np.array(run(x0=x, p=np.vstack([batch.parameters, a, b - a]))["xf"])
            except RuntimeError:
                x = np.full_like(x, np.nan)
            if not plan.within(x):
                return super().finals(plan, batch)
        return Finals(batch.edges[-1].copy(), x, (Outcome.REACHED,) * batch.size)


@lru_cache(maxsize=32)
def mapped(system: System, size: int, rtol: float, atol: float, max_steps: int, workers: int) -> Any:
    """:func:`integrator` for ``size`` members in one call, on ``workers`` threads of CasADi's own.

    One integrator must not be shared by Python's threads: it keeps its memory in itself.
    """
    run = integrator(system, 1, rtol, atol, max_steps)
    return run.map(size) if workers == 1 or size == 1 else run.map(size, "thread", min(workers, size))


def _by_cvodes(plan: Plan, samples: Samples, grids: Sequence[Array], budget: Budget, near_trouble: bool) -> Run:
    """The rest of a run, as many samples as possible in one call, since each call starts the method afresh.

    Where an explicit method has broken off in the middle, more and more, for the run may end between two samples.
    """
    solve = _Solver(plan, samples.member.parameters[:, 0].tolist(), budget)
    for i, grid in enumerate(grids):
        reached, size = 0, 2 if near_trouble and i == 0 else len(grid) - 1
        while reached < len(grid) - 1:
            size = min(size, len(grid) - 1 - reached)
            ahead = grid[reached : reached + size + 1]
            # The step limit keeps even a hopeless call short.
            most = min(_STEPS_A_CALL, max(500, _FIRST_STEPS // size))
            block = None if size == 1 else solve(samples.state, ahead, most)
            if block is not None and plan.within(block) and solve.budget.steps > 0:
                samples.add(ahead[1:], block)
                reached, size = reached + size, 2 * size
            elif size > 1 and solve.budget.spent is None:
                size //= 2
            else:
                if stop := _advance(solve, samples, float(ahead[1])):
                    return samples.run(stop)
                reached, size = reached + 1, 2
    return samples.run()


def _advance(solve: _Solver, samples: Samples, target: float) -> Stop | None:
    """Go on to ``target`` in pieces that are halved where they fail and doubled where they don't."""
    plan, member = solve.plan, samples.member
    first, last = float(member.edges[0, 0]), float(member.edges[-1, 0])
    smallest = max((last - first) * 1e-13, abs(target) * 4e-16)
    begin, time, x, step = samples.time, samples.time, samples.state, target - samples.time
    stop = None
    while time < target:
        if limit := solve.budget.spent:
            stop = plan.at_limit(limit, time, last)
            break
        goal = target if time + step >= target else time + step
        block = solve(x, np.array([time, goal]))
        if block is not None and plan.within(block):
            time, x, step = goal, block[:, -1], 2 * step
        elif goal - time > smallest:
            step = (goal - time) / 2
        elif block is not None:
            time, x, stop = goal, block[:, -1], plan.escaped
            break
        else:
            why = "the solver can't continue: the rates are infinite or change without bound"
            stop = plan.broken(member.initial[:, 0], x, why)
            break
    if time > begin:
        samples.add(np.array([time]), x[:, None])
    return stop


ENGINE = _CasADi()
