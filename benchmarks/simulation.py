"""Benchmarks in one run, each checked against a better reference: ``python -m benchmarks.simulation``.

Every code solves the same problem, ``vanishing`` in τ and reduced coordinates to T, from the same right-hand side. Each
gets the loosest tolerance of a ladder at which its error is below the same limit, and the best of several runs
counts. Building and compiling are measured apart.

The accuracy of the comparison is 1e-9: tight, yet within reach of every code here. One trajectory is also compared at
1e-8, which is what ``simulate`` asks for if it is told nothing, and there with its thousand samples too, each of them
to that accuracy; and at 1e-6, without targets.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import time as clock
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.by_hand import heyoka_loop, reduced, scipy_loop, scipy_run
from benchmarks.measuring import ONE, Row, best, machine, ratios, table, targets
from ptproof.problem import Problem, example
from ptproof.simulation import Trajectory, ensemble, simulate
from ptproof.simulation.engines import installed
from ptproof.simulation.ensembles import headings
from ptproof.simulation.plan import Array

ACCURACY = 1e-9
USUAL = 1e-8
LOOSE = 1e-6
SAMPLES = 1000
_FAST = "heyoka" in installed()
# Four rungs a decade; the same for every code.
LADDER = tuple(float(f"{m}e-{e}") for e in range(2, 14) for m in (1, 0.56, 0.32, 0.18))
SMALLEST = 64
_ROUNDS = 5
_OPTIONS: Any = {"frame": "tau", "coordinates": "reduced"}


def run(members: int = 10_000, say: Callable[[str], None] = lambda _: None) -> dict[str, Any]:
    """All items, as JSON-ready data with a description of the machine; ``say`` gets a line before each."""
    begin, about = clock.perf_counter(), machine()
    problem = example("vanishing")
    say("reference")
    truth = _truth(problem)[:, -1]
    independent = np.asarray(_run(problem, engine="dop853", rtol=1e-13).x[:2, -1])
    say("building and compiling")
    rows = building(problem)
    say("one trajectory")
    rows += one_trajectory(problem)
    rows += one_trajectory(problem, (USUAL,), SAMPLES)
    say(f"{members} trajectories")
    rows += many(problem, members, _rung(rows))
    rows += growth(problem, say)
    found = ratios(rows)
    return {
        "command": "python -m benchmarks.simulation", "machine": about, "accuracy": ACCURACY,
        "members": members, "reference": {
            "code": "Taylor method at 1e-13" if _FAST else "DOP853 at 1e-13",
            "difference to DOP853 at 1e-13": float(np.max(np.abs(truth - independent))),
        },
        "rows": [vars(row) for row in rows], "ratios": found, "targets": targets(found),
        "seconds": round(clock.perf_counter() - begin, 1),
    }  # fmt: skip


def _run(problem: Problem, **options: Any) -> Trajectory:
    return simulate(problem, **(_OPTIONS | {"samples": 1} | options))


def _truth(problem: Problem, samples: int = 1) -> Array:
    """Positions (2 × m) from an independent high-order code at 1e-13 (DOP853), or the Taylor method's best."""
    engine = "heyoka" if _FAST else "dop853"
    return np.asarray(_run(problem, engine=engine, rtol=1e-13, samples=samples).x[:2, 1:])


def building(problem: Problem) -> list[Row]:
    """What happens once: translating, building and compiling; a second run of the same system builds nothing."""
    from ptproof.simulation.engines import casadi
    from ptproof.simulation.runge_kutta import trial, trials

    for made in (casadi.integrator, trials, trial):
        made.cache_clear()
    rows = []
    for code in ("casadi", *(["heyoka"] if _FAST else [])):
        if code == "heyoka":
            from ptproof.simulation import smooth, taylor_form
            from ptproof.simulation.engines import heyoka

            smooth.picker.cache_clear()
            heyoka.scalar.cache_clear()
            taylor_form.equations.cache_clear()
        begin = clock.perf_counter()
        _run(problem, engine=code)
        first = clock.perf_counter() - begin
        again = best(partial(_run, problem, engine=code, parameters={"k": 2}))
        rows.append(Row("building", code, first - again, note="first run less a later one with other values"))
    built = casadi.integrator.cache_info().misses
    _run(problem, parameters={"omega": 40, "mu": 0.002})
    assert casadi.integrator.cache_info().misses == built, "a second run must build nothing"
    return rows


