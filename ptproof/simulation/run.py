"""The door: one run of a question, or an ensemble of runs."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Unpack

import numpy as np

from ptproof.errors import InputError
from ptproof.problem import Problem
from ptproof.problem import parameters as loop_parameters
from ptproof.simulation.engines import fitting
from ptproof.simulation.ensembles import Progress, engine_for, members, run_blocks
from ptproof.simulation.plan import Array, Batch, Paths, Plan, Work
from ptproof.simulation.question import Options, Question, asked
from ptproof.simulation.sampled import NOISE_SEED, noise_seeds
from ptproof.simulation.settings import Outcome, Settings, Stop
from ptproof.simulation.setup import Setup
from ptproof.simulation.trajectory import Ensemble, Trajectory
from ptproof.system import System

_HEADINGS = (0.0, 2 * np.pi)
Target = Question | Problem | System | str


def simulate(
    target: Target, seeker: str | None = None, frame: str | None = None, **options: Unpack[Options]
) -> Trajectory:
    """Simulate a seeking problem, or any system of ordinary differential equations, once.

    Parameters
    ----------
    target
        A :class:`Problem` (its closed loop to T), an example's name, a :class:`System` (which needs ``initial`` and
        ``span``), or a whole :class:`Question`.
    seeker, frame
        For a problem: the prescribed-time seeker, ``pt``, and the time ``t`` if left out.
    options
        Whatever else :class:`Question` and :class:`Settings` hold, such as ``model="average"`` or ``rtol=1e-10``;
        ``settings=`` takes a whole :class:`Settings`.

    Returns
    -------
    Trajectory
        A run that escapes, fails or takes too long is an outcome, not an exception.

    Raises
    ------
    InputError
        For bad input.

    Examples
    --------
    >>> from ptproof import simulate
    >>> run = simulate("vanishing")
    >>> str(run.outcome), round(run.final_distance, 4)
    ('reached T', 0.1788)
    >>> simulate("vanishing", "asymptotic", frame="tau", model="average", samples=10)
    Trajectory(x1, x2; 11 samples to t = 1, reached T, final distance 3.05549)
    """
    question, settings = asked(target, {**options, "seeker": seeker, "frame": frame})
    job = (_once if question.plain else prepared)(question, settings)
    begin = clock.perf_counter()
    run = engine_for(job.plan, job.engine).trajectory(job.plan, job.batch)
    return _trajectory(job, run, clock.perf_counter() - begin)


def ensemble(
    target: Target,
    size: int,
    seeker: str | None = None,
    frame: str | None = None,
    *,
    seed: int = 0,
    vary: Mapping[str, Any] | None = None,
    workers: int = 1,
    client: Any = None,
    progress: Progress | None = None,
    **options: Unpack[Options],
) -> Ensemble:
    """Simulate a problem or a system many times, with something that differs between the members.

    Parameters
    ----------
    target, seeker, frame, options
        As for :func:`simulate`.
    size
        The number of members N.
    seed, vary
        ``vary`` maps names of initial states and parameters to a pair (low, high), drawn from ``seed``, or to N
        values. Left out, a problem's members differ in their headings, over the circle.
    workers, client
        Threads, or a ``distributed.Client``; neither changes the result.
    progress
        Called with the number of members that have just ended.

    Returns
    -------
    Ensemble
        With an outcome for each member; bad input raises :class:`InputError`.

    Examples
    --------
    >>> from ptproof import ensemble
    >>> many = ensemble("vanishing", 20, seed=1)
    >>> many.counts
    {'reached T': 20}
    """
    question, settings = asked(target, {**options, "seeker": seeker, "frame": frame})
    setup = question.setup()
    varied = _varied(question, setup, size, seed, vary)
    job = prepared(question, settings, setup, size, varied)
    begin = clock.perf_counter()
    finals = run_blocks(job.engine, job.plan, job.batch, workers, client, progress)
    seconds = clock.perf_counter() - begin
    outcomes = tuple(job.ended.outcome if outcome is Outcome.REACHED else outcome for outcome in finals.outcomes)
    t = finals.time if setup.to_t is None else setup.to_t(finals.time, job.table)
    x = finals.x if setup.shift is None else _shifted(setup, finals.x, t)
    return Ensemble(
        t, x, job.states, outcomes, job.plan.distance(finals.x), varied, job.about | {"seed": seed}, seconds
    )


def average_beside(
    target: Problem, vehicle: Trajectory, seeker: str | None = None, **options: Unpack[Options]
) -> Trajectory | None:
    """The average of a problem's closed loop over the same time as a ``vehicle``'s run, which it is not.

    None where the run is no closed loop's, or its seeker has no average. What is measured with noise, or sampled, is
    averaged as if it were not.
    """
    about = vehicle.settings
    if about.get("model") != "closed loop" or not target.seeker(about["seeker"]).averaged:
        return None
    ideal: Any = {name: value for name, value in options.items() if name not in _OF_THE_VEHICLE}
    return simulate(target, about["seeker"], about["frame"], **(ideal | {"model": "average"}))


_OF_THE_VEHICLE = {"model", "frame", "engine", "sample_time", "noise", "noise_seed", "coordinates"}


def _varied(question: Question, setup: Setup, size: int, seed: int, vary: Mapping[str, Any] | None) -> dict[str, Array]:
    """What differs, by name (N each): a problem's headings where nothing is named, and the noise."""
    if not vary:
        if question.problem is None or "theta" not in setup.free:
            raise InputError("vary: say what differs between the members, such as {'x': (-1, 1)}")
        vary = {"theta": _HEADINGS}
    varied = members(size, seed, vary, setup.free)
    if question.sampled and NOISE_SEED.name not in varied:
        varied |= {NOISE_SEED.name: noise_seeds(size, seed, question.noise_seed)}
    return varied


