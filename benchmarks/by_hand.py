"""What one writes with SciPy or heyoka alone: the other side of the benchmarks."""

from __future__ import annotations

import copy
import itertools
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np

from ptproof.problem import Problem
from ptproof.simulation.engines.peers import lambdified
from ptproof.simulation.plan import Array, Batch
from ptproof.simulation.setup import Setup, completed_parameters, from_problem


def reduced(problem: Problem, angles: Array | None = None) -> tuple[Setup, Batch]:
    """The closed loop in τ and reduced coordinates, from the problem's own heading or from each of ``angles`` (N)."""
    setup = from_problem(problem, "pt", "tau", "reduced", "closed loop", None, None)
    size = 1 if angles is None else len(angles)
    table = {name: np.full(size, value) for name, value in setup.defaults.items()}
    if angles is not None:
        table["theta"] = angles
    return setup, Batch(setup.initial(table), completed_parameters(setup, problem, table), setup.edges(table))


def scipy_loop(problem: Problem, method: str, rtol: float, angles: Array | None = None) -> Array:
    """End positions (2 × N) by ``solve_ivp`` on a lambdified right-hand side, restarted at the gain's kink."""
    from scipy.integrate import solve_ivp

    setup, batch = reduced(problem, angles)
    function = lambdified(setup.system)
    ends = []
    for i in range(batch.size):
        values, state = batch.parameters[:, i].tolist(), batch.initial[:, i]
        for a, b in itertools.pairwise(batch.edges[:, i]):
            solution = solve_ivp(
                lambda t, x, p=values: function(t, x, p), (a, b), state, method=method, rtol=rtol, atol=rtol / 10
            )
            state = solution.y[:, -1]
        ends.append(state[:2])
    return np.array(ends).T


def heyoka_loop(problem: Problem, angles: Array, cores: int, tolerance: float) -> Callable[[], Array]:
    """A function for the end positions (2 × N) with heyoka alone: batches, two pieces, one integrator a thread.

    N must be a multiple of the batches' width; building is done before.
    """
    from ptproof.simulation.engines import taylor

    setup, batch = reduced(problem, angles)
    initial, values, edges = batch.initial, batch.parameters, batch.edges
    solvers = [
        taylor.batched(taylor.chosen(setup.system, float((a + b) / 2), tuple(values[:, 0].tolist()), True), tolerance)
        for a, b in zip(edges[:-1, 0], edges[1:, 0], strict=True)
    ]
    threads = [[copy.deepcopy(solver) for solver in solvers] for _ in range(cores)]
    width = taylor.WIDTH
    ends = np.empty((2, batch.size))

    def work(first: int, own: list[Any]) -> None:
        for start in range(first * width, batch.size, cores * width):
            group = slice(start, start + width)
            state = initial[:, group]
            for piece, solver in enumerate(own):
                solver.set_time(edges[piece, group])
                solver.state[:], solver.pars[:] = state, values[: len(solver.pars), group]
                solver.propagate_until(edges[piece + 1, group].tolist())
                state = solver.state
            ends[:, group] = state[:2]

    def everything() -> Array:
        with ThreadPoolExecutor(cores) as pool:
            list(pool.map(work, range(cores), threads))
        return ends

    return everything
