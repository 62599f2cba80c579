"""Values of SymPy trees by mpmath alone: what the engines' answers are held against.

Nothing of ptproof is used here,
and nothing of SymPy but the shape of trees. A value is real or there is none; what may
be a matter of rounding (which branch, which side of a jump) has no value either.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import mpmath
import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

DIGITS = 60
MP = mpmath.MPContext()
"""A context of its own, so that nobody else's precision is changed; numbers of it have 100 digits."""
MP.dps = 100
mpf = MP.mpf
_TINY = mpf(10) ** -40
_HUGE = mpf(10) ** 60


class NoValue(Exception):
    """The expression has no real value there, or none that rounding leaves certain."""


class Unsure(NoValue):
    """It may have one: rounding decides, or no rule is known here."""


Values = Mapping[Any, Any]
Functions = Mapping[str, Callable[..., Any]]

_FUNCTIONS: Mapping[str, Callable[[Any], Any]] = {
    "exp": MP.exp, "sin": MP.sin, "cos": MP.cos, "tan": MP.tan, "cot": MP.cot, "sec": MP.sec, "csc": MP.csc,
    "sinh": MP.sinh, "cosh": MP.cosh, "tanh": MP.tanh, "atan": MP.atan, "asinh": MP.asinh, "erf": MP.erf,
    "log": MP.log, "asin": MP.asin, "acos": MP.acos, "Ei": MP.ei,
}  # fmt: skip
_CONSTANTS: Mapping[Any, Callable[[], Any]] = {
    sp.pi: lambda: +MP.pi, sp.E: lambda: +MP.e, sp.GoldenRatio: lambda: +MP.phi,
    sp.EulerGamma: lambda: +MP.euler, sp.Catalan: lambda: +MP.catalan,
}  # fmt: skip


def value(expression: Any, values: Values, functions: Functions | None = None) -> Any:
    """The real value at the present precision of mpmath; raises :class:`NoValue`."""
    try:
        result = _Evaluator(values, functions or {}).visit(sp.sympify(expression))
    except (ZeroDivisionError, ValueError) as error:
        raise NoValue(str(error)) from None
    except (OverflowError, MemoryError, mpmath.libmp.NoConvergence) as error:
        raise Unsure(str(error)) from None
    return _real(result)


def certain(expression: Any, values: Values, functions: Functions | None = None) -> tuple[Any, Any]:
    """The value and a bound of its error, from two precisions; raises :class:`NoValue`."""
    with MP.workdps(DIGITS):
        rough = value(expression, values, functions)
    fine = value(expression, values, functions)
    return fine, 1000 * abs(fine - rough) + _TINY


def is_not_zero(expression: Any, values: Values, functions: Functions | None = None) -> bool:
    """Whether the value is certainly not 0; raises :class:`NoValue`."""
    found, error = certain(expression, values, functions)
    return bool(abs(found) > error)


def sign(expression: Any, values: Values, functions: Functions | None = None) -> int:
    """1 or −1 where the value certainly has that sign, else 0 (it may be 0); raises :class:`NoValue`."""
    found, error = certain(expression, values, functions)
    return 0 if abs(found) <= error else 1 if found > 0 else -1


def fails(left: Any, relation: str, right: Any, values: Values, functions: Functions | None = None) -> bool:
    """Whether ``left relation right`` certainly fails; raises :class:`NoValue`."""
    side = sign(sp.Add(left, sp.Mul(-1, right, evaluate=False), evaluate=False), values, functions)
    if side == 0:
        return False
    return {"=": True, "!=": False, "<": side > 0, "<=": side > 0, ">": side < 0, ">=": side < 0}[relation]


def _real(number: Any) -> Any:
    if isinstance(number, mpmath.ctx_mp_python._mpc):
        raise NoValue("not real")
    if not MP.isfinite(number) or abs(number) > _HUGE:
        raise Unsure("not finite, or too large to be known well")
    return number


