"""heyoka's Taylor integrator: the fast engine, an extra, for systems whose kinks are known instants.

On each smooth piece the choices in the right-hand side (Max, Min, Piecewise in the time alone) are made once, so
that heyoka sees smooth expressions. Members run in SIMD batches of a fixed order; whatever a batch can't finish is run
again on its own and gets its own outcome.
"""

from __future__ import annotations

import copy
import itertools
import math
import time as clock
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from typing import Any

import numpy as np
import sympy as sp

from ptproof.errors import InputError
from ptproof.problem import parameters
from ptproof.simulation.plan import Array, Batch, Finals, Outcome, Plan, Run, stopped
from ptproof.simulation.translate import heyoka_rules, translate
from ptproof.system import System

_STEPS_A_CALL = 20_000
_BATCH_STEPS = 200_000
# Measured: vectors of eight cost less a member than the width that heyoka recommends for the processor. Divides the
# blocks of an ensemble, so that groups are the same however the members are shared out.
WIDTH = 8
# Sums may be reordered and fused; measured, errors stay the same and heyoka's checks for finite states stay in place.
_BUILD = {"fast_math": True}


def chosen(system: System, time: float, values: tuple[float, ...], known: bool) -> System:
    """``system`` with each Max, Min, Abs and Piecewise of the time alone replaced by its branch at ``time``.

    ``known`` says that the instants at which a clipped gain has its kink are among the edges. Other kinks in time are
    refused, since a Taylor step across one would not notice it.
    """
    branches = _branches(system)
    if branches is None:
        return system
    if not known or not _all_clipped(system):
        raise InputError("heyoka can't follow a kink in time whose instant it is not told; use the engine casadi")
    _, options = branches
    return _resolved(system, tuple(_highest(scores) for scores in options(time, values)))


@lru_cache(maxsize=64)
def _branches(system: System) -> tuple[tuple[Any, ...], Any] | None:
    """The kinks, and a function of time and parameters that scores the branches of each: the highest one holds."""
    found = set().union(*(entry.atoms(sp.Max, sp.Min, sp.Piecewise, sp.Abs) for entry in system.rhs))
    if not found:
        return None
    kinks = tuple(sorted(found, key=sp.default_sort_key))
    scores = []
    for node in kinks:
        if node.free_symbols & set(system.state):
            raise InputError("heyoka can't follow a kink in the state (Max, Min, Abs, …); use the engine casadi")
        if isinstance(node, sp.Piecewise):
            scores.append([sp.Piecewise((1, condition), (0, True)) for _, condition in (p.args for p in node.args)])
        elif isinstance(node, sp.Abs):
            scores.append([node.args[0], -node.args[0]])
        else:
            scores.append([entry if isinstance(node, sp.Max) else -entry for entry in node.args])
    return kinks, sp.lambdify([system.time, system.parameters or ()], scores, modules="math")


@lru_cache(maxsize=64)
def _all_clipped(system: System) -> bool:
    branches = _branches(system)
    return branches is None or all(parameters.nu_min in node.free_symbols for node in branches[0])


def _highest(scores: list[float]) -> int:
    return max(range(len(scores)), key=scores.__getitem__)


@lru_cache(maxsize=64)
def _resolved(system: System, picks: tuple[int, ...]) -> System:
    branches = _branches(system)
    assert branches is not None
    choices = {}
    for node, pick in zip(branches[0], picks, strict=True):
        if isinstance(node, sp.Piecewise):
            choices[node] = node.args[pick].args[0]
        elif isinstance(node, sp.Abs):
            choices[node] = node.args[0] * (1 - 2 * pick)
        else:
            choices[node] = node.args[pick]
    rhs = tuple(entry.xreplace(choices) for entry in system.rhs)
    return System(system.time, system.state, rhs, system.parameters, name=system.name)