def one_trajectory(
    problem: Problem, accuracies: tuple[float, ...] = (ACCURACY, USUAL, LOOSE), samples: int = 1
) -> list[Row]:
    """One trajectory at the same accuracy by each code; CasADi and heyoka as whole calls of ``simulate``.

    The error is that of the end, or the largest one of all samples where they are asked for. Whole calls are in
    seconds of the processor, so that other people's work does not count.
    """
    (setup, batch), kept = reduced(problem), slice(-1 if samples == 1 else 0, None)

    def ours(engine: str, rtol: float) -> Array:
        return _run(problem, engine=engine, rtol=rtol, samples=samples).x[:2, 1:][:, kept]

    codes: dict[str, Callable[[float], Array]] = {
        "casadi": partial(ours, "casadi"),
        "lsoda": lambda rtol: scipy_run(setup, batch, "LSODA", rtol, samples)[:, kept],
        "radau": lambda rtol: scipy_run(setup, batch, "Radau", rtol, samples)[:, kept],
    }
    if _FAST:
        codes["heyoka"] = partial(ours, "heyoka")
    truth = _truth(problem, samples)[:, kept]
    met = {code: _tolerances(work, truth, accuracies) for code, work in codes.items()}
    rows = []
    for accuracy in accuracies:
        # In turns, so that a busy moment of the machine does not fall on one code alone; the best of all counts.
        whole, inside = dict.fromkeys(codes, np.inf), dict.fromkeys(codes, np.inf)
        for _ in range(_ROUNDS):
            for code, work in codes.items():
                rtol = met[code][accuracy][0]
                whole[code] = min(whole[code], best(partial(work, rtol), 20, 0.2, clock.thread_time))
                if code in ("casadi", "heyoka"):
                    runs = (_run(problem, engine=code, rtol=rtol, samples=samples) for _ in range(9))
                    inside[code] = min(inside[code], *(run.seconds for run in runs))
        item = ONE + (f"to {accuracy:.0e}" if samples == 1 else f"with {samples} samples to {accuracy:.0e}")
        for code in codes:
            rtol, error = met[code][accuracy]
            rows.append(Row(item, code, whole[code], error, rtol))
            if np.isfinite(inside[code]):
                rows.append(Row(item, f"{code}, integration alone", inside[code], error, rtol))
    return rows


def _tolerances(
    work: Callable[[float], Array], truth: Array, accuracies: tuple[float, ...]
) -> dict[float, tuple[float, float]]:
    """For each accuracy the loosest tolerance of the ladder that meets it, and the error there."""
    met: dict[float, tuple[float, float]] = {}
    for rtol in LADDER:
        error = float(np.max(np.abs(work(rtol) - truth)))
        met |= {accuracy: (rtol, error) for accuracy in accuracies if accuracy not in met and error <= accuracy}
        if len(met) == len(accuracies):
            return met
    raise RuntimeError("no tolerance of the ladder meets the accuracy")


def _rung(rows: list[Row]) -> dict[str, float]:
    item = f"{ONE}to {ACCURACY:.0e}"
    return {row.code: row.rtol for row in rows if row.item == item and row.rtol is not None}