@dataclass(frozen=True)
class Job:
    """A question made ready for an engine: its values by name (N each), what the engine is given, and how a run that
    comes to its end has ended."""

    setup: Setup
    table: Mapping[str, Array]
    batch: Batch
    plan: Plan
    engine: str
    about: dict[str, Any]
    ended: Stop

    @property
    def states(self) -> tuple[str, ...]:
        return tuple(symbol.name for symbol in self.setup.system.state)

    def way(self, workers: int) -> Paths:
        """All members' states on the way, in the system's own time."""
        return engine_for(self.plan, self.engine).paths(self.plan, self.batch, workers)


def prepared(
    question: Question, settings: Settings, setup: Setup | None = None, size: int = 1,
    varied: Mapping[str, Array] | None = None,
) -> Job:  # fmt: skip
    """A question made ready, with ``size`` members that differ in what is ``varied``."""
    setup, problem, varied = setup or question.setup(), question.problem, varied or {}
    rows = np.repeat(np.array(list(setup.defaults.values()), dtype=float)[:, None], size, axis=1)
    table = setup.completed(dict(zip(setup.defaults, rows, strict=True)) | dict(varied))
    if problem is not None:
        _check_values(setup, varied)
    batch = setup.batch(table)
    work = _work(setup, table, batch, bool(varied))
    plan = Plan(
        setup.system, settings, setup.position, setup.source, _escape_radius(setup, batch, settings),
        _tightening(setup, table, work.radians or 0.0), setup.conditions, setup.sampling,
    )  # fmt: skip
    engine = _engine(plan, batch, work)
    about: dict[str, Any] = {
        "example": setup.system.name if problem is None else problem.name, "engine": engine, "rtol": settings.rtol,
        "atol": settings.absolute, "values": dict(setup.defaults),
    }  # fmt: skip
    if problem is not None:
        about |= {name: getattr(question, name) for name in ("seeker", "frame", "coordinates", "model")}
        about |= {} if question.motion is None else {"motion": tuple(map(str, question.motion))}
    return Job(setup, table, batch, plan, engine, about, setup.ended(table))


def _engine(plan: Plan, batch: Batch, work: Work) -> str:
    asked_for = plan.settings.engine
    if plan.sampling is None:
        return asked_for or fitting(plan, batch, work)
    if asked_for is not None:
        raise InputError(
            f"engine: {asked_for} integrates, but a sampled loop has a way of its own; leave the engine out"
        )
    return "sampled"


_once = lru_cache(maxsize=64)(prepared)
_POSITIVE = tuple(name.name for name in vars(loop_parameters).values() if getattr(name, "is_positive", False))


def _check_values(setup: Setup, varied: Mapping[str, Array]) -> None:
    for name in _POSITIVE:
        given = setup.defaults.get(name, 1.0)
        low, high = (varied[name].min(), varied[name].max()) if name in varied else (given, given)
        if low <= 0:
            raise InputError(f"{name}: must be positive, got {low:g}")
        if name == "nu_min" and high > 1:
            raise InputError(f"nu_min: must lie in (0, 1], got {high:g}")


def _escape_radius(setup: Setup, batch: Batch, settings: Settings) -> float:
    if settings.escape_radius is not None:
        return settings.escape_radius
    away = sum((batch.initial[i] - centre) ** 2 for i, centre in zip(setup.position, setup.source, strict=True))
    return 1e6 * max(1.0, math.sqrt(np.max(away)))


def _work(setup: Setup, table: Mapping[str, Array], batch: Batch, many: bool) -> Work:
    """What the first member costs, which stands for all in choices of speed."""
    if setup.to_tau is None:
        return Work(many)
    values = {name: entries[0] for name, entries in table.items()}
    first, last = setup.to_tau(batch.edges[[0, -1], 0], values)
    radians = float(values["omega"] * (last - first))
    return Work(many, radians, radians / float(values["mu"] * values["omega"]))


def _tightening(setup: Setup, table: Mapping[str, Array], radians: float) -> float:
    """A hundred radians are within the tolerances' own margin; further turns of heading and dither tighten them."""
    if loop_parameters.omega not in (setup.system.parameters or ()):
        return 1.0
    turned = radians + (float(np.max(np.abs(table["theta"]))) if "theta" in table else 0.0)
    return 10.0 ** -max(0, math.ceil(math.log10(max(turned, 1.0) / 100)))


def _trajectory(job: Job, run: Any, seconds: float) -> Trajectory:
    setup, values = job.setup, job.setup.defaults
    stop = job.ended if run.stop.outcome is Outcome.REACHED else run.stop
    t = run.time if setup.to_t is None else setup.to_t(run.time, values)
    tau = None if setup.to_tau is None else setup.to_tau(run.time, values)
    position, inputs = run.x[list(setup.position)], run.inputs
    if inputs is None:
        inputs = {} if setup.inputs_at is None else setup.inputs_at(t, run.x, values)
    source, x = None, run.x
    if setup.field_at is not None:
        source = np.array([[entry] * len(t) for entry in setup.source])
        if setup.shift is not None:
            source, x = source + setup.shift(t), _shifted(setup, run.x, t)
    return Trajectory(
        t, x, job.states, stop.outcome, job.plan.away(run.x[:, -1]), stop.message, tau,
        None if setup.field_at is None else setup.field_at(position), inputs, dict(job.about), seconds, stop.limit,
        source,
    )  # fmt: skip


def _shifted(setup: Setup, x: Array, t: Array) -> Array:
    """States relative to a source that moves, as they are for who stands still."""
    assert setup.shift is not None
    moved = x.copy()
    moved[list(setup.position)] += setup.shift(t)
    return moved
