"""The one door: simulate a problem or a system."""

from __future__ import annotations

import time as clock
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ptproof.errors import InputError
from ptproof.problem import Problem, example
from ptproof.problem import parameters as loop_parameters
from ptproof.simulation.engines import engine_named, has_heyoka
from ptproof.simulation.ensembles import Progress, members, run_blocks
from ptproof.simulation.plan import Array, Batch, Outcome, Plan
from ptproof.simulation.setup import (
    Setup,
    as_float,
    by_name,
    completed_parameters,
    from_problem,
    from_system,
    with_filter,
)
from ptproof.simulation.trajectory import Ensemble, Trajectory
from ptproof.system import System

_HEADINGS = (0.0, 2 * np.pi)
# A thousandth of a second or so each with CasADi; from here on the fast engine is worth its compilation.
_MANY_TURNS = 3000


def simulate(
    target: Problem | System | str,
    seeker: str = "pt",
    frame: str = "t",
    *,
    coordinates: str = "full",
    model: str = "closed loop",
    rtol: float = 1e-8,
    atol: float | None = None,
    engine: str | None = None,
    ensemble: int | None = None,
    seed: int = 0,
    vary: Mapping[str, Any] | None = None,
    initial: Any = None,
    parameters: Mapping[Any, Any] | None = None,
    span: tuple[Any, Any] | None = None,
    until: Any = None,
    samples: int = 1000,
    nu_end: float | None = None,
    escape_radius: float | None = None,
    max_steps: int = 50_000_000,
    time_limit: float = 60.0,
    workers: int = 1,
    client: Any = None,
    progress: Progress | None = None,
) -> Trajectory | Ensemble:
    """Simulate a seeking problem, or any system of ordinary differential equations.

    Parameters
    ----------
    target
        A :class:`Problem` (its closed loop to T), an example's name, or a :class:`System` (which needs ``initial``
        and ``span``).
    seeker, frame, coordinates
        For a problem: as for :func:`ptproof.problem.closed_loop`.
    model
        For a problem: ``closed loop``, ``reduced model`` or ``average``.
    rtol, atol
        The error asked for; the local tolerances are tighter (CVODES: 50 times, the others: 10). ``atol`` is
        ``rtol``/10 if left out.
    engine
        ``casadi``, ``lsoda``, ``radau``, ``dop853`` or ``heyoka``. Left out: CasADi; for an ensemble, and for a run
        of thousands of dither periods, heyoka where it is installed and the system has no kink in its states.
    ensemble, seed, vary
        N members instead of one; ``vary`` maps names of initial states and parameters to a pair (low, high), drawn
        from ``seed``, or to N values. Left out, a problem's members differ in their headings, over the circle.
    initial, parameters
        Values by name; for a problem they replace its own.
    span
        (start, end) for a system.
    until
        For a problem: another end than t₀ + T, in t.
    samples
        About how many intervals a trajectory has.
    nu_end
        For a gain that is never clipped: the ν at which the run stops, since no run reaches T.
    escape_radius
        The distance at which a run has escaped; 10⁶ times the initial one (or 1) if left out.
    max_steps, time_limit
        Bounds on the work of each run; past them its outcome is ``step limit``.
    workers, client
        Threads for an ensemble, or a ``distributed.Client``; neither changes the result.
    progress
        Called with the number of members that have just ended.

    Returns
    -------
    Trajectory, or Ensemble where ``ensemble`` is a number.

    Raises
    ------
    InputError
        For bad input. A run that escapes, fails or takes too long is an outcome, not an exception.

    Examples
    --------
    >>> from ptproof import simulate
    >>> run = simulate("vanishing")
    >>> str(run.outcome), round(run.final_distance, 4)
    ('reached T', 0.1788)
    >>> many = simulate("vanishing", ensemble=20, seed=1)
    >>> many.counts
    {'reached T': 20}
    """
    if isinstance(target, str):
        target = example(target)
    problem: Problem | None = None
    if isinstance(target, Problem):
        problem = target
        if span is not None:
            raise InputError("span: a problem has its own; use until= for another end")
        setup = from_problem(problem, seeker, frame, coordinates, model, until, nu_end)
        setup = _override(setup, initial, parameters)
    elif isinstance(target, System):
        setup = from_system(target, initial, span, parameters)
    else:
        raise InputError(f"simulate: expected a problem, a system or an example's name, got {type(target).__name__}")
    rtol = as_float(rtol, "rtol")
    size = 1 if ensemble is None else ensemble
    if vary and ensemble is None:
        raise InputError("vary: needs ensemble=, the number of members")
    if ensemble is not None and not vary:
        if problem is None or "theta" not in setup.free:
            raise InputError("vary: say what differs between the members, such as {'x': (-1, 1)}")
        vary = {"theta": _HEADINGS}
    varied = members(size, seed, vary or {}, setup.free)
    rows = np.repeat(np.array(list(setup.defaults.values()), dtype=float)[:, None], size, axis=1)
    table: dict[str, Array] = dict(zip(setup.defaults, rows, strict=True)) | varied
    if problem is not None:
        table = with_filter(problem, table)
    _check_values(setup, problem, varied)
    batch = Batch(setup.initial(table), completed_parameters(setup, problem, table), setup.edges(table))
    plan = _plan(setup, batch, samples, rtol, atol, escape_radius, max_steps, time_limit, table)
    chosen = engine or _default_engine(setup, table, batch, ensemble is not None)
    solver = engine_named(chosen)
    settings: dict[str, Any] = {
        "example": problem.name if problem is not None else setup.system.name,
        "engine": chosen, "rtol": rtol, "atol": plan.atol, "values": dict(setup.defaults),
    }  # fmt: skip
    if problem is not None:
        settings |= {"seeker": seeker, "frame": frame, "coordinates": coordinates, "model": model}
    states = tuple(symbol.name for symbol in setup.system.state)
    begin = clock.perf_counter()
    if ensemble is None:
        run = solver.trajectory(plan, batch)
        seconds = clock.perf_counter() - begin
        return _trajectory(setup, plan, states, run, seconds, settings)
    finals = run_blocks(chosen, plan, batch, workers, client, progress)
    seconds = clock.perf_counter() - begin
    outcomes = finals.outcomes if setup.complete else tuple(map(_never_complete, finals.outcomes))
    t = finals.time if setup.to_t is None else setup.to_t(finals.time, table)
    return Ensemble(t, finals.x, states, outcomes, plan.distance(finals.x), varied, settings | {"seed": seed}, seconds)


