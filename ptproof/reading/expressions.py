"""Text from outside becomes a SymPy expression, through a list of allowed names and nothing else.

The text is read by Python's own grammar (:mod:`ast`), and only numbers, the declared names, the functions
below and arithmetic are turned into SymPy objects. Nothing is evaluated as Python.
"""

from __future__ import annotations

import ast
import operator
import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.logic.boolalg import Boolean

from ptproof.errors import InputError
from ptproof.reading.guards import INFINITE, arguments_refused, divisor_refused, is_deep, power_refused, value_refused

FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    "sin": sp.sin, "cos": sp.cos, "tan": sp.tan, "asin": sp.asin, "acos": sp.acos, "atan": sp.atan,
    "sinh": sp.sinh, "cosh": sp.cosh, "tanh": sp.tanh, "exp": sp.exp, "log": sp.log, "ln": sp.log,
    "sqrt": lambda value: sp.sqrt(value), "Abs": sp.Abs, "abs": sp.Abs, "sign": sp.sign, "Max": sp.Max, "Min": sp.Min,
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
_LARGEST_DECIMAL_EXPONENT = 400
_MOST_DERIVATIVES = 8


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
        For anything that is not arithmetic over the allowed names, for numbers that are too large to be written
        down, and where a part has no finite real value.

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
        raise InputError(f"{where}: expected a number or an expression as text, got {quoted(text)}")
    if isinstance(text, int) and (reason := value_refused(text)):
        raise InputError(f"{where}: {reason}")
    source = str(text).strip()
    if not source:
        raise InputError(f"{where}: the expression is empty")
    if len(source) > _LONGEST:
        raise InputError(f"{where}: the expression is longer than {_LONGEST} characters")
    # Before anything is parsed, since Python's own ^ binds looser than +; it has no other place in arithmetic.
    source = source.replace("^", "**")
    try:
        value = _Reader(source, table, where).number(_tree(source, where))
        if value.has(*INFINITE, sp.I, sp.AccumBounds):
            raise InputError(f"{where}: {quoted(source)} is not a finite real number")
        if is_deep(value):
            raise RecursionError
    except RecursionError:
        raise InputError(f"{where}: {quoted(source)} is nested too deeply") from None
    return value


def _tree(source: str, where: str) -> ast.expr:
    # Python warns of texts such as "1if" before it refuses them, and of names that it will refuse one day.
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return ast.parse(source, mode="eval").body
        except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
            reason = getattr(error, "msg", error)
            raise InputError(f"{where}: cannot read {quoted(source)} ({reason})") from None


def quoted(value: Any) -> str:
    """What was given, as an error quotes it: in Python's notation, and not much of it."""
    try:
        text = repr(value)
    except ValueError:
        text = "a number of thousands of digits"  # which Python does not write
    return text if len(text) <= 62 else f"{text[:58]}...{text[-1]}"