@lru_cache(maxsize=64)
def equations(system: System) -> tuple[list[tuple[Any, Any]], int]:
    """heyoka's list of (variable, rate), and the number of parameters up to the last that occurs."""
    import heyoka as hy

    names = [f"x{i}" for i in range(system.dimension)]
    made = hy.make_vars(*names)
    variables = made if isinstance(made, list) else [made]
    parameters = system.parameters or ()
    table: dict[Any, Any] = {system.time: hy.time}
    table |= dict(zip(system.state, variables, strict=True))
    table |= {symbol: hy.par[i] for i, symbol in enumerate(parameters)}
    used = set().union(*(entry.free_symbols for entry in system.rhs))
    count = max((i + 1 for i, symbol in enumerate(parameters) if symbol in used), default=0)
    return list(zip(variables, translate(system.rhs, table, heyoka_rules()), strict=True)), count


@lru_cache(maxsize=64)
def scalar(system: System, tolerance: float) -> Any:
    """A compiled integrator for one trajectory."""
    import heyoka as hy

    odes, count = equations(system)
    return hy.taylor_adaptive(odes, [0.0] * system.dimension, pars=[0.0] * count, tol=tolerance, **_BUILD)


@lru_cache(maxsize=64)
def _picker(system: System, tolerance: float, known: bool) -> Callable[[float, tuple[float, ...]], Any]:
    """From the middle of a piece and the parameters to its integrator; a look-up of its own, since runs are short."""
    chosen(system, 0.25, (0.5,) * len(system.parameters or ()), known)  # refuses what heyoka can't follow
    branches, made = _branches(system), {}

    def pick(time: float, values: tuple[float, ...]) -> Any:
        scores = () if branches is None else branches[1](time, values)
        picks = tuple(_highest(entry) for entry in scores)
        if picks not in made:
            made[picks] = scalar(system if branches is None else _resolved(system, picks), tolerance)
        return made[picks]

    return pick


@lru_cache(maxsize=256)
def batched(system: System, tolerance: float, thread: int = 0) -> Any:
    """A compiled integrator for as many trajectories as the processor's vectors hold; one for each thread."""
    import heyoka as hy

    if thread:
        return copy.deepcopy(batched(system, tolerance))
    odes, count = equations(system)
    return hy.taylor_adaptive_batch(
        odes, np.zeros((system.dimension, WIDTH)), pars=np.zeros((count, WIDTH)), tol=tolerance, force_avx512=True,
        **_BUILD,
    )  # fmt: skip


def _tolerance(plan: Plan) -> float:
    # Relative to the largest state. From a short ladder, so that few integrators are compiled; tight ones cost little.
    wanted = plan.rtol / 10 * plan.tightening / 100
    return next((rung for rung in (1e-5, 1e-7, 1e-9, 1e-11, 1e-13) if rung <= wanted), 2.2e-16)