def _override(setup: Setup, initial: Any, parameters: Mapping[Any, Any] | None) -> Setup:
    if initial is not None and not isinstance(initial, Mapping):
        raise InputError("initial: give a problem's initial states by name, such as {'theta': 1}")
    changes = by_name(initial or {}) | by_name(parameters or {})
    if not changes:
        return setup
    for name in changes:
        if name not in setup.free:
            raise InputError(f"initial, parameters: {name!r} is not one of {', '.join(setup.free)}")
    numbers = {name: as_float(value, name) for name, value in changes.items()}
    return replace(setup, defaults=dict(setup.defaults) | numbers)


_POSITIVE = ("k", "omega", "mu", "T", "nu_min", "epsilon", "S", "C")


def _check_values(setup: Setup, problem: Problem | None, varied: Mapping[str, Array]) -> None:
    if problem is None:
        return
    for name in _POSITIVE:
        given = setup.defaults.get(name, 1.0)
        low, high = (varied[name].min(), varied[name].max()) if name in varied else (given, given)
        if low <= 0:
            raise InputError(f"{name}: must be positive, got {low:g}")
        if name == "nu_min" and high > 1:
            raise InputError(f"nu_min: must lie in (0, 1], got {high:g}")


def _plan(
    setup: Setup, batch: Batch, samples: int, rtol: float, atol: float | None, radius: float | None,
    max_steps: int, time_limit: float, table: Mapping[str, Array],
) -> Plan:  # fmt: skip
    start = batch.initial[list(setup.position)] - np.array(setup.source)[:, None]
    reach = max(1.0, float(np.max(np.linalg.norm(start, axis=0))))
    return Plan(
        setup.system,
        samples,
        rtol,
        rtol / 10 if atol is None else as_float(atol, "atol"),
        setup.position,
        setup.source,
        1e6 * reach if radius is None else as_float(radius, "escape_radius"),
        max_steps,
        as_float(time_limit, "time_limit"),
        _tightening(setup, batch, table),
    )


def _tightening(setup: Setup, batch: Batch, table: Mapping[str, Array]) -> float:
    """A hundred radians are within the tolerances' own margin; further turns of heading and dither tighten them."""
    if loop_parameters.omega not in (setup.system.parameters or ()):
        return 1.0
    radians = _radians(setup, table, batch) + float(np.max(np.abs(table.get("theta", np.zeros(1)))))
    return 10.0 ** -max(0, int(np.ceil(np.log10(max(radians, 1.0) / 100))))


def _radians(setup: Setup, table: Mapping[str, Array], batch: Batch) -> float:
    """How far the dither turns in a run, for the first member, which stands for all in choices of speed."""
    if setup.to_tau is None:
        return 0.0
    values = {name: entries[0] for name, entries in table.items()}
    first, last = setup.to_tau(batch.edges[[0, -1], 0], values)
    return float(values["omega"] * (last - first))


def _default_engine(setup: Setup, table: Mapping[str, Array], batch: Batch, many: bool) -> str:
    """heyoka where it can follow the system and its steps, bounded by the filter's μ, are worth it; else CasADi."""
    if not has_heyoka():
        return "casadi"
    if setup.to_tau is not None:
        radians = _radians(setup, table, batch)
        turns = radians / (2 * np.pi)
        if not many and turns < _MANY_TURNS:
            return "casadi"
        # An explicit method can't step over more than a few μ; CasADi's implicit one takes some hundred steps a turn.
        if radians / (6 * table["mu"][0] * table["omega"][0]) > 300 * max(turns, 10.0):
            return "casadi"
    elif not many:
        return "casadi"
    from ptproof.simulation.engines.taylor import follows

    lengths = np.diff(batch.edges, axis=0) > 0
    alike = bool(np.all(lengths == lengths[:, :1]))
    return "heyoka" if alike and follows(setup.system, batch.edges.shape[0] > 2) else "casadi"


def _never_complete(outcome: Outcome) -> Outcome:
    return Outcome.STEP_LIMIT if outcome is Outcome.REACHED else outcome


def _trajectory(
    setup: Setup, plan: Plan, states: tuple[str, ...], run: Any, seconds: float, settings: Any
) -> Trajectory:
    values = dict(setup.defaults)
    outcome, message = run.outcome, run.message
    if not setup.complete and outcome is Outcome.REACHED:
        outcome, message = _never_complete(outcome), setup.note
    t = run.time if setup.to_t is None else setup.to_t(run.time, values)
    tau = None if setup.to_tau is None else setup.to_tau(run.time, values)
    position = run.x[list(setup.position)]
    return Trajectory(
        t, run.x, states, outcome, float(plan.distance(run.x[:, -1])), message, tau,
        None if setup.field_at is None else setup.field_at(position),
        {} if setup.inputs_at is None else setup.inputs_at(t, run.x, values), settings, seconds,
    )  # fmt: skip
