"""Dither systems from TOML files, exactly; every error names the file and the key."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import sympy as sp

from ptproof.averaging.powers import PoweredProblem, with_frequencies
from ptproof.averaging.problem import MU, OMEGA, PHASE, TIME, DitherProblem, FastStates
from ptproof.averaging.reading_powers import arguments_and_sign, frequencies_of_dithers, with_order
from ptproof.errors import InputError
from ptproof.reading.tables import RESERVED, build_from, check_known, declared, finite, hint, listed, read_file
from ptproof.system import DitherSystem

_FIXED = {symbol.name: symbol for symbol in (TIME, PHASE, OMEGA)}
_RESERVED = RESERVED | _FIXED.keys()


@dataclass(frozen=True)
class _Dither:
    field: Any
    signal: Any
    power: Any = "1/2"
    frequency: Any = 1


@dataclass(frozen=True)
class _System:
    state: Any
    drift: Any
    period: Any
    dither: list[_Dither]
    parameters: Any = None
    functions: dict[str, Any] = field(default_factory=dict)
    bounded: Any = None
    fast: FastStates | None = None
    start: Any = None
    name: Any = None
    mu_omega: Any = None
    order: Any = 1
    conditions: Any = None


@dataclass(frozen=True)
class _Expected:
    average: Any


@dataclass(frozen=True)
class _Tables:
    system: _System
    expected: _Expected | None = None
    region: dict[str, Any] = field(default_factory=dict)


def load_dither_system(path: str | Path) -> DitherProblem | PoweredProblem:
    """Read a dither system from a TOML file.

    The table ``[system]`` has ``state``, ``drift``, ``period`` and one ``[[system.dither]]`` (``field``,
    ``signal``) per dither, and may have ``parameters`` (positive), ``functions`` (unknown smooth functions with
    their arguments, ``F = ["x"]``, or with a sign too, ``J = { of = ["x"], sign = "positive" }``), ``bounded`` (those
    functions of ``tau`` that are assumed bounded in it, with their derivatives), ``start`` (the earliest τ asked
    about, 0 if left out), ``name`` and ``[system.fast]`` (``state``, ``rate``, and ``quasi_steady_state`` where the
    author knows it). With fast states there may be ``mu_omega``, the product μω where it is held fixed: a positive
    number, or a name for one.

    A dither may have a ``frequency`` (rational; its signal is taken at that many times the phase) and a ``power`` of ω
    (1/2 if left out; linear in parameters), the system ``conditions`` on the powers' parameters (``["1/2 < p < 1"]``)
    and an ``order``, 1 or 2. With 2, or with other powers, the problem is a :class:`PoweredProblem`.

    ``[region]`` gives the interval of a state (``x1 = ["-1", "1"]``), ``[expected]`` the ``average`` that the author
    claims. In expressions ``tau`` is the slow time, ``theta`` the phase ωτ and ``omega`` the frequency. An example
    stands at :func:`read_dither_system`, which reads the same from text.

    Raises
    ------
    InputError
        Naming the file and the key, and what would be right.
    """
    return read_dither_system(read_file(path, "a dither system"), str(path), name=Path(path).stem)


def read_dither_system(text: str, where: str = "text", name: str | None = None) -> DitherProblem | PoweredProblem:
    """The dither system that ``text`` (TOML) describes; ``where`` opens the error messages.

    Examples
    --------
    >>> text = '[system]\\nstate = ["x"]\\ndrift = ["-x"]\\nperiod = "2*pi"\\n'
    >>> text += '[[system.dither]]\\nfield = ["x"]\\nsignal = "cos(theta)"'
    >>> read_dither_system(text).system.dithers
    (cos(theta),)
    """
    return build_from(text, where, _Tables, lambda data: _problem(data, name or where))


def _problem(data: Mapping[str, Any], name: str) -> DitherProblem | PoweredProblem:
    system, fast = data["system"], data["system"].get("fast")
    taken: dict[str, Any] = dict(_FIXED)
    state = _symbols(system["state"], "system.state", taken, real=True)
    fast_state = _symbols(fast["state"], "system.fast.state", taken, real=True) if fast else ()
    parameters = _symbols(system.get("parameters", []), "system.parameters", taken, empty=True, positive=True)
    functions = _functions(system.get("functions", {}), taken)
    if fast and MU.name in {*taken, *functions}:
        raise InputError(f"system: {MU.name!r} is the small parameter of the fast states here; choose another name")
    finite_rate = _mu_omega(system, taken, functions)
    everything = {**taken, **{key: _of_arity(*entry) for key, entry in functions.items()}}

    def vector(table: Mapping[str, Any], key: str, where: str, length: int = len(state)) -> tuple[sp.Expr, ...]:
        entries = listed(table[key], f"{where}.{key}", length, "states")
        return tuple(finite(entry, f"{where}.{key}[{i}]", everything) for i, entry in enumerate(entries, start=1))

    if not system["dither"]:
        raise InputError("system.dither: expected at least one table [[system.dither]]")
    fields, signals = [], []
    for i, dither in enumerate(system["dither"], start=1):
        where = f"system.dither[{i}]"
        fields.append(vector(dither, "field", where))
        signals.append(finite(dither["signal"], f"{where}.signal", everything))
        _separate(fields[-1], signals[-1], {*state, *fast_state}, where)
    drift, period = vector(system, "drift", "system"), _period(system["period"], parameters)
    title = _name(system.get("name", name))
    rates = {key: vector(fast, key, "system.fast", len(fast_state)) for key in fast or {} if key != "state"}
    plain = DitherSystem(TIME, PHASE, OMEGA, state, drift, tuple(fields), tuple(signals), period, name=title)
    problem = DitherProblem(
        system=with_frequencies(plain, frequencies_of_dithers(system["dither"])),
        fast=FastStates(fast_state, **rates) if fast else None,
        functions=tuple(function(*arguments) for function, arguments in functions.values()),
        bounded=_bounded(system.get("bounded", []), functions),
        region=_region(data.get("region", {}), {symbol.name: symbol for symbol in (*state, *fast_state)}, parameters),
        start=finite(system.get("start", 0), "system.start"),
        expected=vector(data["expected"], "average", "expected") if "expected" in data else None,
        mu_omega=finite_rate,
    )
    return with_order(problem, system, parameters)


def _name(value: Any) -> str:
    if not isinstance(value, str) or not value.strip() or len(value) > 200:
        raise InputError("system.name: expected a short text")
    return value


def _symbols(
    value: Any, where: str, taken: dict[str, Any], empty: bool = False, **assumptions: bool
) -> tuple[sp.Symbol, ...]:
    names = declared(listed(value, where), where, _RESERVED, taken)
    if not names and not empty:
        raise InputError(f"{where}: expected at least one name")
    symbols = {name: sp.Symbol(name, **assumptions) for name in names}
    taken |= symbols
    return tuple(symbols.values())


def _functions(value: Mapping[str, Any], taken: Mapping[str, Any]) -> dict[str, tuple[Any, tuple[sp.Symbol, ...]]]:
    """Name → (SymPy function, declared arguments)."""
    result = {}
    known = [key for key in taken if key not in (PHASE.name, OMEGA.name)]
    for name, entry in value.items():
        where = f"system.functions.{name}"
        declared([name], where, _RESERVED, taken)
        arguments, sign = arguments_and_sign(entry, where)
        for argument in arguments:
            if argument not in known:
                raise InputError(f"{where}: {argument!r} is not a state{hint(str(argument), known)}")
        if not arguments:
            raise InputError(f"{where}: a function needs at least one argument; a constant is a parameter")
        kind = {"real": True} if sign is None else {"real": True, sign: True}
        result[name] = (sp.Function(name, **kind), tuple(taken[argument] for argument in arguments))
    return result


def _mu_omega(system: Mapping[str, Any], taken: dict[str, Any], functions: Mapping[str, Any]) -> sp.Expr | None:
    """The value of μω: a positive expression in the parameters, or a name, which is declared here if it is new."""
    if "mu_omega" not in system:
        return None
    where, value = "system.mu_omega", system["mu_omega"]
    if "fast" not in system:
        raise InputError(f"{where}: there are no fast states; add [system.fast] or leave it out")
    parameters = {name: symbol for name, symbol in taken.items() if symbol.is_positive and symbol != OMEGA}
    known = {*taken, *functions, "inf", "nan", "infinity"}
    if isinstance(value, str) and value.isidentifier() and value not in known:
        taken |= {
            name: sp.Symbol(name, positive=True) for name in declared([value], where, _RESERVED | {MU.name}, taken)
        }
        return taken[value]
    found = finite(value, where, parameters)
    if found.is_positive is not True:
        raise InputError(f"{where}: {found} is not shown to be positive; give a positive number or a name")
    return found


def _bounded(value: Any, functions: Mapping[str, Any]) -> tuple[Any, ...]:
    for name in listed(value, "system.bounded"):
        if not isinstance(name, str) or name not in functions:
            near = hint(str(name), functions)
            raise InputError(f"system.bounded: {name!r} is not declared in system.functions{near}")
    return tuple(functions[name][0](*functions[name][1]) for name in value)


def _of_arity(function: Any, declared_arguments: Sequence[sp.Symbol]) -> Callable[..., Any]:
    def call(*arguments: sp.Expr) -> sp.Expr:
        if len(arguments) != len(declared_arguments):
            raise TypeError
        return function(*arguments)

    return call


def _period(value: Any, parameters: Sequence[sp.Symbol]) -> sp.Expr:
    period = finite(value, "system.period", parameters)
    if period.is_number and period.is_positive is not True:
        raise InputError(f"system.period: {period} is not positive")
    return period


def _region(
    value: Mapping[str, Any], states: Mapping[str, sp.Symbol], parameters: Sequence[sp.Symbol]
) -> dict[sp.Symbol, tuple[sp.Expr, sp.Expr]]:
    for name in value.keys() & {symbol.name for symbol in parameters}:
        raise InputError(f"region.{name}: a region is of states; what a power may be says system.conditions")
    check_known(value, tuple(states), "state in [region]")
    result = {}
    for name, interval in value.items():
        where = f"region.{name}"
        if len(listed(interval, where)) != 2:
            raise InputError(f"{where}: expected two ends, such as [-1, 1]")
        low, high = (finite(end, where) for end in interval)
        if (high - low).is_positive is not True:
            raise InputError(f"{where}: the interval [{low}, {high}] is empty")
        result[states[name]] = (low, high)
    return result


def _separate(entries: Sequence[sp.Expr], signal: sp.Expr, states: set[sp.Symbol], where: str) -> None:
    """A signal that depends on states, or a field that depends on the phase, is refused."""
    if found := signal.free_symbols & states:
        names = ", ".join(sorted(symbol.name for symbol in found))
        raise InputError(
            f"{where}.signal: a signal depends on theta, tau and parameters only; put {names} into the field"
        )
    if any(PHASE in entry.free_symbols for entry in entries):
        raise InputError(f"{where}.field: a field does not depend on theta; put that into the signal")