def many(problem: Problem, members: int, rungs: dict[str, float]) -> list[Row]:
    """Many trajectories, all headings, to the accuracy: the ensemble and heyoka by hand on all cores, SciPy's loop.

    ``rungs`` are the tolerances at which SciPy's codes reach the accuracy for one heading; they are tightened until
    each heading that is looked at has it.
    """
    cores = os.cpu_count() or 1
    members -= members % 8
    angles = headings(members)
    picked = np.arange(4) * (members // 4) + 1
    truth = np.array(
        [_run(problem, engine="dop853", rtol=1e-13, initial={"theta": a}).x[:2, -1] for a in angles[picked]]
    ).T
    options: Any = _OPTIONS | {"workers": cores, "rtol": ACCURACY}

    def ends(engine: str, angles: Array) -> Array:
        return ensemble(problem, len(angles), engine=engine, vary={"theta": angles}, **options).x[:2]

    def error(found: Array) -> float:
        return float(np.max(np.abs(found - truth)))

    rows = []
    few = angles[:: max(1, members // 256)]
    casadi = error(ends("casadi", angles[picked]))
    if _FAST:
        both: list[Callable[[], Array]] = [
            partial(ends, "heyoka", angles),
            heyoka_loop(problem, angles, cores, ACCURACY),
        ]
        errors = [error(work()[:, picked]) for work in both]
        seconds = [np.inf, np.inf]
        for _ in range(_ROUNDS):
            seconds = [min(old, best(work, 1)) for old, work in zip(seconds, both, strict=True)]
        threads = f"{members} members, {cores} threads"
        rows.append(Row("many", "ptproof", seconds[0] / members, errors[0], ACCURACY, threads))
        rows.append(Row("many", "heyoka by hand", seconds[1] / members, errors[1], ACCURACY, threads))
    seconds_casadi = best(partial(ends, "casadi", few), 3, 6) / len(few)
    note = f"{len(few)} members, {cores} threads"
    rows.append(Row("many", "ptproof with casadi", seconds_casadi, casadi, ACCURACY, note))
    for name in ("LSODA", "Radau"):
        code = name.lower()
        for rtol in (rung for rung in LADDER if rung <= rungs[code]):
            loop = partial(scipy_loop, problem, name, rtol, angles[picked])
            if (found := error(loop())) <= ACCURACY:
                break
        seconds_loop = best(loop, 3, 6) / len(picked)
        rows.append(
            Row("many", f"{code} loop", seconds_loop, found, rtol, f"{len(picked)} of the loop's runs, one core")
        )
    return rows


def growth(problem: Problem, say: Callable[[str], None] = lambda _: None) -> list[Row]:
    """How the time grows with the number of members, with ω, with 1/μ, and with 1/ν where an unclipped gain ends."""
    rows = []
    codes = ("casadi", "heyoka") if _FAST else ("casadi",)
    say("growth with the number of members")
    for size in (100, 1000, 10_000 if _FAST else 2000):
        options: Any = _OPTIONS | {"rtol": ACCURACY, "engine": codes[-1], "workers": os.cpu_count()}
        work: Callable[[], Any] = partial(ensemble, problem, size, vary={"theta": headings(size)}, **options)
        rows.append(Row("growth with N", f"N = {size}", best(work, 3, 4)))
    say("growth with omega and 1/mu")
    for code in codes:
        for omega in (30, 120, 480, 1920):
            work = partial(_run, problem, parameters={"omega": omega}, engine=code)
            rows.append(Row("growth with omega", f"omega = {omega}, {code}", best(work, 3)))
        for mu in (1e-2, 1e-3, 1e-4, 1e-5):
            work = partial(_run, problem, parameters={"mu": mu}, engine=code)
            rows.append(Row("growth with 1/mu", f"1/mu = {1 / mu:g}, {code}", best(work, 3)))
    say("growth with 1/nu")
    ideal = replace(problem, tuning=replace(problem.tuning, nu_min=None))
    for nu in (0.3, 0.1, 0.03, 0.01):
        for frame in ("t", "tau"):
            work = partial(_run, ideal, nu_end=nu, frame=frame)
            rows.append(Row("growth with 1/nu", f"1/nu = {1 / nu:.3g}, in {frame}", best(work, 3)))
    return rows


def main(arguments: list[str] | None = None) -> int:
    """Print the table, or with ``--json`` the data; 0, or 2 for bad use."""
    parser = argparse.ArgumentParser("python -m benchmarks.simulation", description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--json", action="store_true", help="print the data instead of the table")
    parser.add_argument("--members", type=int, default=10_000, metavar="N", help="trajectories of the ensemble (10000)")
    parser.add_argument("--out", type=Path, metavar="FILE", help="also write the data, as JSON, to FILE")
    chosen = parser.parse_args(arguments)
    if not SMALLEST <= chosen.members <= 1_000_000:
        parser.error(f"--members: expected a number from {SMALLEST} to 1000000, got {chosen.members}")
    if chosen.out is not None and not chosen.out.resolve().parent.is_dir():
        parser.error(f"--out: the folder of {chosen.out} does not exist")
    data = run(chosen.members, lambda line: print(f"benchmark: {line}", file=sys.stderr, flush=True))
    if chosen.out is not None:
        chosen.out.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
    print(json.dumps(data) if chosen.json else table(data))
    return 0


if __name__ == "__main__":
    sys.exit(main())
