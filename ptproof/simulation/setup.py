"""From a problem, or a system, to what an engine is asked: parameters, time span, kinks and initial states by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np
import sympy as sp

from ptproof.errors import InputError
from ptproof.problem import Problem, parameters
from ptproof.problem.clipped import ClippedClock
from ptproof.problem.loops import TAU, clock_of, loop_letters
from ptproof.problem.model import TIME
from ptproof.reading.expressions import parse
from ptproof.simulation.plan import Array
from ptproof.simulation.quantities import field_function, input_function
from ptproof.system import System

MODELS = ("closed loop", "reduced model", "average")
LARGEST = 1e15
# How close an unclipped gain, infinite at T, is followed towards it.
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
    initial
        The initial states (n × N) from a table of values by name (N each).
    edges
        Start, kinks and end (q × N) from the same table.
    position
        Indices of the states whose distance to ``source`` counts.
    complete
        Whether the end is T itself; False where the gain is infinite there.
    to_t, to_tau
        Maps between the run's own time and t, τ for arrays, given the parameters of one member.
    """

    system: System
    defaults: Mapping[str, float]
    initial: Callable[[Mapping[str, Array]], Array]
    edges: Callable[[Mapping[str, Array]], Array]
    position: tuple[int, ...]
    source: tuple[float, ...]
    complete: bool = True
    note: str = ""
    to_t: Callable[[Array, Mapping[str, Any]], Array] | None = None
    to_tau: Callable[[Array, Mapping[str, Any]], Array] | None = None
    field_at: Callable[[Array], Array] | None = None
    inputs_at: Callable[[Array, Array, Mapping[str, float]], dict[str, Array]] | None = None
    free: tuple[str, ...] = field(default=())


def as_float(value: Any, where: str) -> float:
    """A finite number from a number, exact expression or text; refused otherwise."""
    if isinstance(value, str):
        value = parse(value, where=where)
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise InputError(f"{where}: expected a number, got {value!r}") from None
    if not np.isfinite(number) or abs(number) > LARGEST:
        raise InputError(f"{where}: expected a finite number up to {LARGEST:g}, got {value}")
    return number


def by_name(values: Mapping[Any, Any]) -> dict[str, Any]:
    """The same mapping with symbols as keys replaced by their names."""
    return {key.name if isinstance(key, sp.Symbol) else str(key): value for key, value in values.items()}


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
        size = len(next(iter(table.values())))
        return np.array([np.full(size, start), np.full(size, end)])

    return Setup(
        system, defaults, lambda table: np.array([table[name] for name in states]), edges,
        tuple(range(system.dimension)), (0.0,) * system.dimension, free=tuple(defaults),
    )  # fmt: skip


def from_problem(
    problem: Problem, seeker: str, frame: str, coordinates: str, model: str, until: Any, nu_end: float | None
) -> Setup:
    """The setup of a problem's closed loop, reduced model or average."""
    if model not in MODELS:
        raise InputError(f"model: {model!r} is not one of {', '.join(MODELS)}")
    if model == "closed loop":
        system = problem.closed_loop(seeker, frame, coordinates=coordinates, symbolic=True)
    else:
        derive = problem.reduced_model if model == "reduced model" else problem.averaged
        system = derive(seeker, frame, symbolic=True)
    letters = loop_letters(problem)
    theta, z = letters.heading.name, letters.filter.name
    defaults = dict(_defaults(problem))
    field_at = field_function(problem)

    def completed(table: Mapping[str, Array]) -> dict[str, Array]:
        full = with_filter(problem, table)
        full["p0"] = full[theta] + full["k"] * full[z]
        return full

    def initial(table: Mapping[str, Array]) -> Array:
        full = completed(table)
        return np.array([full[symbol.name] for symbol in system.state])

    complete = until is not None or problem.tuning.nu_min is not None or clock_of(problem, seeker) is None
    last = as_float(until, "until") if until is not None else None
    ending = _Ending(problem, seeker, frame, last, complete, NU_END[model] if nu_end is None else nu_end)
    clock = clock_of(problem, seeker)
    note = "" if complete else ending.note
    full = model == "closed loop" and coordinates == "full"
    inputs_at = input_function(problem, seeker, system) if full else None
    return Setup(
        system, defaults,
        initial=initial, edges=ending, position=(0, 1), source=_source(problem),
        complete=complete, note=note,
        to_t=_identity if clock is None or frame == "t" else _time_map(clock.to_t, TAU),
        to_tau=_identity if clock is None or frame == "tau" else _time_map(clock.to_tau, TIME),
        field_at=field_at,
        inputs_at=inputs_at, free=(*defaults, *([] if z in defaults else [z])),
    )  # fmt: skip


