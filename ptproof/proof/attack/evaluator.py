"""What an expression is worth at a point: a recursion over its tree, from nothing but the tree and the point.

SymPy only hands over the tree: nothing is evaluated, substituted or simplified by it. Real semantics throughout: what
has no real value raises :class:`~ptproof.proof.attack.numbers.NotReal`, what has none at all ``Undefined``, and what is
not known here ``Unsure``.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.attack.concrete import Concrete
from ptproof.proof.attack.elementary import ANYTHING, COMPARISONS, UNARY, angle, below, meets
from ptproof.proof.attack.limiting import integral, limit
from ptproof.proof.attack.numbers import ONE, ZERO, Exact, NotReal, Number, Undefined, Unsure
from ptproof.proof.attack.program import ADD, FUNCTION, MUL, OTHER, POWER, Kind, follow, program
from ptproof.proof.attack.scope import Inadmissible, Scope, Work
from ptproof.proof.attack.series import Calculus, Series, Value, base, hashable
from ptproof.proof.attack.tree import Name, Node, tree


class Evaluator:
    """Values of expressions at one precision, with ``functions`` in place of the undefined ones."""

    def __init__(self, digits: int, functions: Mapping[Name, Concrete], work: Work | None = None) -> None:
        self.calculus = Calculus(digits)
        self.functions = functions
        self.work = work if work is not None else Work()
        self.point = Scope.of({})
        self._tag = itertools.count(1)
        self._depth = 0
        self._integrals: dict[Any, Number | Unsure] = {}

    def number(self, expression: sp.Expr, scope: Scope) -> Number:
        """The value where no derivative is taken."""
        return self.plain(tree(expression), scope)

    def plain(self, node: Node, scope: Scope) -> Number:
        """The same of an expression that was taken apart before."""
        value = self.worth(node, scope)
        if type(value) is Series:
            raise Unsure("a derivative of something that is not differentiated here")
        return value

    def value(self, expression: sp.Expr, scope: Scope) -> Value:
        return self.worth(tree(expression), scope)

    def worth(self, node: Node, scope: Scope) -> Value:
        """The value of an expression that was taken apart before; everything that it takes is known afterwards."""
        found = scope.known.get(node)
        if found is not None:
            return found
        if (node.constant is not None or node.symbol) and (found := self._looked_up(node, scope)) is not None:
            return found
        if self.work.steps > self.work.limit:
            raise Unsure("too much work")
        given = None if scope.outer is None else scope.given
        steps = node.programs.get(given)
        if steps is None:
            steps = node.programs[given] = program(node, given, _kind)
        follow(steps, self, scope)
        return scope.known[node]

    def _looked_up(self, node: Node, scope: Scope) -> Value | None:
        """The value of a number, or of a symbol around, which is known here afterwards too: that is one step."""
        found, around = node.constant, scope.outer
        while found is None and around is not None:
            found, around = around.known.get(node), around.outer
        if found is not None:
            self.work.steps += 1
            within: Scope | None = scope
            while within is not None and node not in within.known:
                within.known[node], within = found, within.outer
        return found

    def _symbol(self, node: Node, scope: Scope) -> Value:
        raise Unsure(f"{node.expression} has no value")

    def _applied(self, node: Node, scope: Scope) -> Value:
        given = scope.value_of(node)
        if given is not None:
            return given
        concrete = self.functions.get(node.function)
        if concrete is None:
            raise Unsure(f"{node.expression.func} has no concrete function")
        arguments, core = [self.worth(argument, scope) for argument in node.parts], concrete.core
        if core.constant is not None:
            value = self.point.known[core] = core.constant
            self.work.steps += 1
        else:
            inside = self.point.around(dict(zip(concrete.places, arguments, strict=True)), concrete.given)
            self._depth += 1
            if self._depth > 8:
                raise Unsure("functions are defined by each other")
            try:
                value = self.worth(core, inside)
            finally:
                self._depth -= 1
        if node.asked != ANYTHING and not meets(node.asked, base(value), self.calculus):
            raise Inadmissible(f"{node.expression} is {base(value)}")
        return value

    # The nodes -------------------------------------------------------------------------------------------------------

    def _constant(self, node: sp.Expr, scope: Scope) -> Value:
        return self.calculus.numbers.constant(type(node).__name__)

    def _float(self, node: sp.Expr, scope: Scope) -> Value:
        sign, mantissa, exponent, _ = node._mpf_
        return Exact((-1) ** sign * int(mantissa)) * Exact(2) ** exponent

    def _unknown(self, node: sp.Expr, scope: Scope) -> Value:
        raise Unsure(f"{type(node).__name__} is not evaluated")

    def _undefined(self, node: sp.Expr, scope: Scope) -> Value:
        raise Undefined(f"{node} is not a number")

    def _imaginary(self, node: sp.Expr, scope: Scope) -> Value:
        raise NotReal("the imaginary unit occurs")

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
        if type(node).__name__ == "ceiling":
            return -below(self.calculus, self.calculus.neg(value))
        return below(self.calculus, value)

    def _modulo(self, node: sp.Expr, scope: Scope) -> Value:
        left, right = (self.value(part, scope) for part in node.args)
        quotient = self.calculus.mul(left, self.calculus.inverse(right))
        return self.calculus.sub(left, self.calculus.mul(right, below(self.calculus, quotient)))

    def _atan2(self, node: sp.Expr, scope: Scope) -> Value:
        y, x = (self.value(part, scope) for part in node.args)
        return angle(self.calculus, y, x)

    def _derivative(self, node: Node, scope: Scope) -> Value:
        levels: list[tuple[int, int]] = []
        moved: dict[Node, Value] = {}
        for variable, count, applied in node.levels:
            start = moved.get(variable)
            if start is None:
                # ∂g/∂l(x): what l(x) is worth moves, wherever it stands in g.
                start = self.worth(variable, scope) if applied else scope.value_of(variable)
            if count is None or start is None or count > 6:
                raise Unsure(f"{node.expression} is not evaluated")
            if count:
                series = moved[variable] = Series(next(self._tag), (start, ONE, *(ZERO,) * (count - 1)))
                levels.append((series.tag, count))
        value = self.worth(node.parts[0], scope.around(moved, node.moved))
        for tag, count in reversed(levels):
            if type(value) is not Series or value.tag != tag:
                return ZERO
            value = value.terms[count]
            if count > 1:
                value = self.calculus.mul(Exact(math.factorial(count)), value)
        return value

    def _subs(self, node: Node, scope: Scope) -> Value:
        inner, letters, points, given = node.put
        values = [self.worth(point, scope) for point in points]
        return self.worth(inner, scope.around(dict(zip(letters, values, strict=True)), given))

    def _sum(self, node: sp.Expr, scope: Scope) -> Value:
        term, *ranges = node.args
        variable, low, high = ranges[-1]
        first, last = (self.number(end, scope) for end in (low, high))
        whole = all(type(end) is Exact and end.q == 1 for end in (first, last))
        if len(ranges) > 1 or not whole or last - first > 500:
            raise Unsure("a sum with these ends is not evaluated")
        places = map(Exact, range(int(first.p), int(last.p) + 1))
        values = [self.value(term, scope.with_values({variable: place})) for place in places]
        if type(node).__name__ == "Sum":
            return self.calculus.add(values) if values else ZERO
        return self.calculus.product(values) if values else ONE

    def _integral(self, node: Node, scope: Scope) -> Value:
        key = (node, tuple(hashable(scope.value_of(symbol)) for symbol in node.free))
        if key not in self._integrals:
            try:
                self._integrals[key] = integral(self, node, scope)
            except Unsure as error:
                self._integrals[key] = error  # what was given up is not begun again
        found = self._integrals[key]
        if isinstance(found, Unsure):
            raise found
        return found

    def _limit(self, node: sp.Expr, scope: Scope) -> Value:
        return limit(self, node, scope)


_ON_NODES: dict[str, Kind] = {
    "Add": Kind(ADD),
    "Mul": Kind(MUL),
    "Pow": Kind(POWER),
    "Derivative": Kind(OTHER, Evaluator._derivative),
    "Integral": Kind(OTHER, Evaluator._integral),
    "Subs": Kind(OTHER, Evaluator._subs),
}
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
    "Sum": Evaluator._sum,
    "Product": Evaluator._sum,
    "Limit": Evaluator._limit,
    **dict.fromkeys(("Pi", "Exp1", "GoldenRatio", "EulerGamma", "Catalan"), Evaluator._constant),
    **dict.fromkeys(("NaN", "ComplexInfinity"), Evaluator._undefined),
}


def _kind(node: Node) -> Kind:
    """How a node is evaluated."""
    expression = node.expression
    if isinstance(expression, AppliedUndef | sp.Symbol):
        return Kind(OTHER, Evaluator._applied if expression.args else Evaluator._symbol)
    name = type(expression).__name__
    if name in _ON_NODES:
        return _ON_NODES[name]
    if (function := UNARY.get(name)) is not None:
        return Kind(FUNCTION, function)
    found = _NODES.get(name, Evaluator._unknown)
    return Kind(OTHER, lambda evaluator, node, scope: found(evaluator, node.expression, scope))
