"""Benchmarks in one run, each checked against a better reference: ``python -m ptproof.simulation.benchmark``.

Every code solves the same problem, ``vanishing`` in τ and reduced coordinates to T, from the same right-hand side. Each
gets the loosest tolerance of a ladder at which its error is below the same limit, and the best of several runs
counts. Building and compiling are measured apart.
"""

from __future__ import annotations

import itertools
import json
import os
import sys
import time as clock
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from ptproof.problem import Problem, example
from ptproof.simulation.engines import has_heyoka
from ptproof.simulation.engines.peers import lambdified
from ptproof.simulation.ensembles import headings
from ptproof.simulation.measuring import Row, best, machine, table
from ptproof.simulation.plan import Array
from ptproof.simulation.run import simulate
from ptproof.simulation.setup import completed_parameters, from_problem
from ptproof.simulation.trajectory import Ensemble, Trajectory

ACCURACY = 1e-6
_LADDER = (1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 3e-8, 1e-8, 1e-9, 1e-10)
_ROUNDS = 6
_OPTIONS: Any = {"frame": "tau", "coordinates": "reduced"}


def run(members: int = 10_000) -> dict[str, Any]:
    """All items, as JSON-ready data with a description of the machine."""
    problem = example("vanishing")
    truth = _truth(problem)
    rows = [*building(problem), *one_trajectory(problem, truth), *many(problem, members), *growth(problem)]
    found = {(row.item, row.code): row for row in rows}
    ratios = {}
    for code in ("casadi", "casadi, integration alone", "heyoka", "heyoka, integration alone"):
        for name in ("lsoda", "radau"):
            if ("one trajectory", code) in found:
                slow, fast = (found["one trajectory", which].seconds for which in (name, code))
                ratios[f"{name} over {code}"] = slow / fast
    if has_heyoka():
        each, hand = found["many", "ptproof"].seconds, found["many", "heyoka by hand"].seconds
        ratios["loop of lsoda over ensemble, a trajectory"] = found["many", "lsoda loop"].seconds / each
        ratios["loop of radau over ensemble, a trajectory"] = found["many", "radau loop"].seconds / each
        ratios["ensemble over heyoka by hand"] = each / hand
    return {
        "machine": machine(), "accuracy": ACCURACY, "members": members,
        "rows": [vars(row) for row in rows], "ratios": ratios,
    }  # fmt: skip


def _run(problem: Problem, **options: Any) -> Trajectory:
    result = simulate(problem, samples=1, **(_OPTIONS | options))
    assert isinstance(result, Trajectory)
    return result


def _truth(problem: Problem) -> Array:
    """End state from an independent high-order code at 1e-13 (DOP853), or the Taylor method at machine accuracy."""
    engine = "heyoka" if has_heyoka() else "dop853"
    return np.asarray(_run(problem, engine=engine, rtol=1e-13).x[:2, -1])


def building(problem: Problem) -> list[Row]:
    """What happens once: translating, building and compiling; a second run of the same system builds nothing."""
    from ptproof.simulation.engines import cvodes

    cvodes.integrator.cache_clear()
    rows = []
    for code in ("casadi", *(["heyoka"] if has_heyoka() else [])):
        if code == "heyoka":
            from ptproof.simulation.engines import taylor

            taylor.scalar.cache_clear()
            taylor.equations.cache_clear()
        begin = clock.perf_counter()
        _run(problem, engine=code)
        first = clock.perf_counter() - begin
        again = best(partial(_run, problem, engine=code, parameters={"k": 2}))
        rows.append(Row("building", code, first - again, note="first run less a later one with other values"))
    built = cvodes.integrator.cache_info().misses
    _run(problem, parameters={"omega": 40, "mu": 0.002})
    assert cvodes.integrator.cache_info().misses == built, "a second run must build nothing"
    return rows


def _solve_ivp(problem: Problem, method: str, rtol: float) -> Array:
    """What one writes by hand with SciPy: ``solve_ivp`` on a lambdified right-hand side, restarted at the clip."""
    from scipy.integrate import solve_ivp

    setup = from_problem(problem, "pt", "tau", "reduced", "closed loop", None, None)
    table = {name: np.array([value]) for name, value in setup.defaults.items()}
    values = completed_parameters(setup, problem, table)[:, 0].tolist()
    function, state = lambdified(setup.system), setup.initial(table)[:, 0]
    edges = setup.edges(table)[:, 0]
    for a, b in itertools.pairwise(edges):
        solution = solve_ivp(
            lambda t, x: function(t, x, values), (a, b), state, method=method, rtol=rtol, atol=rtol / 10
        )
        state = solution.y[:, -1]
    return np.asarray(state[:2])


def one_trajectory(problem: Problem, truth: Array) -> list[Row]:
    """One trajectory at the same accuracy by each code; CasADi and heyoka as whole calls of ``simulate``."""
    codes: dict[str, Callable[[float], Array]] = {
        "casadi": lambda rtol: _run(problem, engine="casadi", rtol=rtol).x[:2, -1],
        "lsoda": lambda rtol: _solve_ivp(problem, "LSODA", rtol),
        "radau": lambda rtol: _solve_ivp(problem, "Radau", rtol),
    }
    if has_heyoka():
        codes["heyoka"] = lambda rtol: _run(problem, engine="heyoka", rtol=rtol).x[:2, -1]
    met: dict[str, tuple[float, float]] = {}
    for code, work in codes.items():
        for rtol in _LADDER:
            error = float(np.max(np.abs(work(rtol) - truth)))
            if error <= ACCURACY:
                break
        met[code] = (rtol, error)
    # In turns, so that a busy moment of the machine does not fall on one code alone; the best of all counts.
    whole, inside = dict.fromkeys(codes, np.inf), dict.fromkeys(codes, np.inf)
    for _ in range(_ROUNDS):
        for code, work in codes.items():
            rtol = met[code][0]
            whole[code] = min(whole[code], best(partial(work, rtol), 10, 0.2))
            if code in ("casadi", "heyoka"):
                inside[code] = min(inside[code], *(_run(problem, engine=code, rtol=rtol).seconds for _ in range(5)))
    rows = []
    for code, (rtol, error) in met.items():
        rows.append(Row("one trajectory", code, whole[code], error, rtol))
        if np.isfinite(inside[code]):
            rows.append(Row("one trajectory", f"{code}, integration alone", inside[code], error, rtol))
    return rows