@lru_cache(maxsize=64)
def _defaults(problem: Problem) -> tuple[tuple[str, float], ...]:
    """Parameters and initial states as floats, by name; without z where it starts at the measured field."""
    letters, start = loop_letters(problem), problem.initial
    found = {symbol.name: float(value) for symbol, value in problem.values.items() if symbol != parameters.p0}
    found |= {symbol.name: float(value) for symbol, value in zip(problem.variables, start.x, strict=True)}
    found |= {letters.heading.name: float(start.theta), letters.angular_velocity.name: float(start.u2)}
    if start.z is not None:
        found[letters.filter.name] = float(start.z)
    return tuple(found.items())


@lru_cache(maxsize=64)
def _source(problem: Problem) -> tuple[float, ...]:
    return tuple(float(value) for value in problem.source)


def with_filter(problem: Problem, table: Mapping[str, Array]) -> dict[str, Array]:
    """The table with the filter's start, which is the measured field at each member's position unless it is given."""
    z = loop_letters(problem).filter.name
    if z in table:
        return dict(table)
    position = np.array([table[symbol.name] for symbol in problem.variables])
    return dict(table) | {z: field_function(problem)(position)}


def completed_parameters(setup: Setup, problem: Problem | None, table: Mapping[str, Array]) -> Array:
    """The parameter values (m × N) in the system's order; p₀ follows from heading and filter of each member."""
    full = dict(table)
    names = [symbol.name for symbol in setup.system.parameters or ()]
    if "p0" in names and problem is not None:
        full = with_filter(problem, full)
        letters = loop_letters(problem)
        full["p0"] = full[letters.heading.name] + full["k"] * full[letters.filter.name]
    size = len(next(iter(full.values())))
    return np.array([full[name] for name in names]).reshape(len(names), size)


@dataclass(frozen=True)
class _Ending:
    """Start, kink and end of each member, in the frame's own time."""

    problem: Problem
    seeker: str
    frame: str
    until: float | None
    complete: bool
    nu_end: float

    @property
    def note(self) -> str:
        return (
            f"the gain is not clipped and infinite at T, so that no run gets there; this one was asked as far as "
            f"nu = {self.nu_end:g}"
        )

    def __call__(self, table: Mapping[str, Array]) -> Array:
        start, horizon = table["t0"], table["T"]
        end = start + horizon if self.until is None else np.full_like(start, self.until)
        if self.until is not None and np.any(end <= start):
            raise InputError(f"until: must be after the start t0 = {start.min():g}, got {self.until:g}")
        clock = clock_of(self.problem, self.seeker)
        if clock is None:
            return np.array([start, end])
        if not isinstance(clock, ClippedClock):
            last = start + horizon * (1 - self.nu_end)
            end = last if self.until is None else np.minimum(end, last)
            return self._in_frame(np.array([start, end]), table)
        corner = np.clip(start + horizon * (1 - table["nu_min"]), start, end)
        return self._in_frame(np.array([start, corner, end]), table)

    def _in_frame(self, edges: Array, table: Mapping[str, Array]) -> Array:
        if self.frame == "t":
            return edges
        clock = clock_of(self.problem, self.seeker)
        assert clock is not None
        to_tau = _time_map(clock.to_tau, TIME)
        return to_tau(edges, table)


def _identity(times: Array, _: Mapping[str, Any]) -> Array:
    return times


def _select(conditions: list[Any], choices: list[Any], default: Any = np.nan) -> Any:
    # As numpy.select, whose checks take longer than a short run.
    result = default
    for condition, choice in zip(reversed(conditions), reversed(choices), strict=True):
        result = np.where(condition, choice, result)
    return result


@lru_cache(maxsize=16)
def _time_map(expression: sp.Expr, variable: sp.Symbol) -> Callable[[Array, Mapping[str, Any]], Array]:
    symbols = [parameters.t0, parameters.T, parameters.nu_min]
    function = sp.lambdify([variable, *symbols], expression, modules=[{"select": _select}, "numpy"])

    def evaluate(times: Array, table: Mapping[str, Any]) -> Array:
        values = [table.get(symbol.name, 1.0) for symbol in symbols]
        with np.errstate(all="ignore"):
            return np.asarray(function(times, *values), dtype=float) + 0.0 * times

    return evaluate
