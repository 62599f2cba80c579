"""Text from outside becomes a SymPy expression, through a list of allowed names and nothing else.

The text is read by Python's own grammar (:mod:`ast`), and only numbers, the declared names, the functions
below and arithmetic are turned into SymPy objects. Nothing is evaluated as Python.
"""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import sympy as sp

from ptproof.errors import InputError

FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    "sin": sp.sin, "cos": sp.cos, "tan": sp.tan, "asin": sp.asin, "acos": sp.acos, "atan": sp.atan,
    "sinh": sp.sinh, "cosh": sp.cosh, "tanh": sp.tanh, "exp": sp.exp, "log": sp.log, "ln": sp.log,
    "sqrt": sp.sqrt, "Abs": sp.Abs, "abs": sp.Abs, "sign": sp.sign, "Max": sp.Max, "Min": sp.Min,
    "atan2": sp.atan2, "floor": sp.floor, "Mod": sp.Mod,
}  # fmt: skip
CONSTANTS: Mapping[str, sp.Expr] = {"pi": sp.pi, "E": sp.E}

_ARITHMETIC: Mapping[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
    ast.Pow: operator.pow, ast.Mod: sp.Mod,
}  # fmt: skip
_COMPARISONS: Mapping[type[ast.cmpop], Callable[[Any, Any], Any]] = {
    ast.Lt: sp.Lt, ast.LtE: sp.Le, ast.Gt: sp.Gt, ast.GtE: sp.Ge,
}  # fmt: skip
_LONGEST = 10_000
_LARGEST_EXPONENT = 10_000
_LARGEST_DECIMAL_EXPONENT = 400
_LARGEST_BITS = 100_000