class _Reader:
    def __init__(self, source: str, names: Mapping[str, Any], where: str) -> None:
        self.source, self.names, self.where = source, names, where

    def fail(self, reason: str) -> InputError:
        return InputError(f"{self.where}: {reason} in {quoted(self.source)}")

    def number(self, node: ast.expr) -> sp.Expr:
        """What ``node`` says, if it is a number and no condition."""
        value = self.read(node)
        if not isinstance(value, sp.Expr):
            raise self.fail(f"the condition {self.text(node)} stands where a number should")
        return value

    def condition(self, node: ast.expr) -> Any:
        """What ``node`` says, if it is a condition and no number."""
        value = self.read(node)
        if not isinstance(value, Boolean) or isinstance(value, sp.Expr):
            raise self.fail(f"{self.text(node)} stands where a condition should")
        return value

    def text(self, node: ast.expr) -> str:
        return quoted(ast.get_source_segment(self.source, node) or type(node).__name__)

    def read(self, node: ast.expr) -> Any:
        """What ``node`` says; a number is finite and small enough to be written down."""
        value = self.value(node)
        self.unless(value_refused(value))
        return value

    def value(self, node: ast.expr) -> Any:
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
                return -self.number(operand)
            case ast.UnaryOp(op=ast.UAdd(), operand=operand):
                return self.number(operand)
            case ast.BinOp(left=left, op=op, right=right) if type(op) in _ARITHMETIC:
                return self.arithmetic(op, self.number(left), self.number(right))
            case ast.Compare(left=left, ops=ops, comparators=right):
                return self.compare(self.number(left), ops, list(map(self.number, right)))
            case ast.BoolOp(op=op, values=values):
                return (sp.And if isinstance(op, ast.And) else sp.Or)(*map(self.condition, values))
            case ast.Call(func=ast.Name(id=name), args=args, keywords=[]):
                return self.call(name, args)
        raise self.fail(f"{self.text(node)} is not arithmetic")

    def decimal(self, literal: str) -> sp.Rational:
        _, _, exponent = literal.lower().partition("e")
        if exponent and abs(int(exponent)) > _LARGEST_DECIMAL_EXPONENT:
            raise self.fail(f"{quoted(literal)} is out of range")
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
        raise self.fail(f"unknown name {quoted(name)} (known: {known})")

    def unless(self, reason: str) -> None:
        if reason:
            raise self.fail(reason)

    def arithmetic(self, op: ast.operator, left: sp.Expr, right: sp.Expr) -> sp.Expr:
        if isinstance(op, ast.Pow):
            self.unless(power_refused(left, right))
        if isinstance(op, ast.Div | ast.Mod):
            self.unless(divisor_refused(right))
        return _ARITHMETIC[type(op)](left, right)

    def compare(self, left: sp.Expr, ops: list[ast.cmpop], right: list[sp.Expr]) -> Any:
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
        if name == "Derivative":
            return self.derivative(args)
        values = list(map(self.number, args))
        target = self.names.get(name, FUNCTIONS.get(name))
        if target is None or isinstance(target, sp.Basic):
            known = ", ".join(sorted({*FUNCTIONS, "Piecewise", "Derivative"}))
            raise self.fail(f"unknown function {quoted(name)} (known: {known})")
        self.unless(arguments_refused(name, values))
        try:
            return target(*values)
        except TypeError:
            raise self.fail(f"wrong number of arguments for {name!r}") from None

    def piecewise(self, args: list[ast.expr]) -> sp.Expr:
        pairs = [arg.elts for arg in args if isinstance(arg, ast.Tuple) and len(arg.elts) == 2]
        if not pairs or len(pairs) < len(args):
            raise self.fail("Piecewise takes pairs (value, condition)")
        return sp.Piecewise(*((self.number(value), self.condition(condition)) for value, condition in pairs))

    def derivative(self, args: list[ast.expr]) -> sp.Expr:
        times = list(map(_times, args[1:]))
        variables = [arg.elts[0] if isinstance(arg, ast.Tuple) and arg.elts else arg for arg in args[1:]]
        values = list(map(self.number, [*args[:1], *variables]))
        if len(values) < 2 or not all(times) or not all(isinstance(value, sp.Symbol) for value in values[1:]):
            raise self.fail("Derivative takes an expression and names of variables, or pairs such as (x, 2)")
        inside = [node for node in ast.walk(args[0]) if isinstance(node, ast.Call)]
        if sum(times) + sum(_is_derivative(node) for node in inside) > _MOST_DERIVATIVES:
            raise self.fail(f"more than {_MOST_DERIVATIVES} derivatives of one expression")
        value = sp.diff(values[0], *zip(values[1:], times, strict=True))
        if value.has(sp.DiracDelta) or any(not node.expr.has(AppliedUndef) for node in value.atoms(sp.Derivative)):
            raise self.fail(f"no derivative of {self.text(args[0])}, which jumps")
        return value


def _times(variable: ast.expr) -> int:
    """How often a variable of a derivative is meant: n of (x, n), 1 of a name, 0 of what is neither."""
    if not isinstance(variable, ast.Tuple):
        return 1
    match variable.elts:
        case [_, ast.Constant(value=int(count))] if not isinstance(count, bool):
            return count
    return 0


def _is_derivative(node: ast.Call) -> int:
    named = isinstance(node.func, ast.Name) and node.func.id == "Derivative"
    return sum(map(_times, node.args[1:])) if named else 0
