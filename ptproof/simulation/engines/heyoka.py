"""heyoka's Taylor integrator: the fast engine, an extra, for systems whose kinks are known instants.

On each smooth piece the choices in the right-hand side are made once, so that heyoka sees smooth expressions. Members
run in SIMD batches of a fixed order; whatever a batch can't finish is run again on its own and gets its own outcome.
"""

from __future__ import annotations

import copy
import importlib.util
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, TypeAlias

import numpy as np
from sympy.core.relational import Relational

from ptproof.errors import InputError
from ptproof.simulation.plan import Array, Batch, Engine, Finals, Paths, Plan, Run, Samples, Work
from ptproof.simulation.settings import Budget, Outcome, Stop
from ptproof.simulation.smooth import picker, pieces
from ptproof.simulation.taylor_form import equations
from ptproof.system import System

_STEPS_A_CALL = 20_000
_BATCH_STEPS = 200_000
_SAMPLES_A_CALL = 100
# Measured: vectors of eight cost less a member than the width that heyoka recommends for the processor. Divides the
# blocks of an ensemble, so that groups are the same however the members are shared out.
WIDTH = 8
# Sums may be reordered and fused; measured, errors stay the same and heyoka's checks for finite states stay in place.
_BUILD = {"fast_math": True}
# A turn takes the default engine a thousandth of a second or so; from here on compiling is worth it.
_MANY_TURNS = 3000
# For each piece of time its place among the edges, heyoka's constants (m × N), and a compiled integrator.
_Solvers: TypeAlias = list[tuple[int, Array, Any]]


@lru_cache(maxsize=64)
def scalar(system: System, tolerance: float) -> Any:
    """A compiled integrator for one trajectory."""
    import heyoka as hy

    made = equations(system)
    return hy.taylor_adaptive(made.rates, [0.0] * system.dimension, pars=[0.0] * made.count, tol=tolerance, **_BUILD)


@lru_cache(maxsize=64)
def _ready(
    system: System, conditions: tuple[Relational, ...], tolerance: float
) -> Callable[[float, tuple[float, ...]], tuple[Any, Array]]:
    """From an instant and the parameters to an integrator and its constants; one look-up, since runs are short."""
    pick, made = picker(system, conditions), {}
    told: dict[int, tuple[tuple[float, ...], Array]] = {}  # the latest parameters, and what follows from them

    def ready(time: float, values: tuple[float, ...]) -> tuple[Any, Array]:
        smooth = pick(time, values)
        key = id(smooth)
        if key not in made:
            made[key] = scalar(smooth, tolerance), equations(smooth).constants
        solver, constants = made[key]
        if key not in told or told[key][0] != values:
            told[key] = values, constants(np.array(values))
        return solver, told[key][1]

    return ready


@lru_cache(maxsize=256)
def batched(system: System, tolerance: float, thread: int = 0) -> Any:
    """A compiled integrator for as many trajectories as the processor's vectors hold; one for each thread."""
    import heyoka as hy

    if thread:
        return copy.deepcopy(batched(system, tolerance))
    made = equations(system)
    return hy.taylor_adaptive_batch(
        made.rates, np.zeros((system.dimension, WIDTH)), pars=np.zeros((made.count, WIDTH)), tol=tolerance,
        force_avx512=True, **_BUILD,
    )  # fmt: skip


def _tolerance(plan: Plan) -> float:
    # Relative to the largest state. From a short ladder, so that few integrators are compiled; above its first rung
    # nothing is gained: where 1/μ bounds the steps, an order less makes them shorter.
    wanted = plan.settings.rtol / 10 * plan.tightening / 100
    return next((rung for rung in (1e-7, 1e-9, 1e-11, 1e-13) if rung <= wanted), 2.2e-16)


