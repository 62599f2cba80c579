"""What an expression is worth at a point: a recursion over its tree, from nothing but the tree and the point.

SymPy only hands over the tree: nothing is evaluated, substituted or simplified by it. Real semantics throughout: what
has no real value raises :class:`~ptproof.proof.attack.numbers.NotReal`, what has none at all ``Undefined``, and what is
not known here ``Unsure``.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.attack.elementary import COMPARISONS, UNARY, fits
from ptproof.proof.attack.functions import Concrete
from ptproof.proof.attack.limiting import integral, limit
from ptproof.proof.attack.numbers import ONE, ZERO, Exact, NotReal, Number, Undefined, Unsure
from ptproof.proof.attack.scope import BINDERS, Inadmissible, Scope, Work
from ptproof.proof.attack.series import Calculus, Series, Value, base, hashable
from ptproof.proof.attack.tree import Node, tree


class Evaluator:
    """Values of expressions at one precision, with ``functions`` in place of the undefined ones."""

    def __init__(self, digits: int, functions: Mapping[Any, Concrete], work: Work | None = None) -> None:
        self.calculus = Calculus(digits)
        self.functions = functions
        self.work = work if work is not None else Work()
        self.point = Scope({})
        self._concrete: dict[object, Concrete | None] = {}
        self._tag = itertools.count(1)
        self._depth = 0
        self._integrals: dict[Any, Number] = {}

    def number(self, expression: sp.Expr, scope: Scope) -> Number:
        """The value where no derivative is taken."""
        value = self.value(expression, scope)
        if isinstance(value, Series):
            raise Unsure("a derivative of something that is not differentiated here")
        return value

    def value(self, expression: sp.Expr, scope: Scope) -> Value:
        return self.worth(tree(expression), scope)

    def worth(self, node: Node, scope: Scope) -> Value:
        """The value of an expression that was taken apart before."""
        found = scope.known.get(node)
        if found is None:
            work = self.work
            work.steps += 1
            if work.steps > work.limit:
                raise Unsure("too much work")
            if node.handler is None:
                node.handler = _handler(node.expression)
            found = scope.known[node] = node.handler(self, node, scope)
        return found

    def _symbol(self, node: Node, scope: Scope) -> Value:
        try:
            return scope.symbols[node.expression]
        except KeyError:
            raise Unsure(f"{node.expression} has no value") from None

    def _number(self, node: Node, scope: Scope) -> Value:
        return node.rational

    def _applied(self, node: Node, scope: Scope) -> Value:
        given = scope.symbols.get(node.expression)
        if given is not None:
            return given
        function = node.function
        if function in self._concrete:
            concrete = self._concrete[function]
        else:
            concrete = self._concrete[function] = self.functions.get(node.expression.func)
        if concrete is None:
            raise Unsure(f"{node.expression.func} has no concrete function")
        arguments = [self.worth(argument, scope) for argument in node.parts]
        inside = Scope({**self.point.symbols, **dict(zip(concrete.arguments, arguments, strict=True))})
        self._depth += 1
        if self._depth > 8:
            raise Unsure("functions are defined by each other")
        try:
            return self._checked(node.expression, self.worth(tree(concrete.body), inside))
        finally:
            self._depth -= 1

    def _checked(self, node: AppliedUndef, value: Value) -> Value:
        number = base(value)
        if not fits(node, number, self.calculus):
            raise Inadmissible(f"{node} is {number}")
        return value

    # The nodes -------------------------------------------------------------------------------------------------------

    def _add(self, node: Node, scope: Scope) -> Value:
        return self.calculus.add([self.worth(part, scope) for part in node.parts])

    def _mul(self, node: Node, scope: Scope) -> Value:
        # All of them are evaluated: 0 times something undefined is undefined.
        total, *values = [self.worth(part, scope) for part in node.parts]
        for value in values:
            total = self.calculus.mul(total, value)
        return total

    def _pow(self, node: Node, scope: Scope) -> Value:
        base, exponent = node.parts
        return self.calculus.power(self.worth(base, scope), self.worth(exponent, scope))

    def _constant(self, node: sp.Expr, scope: Scope) -> Value:
        return self.calculus.numbers.constant(type(node).__name__)

    def _float(self, node: sp.Expr, scope: Scope) -> Value:
        sign, mantissa, exponent, _ = node._mpf_
        return Exact((-1) ** sign * int(mantissa)) * Exact(2) ** exponent

    def _undefined(self, node: sp.Expr, scope: Scope) -> Value:
        raise Undefined(f"{node} is not a number")

    def _imaginary(self, node: sp.Expr, scope: Scope) -> Value:
        raise NotReal("the imaginary unit occurs")

    def _unary(self, node: sp.Expr, scope: Scope) -> Value:
        return UNARY[type(node).__name__](self.calculus, self.value(node.args[0], scope))

    def _piecewise(self, node: sp.Expr, scope: Scope) -> Value:
        for piece in node.args:
            if self.truth(piece.args[1], scope):
                return self.value(piece.args[0], scope)
        raise Undefined("no piece of a Piecewise applies")

    def truth(self, condition: Any, scope: Scope) -> bool:
        """Whether a condition of a Piecewise holds."""
        name = type(condition).__name__
        if name in ("BooleanTrue", "BooleanFalse"):
            return bool(name == "BooleanTrue")
        if name in ("And", "Or", "Not"):
            inner = [self.truth(part, scope) for part in condition.args]
            return all(inner) if name == "And" else any(inner) if name == "Or" else not inner[0]
        test = COMPARISONS.get(name)
        if test is None:
            raise Unsure(f"the condition {condition} is not evaluated")
        left, right = (self.value(side, scope) for side in condition.args)
        return test(self.calculus.sign(self.calculus.sub(left, right)))

    def _extreme(self, node: sp.Expr, scope: Scope) -> Value:
        values = [self.value(part, scope) for part in node.args]
        found = values[0]
        for value in values[1:]:
            if type(node).__name__ == "Max":
                found = self.calculus.larger(found, value)
            else:
                found = self.calculus.neg(self.calculus.larger(self.calculus.neg(found), self.calculus.neg(value)))
        return found

    def _sign(self, node: sp.Expr, scope: Scope) -> Value:
        return Exact(self.calculus.sign(self.value(node.args[0], scope)))

    def _heaviside(self, node: sp.Expr, scope: Scope) -> Value:
        sign = self.calculus.sign(self.value(node.args[0], scope))
        return ONE if sign > 0 else ZERO if sign < 0 else self.value(node.args[1], scope)

    def _floor(self, node: sp.Expr, scope: Scope) -> Value:
        value = self.value(node.args[0], scope)
        below = self._below(value)
        if type(node).__name__ == "ceiling":
            return -self._below(self.calculus.neg(value))
        return below

    def _below(self, value: Value) -> Exact:
        number = base(value)
        if type(number) is Exact:
            found = Exact(number.floor())
        else:
            nearest = self.calculus.numbers.nearest(number)
            away = self.calculus.numbers.sign(self.calculus.numbers.sub(number, nearest))
            found = nearest - 1 if away < 0 else nearest
        if isinstance(value, Series) and type(number) is Exact and number == found:
            raise Unsure("a derivative at a jump")
        return found

    def _modulo(self, node: sp.Expr, scope: Scope) -> Value:
        left, right = (self.value(part, scope) for part in node.args)
        quotient = self.calculus.mul(left, self.calculus.inverse(right))
        return self.calculus.sub(left, self.calculus.mul(right, self._below(quotient)))

    def _atan2(self, node: sp.Expr, scope: Scope) -> Value:
        y, x = (self.value(part, scope) for part in node.args)
        calculus = self.calculus
        half = calculus.right_angle()
        if (sign := calculus.sign(x)) > 0:
            return calculus.arctangent(calculus.mul(y, calculus.inverse(x)))
        side = calculus.sign(y)
        if sign == 0:
            if side == 0:
                raise Undefined("the angle of the origin")
            return calculus.sub(
                calculus.mul(Exact(side), half), calculus.arctangent(calculus.mul(x, calculus.inverse(y)))
            )
        turn = calculus.mul(Exact(2 if side >= 0 else -2), half)
        return calculus.add([calculus.arctangent(calculus.mul(y, calculus.inverse(x))), turn])

    def _derivative(self, node: sp.Expr, scope: Scope) -> Value:
        levels, inside, known = [], dict(scope.symbols), {}
        for variable, count in node.variable_count:
            start = inside.get(variable)
            if isinstance(variable, AppliedUndef) and len(node.variable_count) == 1 and not node.args[0].has(*BINDERS):
                start = self.value(variable, scope)  # ∂g/∂l(x): what l(x) is worth moves, wherever it stands in g
            if not count.is_Integer or start is None or count > 6:
                raise Unsure(f"{node} is not evaluated")
            if count:
                moved = Series(next(self._tag), (start, ONE, *(ZERO,) * (int(count) - 1)))
                inside[variable] = known[tree(variable)] = moved
                levels.append((moved.tag, int(count)))
        value = self.value(node.args[0], Scope(inside, known))
        for tag, count in reversed(levels):
            if not isinstance(value, Series) or value.tag != tag:
                return ZERO
            value = self.calculus.mul(Exact(math.factorial(count)), value.terms[count])
        return value

    def _subs(self, node: sp.Expr, scope: Scope) -> Value:
        inner, variables, points = node.args
        values = {variable: self.value(point, scope) for variable, point in zip(variables, points, strict=True)}
        return self.value(inner, scope.with_values(values))

    def _sum(self, node: sp.Expr, scope: Scope) -> Value:
        term, *ranges = node.args
        variable, low, high = ranges[-1]
        first, last = (self.number(end, scope) for end in (low, high))
        if len(ranges) > 1 or type(first) is not Exact or type(last) is not Exact:
            raise Unsure("a sum with these ends is not evaluated")
        if first.q != 1 or last.q != 1 or last - first > 500:
            raise Unsure("a sum with these ends is not evaluated")
        values = [
            self.value(term, scope.with_values({variable: Exact(n)})) for n in range(int(first.p), int(last.p) + 1)
        ]
        if type(node).__name__ == "Sum":
            return self.calculus.add(values) if values else ZERO
        product: Value = ONE
        for value in values:
            product = self.calculus.mul(product, value)
        return product

    def _integral(self, node: sp.Expr, scope: Scope) -> Value:
        inside = tuple(sorted(node.free_symbols, key=str))
        key = (node, tuple(hashable(scope.symbols.get(symbol)) for symbol in inside))
        if key not in self._integrals:
            self._integrals[key] = integral(self, node, scope)
        return self._integrals[key]

    def _limit(self, node: sp.Expr, scope: Scope) -> Value:
        return limit(self, node, scope)


_Handler: TypeAlias = Callable[[Evaluator, Node, Scope], Value]
_ON_NODES: dict[str, _Handler] = {"Add": Evaluator._add, "Mul": Evaluator._mul, "Pow": Evaluator._pow}
_NODES: dict[str, Callable[[Evaluator, Any, Scope], Value]] = {
    "Float": Evaluator._float,
    "ImaginaryUnit": Evaluator._imaginary,
    "Piecewise": Evaluator._piecewise,
    "Max": Evaluator._extreme,
    "Min": Evaluator._extreme,
    "sign": Evaluator._sign,
    "Heaviside": Evaluator._heaviside,
    "floor": Evaluator._floor,
    "ceiling": Evaluator._floor,
    "Mod": Evaluator._modulo,
    "atan2": Evaluator._atan2,
    "Derivative": Evaluator._derivative,
    "Subs": Evaluator._subs,
    "Sum": Evaluator._sum,
    "Product": Evaluator._sum,
    "Integral": Evaluator._integral,
    "Limit": Evaluator._limit,
    **dict.fromkeys(UNARY, Evaluator._unary),
    **dict.fromkeys(("Pi", "Exp1", "GoldenRatio", "EulerGamma", "Catalan"), Evaluator._constant),
    **dict.fromkeys(("NaN", "ComplexInfinity"), Evaluator._undefined),
}


def _handler(expression: Any) -> _Handler:
    """What evaluates expressions of this type."""
    if isinstance(expression, AppliedUndef):
        return Evaluator._applied
    if expression.is_Symbol:
        return Evaluator._symbol
    if expression.is_Rational:
        return Evaluator._number
    name = type(expression).__name__
    if name in _ON_NODES:
        return _ON_NODES[name]
    if (found := _NODES.get(name)) is None:
        raise Unsure(f"{name} is not evaluated")
    return lambda evaluator, node, scope: found(evaluator, node.expression, scope)
