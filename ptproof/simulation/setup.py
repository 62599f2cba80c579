"""From a problem, or a system, to what an engine is asked: parameters, time span, kinks and initial states by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache, partial
from typing import Any

import numpy as np
import sympy as sp
from sympy.core.relational import Relational

from ptproof.errors import InputError
from ptproof.problem import TAU, TIME, Problem, parameters
from ptproof.problem.loops import check_word
from ptproof.problem.moving import motion_of, moving_source
from ptproof.simulation.numbers import as_float, by_name
from ptproof.simulation.plan import Array, Batch, Sampling
from ptproof.simulation.quantities import field_function, input_function, motion_function, time_map
from ptproof.simulation.sampled import sampled as sampled_loop
from ptproof.simulation.settings import Limit, Outcome, Stop
from ptproof.simulation.switches import between_switches
from ptproof.system import System
from ptproof.transforms import CappedClock, Clock

_NU = sp.Symbol("nu", positive=True)
# The models of a problem, and how close an unclipped gain, infinite at T, is followed towards it.
NU_END = {"closed loop": 0.01, "reduced model": 0.01, "average": 1e-4}


@dataclass(frozen=True)
class Setup:
    """One question to an engine, with everything by name.

    Attributes
    ----------
    system
        With symbolic parameters.
    defaults
        The value of each parameter and of each initial state that is not computed from others, by name.
    edges
        Start, kinks and end (q × N) from a table of values by name (N each).
    position
        Indices of the states whose distance to ``source`` counts.
    ended
        From a completed table how a run that came to its end has ended, and in what words: at T, before it where that
        was asked for, or at the limit of a gain that is infinite there.
    conditions
        The conditions of the choices in ``system`` that change at the edges between start and end, and nowhere else.
    to_t, to_tau
        Maps between the run's own time and t, τ for arrays, given the parameters of one member.
    sampling
        How the loop is sampled, if it is.
    shift
        Where the source moves: how far from its place it is, (n × …) for times t. States are relative to it.
    completed
        From a table with the defaults' names, in which positions are the user's, to one with those of all states and
        parameters.
    """

    system: System
    defaults: Mapping[str, float]
    edges: Callable[[Mapping[str, Array]], Array]
    position: tuple[int, ...]
    source: tuple[float, ...]
    ended: Callable[[Mapping[str, Array]], Stop] = lambda table: Stop()
    to_t: Callable[[Array, Mapping[str, Any]], Array] | None = None
    to_tau: Callable[[Array, Mapping[str, Any]], Array] | None = None
    field_at: Callable[[Array], Array] | None = None
    inputs_at: Callable[[Array, Array, Mapping[str, float]], dict[str, Array]] | None = None
    free: tuple[str, ...] = ()
    conditions: tuple[Relational, ...] = ()
    sampling: Sampling | None = None
    shift: Callable[[Array], Array] | None = None
    completed: Callable[[Mapping[str, Array]], dict[str, Array]] = dict

    def batch(self, table: Mapping[str, Array]) -> Batch:
        """The members of a completed table (N values a name) as an engine takes them, in the system's order."""
        size = len(next(iter(table.values())))
        states, values = (
            np.array([table[symbol.name] for symbol in symbols]).reshape(len(symbols), size)
            for symbols in (self.system.state, self.system.parameters or ())
        )
        return Batch(states, values, self.edges(table))


