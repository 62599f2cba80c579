"""Attacking smoothness: derivatives beside an exact point, on all sides and closer and closer to it.

Beside the point the derivatives are exact (Taylor series); at the point only their limits are looked at. Derivatives
that grow without bound, or tend to different values from different sides, are no continuous ones.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

import sympy as sp

from ptproof.proof.attack.concrete import Concrete
from ptproof.proof.attack.evaluator import Evaluator
from ptproof.proof.attack.kinds import fits_kind
from ptproof.proof.attack.magnitudes import as_float, spread
from ptproof.proof.attack.numbers import ONE, ZERO, Exact, NotReal, Undefined, Unsure
from ptproof.proof.attack.preparation import Prepared
from ptproof.proof.attack.sampling import Point
from ptproof.proof.attack.scope import Inadmissible
from ptproof.proof.attack.series import Series, base
from ptproof.proof.attack.tree import Name, Node, tree
from ptproof.proof.statement import Smooth

_STEPS = tuple(Exact(1, 10**k) for k in (6, 11, 16))
_BOUNDED, _APART = 1e3, 200.0
_NOISE = 1e-20  # what is smaller may be rounding where a value is 0, and is no jump


def rough(statement: Smooth, ready: Prepared, point: Point, digits: int) -> str:
    """Why the statement fails at the point; empty if no reason was found."""
    variables = [tree(variable) for variable in statement.variables if tree(variable) in point.values]
    directions = _directions(variables)
    fixed = replace(point, functions=_fixed(point), made={})  # a function with a kink there must not move along
    evaluator = point.evaluator(digits)
    for expression in statement.expressions:
        try:
            evaluator.number(expression, evaluator.point)
        except (Undefined, NotReal) as error:
            return f"{error} at the point itself"
        except Unsure:
            pass
        for along in directions:
            sides = [
                _approached(expression, along, int(statement.order), towards, side, ready, fixed, digits)
                for towards, side in itertools.product(directions, (1, -1))
            ]
            for order, values in enumerate(zip(*(side for side in sides if side), strict=True)):
                if reason := _torn(values):
                    return f"derivative {order} {reason}"
    return ""


def _torn(sides: Sequence[Sequence[float]]) -> str:
    """What is wrong with a derivative that takes these values towards a point, from each of its sides."""
    if any(map(_grows, sides)):
        return "is not bounded"
    limits = [(values[-1], 2 * abs(values[-1] - values[-2])) for values in sides]
    for (a, e), (b, f) in itertools.combinations(limits, 2):
        if abs(a - b) > _APART * (e + f) + 1e-9 * (abs(a) + abs(b)) + _NOISE:
            return "jumps"
    return ""


def _directions(variables: Sequence[Node]) -> list[dict[Node, Exact]]:
    axes = [{variable: ONE} for variable in variables]
    if len(variables) < 2:
        return axes
    slopes = (ONE, Exact(-3, 2), Exact(2, 3), Exact(-5, 4))
    return [*axes, dict(zip(variables, itertools.cycle(slopes), strict=False))]


def _approached(
    expression: sp.Expr,
    along: Mapping[Node, Exact],
    order: int,
    towards: Mapping[Node, Exact],
    side: int,
    ready: Prepared,
    point: Point,
    digits: int,
) -> list[list[float]] | None:
    """The derivatives along a line, up to an order, at places that approach the point: for each order its values.

    None where the claim does not speak of these places.
    """
    found = []
    for step in _STEPS:
        values = {**point.values, **{atom: point.values[atom] + side * step * towards[atom] for atom in towards}}
        if not all(fits_kind(atom, values[atom]) for atom in towards):
            return None
        try:
            evaluator = replace(point, values=values, made={}).evaluator(digits)
            if not all(bound.sides.hold(evaluator, evaluator.point) for bound in ready.bounds):
                return None
            found.append(_derivatives(expression, along, order, evaluator))
        except (Unsure, Inadmissible):
            return None
    return [list(values) for values in zip(*found, strict=True)]


def _fixed(point: Point) -> Mapping[Name, Concrete]:
    known = {atom.expression: sp.Rational(int(value.p), int(value.q)) for atom, value in point.values.items()}
    return {
        function: replace(concrete, body=concrete.body.xreplace(known))
        for function, concrete in point.functions.items()
    }


def _derivatives(expression: sp.Expr, along: Mapping[Node, Exact], order: int, evaluator: Evaluator) -> list[float]:
    scope = evaluator.point
    if order:
        rest = (ZERO,) * (order - 1)
        starts = {atom: base(evaluator.plain(atom, scope)) for atom in along}
        moving = {atom: Series(0, (starts[atom], slope, *rest)) for atom, slope in along.items()}
        scope = scope.around(moving)
    value = evaluator.value(expression, scope)
    terms = value.terms if isinstance(value, Series) else (value, *((ZERO,) * order))
    evaluator.work.steps += 5 * order**2
    found = []
    for k, term in enumerate(terms):
        number = base(term)
        if type(number) is not Exact and spread(number) > max(-60.0, evaluator.calculus.numbers.negligible / 4):
            raise Unsure("a derivative is not known well enough")
        found.append(math.factorial(k) * as_float(number))
    return found


def _grows(values: Sequence[float]) -> bool:
    """Whether values grow by a factor, or by the same amount, each time the point is approached further."""
    sizes = [abs(value) for value in values]
    if all(later > 5 * earlier for earlier, later in pairwise(sizes)) and sizes[-1] > _BOUNDED:
        return True
    gains = [later - earlier for earlier, later in pairwise(sizes)]
    return min(gains) > 1e-3 and all(abs(b - a) < 0.02 * abs(a) for a, b in pairwise(gains))
