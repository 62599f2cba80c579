"""Seeking problems from TOML files, exactly; every error names the file and the key."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from importlib import resources
from pathlib import Path
from typing import Any

import sympy as sp

from ptproof.errors import InputError
from ptproof.problem.drift import Drift, bounded_drift, gradient_drift, no_drift
from ptproof.problem.field import Field
from ptproof.problem.model import TIME, Initial, Problem, Saturation, Tuning, number, positive
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

EXAMPLES = ("vanishing", "nonvanishing", "saturated")
_TABLES = {
    "field": ("variables", "expression", "source", "kappa"),
    "drift": ("kind", "E", "f", "bound"),
    "seeker": ("k", "omega", "mu", "T", "t0", "nu_min"),
    "saturation": ("epsilon", "level", "gain"),
    "initial": ("x", "theta", "z", "u2"),
}
_REQUIRED = {
    "field": ("variables", "expression", "source", "kappa"),
    "drift": ("kind",),
    "seeker": ("k", "omega", "mu", "T"),
    "saturation": ("epsilon", "level", "gain"),
    "initial": ("x",),
}
_DRIFT_KEYS = {"none": (), "gradient": ("E",), "bounded": ("f",)}
_RESERVED = RESERVED | {"t", "tau"}


@lru_cache(maxsize=8)
def example(name: str) -> Problem:
    """One of the paper's examples (Section 7): ``vanishing``, ``nonvanishing`` or ``saturated``, with exact numbers."""
    if name not in EXAMPLES:
        near = hint(name, EXAMPLES, any_case=True)
        raise InputError(f"{name!r} is not an example{near}; the examples are {', '.join(EXAMPLES)}")
    text = resources.files("ptproof.problem").joinpath("examples", f"{name}.toml").read_text("utf-8")
    return read(text, name)


def load(path: str | Path) -> Problem:
    """Read a seeking problem from a TOML file.

    Numbers are exact: ``"1.8"``, ``1.8`` and ``"9/5"`` are the same. The tables are ``[field]`` (variables,
    expression, source, kappa), ``[drift]`` (kind = none, gradient with E, or bounded with f and, where it is
    known, bound), ``[seeker]`` (k, omega, mu, T, and t0 = 0, nu_min if the gain is clipped), ``[initial]`` (x, and
    theta = 0, z = F(x), u2 = 0) and, for the saturated seeker, ``[saturation]`` (epsilon, level, gain).

    Raises
    ------
    InputError
        Naming the file and the key, and what would be right.
    """
    return read(read_file(path, "a seeking problem"), str(path), name=Path(path).stem)


def read(text: str, where: str, name: str | None = None) -> Problem:
    """The problem that ``text`` (TOML) describes; ``where`` opens the error messages."""
    return build_from(text, where, lambda data: _problem(data, name or where))


def _problem(data: Mapping[str, Any], name: str) -> Problem:
    check_known(data, tuple(_TABLES), "table", any_case=True)
    for table in ("field", "drift", "seeker", "initial"):
        if table not in data:
            raise InputError(f"the table [{table}] is missing")
    for table, keys in _TABLES.items():
        content = data.get(table)
        if content is None:
            continue
        if not isinstance(content, dict):
            raise InputError(f"{table}: expected a table [{table}]")
        check_known(content, keys, f"key in [{table}]", any_case=True)
        check_required(content, _REQUIRED[table], table)
    field, seeker, initial = data["field"], data["seeker"], data["initial"]
    variables = _variables(field["variables"])
    expression = finite(field["expression"], "field.expression", variables)
    source = _numbers(field["source"], "field.source", len(variables))
    return Problem(
        field=Field(variables, expression, source, _kappa(field["kappa"])),
        drift=_drift(data["drift"], expression, variables),
        tuning=Tuning(**{key: _number(value, f"seeker.{key}") for key, value in seeker.items()}),
        initial=Initial(
            _numbers(initial["x"], "initial.x", len(variables)),
            **{key: _number(value, f"initial.{key}") for key, value in initial.items() if key != "x"},
        ),
        saturation=_saturation(data.get("saturation")),
        name=name,
    )


def _list(value: Any, where: str, length: int | None = None) -> list[Any]:
    if not isinstance(value, list):
        raise InputError(f"{where}: expected a list, got {value!r}")
    if length is not None and len(value) != length:
        raise InputError(f"{where}: {len(value)} entries for {length} coordinates; give one for each")
    return value


def _variables(value: Any) -> tuple[sp.Symbol, ...]:
    names = _list(value, "field.variables")
    if not names:
        raise InputError("field.variables: expected at least one name")
    for name in names:
        check_name(name, "field.variables", _RESERVED)
    if len(set(names)) != len(names):
        raise InputError("field.variables: a name stands there twice")
    return tuple(sp.Symbol(name, real=True) for name in names)


def _number(value: Any, where: str) -> sp.Expr:
    return number(finite(value, where), where)


def _numbers(value: Any, where: str, length: int) -> tuple[sp.Expr, ...]:
    return tuple(_number(entry, f"{where}[{i}]") for i, entry in enumerate(_list(value, where, length)))


def _kappa(value: Any) -> int:
    exact = _number(value, "field.kappa")
    if not exact.is_Integer or exact < 1 or exact > 1000:
        raise InputError(f"field.kappa: must be a positive integer (up to 1000), got {value}")
    return int(exact)


def _drift(table: Mapping[str, Any], field: sp.Expr, variables: tuple[sp.Symbol, ...]) -> Drift:
    kind, n = table["kind"], len(variables)
    if not isinstance(kind, str) or kind not in _DRIFT_KEYS:
        near = hint(str(kind), tuple(_DRIFT_KEYS), any_case=True)
        raise InputError(f"drift.kind: {kind!r} is not one of {', '.join(_DRIFT_KEYS)}{near}")
    for key in _DRIFT_KEYS[kind]:
        if key not in table:
            raise InputError(f"drift.{key} is missing; a drift of kind {kind!r} needs it")
    allowed = {"none": ("kind",), "gradient": ("kind", "E"), "bounded": ("kind", "f", "bound")}[kind]
    for key in table:
        if key not in allowed:
            raise InputError(f"drift.{key}: a drift of kind {kind!r} has no {key}")
    if kind == "none":
        return no_drift(n)
    if kind == "gradient":
        rows = _list(table["E"], "drift.E", n)
        return gradient_drift([_numbers(row, f"drift.E[{i}]", n) for i, row in enumerate(rows)], field, variables)
    names = (TIME, *variables)
    rate = [finite(entry, f"drift.f[{i}]", names) for i, entry in enumerate(_list(table["f"], "drift.f", n))]
    bound = finite(table["bound"], "drift.bound", [TIME]) if "bound" in table else None
    return bounded_drift(rate, bound)


def _saturation(table: Mapping[str, Any] | None) -> Saturation | None:
    if table is None:
        return None
    read_positive: Callable[[str], sp.Expr] = lambda key: positive(  # noqa: E731
        finite(table[key], f"saturation.{key}"), f"saturation.{key}"
    )
    return Saturation(read_positive("epsilon"), read_positive("level"), read_positive("gain"))
