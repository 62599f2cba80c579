"""Integrals and limits as numbers with an honest bound of their error, or not at all."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import cache
from itertools import pairwise
from typing import Any

import sympy as sp

from ptproof.proof.attack.numbers import Ball, NotReal, Number, Undefined, Unsure, context, size
from ptproof.proof.attack.scope import Scope, Valuer
from ptproof.proof.attack.series import ONE, Series, base

_FEW, _MANY = 14, 20
_SETTLED = -40.0  # the base-2 logarithm of an error that is small enough
_STEPS = (8, 12, 16, 20, 24)


@cache
def _nodes(count: int, digits: int) -> tuple[tuple[Any, Any], ...]:
    """Gauss-Legendre nodes and weights on [0, 1]."""
    mp = context(digits)
    found = []
    for k in range(1, count + 1):
        x = mp.cos(mp.pi * (k - mp.mpf(1) / 4) / (count + mp.mpf(1) / 2))
        for _ in range(12):
            before, now = mp.one, x
            for n in range(2, count + 1):
                before, now = now, ((2 * n - 1) * x * now - (n - 1) * before) / n
            slope = count * (x * now - before) / (x * x - 1)
            step = now / slope
            x -= step
            if abs(step) < mp.eps:
                break
        found.append(((1 + x) / 2, 1 / ((1 - x * x) * slope * slope)))
    return tuple(found)


def integral(evaluator: Valuer, node: sp.Expr, scope: Scope) -> Number:
    """∫ by two Gauss-Legendre rules; a hundred times their disagreement is the bound."""
    integrand, *limits = node.args
    if len(limits) > 1:
        integrand, limits = sp.Integral(integrand, *limits[:-1]), limits[-1:]
    if len(limits[0]) != 3:
        raise Unsure("an integral without ends")
    variable, low, high = limits[0]
    if any(isinstance(value, Series) for value in scope.symbols.values()):
        raise Unsure("a derivative of an integral")
    if high == sp.oo or low == -sp.oo:
        return _improper(evaluator, integrand, variable, low, high, scope)
    ends = [evaluator.number(end, scope) for end in (low, high)]
    if ends[0] == ends[1]:
        return Fraction(0)
    numbers = evaluator.calculus.numbers
    width = numbers.sub(ends[1], ends[0])

    def at(part: Number) -> Number:
        place = numbers.add([ends[0], numbers.mul(width, part)])
        return evaluator.number(integrand, scope.with_values({variable: place}))

    return numbers.mul(width, _gauss(evaluator, at))


def _improper(evaluator: Valuer, integrand: sp.Expr, variable: Any, low: Any, high: Any, scope: Scope) -> Number:
    """∫ from a to ∞ through x = a + u/(1 - u), and the same downwards."""
    numbers = evaluator.calculus.numbers
    if low == -sp.oo:
        raise Unsure("an integral from minus infinity")
    start = evaluator.number(low, scope)

    def at(part: Number) -> Number:
        rest = numbers.inverse(numbers.sub(ONE, part))
        place = numbers.add([start, numbers.mul(part, rest)])
        return numbers.mul(evaluator.number(integrand, scope.with_values({variable: place})), numbers.mul(rest, rest))

    return _gauss(evaluator, at)


def _gauss(evaluator: Valuer, at: Callable[[Number], Number]) -> Number:
    """∫₀¹ on one panel, or on two or four where one is not enough."""
    for panels in (1, 2, 4):
        found = _panels(evaluator, at, panels)
        if found.error < _SETTLED + max(0.0, size(found.middle)):
            break
    return found


def _panels(evaluator: Valuer, at: Callable[[Number], Number], panels: int) -> Ball:
    numbers = evaluator.calculus.numbers
    totals: list[Number] = []
    for count in (_FEW, _MANY):
        terms: list[Number] = []
        for panel in range(panels):
            for place, weight in _nodes(count, numbers.digits):
                part = Ball((panel + place) / panels, 1.0 - numbers.bits)
                terms.append(numbers.mul(Ball(weight / panels, 1.0 - numbers.bits), at(part)))
        totals.append(numbers.add(terms))
    apart = numbers.ball(numbers.sub(totals[0], totals[1]))
    best = numbers.ball(totals[1])
    return Ball(best.middle, max(size(apart.middle), apart.error, best.error) + 7)


def limit(evaluator: Valuer, node: sp.Expr, scope: Scope) -> Number:
    """A limit from values that come closer and closer, if they settle down; infinite and doubtful ones raise."""
    expression, variable, point, direction = node.args
    if any(isinstance(value, Series) for value in scope.symbols.values()):
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
            place: Number = Fraction(10**step) * (1 if point == sp.oo else -1)
        else:
            target = base(evaluator.number(point, scope))
            place = numbers.add([target, Fraction(side, 10**step)])
        try:
            values.append(evaluator.number(expression, scope.with_values({variable: place})))
        except (NotReal, Undefined) as error:
            # A limit asks nothing of a place that is not near enough, and no place is known to be.
            raise Unsure("no real value on the way to a limit") from error
    sizes = [size(numbers.ball(numbers.sub(b, a)).middle) for a, b in pairwise(values)]
    last = numbers.ball(values[-1])
    if all(later > earlier + 1 for earlier, later in pairwise(sizes)) and sizes[-1] > 20:
        raise Grows(1 if last.middle > 0 else -1)
    if any(later > earlier - 3 and later > -60 for earlier, later in pairwise(sizes)):
        raise Unsure("a limit does not settle down")
    return Ball(last.middle, max(sizes[-1] + 10, last.error, -40.0))