class _Taylor:
    name = "heyoka"

    def trajectory(self, plan: Plan, member: Batch) -> Run:
        """One run with samples; see :class:`ptproof.simulation.plan.Engine`."""
        import heyoka as hy

        deadline = clock.monotonic() + plan.time_limit
        values = member.parameters[:, 0]
        start = member.initial[:, 0]
        times, columns = [member.edges[0, 0]], [start]
        pieces, total = member.pieces(), float(member.edges[-1, 0] - member.edges[0, 0])
        pick, numbers = _picker(plan.system, _tolerance(plan), _known(member)), tuple(values.tolist())
        for a, b in pieces:
            solver = pick((a + b) / 2, numbers)
            solver.time, solver.state[:], solver.pars[:] = a, columns[-1], values[: len(solver.pars)]
            intervals = max(1, math.ceil(plan.samples * (b - a) / total - 1e-9))
            for target in [b] if intervals == 1 else np.linspace(a, b, intervals + 1)[1:]:
                outcome = hy.taylor_outcome.step_limit
                while outcome == hy.taylor_outcome.step_limit and clock.monotonic() <= deadline:
                    outcome = solver.propagate_until(float(target), max_steps=_STEPS_A_CALL)[0]
                    distance = plan.distance(solver.state)
                    if distance > plan.radius:
                        break
                times.append(float(solver.time))
                columns.append(solver.state.copy())
                if outcome == hy.taylor_outcome.time_limit and distance <= plan.radius:
                    continue
                if plan.distance(columns[-1]) > plan.radius:
                    word, message = Outcome.ESCAPED, f"left the ball of radius {plan.radius:.3g}"
                else:
                    late = outcome == hy.taylor_outcome.step_limit
                    reason = f"time limit of {plan.time_limit:g} s" if late else "the state is not finite any more"
                    word, message = stopped(plan, start, columns[-1], reason)
                return Run(np.array(times), np.stack(columns, axis=1), word, message)
        return Run(np.array(times), np.stack(columns, axis=1), Outcome.REACHED)

    def finals(self, plan: Plan, batch: Batch, workers: int = 1) -> Finals:
        """End states of many, in SIMD groups of a fixed order, spread over ``workers`` threads."""
        groups = [np.arange(first, first + WIDTH) for first in range(0, batch.size, WIDTH)]
        time, x = batch.edges[-1].copy(), np.full_like(batch.initial, np.nan)
        pieces = _pieces(plan, batch)

        def work(share: Iterable[Any], thread: int) -> list[int]:
            solvers = [(row, batched(system, _tolerance(plan), thread)) for row, system in pieces]
            return [i for group in share for i in _group(batch, solvers, group, x)]

        if workers == 1 or len(groups) < 2 * workers:
            unfinished = work(groups, 0)
        else:
            # Each thread has integrators of its own; heyoka lets other threads run while it integrates.
            with ThreadPoolExecutor(workers) as pool:
                # They take the next group from one list, so that none waits for another whose core is busy.
                queue = iter(groups)
                shares = [pool.submit(work, queue, thread) for thread in range(workers)]
            unfinished = [i for share in shares for i in share.result()]
        unfinished += np.flatnonzero(~(plan.distance(x) <= plan.radius)).tolist()
        outcomes = [Outcome.REACHED] * batch.size
        for i in sorted(set(unfinished)):
            run = self.trajectory(plan, batch.member(i))
            time[i], x[:, i], outcomes[i] = run.time[-1], run.x[:, -1], run.outcome
        return Finals(time, x, tuple(outcomes))


def _group(batch: Batch, solvers: list[tuple[int, Any]], group: Any, x: Array) -> list[int]:
    """Integrate one group into ``x``; the members of a group that didn't get through are returned."""
    import heyoka as hy

    # The last group is filled up with copies of its last member.
    index = np.minimum(group, batch.size - 1)
    kept = index[: max(0, min(len(group), batch.size - int(group[0])))]
    state = batch.initial[:, index]
    for piece, solver in solvers:
        solver.set_time(batch.edges[piece, index])
        solver.state[:], solver.pars[:] = state, batch.parameters[: len(solver.pars), index]
        solver.propagate_until(batch.edges[piece + 1, index].tolist(), max_steps=_BATCH_STEPS)
        state = solver.state
        if any(result[0] != hy.taylor_outcome.time_limit for result in solver.propagate_res):
            return [int(i) for i in kept]
    x[:, kept] = state[:, : len(kept)]
    return []


def _known(batch: Batch) -> bool:
    return batch.edges.shape[0] > 2


def _pieces(plan: Plan, batch: Batch) -> list[tuple[int, System]]:
    """The smooth system of each piece that is not empty, with the piece's place among the edges."""
    systems = []
    for row, (a, b) in enumerate(itertools.pairwise(batch.edges)):
        if np.all(b == a):
            continue
        if not np.all(b > a):
            raise InputError("heyoka: some members have a kink in time where others have none; use the engine casadi")
        middle, values = float((a[0] + b[0]) / 2), tuple(batch.parameters[:, 0].tolist())
        systems.append((row, chosen(plan.system, middle, values, _known(batch))))
    return systems


@lru_cache(maxsize=64)
def follows(system: System, known: bool) -> bool:
    """Whether heyoka can take ``system``: no kinks but those of a clipped gain at ``known`` instants."""
    try:
        equations(chosen(system, 0.25, (0.5,) * len(system.parameters or ()), known))
    except InputError:
        return False
    return True


TAYLOR = _Taylor()
