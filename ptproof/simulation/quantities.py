"""What is computed along a run: the field, and the inputs that the seeker applies."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any

import numpy as np
import sympy as sp

from ptproof.problem import TIME, Field, parameters
from ptproof.problem.seekers import Letters, Seeker
from ptproof.simulation.plan import Array
from ptproof.transforms import CappedClock, Clock


@lru_cache(maxsize=64)
def _vectorised(expression: sp.Expr, variables: tuple[sp.Symbol, ...]) -> Callable[..., Any]:
    return sp.lambdify(variables, expression, modules="numpy", cse=True)


def _spread(function: Callable[..., Any], like: Array, *arguments: Any) -> Array:
    """The function's values in the shape of ``like``, also where it is constant; NaN or infinite where it has none."""
    with np.errstate(all="ignore"):
        return np.asarray(function(*arguments), dtype=float) + 0.0 * like


@lru_cache(maxsize=64)
def field_function(field: Field) -> Callable[[Array], Array]:
    """F for arrays of positions (n × …)."""
    function = _vectorised(field.expression, field.variables)
    return lambda x: _spread(function, x[0], *x)


@lru_cache(maxsize=64)
def motion_function(motion: tuple[sp.Expr, ...]) -> Callable[[Array], Array]:
    """How far a source that moves is from its place, (n × …) for times t."""
    functions = [_vectorised(entry, (TIME,)) for entry in motion]
    return lambda t: np.array([_spread(function, t, t) for function in functions])


@lru_cache(maxsize=64)
def input_function(
    field: Field, seeker: Seeker, clock: Clock | CappedClock, states: Letters, order: tuple[sp.Symbol, ...]
) -> Callable[[Array, Array, Mapping[str, float]], dict[str, Array]]:
    """The inputs of a seeker along a run in full coordinates, from t and the states in their ``order``.

    ``clock`` is the symbolic clock whose rate is the seeker's gain.
    """
    wanted = seeker.inputs(field.expression, clock.rate, states)
    given = {TIME, *order}
    symbols = tuple(sorted(set().union(*(entry.free_symbols for entry in wanted.values())) - given, key=str))
    functions = {name: _vectorised(expression, (TIME, *order, *symbols)) for name, expression in wanted.items()}

    def evaluate(t: Array, x: Array, table: Mapping[str, float]) -> dict[str, Array]:
        values = [table[symbol.name] for symbol in symbols]
        return {name: _spread(function, t, t, *x, *values) for name, function in functions.items()}

    return evaluate


def select(conditions: list[Any], choices: list[Any], default: Any = np.nan) -> Any:
    """As ``numpy.select``, whose checks take longer than a short run."""
    result = default
    for condition, choice in zip(reversed(conditions), reversed(choices), strict=True):
        result = choice if condition is True else np.where(condition, choice, result)
    return result


@lru_cache(maxsize=64)
def time_map(expression: sp.Expr, variable: sp.Symbol) -> Callable[[Array, Mapping[str, Any]], Array]:
    """``expression`` for arrays of ``variable``, given the parameters of a clock by name."""
    if expression == variable:
        return lambda times, table: times + 0.0
    symbols = (parameters.t0, parameters.T, parameters.nu_min, parameters.exponent, parameters.gain)
    function = sp.lambdify([variable, *symbols], expression, modules=[{"select": select}, "numpy"], cse=True)
    return lambda times, table: _spread(
        function, times, times, *(table.get(symbol.name, 1.0) for symbol in symbols)
    )  # fmt: skip
