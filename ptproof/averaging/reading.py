"""Dither systems from TOML files, exactly; every error names the file and the key."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import sympy as sp

from ptproof.averaging.problem import MU, OMEGA, PHASE, TIME, DitherProblem, FastStates
from ptproof.errors import InputError
from ptproof.reading.tables import (
    RESERVED,
    build_from,
    check_known,
    check_name,
    check_required,
    finite,
    hint,
    read_file,
)
from ptproof.system import DitherSystem

_TOP = ("system", "expected", "region")
_SYSTEM = ("state", "parameters", "functions", "bounded", "drift", "period", "dither", "fast", "start", "name")
_DITHER = ("field", "signal")
_FAST = ("state", "rate", "quasi_steady_state")
_FIXED = {symbol.name: symbol for symbol in (TIME, PHASE, OMEGA)}
_RESERVED = RESERVED | _FIXED.keys()
_MOST = 512


def load_dither_system(path: str | Path) -> DitherProblem:
    """Read a dither system from a TOML file.

    The table ``[system]`` has ``state``, ``drift``, ``period`` and one ``[[system.dither]]`` (``field``,
    ``signal``) per dither, and may have ``parameters`` (positive), ``functions`` (unknown smooth functions with
    their arguments), ``bounded`` (those functions of ``tau`` that are assumed bounded in it, with their
    derivatives), ``start`` (the earliest τ asked about, 0 if left out), ``name`` and ``[system.fast]``
    (``state``, ``rate``, and ``quasi_steady_state`` where the author knows it). ``[region]`` gives the interval
    of a state (``x1 = ["-1", "1"]``), ``[expected]`` the ``average`` that the author claims. In expressions
    ``tau`` is the slow time, ``theta`` the phase ωτ and ``omega`` the frequency.

    Raises
    ------
    InputError
        Naming the file and the key, and what would be right.
    """
    return read_dither_system(read_file(path, "a dither system"), str(path), name=Path(path).stem)


def read_dither_system(text: str, where: str = "text", name: str | None = None) -> DitherProblem:
    """The dither system that ``text`` (TOML) describes; ``where`` opens the error messages."""
    return build_from(text, where, lambda data: _problem(data, name or where))


def _problem(data: Mapping[str, Any], name: str) -> DitherProblem:
    check_known(data, _TOP, "table")
    system = _table(data, "system", _SYSTEM, ("state", "drift", "period", "dither"))
    fast = _table(system, "fast", _FAST, ("state", "rate"), "system.") if "fast" in system else {}
    taken: dict[str, Any] = dict(_FIXED)
    state = _symbols(system["state"], "system.state", taken, real=True)
    fast_state = _symbols(fast["state"], "system.fast.state", taken, real=True) if fast else ()
    parameters = _symbols(system.get("parameters", []), "system.parameters", taken, empty=True, positive=True)
    functions = _functions(system.get("functions", {}), taken)
    if fast and MU.name in {*taken, *functions}:
        raise InputError(f"system: {MU.name!r} is the small parameter of the fast states here; choose another name")
    everything = {**taken, **{key: entry[0] for key, entry in functions.items()}}

    def vector(value: Any, where: str, length: int) -> tuple[sp.Expr, ...]:
        entries = _list(value, where, length)
        return tuple(finite(entry, f"{where}[{i}]", everything) for i, entry in enumerate(entries, start=1))

    dithers = _list(system["dither"], "system.dither")
    if not dithers:
        raise InputError("system.dither: expected at least one table [[system.dither]]")
    fields, signals = [], []
    for i, dither in enumerate(dithers, start=1):
        where = f"system.dither[{i}]"
        if not isinstance(dither, dict):
            raise InputError(f"{where}: expected a table [[system.dither]]")
        _keys(dither, _DITHER, _DITHER, where)
        fields.append(vector(dither["field"], f"{where}.field", len(state)))
        signals.append(finite(dither["signal"], f"{where}.signal", everything))
        _no_states(signals[-1], {*state, *fast_state}, f"{where}.signal")
    _no_phase(fields, "system.dither[{}].field")
    problem_fast = None
    if fast:
        steady = fast.get("quasi_steady_state")
        problem_fast = FastStates(
            fast_state,
            vector(fast["rate"], "system.fast.rate", len(fast_state)),
            None if steady is None else vector(steady, "system.fast.quasi_steady_state", len(fast_state)),
        )
    expected = None
    if "expected" in data:
        claimed = _table(data, "expected", ("average",), ("average",))
        expected = vector(claimed["average"], "expected.average", len(state))
    return DitherProblem(
        system=DitherSystem(
            TIME,
            PHASE,
            OMEGA,
            state,
            vector(system["drift"], "system.drift", len(state)),
            tuple(fields),
            tuple(signals),
            _period(system["period"], parameters),
            name=_name(system.get("name", name)),
        ),
        fast=problem_fast,
        functions=tuple(function(*arguments) for function, arguments in (e[1] for e in functions.values())),
        bounded=_bounded(system.get("bounded", []), {key: entry[1] for key, entry in functions.items()}),
        region=_region(data.get("region", {}), {symbol.name: symbol for symbol in (*state, *fast_state)}),
        start=_number(system.get("start", 0), "system.start"),
        expected=expected,
    )


def _keys(table: Mapping[str, Any], known: Sequence[str], required: Sequence[str], where: str) -> None:
    check_known(table, known, f"key in [{where}]")
    check_required(table, required, where)


def _table(
    data: Mapping[str, Any], key: str, known: Sequence[str], required: Sequence[str], above: str = ""
) -> Mapping[str, Any]:
    if key not in data:
        raise InputError(f"the table [{above}{key}] is missing")
    table = data[key]
    if not isinstance(table, dict):
        raise InputError(f"{above}{key}: expected a table [{above}{key}]")
    _keys(table, known, required, f"{above}{key}")
    return table


def _list(value: Any, where: str, length: int | None = None) -> list[Any]:
    if not isinstance(value, list):
        raise InputError(f"{where}: expected a list, got {value!r}")
    if len(value) > _MOST:
        raise InputError(f"{where}: more than {_MOST} entries")
    if length is not None and len(value) != length:
        raise InputError(f"{where}: {len(value)} entries for {length} states; give one for each")
    return value


def _name(value: Any) -> str:
    if not isinstance(value, str) or not value.strip() or len(value) > 200:
        raise InputError("system.name: expected a short text")
    return value


def _identifier(name: Any, where: str, taken: Mapping[str, Any]) -> str:
    name = check_name(name, where, _RESERVED)
    if name in taken:
        raise InputError(f"{where}: {name!r} is declared twice")
    return name


def _symbols(
    value: Any, where: str, taken: dict[str, Any], empty: bool = False, **assumptions: bool
) -> tuple[sp.Symbol, ...]:
    names = _list(value, where)
    if not names and not empty:
        raise InputError(f"{where}: expected at least one name")
    for name in names:
        known = _identifier(name, where, taken)
        taken[known] = sp.Symbol(known, **assumptions)
    return tuple(taken[name] for name in names)


def _functions(value: Any, taken: dict[str, Any]) -> dict[str, tuple[Callable[..., Any], Any]]:
    """Name → (what the parser calls, (SymPy function, declared arguments))."""
    if not isinstance(value, dict):
        raise InputError('system.functions: expected a table such as { F = ["x1", "x2"] }')
    result: dict[str, tuple[Callable[..., Any], Any]] = {}
    for name, arguments in value.items():
        where = f"system.functions.{name}"
        _identifier(name, where, {**taken, **result})
        symbols = []
        for argument in _list(arguments, where):
            if not isinstance(argument, str) or argument not in taken or argument in (PHASE.name, OMEGA.name):
                known = [key for key in taken if key not in (PHASE.name, OMEGA.name)]
                raise InputError(f"{where}: {argument!r} is not a state{hint(str(argument), known)}")
            symbols.append(taken[argument])
        if not symbols:
            raise InputError(f"{where}: a function needs at least one argument; a constant is a parameter")
        function = sp.Function(name, real=True)
        result[name] = (_of_arity(function, len(symbols)), (function, tuple(symbols)))
    return result


def _bounded(value: Any, functions: Mapping[str, Any]) -> tuple[Any, ...]:
    result = []
    for name in _list(value, "system.bounded"):
        if not isinstance(name, str) or name not in functions:
            near = hint(str(name), tuple(functions))
            raise InputError(f"system.bounded: {name!r} is not declared in system.functions{near}")
        function, arguments = functions[name]
        result.append(function(*arguments))
    return tuple(result)


def _of_arity(function: Any, count: int) -> Callable[..., Any]:
    def call(*arguments: sp.Expr) -> sp.Expr:
        if len(arguments) != count:
            raise TypeError
        return function(*arguments)

    return call


def _number(value: Any, where: str) -> sp.Expr:
    return finite(value, where)


def _period(value: Any, parameters: Sequence[sp.Symbol]) -> sp.Expr:
    period = finite(value, "system.period", {symbol.name: symbol for symbol in parameters})
    if period.is_number and period.is_positive is not True:
        raise InputError(f"system.period: {period} is not positive")
    return period


def _region(value: Any, states: Mapping[str, sp.Symbol]) -> dict[sp.Symbol, tuple[sp.Expr, sp.Expr]]:
    if not isinstance(value, dict):
        raise InputError("region: expected a table [region]")
    check_known(value, tuple(states), "state in [region]")
    result = {}
    for name, interval in value.items():
        where = f"region.{name}"
        if len(_list(interval, where)) != 2:
            raise InputError(f"{where}: expected two ends, such as [-1, 1]")
        low, high = (_number(end, where) for end in interval)
        if (high - low).is_positive is not True:
            raise InputError(f"{where}: the interval [{low}, {high}] is empty")
        result[states[name]] = (low, high)
    return result


def _no_states(signal: sp.Expr, states: set[sp.Symbol], where: str) -> None:
    if found := signal.free_symbols & states:
        names = ", ".join(sorted(symbol.name for symbol in found))
        raise InputError(f"{where}: a signal depends on theta, tau and parameters only; put {names} into the field")


def _no_phase(fields: Sequence[Sequence[sp.Expr]], where: str) -> None:
    for i, entries in enumerate(fields, start=1):
        if any(PHASE in entry.free_symbols for entry in entries):
            raise InputError(f"{where.format(i)}: a field does not depend on theta; put that into the signal")