@dataclass(frozen=True)
class _Way:
    """One run under way: what it has brought so far, and what is left of the limits on its work."""

    plan: Plan
    samples: Samples
    budget: Budget

    def along(self, solver: Any, grid: Array) -> Stop | None:
        """Integrate through ``grid``, whose first time is the solver's; why it stopped before, if it did."""
        import heyoka as hy

        while True:
            outcome, steps, rows = _go(solver, grid, max(1, min(_STEPS_A_CALL, self.budget.steps)))
            self.budget.steps -= steps
            good, count = self.plan.inside(rows), rows.shape[1]
            if good:
                self.samples.add(grid[1 : good + 1], rows[:, :good])
            if good == len(grid) - 1:
                return None
            if good < count and np.isfinite(rows[:, good]).all():
                self.samples.add(grid[good + 1 : good + 2], rows[:, good : good + 1])
                return self.plan.escaped
            if good < count or outcome == hy.taylor_outcome.err_nf_state:
                return self._to_the_border(solver, float(grid[good + 1]))
            grid = np.concatenate([[solver.time], grid[good + 1 :]])
            if limit := self.budget.spent:
                self.samples.add(grid[:1], solver.state.reshape(-1, 1).copy())
                return self.plan.at_limit(limit, float(solver.time), float(self.samples.member.edges[-1, 0]))

    def _to_the_border(self, solver: Any, target: float) -> Stop:
        """From the last sample to where the state leaves the ball, or is a number for the last time."""
        time, x, steps = self.samples.time, self.samples.state, _STEPS_A_CALL
        while steps and time < target and self.plan.away(x) <= self.plan.radius:
            solver.time, solver.state[:] = time, x
            solver.propagate_until(target, max_steps=steps)
            if np.isfinite(solver.state).all():
                time, x = float(solver.time), solver.state.copy()
            else:
                steps //= 8
        if time > self.samples.time:
            self.samples.add(np.array([time]), x[:, None])
        return self.plan.broken(self.samples.member.initial[:, 0], x, "the state is not finite any more")


def _go(solver: Any, grid: Array, most: int) -> tuple[Any, int, Array]:
    """How up to ``most`` steps through ``grid`` ended, their number, and the states (n × …) at the times reached."""
    import heyoka as hy

    if len(grid) > 2:
        outcome, _, _, steps, _, states = solver.propagate_grid(grid, max_steps=most)
        return outcome, steps, states[1:].T
    outcome, _, _, steps, _, _ = solver.propagate_until(float(grid[1]), max_steps=most)
    rows = solver.state.reshape(-1, 1).copy()
    return outcome, steps, rows if outcome == hy.taylor_outcome.time_limit else rows[:, :0]


class _Taylor(Engine):
    # About as long as a block of another engine; its groups are the same in blocks of either size.
    block = 2048
    missing = "" if importlib.util.find_spec("heyoka") else "the extra 'fast'"

    def wants(self, plan: Plan, batch: Batch, work: Work) -> bool:
        """Many members, or thousands of turns, of a system that it can follow with steps of some length."""
        turns = (work.radians or 0.0) / (2 * np.pi)
        if not work.many and turns < _MANY_TURNS:
            return False
        # An explicit method can't step over more than a few μ; an implicit one takes some hundred steps a turn.
        if work.spans is not None and work.spans / 6 > 300 * max(turns, 10.0):
            return False
        lengths = np.diff(batch.edges, axis=0) > 0
        return bool(np.all(lengths == lengths[:, :1])) and follows(plan.system, plan.conditions)

    def trajectory(self, plan: Plan, member: Batch) -> Run:
        """One run; its samples come from the Taylor series of the steps, in one call for each piece."""
        numbers = tuple(member.parameters[:, 0].tolist())
        way = _Way(plan, Samples(member), Budget(plan.settings))
        ready = _ready(plan.system, plan.conditions, _tolerance(plan))
        for grid in member.grids(plan.settings.samples):
            solver, constants = ready(float(grid[0] + grid[-1]) / 2, numbers)
            solver.time, solver.state[:], solver.pars[:] = grid[0], way.samples.state, constants
            if stop := way.along(solver, grid):
                return way.samples.run(stop)
        return way.samples.run()

    def finals(self, plan: Plan, batch: Batch, workers: int = 1) -> Finals:
        """End states of many, in SIMD groups of a fixed order, spread over ``workers`` threads."""
        time, x = batch.edges[-1].copy(), np.full_like(batch.initial, np.nan)
        unfinished = _by_groups(plan, batch, workers, lambda solvers, group: _group(batch, solvers, group, x))
        unfinished += np.flatnonzero(~(plan.distance(x) <= plan.radius)).tolist()
        outcomes = [Outcome.REACHED] * batch.size
        for i in sorted(set(unfinished)):
            run = self.trajectory(plan, batch.member(i))
            time[i], x[:, i], outcomes[i] = run.time[-1], run.x[:, -1], run.stop.outcome
        return Finals(time, x, tuple(outcomes))

    def paths(self, plan: Plan, batch: Batch, workers: int = 1) -> Paths:
        """The way of many, in the groups of :meth:`finals`; the samples come from the Taylor series of the steps."""
        time, grids = batch.path_times(plan.settings.samples), list(batch.member(0).grids(plan.settings.samples))
        x = np.full((*batch.initial.shape, len(time)), np.nan)
        unfinished = _by_groups(
            plan, batch, workers, lambda solvers, group: _group_path(batch, solvers, group, grids, x)
        )
        for i in sorted(unfinished):
            x[:, i] = super().paths(plan, batch.member(i)).x[:, 0]
        return Paths(time, x)