def from_system(system: System, initial: Any, span: tuple[Any, Any] | None, values: Mapping[Any, Any] | None) -> Setup:
    """The setup of a bare system: initial states in order or by name, the time span, and the parameters by name."""
    if system.undefined_functions:
        undefined = ", ".join(map(str, system.undefined_functions))
        raise InputError(f"{system.name}: {undefined} undefined; put expressions in with with_values before simulating")
    states = [symbol.name for symbol in system.state]
    if initial is None or span is None:
        raise InputError(f"{system.name}: a system needs initial= (states {', '.join(states)}) and span=(start, end)")
    if isinstance(initial, Mapping):
        given = by_name(initial)
    else:
        entries: list[Any] = list(initial)
        if len(entries) != len(states):
            raise InputError(f"initial: {len(entries)} numbers for {len(states)} states ({', '.join(states)})")
        given = dict(zip(states, entries, strict=True))
    parameters_given: dict[str, Any] = by_name(values or {})
    names = [symbol.name for symbol in system.parameters or ()]
    for what, found, wanted in (("initial", given, states), ("parameters", parameters_given, names)):
        if absent := [name for name in wanted if name not in found]:
            raise InputError(f"{what}: no value for {', '.join(absent)}")
        extra = [name for name in found if name not in wanted]
        if extra:
            raise InputError(f"{what}: {', '.join(extra)} is not one of {', '.join(wanted) or 'none'}")
    if len(span) != 2:
        raise InputError("span: expected (start, end)")
    start, end = (as_float(value, "span") for value in span)
    if not end > start:
        raise InputError(f"span: must end after it starts, got {start:g} to {end:g}")
    defaults = {name: as_float(value, f"initial.{name}") for name, value in given.items()}
    defaults |= {name: as_float(value, f"parameters.{name}") for name, value in parameters_given.items()}

    def edges(table: Mapping[str, Array]) -> Array:
        return between_switches(system, np.outer((start, end), np.ones(len(table[states[0]]))), table)

    everything = tuple(range(system.dimension))
    return Setup(system, defaults, edges, everything, (0.0,) * len(everything), free=tuple(defaults))


def from_problem(
    given: Problem, seeker: str, frame: str, coordinates: str, model: str, until: Any, nu_end: float | None,
    motion: tuple[Any, ...] | None = None, sampled: bool = False,
) -> Setup:  # fmt: skip
    """The setup of a problem's closed loop, reduced model or average; its source may move, and the loop be sampled."""
    check_word("model", model, tuple(NU_END))
    problem = given if motion is None else moving_source(given, motion)
    shift = None if motion is None else motion_function(motion_of(given, motion))
    if model == "closed loop":
        system = problem.closed_loop(seeker, frame, coordinates=coordinates, symbolic=True)
    else:
        derive = problem.reduced_model if model == "reduced model" else problem.averaged
        system = derive(seeker, frame, symbolic=True)
    states, clock, defaults = problem.states, problem.seeker_clock(seeker), dict(_defaults(given))
    last = as_float(until, "until") if until is not None else None
    ending = _Ending(clock, frame, last, nu_end, NU_END[model])
    full = model == "closed loop" and coordinates == "full"
    sampling = None
    if sampled:
        if not full or frame != "t":
            raise InputError("sample_time, noise: only the closed loop in t and in full coordinates can be sampled")
        system, sampling = sampled_loop(problem, seeker, clock, system)
    return Setup(
        system, defaults, position=(0, 1),
        edges=lambda table: between_switches(system, ending(table), table, clock.conditions),
        source=tuple(map(float, problem.source)),
        ended=ending.ended,
        to_t=time_map(TIME, TIME) if frame == "t" else time_map(clock.to_t, TAU),
        to_tau=time_map(TAU, TAU) if frame == "tau" else time_map(clock.to_tau, TIME),
        field_at=field_function(problem.field),
        inputs_at=input_function(problem.field, problem.seeker(seeker), clock, states, system.state) if full else None,
        free=tuple(dict.fromkeys((*defaults, states.filter.name))), conditions=clock.conditions,
        sampling=sampling, shift=shift, completed=partial(_completed, given, shift),
    )  # fmt: skip


def default_sample_time(problem: Problem, seeker: str, setup: Setup) -> float:
    """A twentieth of the filter's time constant μ/K where the gain K is largest in a run with the defaults."""
    table = {name: np.array([value]) for name, value in setup.defaults.items()}
    edges = setup.edges(setup.completed(table))
    gains = time_map(problem.seeker_clock(seeker).rate, TIME)(np.linspace(edges[0, 0], edges[-1, 0], 1000), table)
    return float(setup.defaults[parameters.mu.name] / 20 / gains.max())


