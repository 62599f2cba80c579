"""A smooth system in heyoka's form, by heyoka's own converter from SymPy.

What depends on the parameters alone is computed once a run: as part of the expressions, heyoka would carry its Taylor
series, which is a number and zeros, through every product.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import lru_cache, reduce
from typing import Any

import numpy as np
import sympy as sp

from ptproof.errors import InputError
from ptproof.simulation.plan import Array
from ptproof.simulation.smooth import constants_apart
from ptproof.simulation.translate import number
from ptproof.system import System


@dataclass(frozen=True)
class Equations:
    """A smooth system in heyoka's form.

    Attributes
    ----------
    rates
        Pairs (variable, rate).
    constants
        From the system's parameters (m × …) to heyoka's, which are those and what was computed from them.
    count
        How many heyoka has.
    """

    rates: list[tuple[Any, Any]]
    constants: Callable[[Array], Array]
    count: int


@lru_cache(maxsize=64)
def equations(system: System) -> Equations:
    """The system for heyoka.

    Raises
    ------
    InputError
        For what heyoka's own converter from SymPy does not take.
    """
    import heyoka as hy

    made = hy.make_vars(*(f"x{i}" for i in range(system.dimension)))
    variables = made if isinstance(made, list) else [made]
    parameters = system.parameters or ()
    rhs, constants = constants_apart(system)
    table: dict[Any, Any] = {system.time: hy.time, **dict(zip(system.state, variables, strict=True))}
    table |= {symbol: hy.par[i] for i, symbol in enumerate((*parameters, *constants.values()))}
    function = sp.lambdify([parameters], list(constants), "numpy", cse=True)

    def evaluate(values: Array) -> Array:
        with np.errstate(all="ignore"):
            more = function(values)
        return np.array([*values, *more]).reshape(count, *values.shape[1:])

    rates, count = list(zip(variables, converted(rhs, table), strict=True)), len(parameters) + len(constants)
    return Equations(rates, evaluate, count)


def converted(expressions: Iterable[sp.Expr], table: dict[Any, Any]) -> list[Any]:
    """The expressions by heyoka's own converter, which is told beforehand what it would refuse or get wrong.

    It refuses numbers such as 1/3 and E. Its power rule divides by the base, so that x**3 would be NaN at 0: integer
    powers become products.
    """
    import heyoka as hy

    known, made = dict(table), []
    for expression in expressions:
        for node in sp.postorder_traversal(expression):
            if node in known:
                continue
            if node.is_number:
                known[node] = hy.expression(number(node))
            elif node.is_Symbol:
                raise InputError(f"the symbol {node} has no value; give it one in parameters")
            elif node.is_Pow and node.exp.is_Integer:
                power = _product(_by_heyoka(node.base, known), abs(int(node.exp)))
                known[node] = power if node.exp > 0 else hy.expression(1.0) / power
        made.append(_by_heyoka(expression, known))
    return made


def _by_heyoka(expression: sp.Expr, known: dict[Any, Any]) -> Any:
    import heyoka as hy

    try:
        return hy.from_sympy(expression, known)
    except TypeError as error:
        raise InputError(
            f"{error}: heyoka integrates smooth systems of elementary functions only; use the engine casadi"
        ) from None


def _product(base: Any, count: int) -> Any:
    """``base`` to the power ``count``, by squaring."""
    if count == 1:
        return base
    root = _product(base, count // 2)
    return reduce(operator.mul, [root, root, *([base] if count % 2 else [])])