def _by_groups(plan: Plan, batch: Batch, workers: int, integrate: Callable[[_Solvers, Array], list[int]]) -> list[int]:
    """All groups, spread over ``workers`` threads; gives the members that ``integrate`` gave back as unfinished."""
    groups = [np.arange(first, first + WIDTH) for first in range(0, batch.size, WIDTH)]
    smooth = [(row, system, equations(system).constants(batch.parameters)) for row, system in pieces(plan, batch)]

    def work(share: Iterable[Any], thread: int) -> list[int]:
        solvers = [(row, values, batched(system, _tolerance(plan), thread)) for row, system, values in smooth]
        return [i for group in share for i in integrate(solvers, group)]

    if workers == 1 or len(groups) < 2 * workers:
        return work(groups, 0)
    # Each thread has integrators of its own; heyoka lets other threads run while it integrates.
    with ThreadPoolExecutor(workers) as pool:
        # They take the next group from one list, so that none waits for another whose core is busy.
        queue = iter(groups)
        shares = [pool.submit(work, queue, thread) for thread in range(workers)]
    return [i for share in shares for i in share.result()]


def _members(batch: Batch, group: Any) -> tuple[Any, Any]:
    """The members whose lanes a group fills, and those that count: the last is filled up with its last member."""
    index = np.minimum(group, batch.size - 1)
    return index, index[: max(0, min(len(group), batch.size - int(group[0])))]


def _group(batch: Batch, solvers: _Solvers, group: Any, x: Array) -> list[int]:
    """Integrate one group into ``x``; the members of a group that didn't get through are returned."""
    import heyoka as hy

    index, kept = _members(batch, group)
    state = batch.initial[:, index]
    for piece, values, solver in solvers:
        solver.set_time(batch.edges[piece, index])
        solver.state[:], solver.pars[:] = state, values[:, index]
        solver.propagate_until(batch.edges[piece + 1, index].tolist(), max_steps=_BATCH_STEPS)
        state = solver.state
        if any(result[0] != hy.taylor_outcome.time_limit for result in solver.propagate_res):
            return [int(i) for i in kept]
    x[:, kept] = state[:, : len(kept)]
    return []


def _group_path(batch: Batch, solvers: _Solvers, group: Any, grids: Sequence[Array], x: Array) -> list[int]:
    """Integrate one group and sample it into ``x`` (n × N × m), as :func:`_group` does the ends."""
    import heyoka as hy

    index, kept = _members(batch, group)
    x[:, kept, 0] = batch.initial[:, kept]
    state, at = batch.initial[:, index], 1
    for (_, values, solver), grid in zip(solvers, grids, strict=True):
        for part in _portions(grid):
            solver.set_time(np.full(WIDTH, part[0]))
            solver.state[:], solver.pars[:] = state, values[:, index]
            _, rows = solver.propagate_grid(np.repeat(part[:, None], WIDTH, axis=1), max_steps=_BATCH_STEPS)
            state = rows[-1].copy()
            ended = any(result[0] != hy.taylor_outcome.time_limit for result in solver.propagate_res)
            if ended or not np.isfinite(state).all():
                return [int(i) for i in kept]
            x[:, kept, at : at + len(part) - 1] = rows[1:, :, : len(kept)].transpose(1, 2, 0)
            at += len(part) - 1
    return []


def _portions(grid: Array) -> Iterator[Array]:
    """A grid in parts that share their ends: the limit on the steps of a call is for one of them."""
    for first in range(0, len(grid) - 1, _SAMPLES_A_CALL):
        yield grid[first : first + _SAMPLES_A_CALL + 1]


@lru_cache(maxsize=64)
def follows(system: System, conditions: tuple[Relational, ...]) -> bool:
    """Whether heyoka can take ``system``: no kinks but at the instants at which ``conditions`` change."""
    try:
        equations(picker(system, conditions)(0.25, (0.5,) * len(system.parameters or ())))
    except InputError:
        return False
    return True


ENGINE = _Taylor()