@lru_cache(maxsize=64)
def _defaults(problem: Problem) -> tuple[tuple[str, float], ...]:
    """Parameters and initial states as floats, by name; without z where it starts at the measured field."""
    letters, start = problem.states, problem.initial
    found = {symbol.name: float(value) for symbol, value in problem.values.items() if symbol != parameters.p0}
    found |= {symbol.name: float(value) for symbol, value in zip(problem.variables, start.x, strict=True)}
    found |= {letters.heading.name: float(start.theta), letters.angular_velocity.name: float(start.u2)}
    if start.z is not None:
        found[letters.filter.name] = float(start.z)
    return tuple(found.items())


def _completed(
    problem: Problem, shift: Callable[[Array], Array] | None, table: Mapping[str, Array]
) -> dict[str, Array]:
    """The table with positions relative to a source that moves, with the filter's start, which is the measured field
    at each member's position unless it is given, and with p₀, which follows from heading and filter."""
    heading, z = problem.states.heading.name, problem.states.filter.name
    position = np.array([table[symbol.name] for symbol in problem.variables])
    if shift is not None:
        position = position - shift(table["t0"])
    measured = table[z] if z in table else field_function(problem.field)(position)
    placed = dict(zip((symbol.name for symbol in problem.variables), position, strict=True))
    return {**table, **placed, z: measured, parameters.p0.name: table[heading] + table[parameters.k.name] * measured}


@dataclass(frozen=True)
class _Ending:
    """Start, corner and end of each member, in the frame's own time."""

    clock: Clock | CappedClock
    frame: str
    until: float | None
    nu_end: float | None
    smallest: float

    def ended(self, table: Mapping[str, Array]) -> Stop:
        """How a run that came to its end has ended."""
        prescribed = float(np.min(table["t0"] + table["T"]))
        slack = 1e-9 * float(np.max(table["T"]))
        if self.clock.horizon is not sp.oo:
            smallest = self._last_nu(table)
            last = float(np.min(table["t0"] + table["T"] * (1 - smallest)))
            if self.until is None or self.until > last + slack:
                why = (
                    f"the gain is not clipped and infinite at T, so that no run gets there; this one was asked as far "
                    f"as nu = {smallest:g}"
                )
                return Stop(Outcome.STEP_LIMIT, why, Limit.GAIN)
        if self.until is None or abs(self.until - prescribed) <= slack:
            return Stop()
        if self.until < prescribed:
            why = f"the run was asked as far as t = {self.until:g}, before the prescribed time t0 + T = {prescribed:g}"
            return Stop(Outcome.UNTIL, why)
        return Stop(message=f"the run was asked as far as t = {self.until:g}, past the prescribed time {prescribed:g}")

    def __call__(self, table: Mapping[str, Array]) -> Array:
        start, horizon = table["t0"], table["T"]
        end = start + horizon if self.until is None else np.full_like(start, self.until)
        if self.until is not None and np.any(end <= start):
            raise InputError(f"until: must be after the start t0 = {start.min():g}, got {self.until:g}")
        edges = [start, end]
        if isinstance(self.clock, CappedClock):
            edges = [start, np.minimum(np.maximum(time_map(self.clock.until, TIME)(start, table), start), end), end]
        elif isinstance(self.clock, Clock) and self.clock.horizon is not sp.oo:
            edges = [start, np.minimum(end, start + horizon * (1 - self._last_nu(table)))]
        found = np.array(edges)
        return found if self.frame == "t" else time_map(self.clock.to_tau, TIME)(found, table)

    def _last_nu(self, table: Mapping[str, Array]) -> float:
        """The ν at which an infinite gain is left: as given, or where none of the members has a larger gain than 1/ν²
        has at the smallest ν of its model."""
        if self.nu_end is not None:
            return self.nu_end
        assert isinstance(self.clock, Clock)
        rate = time_map(self.clock.rate.subs(TIME, self.clock.instant(_NU)), _NU)
        for nu in np.geomspace(self.smallest, 1, 400):
            if np.all(rate(np.full_like(table["T"], nu), table) <= self.smallest**-2 * (1 + 1e-9)):
                return float(nu)
        return 1.0
