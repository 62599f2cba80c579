"""Integrals and limits as numbers with an honest bound of their error, or not at all."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, lru_cache
from itertools import pairwise
from typing import Any

import sympy as sp

from ptproof.proof.attack.magnitudes import size, spread, widened
from ptproof.proof.attack.numbers import ONE, ZERO, Arithmetic, Ball, Exact, NotReal, Number, Undefined, Unsure
from ptproof.proof.attack.scope import Scope, Valuer
from ptproof.proof.attack.series import base
from ptproof.proof.attack.tree import Node, tree

_FEW, _MANY = 14, 20
_ALL, _OFTEN = _FEW + _MANY, 2.0  # places of a panel; so many times more than is left
_SETTLED = -40.0  # the base-2 logarithm of an error that is small enough
_STEPS = (8, 12, 16, 20, 24)


@cache
def _nodes(count: int, digits: int) -> tuple[tuple[Ball, Ball], ...]:
    """Gauss-Legendre nodes and weights on [0, 1], at the precision of an evaluation with so many digits."""
    Arithmetic(digits).ready()
    found = (Ball.legendre_p_root(count, k, weight=True) for k in range(count))
    return tuple(((1 + root) / 2, weight / 2) for root, weight in found)


def integral(evaluator: Valuer, node: Node, scope: Scope) -> Number:
    """∫ by two Gauss-Legendre rules; a hundred times their disagreement is the bound."""
    integrand, variable, low, high = _outermost(node.expression)
    if scope.moves:
        raise Unsure("a derivative of an integral")
    if high.expression == sp.oo or low.expression == -sp.oo:
        return _improper(evaluator, integrand, variable, low, scope)
    ends = [evaluator.plain(end, scope) for end in (low, high)]
    if type(ends[0]) is type(ends[1]) is Exact and ends[0] == ends[1]:
        return ZERO
    numbers = evaluator.calculus.numbers
    width = numbers.sub(ends[1], ends[0])

    def at(part: Number) -> Number:
        place = numbers.add([ends[0], numbers.mul(width, part)])
        return evaluator.plain(integrand, scope.around({variable: place}))

    return numbers.mul(width, _gauss(evaluator, at))


@lru_cache(maxsize=1024)
def _outermost(expression: sp.Integral) -> tuple[Node, Node, Node, Node]:
    """What is integrated last, over which variable, and between which ends."""
    integrand, *limits = expression.args
    if len(limits) > 1:
        integrand, limits = sp.Integral(integrand, *limits[:-1]), limits[-1:]
    if len(limits[0]) != 3:
        raise Unsure("an integral without ends")
    variable, low, high = map(tree, limits[0])
    return tree(integrand), variable, low, high


def _improper(evaluator: Valuer, integrand: Node, variable: Node, low: Node, scope: Scope) -> Number:
    """∫ from a to ∞ through x = a + u/(1 - u), and the same downwards."""
    numbers = evaluator.calculus.numbers
    if low.expression == -sp.oo:
        raise Unsure("an integral from minus infinity")
    start = evaluator.plain(low, scope)

    def at(part: Number) -> Number:
        rest = numbers.inverse(numbers.sub(ONE, part))
        place = numbers.add([start, numbers.mul(part, rest)])
        return numbers.mul(evaluator.plain(integrand, scope.around({variable: place})), numbers.mul(rest, rest))

    return _gauss(evaluator, at)


def _gauss(evaluator: Valuer, at: Callable[[Number], Number]) -> Number:
    """∫₀¹ on one panel, or on two or four where one is not enough."""
    for panels in (1, 2, 4):
        found = _panels(evaluator, at, panels)
        if spread(found) < _SETTLED + max(0.0, size(found)):
            break
    return found


def _panels(evaluator: Valuer, at: Callable[[Number], Number], panels: int) -> Ball:
    """Both rules; given up where even the cheapest panels would take more work than there is left.

    The first places are those next to the upper end: what is integrated inside has been seen nearly whole by then, and
    the second one does not pay for what is the same at all places.
    """
    numbers, work = evaluator.calculus.numbers, evaluator.work
    totals: list[Number] = []
    for count in (_FEW, _MANY):
        terms: list[Number] = []
        for panel in reversed(range(panels)):
            for place, weight in _nodes(count, numbers.digits):
                before = work.steps
                numbers.ready()
                terms.append(numbers.mul(weight / panels, at((panel + place) / panels)))
                if not totals and len(terms) == 2 and (work.steps - before) * _ALL * panels > _OFTEN * work.left:
                    raise Unsure("too much work")
        totals.append(numbers.add(terms))
    apart = numbers.ball(numbers.sub(totals[0], totals[1]))
    return widened(numbers.ball(totals[1]), max(size(apart), spread(apart)) + 7)


def limit(evaluator: Valuer, node: sp.Expr, scope: Scope) -> Number:
    """A limit from values that come closer and closer, if they settle down; infinite and doubtful ones raise."""
    expression, variable, point, direction = node.args
    if scope.moves:
        raise Unsure("a derivative of a limit")
    sides = {"+": (1,), "-": (-1,), "+-": (1, -1)}[str(direction)]
    found = [_approached(evaluator, expression, variable, point, side, scope) for side in sides]
    numbers = evaluator.calculus.numbers
    if len(found) == 2:
        if numbers.sign(numbers.sub(found[0], found[1])) != 0:
            raise Undefined("the limits from the two sides differ")
        return numbers.hull(found[0], found[1])
    return found[0]


class Grows(Unsure):
    """A limit is infinite, as far as can be seen; ``sign`` says which way."""

    def __init__(self, sign: int) -> None:
        super().__init__("a limit is infinite")
        self.sign = sign


def _approached(evaluator: Valuer, expression: sp.Expr, variable: Any, point: Any, side: int, scope: Scope) -> Number:
    numbers = evaluator.calculus.numbers
    values: list[Number] = []
    for step in _STEPS:
        if point in (sp.oo, -sp.oo):
            place: Number = Exact(10**step) * (1 if point == sp.oo else -1)
        else:
            target = base(evaluator.number(point, scope))
            place = numbers.add([target, Exact(side, 10**step)])
        try:
            values.append(evaluator.number(expression, scope.with_values({variable: place})))
        except (NotReal, Undefined) as error:
            # A limit asks nothing of a place that is not near enough, and no place is known to be.
            raise Unsure("no real value on the way to a limit") from error
    sizes = [size(numbers.sub(b, a)) for a, b in pairwise(values)]
    last = numbers.ball(values[-1])
    if all(later > earlier + 1 for earlier, later in pairwise(sizes)) and sizes[-1] > 20:
        raise Grows(1 if float(last) > 0 else -1)
    if any(later > earlier - 3 and later > -60 for earlier, later in pairwise(sizes)):
        raise Unsure("a limit does not settle down")
    return widened(last, max(sizes[-1] + 10, spread(last), -40.0))
