"""SymPy expressions as CasADi expressions, by one table of rules; what has no rule is refused by name."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping, Sequence
from functools import cache, reduce
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.functions.elementary.piecewise import ExprCondPair

from ptproof.errors import InputError
from ptproof.system import System

_SHARED_NAMES = ("exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh",
                 "asinh", "acosh", "atanh", "erf")  # fmt: skip


@cache
def _rules() -> dict[Any, Callable[..., Any]]:
    """By the head of an expression: what takes its translated arguments."""
    import casadi as ca

    def folded(step: Callable[[Any, Any], Any]) -> Callable[..., Any]:
        return lambda *args: reduce(step, args)

    def piecewise(*pieces: tuple[Any, Any]) -> Any:
        # Outside all conditions the value is undefined, as in SymPy.
        return reduce(lambda rest, piece: ca.if_else(piece[1], piece[0], rest), reversed(pieces), ca.SX(float("nan")))

    many = {
        sp.Add: operator.add, sp.Mul: operator.mul, sp.Max: ca.fmax, sp.Min: ca.fmin, sp.And: ca.logic_and,
        sp.Or: ca.logic_or,
    }  # fmt: skip
    return {getattr(sp, name): getattr(ca, name) for name in _SHARED_NAMES} | {
        head: folded(step) for head, step in many.items()
    } | {
        sp.Abs: ca.fabs, sp.sign: ca.sign, sp.floor: ca.floor, sp.ceiling: ca.ceil, sp.Not: ca.logic_not,
        sp.atan2: ca.atan2, sp.StrictLessThan: ca.lt, sp.LessThan: ca.le, sp.StrictGreaterThan: ca.gt,
        sp.GreaterThan: ca.ge, sp.Equality: ca.eq, sp.Unequality: ca.ne, sp.ITE: ca.if_else,
        sp.Mod: lambda a, b: a - b * ca.floor(a / b),
        # CasADi makes products of powers with whole numbers, which are right for negative bases too.
        sp.Pow: operator.pow, ExprCondPair: lambda *pair: pair, sp.Piecewise: piecewise,
    }  # fmt: skip


def translate(expressions: Sequence[sp.Expr], symbols: Mapping[sp.Symbol, Any]) -> list[Any]:
    """The expressions for CasADi, with ``symbols`` put in and common subexpressions shared.

    All elementary functions are taken, and Max, Min, Abs, sign, floor, ceiling, Mod, comparisons and Piecewise.

    Raises
    ------
    InputError
        For an undefined function, a symbol without a value, or a function that there is no rule for.
    """
    shared, reduced = sp.cse([sp.sympify(entry) for entry in expressions], order="none")
    table: dict[Any, Any] = dict(symbols)
    for symbol, entry in shared:
        table[symbol] = _one(entry, table)
    return [_one(entry, table) for entry in reduced]


def number(node: sp.Expr) -> float:
    """The value of a constant; refused where it is not a finite real number."""
    value = sp.N(node, 17)
    if not value.is_Float and not value.is_Rational:
        raise InputError(f"{node} is not a finite real number, so it can't be simulated")
    return float(value)


def _one(node: Any, table: dict[Any, Any]) -> Any:
    import casadi as ca

    if node in table:
        return table[node]
    if node is sp.true or node is sp.false:
        return ca.SX(1.0 if node is sp.true else 0.0)
    if isinstance(node, sp.Symbol):
        raise InputError(f"the symbol {node} has no value; give it one in parameters")
    if isinstance(node, AppliedUndef):
        raise InputError(f"{node} is an undefined function; put an expression in for it before simulating")
    if isinstance(node, sp.Expr) and node.is_number:
        return ca.SX(number(node))
    if isinstance(node, sp.Heaviside):
        return _one(node.rewrite(sp.Piecewise), table)
    if (rule := _rules().get(type(node))) is None:
        raise InputError(
            f"CasADi can't take {node.func.__name__}; write it with elementary functions, Max, Min or Piecewise"
        )
    return rule(*(_one(argument, table) for argument in node.args))


def casadi_expressions(system: System) -> tuple[Any, Any, Any, Any]:
    """CasADi's (time, x, p, rhs): the states in their order (n × 1), the parameters in theirs (m × 1)."""
    import casadi as ca

    parameters = system.parameters or ()
    time, x, p = ca.SX.sym(system.time.name), ca.SX.sym("x", system.dimension), ca.SX.sym("p", len(parameters))
    table = {system.time: time}
    table |= {symbol: x[i] for i, symbol in enumerate(system.state)}
    table |= {symbol: p[i] for i, symbol in enumerate(parameters)}
    return time, x, p, ca.vertcat(*translate(system.rhs, table))


def to_function(system: System, name: str = "rhs") -> Any:
    """The right-hand side as a CasADi ``Function`` (time, x, p) → rate, with x (n × 1) and p (m × 1).

    Raises :class:`InputError` as :func:`translate` does.
    """
    import casadi as ca

    time, x, p, rhs = casadi_expressions(system)
    return ca.Function(name, [time, x, p], [rhs], ["time", "x", "p"], ["rate"])