def parse(
    text: str | int | float,
    names: Mapping[str, Any] | Sequence[sp.Symbol] = (),
    *,
    where: str = "expression",
) -> sp.Expr:
    """Read one expression exactly: ``"1.8"`` is 9/5 and ``"2*pi/3"`` is 2π/3.

    Parameters
    ----------
    text
        The expression in Python's notation, in which ``^`` is a power too. A number is taken as its decimal text.
    names
        What may occur in it besides :data:`FUNCTIONS` and :data:`CONSTANTS`: a mapping from name to symbol or
        undefined function, or a sequence of symbols.
    where
        How the caller calls this place; it opens the error message.

    Raises
    ------
    InputError
        For anything that is not arithmetic over the allowed names, or whose value is infinite or undefined.

    Examples
    --------
    >>> parse("1.8")
    9/5
    >>> x = sp.Symbol("x", real=True)
    >>> parse("cos(2*pi/3*x)/2 - 0.5*x^2", [x])
    -x**2/2 + cos(2*pi*x/3)/2
    """
    table = dict(names) if isinstance(names, Mapping) else {symbol.name: symbol for symbol in names}
    if isinstance(text, bool) or not isinstance(text, str | int | float):
        raise InputError(f"{where}: expected a number or an expression as text, got {text!r}")
    source = str(text).strip()
    if not source:
        raise InputError(f"{where}: the expression is empty")
    if len(source) > _LONGEST:
        raise InputError(f"{where}: the expression is longer than {_LONGEST} characters")
    # Before anything is parsed, since Python's own ^ binds looser than +; it has no other place in arithmetic.
    source = source.replace("^", "**")
    try:
        tree = ast.parse(source, mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        raise InputError(f"{where}: cannot read {source!r} ({getattr(error, 'msg', error)})") from None
    try:
        value = _Reader(source, table, where).read(tree.body)
    except RecursionError:
        raise InputError(f"{where}: {_short(source)} is nested too deeply") from None
    if not isinstance(value, sp.Expr):
        raise InputError(f"{where}: {_short(source)} is a condition, not an expression")
    if value.has(sp.zoo, sp.nan, sp.oo, -sp.oo):
        raise InputError(f"{where}: {_short(source)} is not a finite value")
    return value


def _short(text: str) -> str:
    return repr(text if len(text) <= 60 else text[:57] + "...")


class _Reader:
    def __init__(self, source: str, names: Mapping[str, Any], where: str) -> None:
        self.source, self.names, self.where = source, names, where

    def fail(self, reason: str) -> InputError:
        return InputError(f"{self.where}: {reason} in {_short(self.source)}")

    def read(self, node: ast.expr) -> Any:
        match node:
            case ast.Constant(value=bool()):
                return sp.true if node.value else sp.false
            case ast.Constant(value=int() as number):
                return sp.Integer(number)
            case ast.Constant(value=float()):
                return self.decimal((ast.get_source_segment(self.source, node) or "").replace("_", ""))
            case ast.Name(id=name):
                return self.name(name)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return -self.read(operand)
            case ast.UnaryOp(op=ast.UAdd(), operand=operand):
                return self.read(operand)
            case ast.BinOp(left=left, op=op, right=right) if type(op) in _ARITHMETIC:
                return self.arithmetic(op, self.read(left), self.read(right))
            case ast.Compare(left=left, ops=ops, comparators=right):
                return self.compare(self.read(left), ops, [self.read(item) for item in right])
            case ast.BoolOp(op=op, values=values):
                return (sp.And if isinstance(op, ast.And) else sp.Or)(*map(self.read, values))
            case ast.Call(func=ast.Name(id=name), args=args, keywords=[]):
                return self.call(name, args)
        segment = ast.get_source_segment(self.source, node) or type(node).__name__
        raise self.fail(f"{_short(segment)} is not arithmetic")

    def decimal(self, literal: str) -> sp.Rational:
        _, _, exponent = literal.lower().partition("e")
        if exponent and abs(int(exponent)) > _LARGEST_DECIMAL_EXPONENT:
            raise self.fail(f"{_short(literal)} is out of range")
        return sp.Rational(literal)

    def name(self, name: str) -> Any:
        if name in self.names:
            value = self.names[name]
            if isinstance(value, sp.Basic):
                return value
            raise self.fail(f"{name!r} is a function and needs arguments")
        if name in CONSTANTS:
            return CONSTANTS[name]
        known = ", ".join([*map(str, self.names), *CONSTANTS]) or "none"
        raise self.fail(f"unknown name {name!r} (known: {known})")

    def arithmetic(self, op: ast.operator, left: Any, right: Any) -> Any:
        if not (isinstance(left, sp.Expr) and isinstance(right, sp.Expr)):
            raise self.fail("a condition stands where a number should")
        if isinstance(op, ast.Pow) and right.is_number:
            self.check_power(left, right)
        if isinstance(op, ast.Div) and right.is_zero:
            raise self.fail("a division by zero")
        return _ARITHMETIC[type(op)](left, right)

    def check_power(self, base: sp.Expr, exponent: sp.Expr) -> None:
        """Refuse powers that would fill the memory before anybody could look at them."""
        if exponent.is_comparable and abs(exponent) > _LARGEST_EXPONENT:
            raise self.fail(f"an exponent over {_LARGEST_EXPONENT}")
        if base.is_Rational and exponent.is_Integer:
            bits = max(abs(int(base.p)), int(base.q)).bit_length()
            if bits * abs(int(exponent)) > _LARGEST_BITS:
                raise self.fail("a number that is too large")

    def compare(self, left: Any, ops: list[ast.cmpop], right: list[Any]) -> Any:
        parts = []
        for op, value in zip(ops, right, strict=True):
            if type(op) not in _COMPARISONS:
                raise self.fail("only <, <=, > and >= compare")
            parts.append(_COMPARISONS[type(op)](left, value))
            left = value
        return sp.And(*parts)

    def call(self, name: str, args: list[ast.expr]) -> Any:
        if name == "Piecewise":
            return self.piecewise(args)
        values = [self.read(arg) for arg in args]
        if name == "Derivative":
            return self.derivative(values)
        target = self.names.get(name, FUNCTIONS.get(name))
        if target is None or isinstance(target, sp.Basic):
            known = ", ".join(sorted({*FUNCTIONS, "Piecewise", "Derivative"}))
            raise self.fail(f"unknown function {name!r} (known: {known})")
        try:
            return target(*values)
        except TypeError:
            raise self.fail(f"wrong number of arguments for {name!r}") from None

    def piecewise(self, args: list[ast.expr]) -> sp.Expr:
        pairs = [arg.elts for arg in args if isinstance(arg, ast.Tuple) and len(arg.elts) == 2]
        if not pairs or len(pairs) < len(args):
            raise self.fail("Piecewise takes pairs (value, condition)")
        return sp.Piecewise(*(tuple(map(self.read, pair)) for pair in pairs))

    def derivative(self, values: list[Any]) -> sp.Expr:
        if len(values) < 2 or not all(isinstance(value, sp.Symbol) for value in values[1:]):
            raise self.fail("Derivative takes an expression and names of variables")
        return sp.diff(*values)
