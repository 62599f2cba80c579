"""Seeking problems from TOML files, exactly; every error names the file and the key."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from pathlib import Path
from typing import Any

import sympy as sp

from ptproof.errors import InputError
from ptproof.problem.drift import Drift, bounded_drift, gradient_drift, no_drift
from ptproof.problem.field import Field
from ptproof.problem.model import TIME, Initial, Saturation, Tuning, loop_letters, number
from ptproof.problem.problem import Problem
from ptproof.reading.tables import RESERVED, build_from, check_choice, declared, finite, hint, listed, read_file
from ptproof.transforms.clocks.named import CLOCKS

EXAMPLES = ("vanishing", "nonvanishing", "saturated")
_DRIFTS = {"none": (), "gradient": ("E",), "bounded": ("f",)}
_RESERVED = RESERVED | loop_letters()


@dataclass(frozen=True)
class _Drift:
    kind: Any
    E: Any = None
    f: Any = None
    bound: Any = None


@dataclass(frozen=True)
class _Tables:
    field: Field
    drift: _Drift
    seeker: Tuning
    initial: Initial
    saturation: Saturation | None = None


@lru_cache(maxsize=8)
def example(name: str) -> Problem:
    """One of the paper's examples (Section 7): ``vanishing``, ``nonvanishing`` or ``saturated``, with exact numbers.

    >>> example("nonvanishing").tuning.nu_min
    3/10
    """
    if name not in EXAMPLES:
        raise InputError(f"{name!r} is not an example{hint(name, EXAMPLES)}; the examples are {', '.join(EXAMPLES)}")
    text = resources.files("ptproof.problem").joinpath("examples", f"{name}.toml").read_text("utf-8")
    return read(text, name)


def load(path: str | Path) -> Problem:
    """Read a seeking problem from a TOML file.

    Numbers are exact: ``"1.8"``, ``1.8`` and ``"9/5"`` are the same. The tables are ``[field]`` (variables,
    expression, source, kappa), ``[drift]`` (kind = none, gradient with E, or bounded with f and, where it is
    known, bound), ``[seeker]`` (k, omega, mu, T, and t0 = 0, nu_min if the gain is clipped, and a ``clock`` other
    than "paper": "power" with its ``exponent``, "logarithmic", "exponential" or "tangent"), ``[initial]`` (x, and
    theta = 0, z = F(x), u2 = 0) and, for the saturated seeker, ``[saturation]`` (epsilon, level, gain).

    Raises
    ------
    InputError
        Naming the file and the key, and what would be right.

    Examples
    --------
    >>> file = resources.files("ptproof.problem").joinpath("examples", "vanishing.toml")
    >>> load(str(file)).tuning.k
    9/5
    """
    return read(read_file(path, "a seeking problem"), str(path), name=Path(path).stem)


def read(text: str, where: str, name: str | None = None) -> Problem:
    """The problem that ``text`` (TOML) describes; ``where`` opens the error messages."""
    return build_from(text, where, _Tables, lambda data: _problem(data, name or where))


def _problem(data: Mapping[str, Any], name: str) -> Problem:
    field, initial = data["field"], data["initial"]
    names = listed(field["variables"], "field.variables")
    if not names:
        raise InputError("field.variables: expected at least one name")
    variables = tuple(sp.Symbol(name, real=True) for name in declared(names, "field.variables", _RESERVED))
    n, expression = len(variables), finite(field["expression"], "field.expression", variables)
    saturation = {key: _number(value, f"saturation.{key}") for key, value in data.get("saturation", {}).items()}
    return Problem(
        field=Field(variables, expression, _numbers(field["source"], "field.source", n), _kappa(field["kappa"])),
        drift=_drift(data["drift"], expression, variables),
        tuning=_tuning(data["seeker"]),
        initial=Initial(
            _numbers(initial["x"], "initial.x", n),
            **{key: _number(value, f"initial.{key}") for key, value in initial.items() if key != "x"},
        ),
        saturation=Saturation(**saturation) if saturation else None,
        name=name,
    )


def _number(value: Any, where: str) -> sp.Expr:
    return number(finite(value, where), where)


def _numbers(value: Any, where: str, length: int) -> tuple[sp.Expr, ...]:
    return tuple(_number(entry, f"{where}[{i}]") for i, entry in enumerate(listed(value, where, length, "coordinates")))


def _kappa(value: Any) -> int:
    exact = _number(value, "field.kappa")
    if not exact.is_Integer or exact < 1 or exact > 1000:
        raise InputError(f"field.kappa: must be a positive integer (up to 1000), got {value}")
    return int(exact)


def _tuning(table: Mapping[str, Any]) -> Tuning:
    check_choice(table.get("clock", "paper"), tuple(CLOCKS), "seeker.clock")
    given = {key: value if key == "clock" else _number(value, f"seeker.{key}") for key, value in table.items()}
    return Tuning(**given)


def _drift(table: Mapping[str, Any], field: sp.Expr, variables: tuple[sp.Symbol, ...]) -> Drift:
    kind, n = check_choice(table["kind"], tuple(_DRIFTS), "drift.kind"), len(variables)
    if missing := [key for key in _DRIFTS[kind] if key not in table]:
        raise InputError(f"drift.{missing[0]} is missing; a drift of kind {kind!r} needs it")
    allowed = ("kind", *_DRIFTS[kind], *(["bound"] if kind == "bounded" else []))
    if extra := [key for key in table if key not in allowed]:
        raise InputError(f"drift.{extra[0]}: a drift of kind {kind!r} has no {extra[0]}")
    if kind == "none":
        return no_drift(n)
    if kind == "gradient":
        rows = listed(table["E"], "drift.E", n, "coordinates")
        return gradient_drift([_numbers(row, f"drift.E[{i}]", n) for i, row in enumerate(rows)], field, variables)
    names = (TIME, *variables)
    entries = listed(table["f"], "drift.f", n, "coordinates")
    rate = [finite(entry, f"drift.f[{i}]", names) for i, entry in enumerate(entries)]
    bound = finite(table["bound"], "drift.bound", [TIME]) if "bound" in table else None
    return bounded_drift(rate, bound)
