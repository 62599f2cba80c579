"""Expressions as functions of floats, by closures over their tree: for long runs, not for decisions at a point.

Like the evaluator, this is the attacker's own: no code is printed, so that no printer can be wrong.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias

import sympy as sp

from ptproof.proof.attack.numbers import Unsure

Values: TypeAlias = Sequence[float]
Number: TypeAlias = Callable[[Values], float]

_UNARY: Mapping[str, Callable[[float], float]] = {
    "exp": math.exp, "log": math.log, "sin": math.sin, "cos": math.cos, "tan": math.tan, "asin": math.asin,
    "acos": math.acos, "atan": math.atan, "sinh": math.sinh, "cosh": math.cosh, "tanh": math.tanh, "Abs": abs,
    "sign": lambda x: float((x > 0) - (x < 0)), "floor": math.floor, "asinh": math.asinh,
}  # fmt: skip
_COMPARISONS: Mapping[str, Callable[[float, float], bool]] = {
    "LessThan": lambda a, b: a <= b,
    "StrictLessThan": lambda a, b: a < b,
    "GreaterThan": lambda a, b: a >= b,
    "StrictGreaterThan": lambda a, b: a > b,
}


def in_floats(expression: sp.Expr, symbols: Sequence[sp.Symbol]) -> Number:
    """The expression as a function of the values of ``symbols``; :class:`Unsure` for what it cannot take."""
    return _number(sp.sympify(expression), {symbol: i for i, symbol in enumerate(symbols)})


def _number(node: Any, places: Mapping[Any, int]) -> Number:
    if node.is_Symbol and node in places:
        place = places[node]
        return lambda values: values[place]
    name = type(node).__name__
    if node.is_Number or name in ("Pi", "Exp1"):
        constant = {"Pi": math.pi, "Exp1": math.e}.get(name)
        fixed = float(node.p) / float(node.q) if node.is_Rational else float(node) if constant is None else constant
        return lambda values: fixed
    if name == "Piecewise":
        return _pieces(node, places)
    parts = [_number(part, places) for part in node.args]
    if name == "Add":
        return lambda values: math.fsum(part(values) for part in parts)
    if name == "Mul":
        return lambda values: math.prod(part(values) for part in parts)
    if name == "Pow":
        base, exponent = parts
        return lambda values: math.pow(base(values), exponent(values))
    if name in ("Max", "Min"):
        choose = max if name == "Max" else min
        return lambda values: choose(part(values) for part in parts)
    if name in _UNARY:
        function, (inner,) = _UNARY[name], parts
        return lambda values: function(inner(values))
    raise Unsure(f"{name} is not taken in floats")


def _pieces(node: Any, places: Mapping[Any, int]) -> Number:
    pieces = [(_number(value, places), _condition(condition, places)) for value, condition in node.args]

    def choose(values: Values) -> float:
        for value, condition in pieces:
            if condition(values):
                return value(values)
        raise ValueError("no piece applies")

    return choose


def _condition(node: Any, places: Mapping[Any, int]) -> Callable[[Values], bool]:
    name = type(node).__name__
    if name == "BooleanTrue":
        return lambda values: True
    if name in ("And", "Or"):
        inner = [_condition(part, places) for part in node.args]
        join = all if name == "And" else any
        return lambda values: join(part(values) for part in inner)
    if name not in _COMPARISONS:
        raise Unsure(f"{name} is not taken in floats")
    compare, (left, right) = _COMPARISONS[name], (_number(side, places) for side in node.args)
    return lambda values: compare(left(values), right(values))