class _Evaluator:
    def __init__(self, values: Values, functions: Functions) -> None:
        self.values, self.functions = values, functions

    def visit(self, node: Any) -> Any:
        if node in self.values:
            return _number(self.values[node])
        if isinstance(node, sp.Rational):
            return mpf(int(node.p)) / int(node.q)
        if node in _CONSTANTS:
            return _CONSTANTS[node]()
        method = getattr(self, f"visit_{type(node).__name__}", None)
        if method is not None:
            return _real(method(node))
        if isinstance(node, AppliedUndef):
            return _real(self.functions[node.func.__name__](*map(self.visit, node.args)))
        function = _FUNCTIONS.get(type(node).__name__)
        if function is None or len(node.args) != 1:
            raise Unsure(f"no rule for {type(node).__name__}")
        return _real(function(self.visit(node.args[0])))

    def visit_Add(self, node: Any) -> Any:
        return MP.fsum(map(self.visit, node.args))

    def visit_Mul(self, node: Any) -> Any:
        result = mpf(1)
        for argument in node.args:
            result *= self.visit(argument)
        return result

    def visit_Pow(self, node: Any) -> Any:
        base, exponent = self.visit(node.base), self.visit(node.exp)
        if isinstance(node.exp, sp.Integer):
            if base == 0 and node.exp < 0:
                raise NoValue("a division by 0")
            return base ** int(node.exp)
        if base < 0 or (base == 0 and exponent <= 0):
            raise NoValue("a power of what is negative")
        if base != 0 and abs(base) < _TINY:
            raise Unsure("a power of what may be 0 or negative")
        return MP.power(base, exponent)

    def visit_Abs(self, node: Any) -> Any:
        return abs(self.visit(node.args[0]))

    def visit_sign(self, node: Any) -> Any:
        inner = self.visit(node.args[0])
        return mpf(0) if inner == 0 else MP.sign(self.away(inner))

    def visit_Heaviside(self, node: Any) -> Any:
        return mpf(1) if self.away(self.visit(node.args[0])) > 0 else mpf(0)

    def visit_Max(self, node: Any) -> Any:
        return max(map(self.visit, node.args))

    def visit_Min(self, node: Any) -> Any:
        return min(map(self.visit, node.args))

    def visit_floor(self, node: Any) -> Any:
        return self.floored(self.visit(node.args[0]))

    def visit_ceiling(self, node: Any) -> Any:
        return -self.floored(-self.visit(node.args[0]))

    def visit_Mod(self, node: Any) -> Any:
        dividend, divisor = map(self.visit, node.args)
        return dividend - divisor * self.floored(dividend / divisor)

    def visit_atan2(self, node: Any) -> Any:
        y, x = map(self.visit, node.args)
        if y == 0 and x == 0:
            raise NoValue("the angle of the origin")
        if x < 0 and y != 0:
            self.away(y)
        return MP.atan2(y, x)

    def visit_Piecewise(self, node: Any) -> Any:
        for expression, condition in node.args:
            if self.holds(condition):
                return self.visit(expression)
        raise NoValue("no branch applies")

    def visit_Derivative(self, node: Any) -> Any:
        (variable, count), *rest = node.variable_count
        if rest or variable not in self.values or count > 2:
            raise Unsure("a derivative of another kind")
        at = self.visit(variable)

        def along(inner: Any) -> Any:
            return _Evaluator({**self.values, variable: inner}, self.functions).visit(node.expr)

        return MP.diff(along, at, int(count))

    def visit_Integral(self, node: Any) -> Any:
        if len(node.limits) != 1 or len(node.limits[0]) != 3:
            raise Unsure("an integral of another kind")
        variable, low, high = node.limits[0]

        def along(inner: Any) -> Any:
            return _Evaluator({**self.values, variable: inner}, self.functions).visit(node.function)

        if low is -sp.oo:
            if high is sp.oo:
                raise Unsure("an integral over the whole line")
            end = self.visit(high)
            return _quadrature(lambda u: along(end - u / (1 - u)) / (1 - u) ** 2, mpf(0), mpf(1))
        start = self.visit(low)
        if high is not sp.oo:
            return _quadrature(along, start, self.visit(high))
        return _quadrature(lambda u: along(start + u / (1 - u)) / (1 - u) ** 2, mpf(0), mpf(1))

    @staticmethod
    def away(number: Any) -> Any:
        if abs(number) < _TINY:
            raise Unsure("too near to a jump")
        return number

    @staticmethod
    def floored(number: Any) -> Any:
        nearest = MP.nint(number)
        if number != nearest and abs(number - nearest) < _TINY:
            raise Unsure("too near to a jump")
        return MP.floor(number)

    def holds(self, condition: Any) -> bool:
        if condition in (sp.true, sp.false):
            return bool(condition)
        if isinstance(condition, sp.And):
            return all(self.holds(part) for part in condition.args)
        if isinstance(condition, sp.Or):
            return any(self.holds(part) for part in condition.args)
        if isinstance(condition, sp.Not):
            return not self.holds(condition.args[0])
        if isinstance(condition, Relational):
            difference = self.visit(condition.lhs) - self.visit(condition.rhs)
            if difference != 0:
                self.away(difference)
            return {
                "<": difference < 0, "<=": difference <= 0, ">": difference > 0, ">=": difference >= 0,
                "==": difference == 0, "!=": difference != 0,
            }[condition.rel_op]  # fmt: skip
        raise Unsure(f"no rule for the condition {condition}")


_NODES = (
    (0.0, 0.5688888888888889),
    (0.5384693101056831, 0.47862867049936647),
    (0.906179845938664, 0.23692688505618908),
)
_RULE = [(sign * node, weight) for node, weight in _NODES for sign in (1, -1)][1:]


def _quadrature(function: Callable[[Any], Any], low: Any, high: Any) -> Any:
    """By Gauss's rule on 24 and on 48 pieces, which have to agree."""
    totals = []
    for pieces in (24, 48):
        half = (high - low) / (2 * pieces)
        middles = [low + half * (2 * k + 1) for k in range(pieces)]
        totals.append(half * MP.fsum(weight * function(m + half * node) for m in middles for node, weight in _RULE))
    if abs(totals[1] - totals[0]) > 1e-7 * (1 + abs(totals[0])):
        raise Unsure("the quadrature is not sure of itself")
    return totals[1]


def _number(given: Any) -> Any:
    if isinstance(given, sp.Rational):
        return mpf(int(given.p)) / int(given.q)
    return mpf(given) if isinstance(given, int) else given