def many(problem: Problem, members: int) -> list[Row]:
    """Many trajectories, all headings, on all cores: the ensemble, heyoka by hand, and a SciPy loop."""
    cores = os.cpu_count() or 1
    vary = {"theta": headings(members)}
    rows = []
    options: Any = _OPTIONS | {"vary": vary, "ensemble": members, "workers": cores, "rtol": 1e-6}
    engine = "heyoka" if has_heyoka() else "casadi"
    simulate(problem, engine=engine, **(options | {"ensemble": 64, "vary": {"theta": headings(64)}}))

    def ensemble() -> Ensemble:
        result = simulate(problem, engine=engine, **options)
        assert isinstance(result, Ensemble)
        return result

    result = ensemble()
    picked = [0, members // 3, members - 1]
    error = max(
        abs(
            _run(problem, engine="casadi", rtol=1e-10, initial={"theta": vary["theta"][i]}).final_distance
            - float(result.distances[i])
        )
        for i in picked
    )
    rows.append(Row("many", "ptproof", best(ensemble, 3, 10) / members, error, 1e-6, f"{engine}, {cores} threads"))
    if has_heyoka():
        rows.append(Row("many", "heyoka by hand", best(_by_hand(problem, vary["theta"], cores), 3, 10) / members))
    few = 256
    casadi: Any = options | {"ensemble": few, "vary": {"theta": headings(few)}}
    rows.append(
        Row("many", "ptproof with casadi", best(lambda: simulate(problem, engine="casadi", **casadi), 2, 5) / few)
    )
    for name in ("LSODA", "Radau"):
        seconds = best(partial(_solve_ivp, problem, name, 1e-6), 3, 4)
        rows.append(Row("many", f"{name.lower()} loop", seconds, note="one of the loop's runs, on one core"))
    return rows


def _by_hand(problem: Problem, angles: Array, cores: int) -> Callable[[], Any]:
    """The loop that one writes with heyoka alone: batches, two pieces, one integrator a thread."""
    import copy

    import heyoka as hy

    from ptproof.simulation.engines import taylor

    setup = from_problem(problem, "pt", "tau", "reduced", "closed loop", None, None)
    size = len(angles)
    table = {name: np.full(size, value) for name, value in setup.defaults.items()} | {"theta": angles}
    values, initial, edges = completed_parameters(setup, problem, table), setup.initial(table), setup.edges(table)
    width = hy.recommended_simd_size()
    solvers = [
        taylor.batched(taylor.chosen(setup.system, float((a + b) / 2), tuple(values[:, 0].tolist()), True), 1e-7)
        for a, b in zip(edges[:-1, 0], edges[1:, 0], strict=True)
    ]

    def work(first: int, own: list[Any]) -> None:
        for start in range(first * width, size - width + 1, cores * width):
            state = initial[:, start : start + width]
            for piece, solver in enumerate(own):
                solver.set_time(edges[piece, start : start + width])
                solver.state[:], solver.pars[:] = state, values[: len(solver.pars), start : start + width]
                solver.propagate_until(edges[piece + 1, start : start + width].tolist())
                state = solver.state

    def everything() -> None:
        with ThreadPoolExecutor(cores) as pool:
            list(pool.map(work, range(cores), [[copy.deepcopy(s) for s in solvers] for _ in range(cores)]))

    return everything


def growth(problem: Problem) -> list[Row]:
    """How the time grows with the number of members, with ω, with 1/μ, and with 1/ν where an unclipped gain ends."""
    rows = []
    codes = ("casadi", "heyoka") if has_heyoka() else ("casadi",)
    for size in (100, 1000, 10_000 if has_heyoka() else 2000):
        options: Any = _OPTIONS | {
            "vary": {"theta": headings(size)},
            "ensemble": size,
            "rtol": 1e-6,
            "engine": codes[-1],
        }
        rows.append(Row("growth with N", f"N = {size}", best(partial(simulate, problem, **options), 2, 4)))
    for code in codes:
        for omega in (30, 120, 480, 1920):
            work = partial(_run, problem, parameters={"omega": omega}, engine=code)
            rows.append(Row("growth with omega", f"omega = {omega}, {code}", best(work, 2)))
        for mu in (1e-2, 1e-3, 1e-4, 1e-5):
            work = partial(_run, problem, parameters={"mu": mu}, engine=code)
            rows.append(Row("growth with 1/mu", f"1/mu = {1 / mu:g}, {code}", best(work, 2)))
    ideal = replace(problem, tuning=replace(problem.tuning, nu_min=None))
    for nu in (0.3, 0.1, 0.03, 0.01):
        for frame in ("t", "tau"):
            work = partial(_run, ideal, nu_end=nu, frame=frame)
            rows.append(Row("growth with 1/nu", f"1/nu = {1 / nu:.3g}, in {frame}", best(work, 2)))
    return rows


def main(arguments: list[str]) -> None:
    """Print the table, or with ``--json`` the data."""
    data = run()
    print(json.dumps(data) if "--json" in arguments else table(data))


if __name__ == "__main__":
    main(sys.argv[1:])
