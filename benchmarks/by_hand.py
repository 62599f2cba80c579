"""What one writes with SciPy or heyoka alone: the other side of the benchmarks."""

from __future__ import annotations

import copy
import itertools
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np

from ptproof.problem import Problem
from ptproof.simulation.plan import Array, Batch
from ptproof.simulation.scipy_methods import lambdified
from ptproof.simulation.setup import Setup, from_problem
from ptproof.simulation.smooth import picker
from ptproof.simulation.taylor_form import equations


def reduced(problem: Problem, angles: Array | None = None) -> tuple[Setup, Batch]:
    """The closed loop in τ and reduced coordinates, from the problem's own heading or from each of ``angles`` (N)."""
    setup = from_problem(problem, "pt", "tau", "reduced", "closed loop", None, None)
    size = 1 if angles is None else len(angles)
    table = {name: np.full(size, value) for name, value in setup.defaults.items()}
    if angles is not None:
        table["theta"] = angles
    return setup, setup.batch(setup.completed(table))


def scipy_run(setup: Setup, member: Batch, method: str, rtol: float, samples: int = 1) -> Array:
    """Positions (2 × m) by ``solve_ivp`` on a lambdified right-hand side, restarted at the gain's kink."""
    from scipy.integrate import solve_ivp

    function, values, state = lambdified(setup.system), member.parameters[:, 0].tolist(), member.initial[:, 0]
    found = []
    for grid in member.grids(samples):
        solution = solve_ivp(
            lambda t, x: function(t, x, values), grid[[0, -1]], state, method, grid[1:], rtol=rtol, atol=rtol / 10
        )
        state = solution.y[:, -1]
        found.append(solution.y[:2])
    return np.concatenate(found, axis=1)


def scipy_loop(problem: Problem, method: str, rtol: float, angles: Array | None = None) -> Array:
    """End positions (2 × N) by :func:`scipy_run`, one after the other."""
    setup, batch = reduced(problem, angles)
    return np.array([scipy_run(setup, batch.member(i), method, rtol)[:, -1] for i in range(batch.size)]).T


def heyoka_loop(problem: Problem, angles: Array, cores: int, tolerance: float) -> Callable[[], Array]:
    """A function for the end positions (2 × N) with heyoka alone: batches, two pieces, one integrator a thread.

    N must be a multiple of the batches' width; building is done before.
    """
    from ptproof.simulation.engines import heyoka

    setup, batch = reduced(problem, angles)
    initial, values, edges = batch.initial, batch.parameters, batch.edges
    pick, first = picker(setup.system, setup.conditions), tuple(values[:, 0].tolist())
    systems = [pick(float((a + b) / 2), first) for a, b in itertools.pairwise(edges[:, 0])]
    constants = [equations(system).constants(values) for system in systems]
    solvers = [heyoka.batched(system, tolerance) for system in systems]
    threads = [[copy.deepcopy(solver) for solver in solvers] for _ in range(cores)]
    width = heyoka.WIDTH
    ends = np.empty((2, batch.size))

    def work(first: int, own: list[Any]) -> None:
        for start in range(first * width, batch.size, cores * width):
            group = slice(start, start + width)
            state = initial[:, group]
            for piece, solver in enumerate(own):
                solver.set_time(edges[piece, group])
                solver.state[:], solver.pars[:] = state, constants[piece][:, group]
                solver.propagate_until(edges[piece + 1, group].tolist())
                state = solver.state
            ends[:, group] = state[:2]

    def everything() -> Array:
        with ThreadPoolExecutor(cores) as pool:
            list(pool.map(work, range(cores), threads))
        return ends

    return everything
