"""What is computed along a run: the field, and the inputs that the seeker applies."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any

import numpy as np
import sympy as sp

from ptproof.problem import Problem, parameters
from ptproof.problem.loops import gain_of, loop_letters
from ptproof.problem.model import TIME
from ptproof.problem.seekers import feedback
from ptproof.simulation.plan import Array
from ptproof.system import System


@lru_cache(maxsize=64)
def _vectorised(expression: sp.Expr, variables: tuple[sp.Symbol, ...]) -> Callable[..., Any]:
    return sp.lambdify(variables, expression, modules="numpy", cse=True)


@lru_cache(maxsize=64)
def field_function(problem: Problem) -> Callable[[Array], Array]:
    """F for arrays of positions (n × …)."""
    function = _vectorised(problem.field.expression, problem.variables)

    def evaluate(x: Array) -> Array:
        with np.errstate(all="ignore"):
            return np.asarray(function(*x), dtype=float) + 0.0 * x[0]

    return evaluate


@lru_cache(maxsize=64)
def input_function(
    problem: Problem, seeker: str, system: System
) -> Callable[[Array, Array, Mapping[str, float]], dict[str, Array]]:
    """The inputs u₁ and u₂ (and the angular acceleration a) along a run in full coordinates, from t and x."""
    letters, symbols = loop_letters(problem), parameters
    law = feedback(
        problem.field.expression, letters.filter, symbols.k, symbols.omega, symbols.mu, gain_of(problem, seeker)
    )
    wanted = {"u1": law.forward, "u2": law.angular}
    if seeker.startswith("saturated"):
        loop = problem.closed_loop(seeker, "t", symbolic=True)
        wanted = {"u1": law.forward, "a": loop.rhs[loop.state.index(letters.angular_velocity)]}
    order = (
        symbols.k, symbols.omega, symbols.mu, symbols.T, symbols.nu_min, symbols.epsilon, symbols.level,
        symbols.gain, symbols.t0,
    )  # fmt: skip
    functions = {name: _vectorised(expression, (TIME, *system.state, *order)) for name, expression in wanted.items()}

    def evaluate(t: Array, x: Array, table: Mapping[str, float]) -> dict[str, Array]:
        values = [table.get(symbol.name, 1.0) for symbol in order]
        with np.errstate(all="ignore"):
            return {
                name: np.asarray(function(t, *x, *values), dtype=float) + 0.0 * t
                for name, function in functions.items()
            }

    return evaluate
