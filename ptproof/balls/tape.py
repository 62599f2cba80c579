"""A SymPy expression as a list of instructions that runs on any kind of number.

The same tape is run on real balls (an enclosure), on balls with partial derivatives (a mean value form) and on
power series of balls (a Taylor form with an enclosed remainder).
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache, partial, reduce
from typing import Any

import flint
import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.balls.arithmetic import Arithmetic
from ptproof.balls.arithmetic import Undefined as Undefined
from ptproof.system import differentiated

METHODS: Mapping[Any, str] = {
    sp.exp: "exp", sp.log: "log", sp.sin: "sin", sp.cos: "cos", sp.tan: "tan", sp.cot: "cot",
    sp.sinh: "sinh", sp.cosh: "cosh", sp.tanh: "tanh", sp.asin: "asin", sp.acos: "acos", sp.atan: "atan",
    sp.asinh: "asinh", sp.erf: "erf",
}  # fmt: skip
"""The functions of one argument, and their names in :meth:`Arithmetic.call`."""

_SIMPLE: Mapping[Any, str] = {
    sp.Add: "add", sp.Mul: "mul", sp.Abs: "absolute", sp.sign: "sign", sp.floor: "floor", sp.atan2: "angle",
}  # fmt: skip
_CONSTANTS: Mapping[Any, Callable[[], flint.arb]] = {
    sp.pi: flint.arb.pi,
    sp.E: flint.arb.const_e,
    sp.GoldenRatio: lambda: (1 + flint.arb(5).sqrt()) / 2,
    sp.EulerGamma: flint.arb.const_euler,
    sp.Catalan: flint.arb.const_catalan,
}


def nonnegative_by_form(expression: sp.Expr) -> bool:
    """Whether every real value of the symbols makes the expression >= 0, seen from its form alone.

    Assumptions on symbols are not consulted, since the values that are put in later need not satisfy them.
    """
    if isinstance(expression, sp.Rational):
        return bool(expression >= 0)
    if expression in _CONSTANTS or isinstance(expression, sp.Abs | sp.exp | sp.cosh):
        return True
    if isinstance(expression, sp.Pow):
        even = isinstance(expression.exp, sp.Integer) and expression.exp % 2 == 0
        half = isinstance(expression.exp, sp.Rational) and expression.exp.q % 2 == 0
        return bool(even or half or nonnegative_by_form(expression.base))
    if isinstance(expression, sp.Add | sp.Mul):
        return all(map(nonnegative_by_form, expression.args))
    return False


def switching_part(node: sp.Basic, symbols: Collection[sp.Symbol]) -> sp.Basic | None:
    """The outermost part of ``node`` that may have an enclosure beside a jump or a kink in ``symbols``, or None.

    Without such a part, an expression whose value and derivatives have finite enclosures on a box is analytic there:
    sums, products, powers and :data:`METHODS` are undefined where they are not, or their derivatives are.
    """
    if node.is_Symbol or not any(symbol in symbols for symbol in node.free_symbols):
        return None
    if not (node.is_Add or node.is_Mul or node.is_Pow or node.func in METHODS):
        return node
    return next((found for part in node.args if (found := switching_part(part, symbols)) is not None), None)


@dataclass(frozen=True)
class Condition:
    """A three-valued condition: ``kind`` is a relation with 0 of ``tape``, or and, or, not of ``parts``."""

    kind: str
    parts: tuple[Condition, ...] = ()
    tape: Tape | None = None

    def decide(self, values: Sequence[Any], arithmetic: Arithmetic) -> bool | None:
        """True or False where it is certain at ``values``, else None."""
        if self.tape is not None:
            try:
                sign = arithmetic.order(self.tape.run(values, arithmetic)[0])
            except Undefined:
                return None
            return None if sign is None else _RELATIONS[self.kind](sign, 0)
        found = [part.decide(values, arithmetic) for part in self.parts]
        if self.kind == "not":
            return None if found[0] is None else not found[0]
        stop = self.kind == "or"
        if stop in found:
            return stop
        return None if None in found else not stop


_RELATIONS: Mapping[str, Callable[[int, int], bool]] = {
    "<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge, "==": operator.eq, "!=": operator.ne,
}  # fmt: skip


@dataclass(frozen=True)
class Tape:
    """Instructions (operation, arguments, extra) in order; slot i < len(symbols) is an input.

    ``run`` returns one number per compiled expression, at the present precision of python-flint.
    """

    symbols: tuple[sp.Symbol, ...]
    code: tuple[tuple[str, tuple[int, ...], Any], ...]
    outputs: tuple[int, ...]

    @cached_property
    def _constants(self) -> dict[int, tuple[flint.arb, ...]]:
        """For each precision the constants in the order of the code."""
        return {}

    def __reduce__(self) -> tuple[type[Tape], tuple[Any, ...]]:
        return Tape, (self.symbols, self.code, self.outputs)

    def run(self, values: Sequence[Any], arithmetic: Arithmetic) -> list[Any]:
        """Execute on ``values``, one number per symbol; raises :class:`Undefined`."""
        slots = list(values)
        push, bits = slots.append, flint.ctx.prec
        if bits not in self._constants:
            named = (extra for operation, _, extra in self.code if operation == "const")
            self._constants[bits] = tuple(_constant(extra, bits) for extra in named)
        constants = iter(self._constants[bits])
        for operation, args, extra in self.code:
            if operation == "mul":
                total = slots[args[0]]
                for index in args[1:]:
                    total = total * slots[index]
                push(total)
            elif operation == "add":
                total = slots[args[0]]
                for index in args[1:]:
                    total = total + slots[index]
                push(total)
            elif operation == "pow":
                push(arithmetic.integer_power(slots[args[0]], extra))
            elif operation == "const":
                push(arithmetic.constant(next(constants)))
            elif operation == "call":
                push(arithmetic.call(extra, slots[args[0]]))
            elif operation == "root":
                push(arithmetic.root(slots[args[0]], *extra))
            elif operation == "piecewise":
                push(_piecewise(extra, slots[: len(self.symbols)], arithmetic))
            else:
                push(getattr(arithmetic, operation)(*(slots[index] for index in args)))
        return [slots[index] for index in self.outputs]


@lru_cache(maxsize=10_000)
def _constant(value: sp.Expr, bits: int) -> flint.arb:
    """The ball at the present precision, which is ``bits``, of a rational number or a named constant."""
    if isinstance(value, sp.Rational):
        return flint.arb(flint.fmpq(int(value.p), int(value.q)))
    return _CONSTANTS[value]()


def _piecewise(branches: Sequence[tuple[Tape, Condition]], values: Sequence[Any], arithmetic: Arithmetic) -> Any:
    candidates = []
    for tape, condition in branches:
        holds = condition.decide(values, arithmetic)
        if holds is False:
            continue
        candidates.append(tape)
        if holds:
            found = [tape.run(values, arithmetic)[0] for tape in candidates]
            return found[0] if len(found) == 1 else arithmetic.either(found)
    raise Undefined("a Piecewise whose conditions may all fail here")


def compile_tape(expressions: Sequence[sp.Expr], symbols: Sequence[sp.Symbol]) -> Tape:
    """Compile ``expressions`` in ``symbols``; equal subexpressions are computed once.

    Raises
    ------
    Undefined
        For what has no enclosure: an unknown symbol or function, infinity, the imaginary unit, a SymPy Float.
    """
    builder = _Builder(tuple(symbols))
    given = map(sp.sympify, expressions)
    carried = (differentiated(item) if item.has(sp.Derivative, sp.Subs) else item for item in given)
    outputs = tuple(map(builder.visit, carried))
    return Tape(builder.symbols, tuple(builder.code), outputs)


class _Builder:
    def __init__(self, symbols: tuple[sp.Symbol, ...]) -> None:
        self.symbols = symbols
        self.code: list[tuple[str, tuple[int, ...], Any]] = []
        self.known: dict[sp.Basic, int] = {symbol: index for index, symbol in enumerate(symbols)}

    def emit(self, operation: str, *args: int, extra: Any = None) -> int:
        self.code.append((operation, args, extra))
        return len(self.symbols) + len(self.code) - 1

    def visit(self, node: sp.Basic) -> int:
        if node not in self.known:
            self.known[node] = self.build(node)
        return self.known[node]

    def build(self, node: sp.Basic) -> int:
        if isinstance(node, sp.Float):
            raise Undefined(f"the floating-point number {node} in an exact expression; write a fraction")
        if isinstance(node, sp.Rational) or node in _CONSTANTS:
            return self.emit("const", extra=node)
        if isinstance(node, sp.Pow):
            return self.build_power(node)
        if node.func in METHODS and len(node.args) == 1:
            return self.emit("call", self.visit(node.args[0]), extra=METHODS[node.func])
        if node.func in _SIMPLE:
            return self.emit(_SIMPLE[node.func], *map(self.visit, node.args))
        if isinstance(node, sp.Max | sp.Min):
            operation = "maximum" if isinstance(node, sp.Max) else "minimum"
            return reduce(partial(self.emit, operation), map(self.visit, node.args))
        if isinstance(node, sp.Mod):
            dividend, divisor = node.args
            return self.visit(dividend - divisor * sp.floor(dividend / divisor))
        if isinstance(node, sp.ceiling):
            return self.emit("mul", self.visit(sp.S.NegativeOne), self.emit("floor", self.visit(-node.args[0])))
        if isinstance(node, sp.Heaviside):
            return self.visit(node.rewrite(sp.Piecewise))
        if isinstance(node, sp.Piecewise):
            branches = tuple(
                (compile_tape([value], self.symbols), self.condition(condition)) for value, condition in node.args
            )
            return self.emit("piecewise", extra=branches)
        if isinstance(node, sp.Symbol):
            raise Undefined(f"the symbol {node} has no value")
        if isinstance(node, AppliedUndef | sp.Derivative):
            raise Undefined(f"{node} is an undefined function")
        raise Undefined(f"no enclosure for {node.func.__name__}: {node}")

    def build_power(self, node: sp.Pow) -> int:
        base, exponent = node.args
        if isinstance(exponent, sp.Integer):
            return self.emit("pow", self.visit(base), extra=int(exponent))
        if base is sp.S.Exp1:
            return self.emit("call", self.visit(exponent), extra="exp")
        if isinstance(exponent, sp.Rational):
            extra = (int(exponent.p), int(exponent.q), nonnegative_by_form(base))
            return self.emit("root", self.visit(base), extra=extra)
        return self.emit("power", self.visit(base), self.visit(exponent))

    def condition(self, node: Any) -> Condition:
        if node == sp.true or node == sp.false:
            return Condition("and" if node == sp.true else "or")  # of nothing
        if isinstance(node, sp.And | sp.Or | sp.Not):
            return Condition(node.func.__name__.lower(), tuple(map(self.condition, node.args)))
        if isinstance(node, sp.core.relational.Relational) and not any(side.is_infinite for side in node.args):
            return Condition(node.rel_op, tape=compile_tape([node.lhs - node.rhs], self.symbols))
        raise Undefined(f"no enclosure for the condition {node}")
