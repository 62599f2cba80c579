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
from ptproof.simulation.numbers import as_float, by_name
from ptproof.simulation.plan import Array, Batch
from ptproof.simulation.quantities import field_function, input_function, time_map
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
    complete
        Whether the end is T itself; False where the gain is infinite there.
    conditions
        The conditions of the choices in ``system`` that change at the edges between start and end, and nowhere else.
    to_t, to_tau
        Maps between the run's own time and t, τ for arrays, given the parameters of one member.
    completed
        From a table with the defaults' names to one with those of all states and parameters.
    """

    system: System
    defaults: Mapping[str, float]
    edges: Callable[[Mapping[str, Array]], Array]
    position: tuple[int, ...]
    source: tuple[float, ...]
    complete: bool = True
    note: str = ""
    to_t: Callable[[Array, Mapping[str, Any]], Array] | None = None
    to_tau: Callable[[Array, Mapping[str, Any]], Array] | None = None
    field_at: Callable[[Array], Array] | None = None
    inputs_at: Callable[[Array, Array, Mapping[str, float]], dict[str, Array]] | None = None
    free: tuple[str, ...] = ()
    conditions: tuple[Relational, ...] = ()
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
    return Setup(
        system, defaults, lambda table: np.outer((start, end), np.ones(len(table[states[0]]))),
        tuple(range(system.dimension)), (0.0,) * system.dimension, free=tuple(defaults),
    )  # fmt: skip


def from_problem(
    problem: Problem, seeker: str, frame: str, coordinates: str, model: str, until: Any, nu_end: float | None
) -> Setup:
    """The setup of a problem's closed loop, reduced model or average."""
    check_word("model", model, tuple(NU_END))
    if model == "closed loop":
        system = problem.closed_loop(seeker, frame, coordinates=coordinates, symbolic=True)
    else:
        derive = problem.reduced_model if model == "reduced model" else problem.averaged
        system = derive(seeker, frame, symbolic=True)
    states, clock, defaults = problem.states, problem.seeker_clock(seeker), dict(_defaults(problem))
    last = as_float(until, "until") if until is not None else None
    ending = _Ending(clock, frame, last, nu_end, NU_END[model])
    full = model == "closed loop" and coordinates == "full"
    return Setup(
        system, defaults, edges=ending, position=(0, 1), source=tuple(map(float, problem.source)),
        complete=until is not None or clock.horizon is sp.oo, note=ending.note(defaults),
        to_t=time_map(TIME, TIME) if frame == "t" else time_map(clock.to_t, TAU),
        to_tau=time_map(TAU, TAU) if frame == "tau" else time_map(clock.to_tau, TIME),
        field_at=field_function(problem.field),
        inputs_at=input_function(problem.field, problem.seeker(seeker), clock, states, system.state) if full else None,
        free=tuple(dict.fromkeys((*defaults, states.filter.name))), conditions=clock.conditions,
        completed=partial(_completed, problem),
    )  # fmt: skip


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


def _completed(problem: Problem, table: Mapping[str, Array]) -> dict[str, Array]:
    """The table with the filter's start, which is the measured field at each member's position unless it is given, and
    with p₀, which follows from heading and filter."""
    heading, z = problem.states.heading.name, problem.states.filter.name
    position = np.array([table[symbol.name] for symbol in problem.variables])
    measured = table[z] if z in table else field_function(problem.field)(position)
    return {**table, z: measured, parameters.p0.name: table[heading] + table[parameters.k.name] * measured}


@dataclass(frozen=True)
class _Ending:
    """Start, corner and end of each member, in the frame's own time."""

    clock: Clock | CappedClock
    frame: str
    until: float | None
    nu_end: float | None
    smallest: float

    def note(self, table: Mapping[str, float]) -> str:
        """Where a run of an infinite gain was asked to stop, and why."""
        if self.clock.horizon is sp.oo:
            return ""
        values = {name: np.array([value]) for name, value in table.items()}
        return (
            f"the gain is not clipped and infinite at T, so that no run gets there; this one was asked as far as "
            f"nu = {self._last_nu(values):g}"
        )

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
