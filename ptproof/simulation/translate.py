"""SymPy expressions as CasADi or heyoka expressions, by one table of rules; what has no rule is refused by name."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import reduce
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.errors import InputError
from ptproof.system import System

_SHARED_NAMES = ("exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh",
                 "asinh", "acosh", "atanh", "erf")  # fmt: skip
_LARGEST_PRODUCT = 16


@dataclass(frozen=True)
class Rules:
    """What an engine offers: its constants, its functions of one argument, its comparisons and its choices.

    An engine that leaves ``binary`` or ``select`` out takes smooth expressions only.
    """

    name: str
    constant: Callable[[float], Any]
    unary: Mapping[Any, Callable[[Any], Any]]
    power: Callable[[Any, Any], Any] = operator.pow
    binary: Mapping[Any, Callable[[Any, Any], Any]] = field(default_factory=dict)
    negate: Callable[[Any], Any] | None = None
    select: Callable[[Any, Any, Any], Any] | None = None


def casadi_rules() -> Rules:
    """All elementary functions, with Max, Min, Abs, sign, floor, ceiling, Mod, comparisons and Piecewise."""
    import casadi as ca

    unary = {getattr(sp, name): getattr(ca, name) for name in _SHARED_NAMES}
    unary |= {sp.Abs: ca.fabs, sp.sign: ca.sign, sp.floor: ca.floor, sp.ceiling: ca.ceil}
    binary = {
        sp.Max: ca.fmax, sp.Min: ca.fmin, sp.And: ca.logic_and, sp.Or: ca.logic_or, sp.atan2: ca.atan2,
        sp.StrictLessThan: ca.lt, sp.LessThan: ca.le, sp.StrictGreaterThan: ca.gt, sp.GreaterThan: ca.ge,
        sp.Equality: ca.eq, sp.Unequality: ca.ne, sp.Mod: lambda a, b: a - b * ca.floor(a / b),
    }  # fmt: skip
    return Rules("CasADi", ca.SX, unary, binary=binary, negate=ca.logic_not, select=ca.if_else)


def heyoka_rules() -> Rules:
    """Smooth elementary functions: a Taylor step across a kink would not notice it."""
    import heyoka as hy

    unary = {getattr(sp, name): getattr(hy, name) for name in _SHARED_NAMES}
    return Rules("heyoka", hy.expression, unary, binary={sp.atan2: hy.atan2})


def translate(expressions: Sequence[sp.Expr], symbols: Mapping[sp.Symbol, Any], rules: Rules) -> list[Any]:
    """The expressions in the engine's own form, with ``symbols`` put in and common subexpressions shared.

    Raises
    ------
    InputError
        For an undefined function, a symbol without a value, or a function that the engine has no rule for.
    """
    shared, reduced = sp.cse([sp.sympify(entry) for entry in expressions], order="none")
    table: dict[Any, Any] = dict(symbols)
    for symbol, entry in shared:
        table[symbol] = _one(entry, table, rules)
    return [_one(entry, table, rules) for entry in reduced]


def _one(node: Any, table: dict[Any, Any], rules: Rules) -> Any:
    if node in table:
        return table[node]
    if node is sp.true or node is sp.false:
        return rules.constant(1.0 if node is sp.true else 0.0)
    if isinstance(node, sp.Symbol):
        raise InputError(f"the symbol {node} has no value; give it one in parameters")
    if isinstance(node, AppliedUndef):
        raise InputError(f"{node} is an undefined function; put an expression in for it before simulating")
    if isinstance(node, sp.Expr) and node.is_number:
        return _number(node, rules)
    if isinstance(node, sp.Piecewise):
        return _piecewise(node, table, rules)
    if isinstance(node, sp.Heaviside):
        return _one(node.rewrite(sp.Piecewise), table, rules)
    if isinstance(node, sp.Pow):
        return _power(node, table, rules)
    args = [_one(argument, table, rules) for argument in node.args]
    head = type(node)
    if head in (sp.Add, sp.Mul):
        return reduce(operator.add if head is sp.Add else operator.mul, args)
    if head in rules.unary:
        return rules.unary[head](args[0])
    if head in rules.binary:
        return reduce(rules.binary[head], args)
    if head is sp.Not and rules.negate is not None:
        return rules.negate(args[0])
    if head is sp.ITE and rules.select is not None:
        return rules.select(*args)
    raise InputError(f"{rules.name} can't take {node.func.__name__}; {_advice(rules)}")


def _advice(rules: Rules) -> str:
    if rules.select is None:
        return "it integrates smooth systems only, so use the default engine"
    return "write it with elementary functions, Max, Min or Piecewise"


def _number(node: sp.Expr, rules: Rules) -> Any:
    value = sp.N(node, 17)
    if not value.is_Float and not value.is_Rational:
        raise InputError(f"{node} is not a finite real number, so it can't be simulated")
    return rules.constant(float(value))


def _power(node: sp.Pow, table: dict[Any, Any], rules: Rules) -> Any:
    base, exponent = node.base, node.exp
    if base is sp.E:
        return rules.unary[sp.exp](_one(exponent, table, rules))
    value = _one(base, table, rules)
    if exponent.is_Integer and abs(exponent) <= _LARGEST_PRODUCT:
        # Products instead of pow: right for negative bases, and several times faster.
        power = reduce(operator.mul, [value] * abs(int(exponent)))
        return power if exponent > 0 else rules.constant(1.0) / power
    return rules.power(value, _one(exponent, table, rules))


def _piecewise(node: sp.Piecewise, table: dict[Any, Any], rules: Rules) -> Any:
    if rules.select is None:
        raise InputError(f"{rules.name} can't take Piecewise; {_advice(rules)}")
    # Outside all conditions the value is undefined, as in SymPy.
    result: Any = rules.constant(float("nan"))
    for value, condition in reversed([piece.args for piece in node.args]):
        branch = _one(value, table, rules)
        result = branch if condition is sp.true else rules.select(_one(condition, table, rules), branch, result)
    return result


def casadi_expressions(system: System) -> tuple[Any, Any, Any, Any]:
    """CasADi's (time, x, p, rhs): the states in their order (n × 1), the parameters in theirs (m × 1)."""
    import casadi as ca

    parameters = system.parameters or ()
    time, x, p = ca.SX.sym(system.time.name), ca.SX.sym("x", system.dimension), ca.SX.sym("p", len(parameters))
    table = {system.time: time}
    table |= {symbol: x[i] for i, symbol in enumerate(system.state)}
    table |= {symbol: p[i] for i, symbol in enumerate(parameters)}
    return time, x, p, ca.vertcat(*translate(system.rhs, table, casadi_rules()))


def to_function(system: System, name: str = "rhs") -> Any:
    """The right-hand side as a CasADi ``Function`` (time, x, p) → rate, with x (n × 1) and p (m × 1).

    Raises :class:`InputError` as :func:`translate` does.
    """
    import casadi as ca

    time, x, p, rhs = casadi_expressions(system)
    return ca.Function(name, [time, x, p], [rhs], ["time", "x", "p"], ["rate"])
