"""The order to which F(x*) − F(x) vanishes at the source, and directions in which its leading form does."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import product

import sympy as sp
from flint import arb

from ptproof.balls.ball import ball_from, separated
from ptproof.balls.tape import Undefined
from ptproof.certify.certificate import FieldWitness
from ptproof.certify.quotients import Quotients
from ptproof.certify.witness import Prosecutor, Vector, directions
from ptproof.problem.field import Field
from ptproof.proof.signs import vanishes


def source_order(field: Field, quotients: Quotients, prosecutor: Prosecutor) -> FieldWitness | None:
    """Prove that F(x*) − F(x) vanishes to the order 2κ at the source, or say how it fails.

    Returns None where every term of lower order vanishes and one of order 2κ does not; sets
    ``quotients.vanishing_is_proved``. Raises :class:`Undefined` where that cannot be decided.
    """
    top = 2 * field.kappa
    terms = quotients.expansion.terms
    for order in range(1, top + 1):
        found = {key: value for key, value in terms.items() if sum(key) == order}
        certain = any(value > 0 or value < 0 for value in found.values())
        present = certain or not all(_vanishes(quotients, key) for key in found)
        if present and order < top:
            return _too_steep(quotients, prosecutor, order)
        if order == top and not present:
            detail = f"the numerator vanishes to an order above {top}"
            return prosecutor.limit(next(directions(quotients.n)), False, outward=False, limit="0", detail=detail)
    quotients.vanishing_is_proved = True
    return None


def _vanishes(quotients: Quotients, key: Sequence[int]) -> bool:
    expression = quotients.drop
    for y, times in zip(quotients.offsets, key, strict=True):
        expression = sp.diff(expression, y, times) if times else expression
    value = expression.subs(dict.fromkeys(quotients.offsets, 0))
    if vanishes(value):
        return True
    if separated(value, 0) is None:
        raise Undefined(f"cannot decide whether the derivative {tuple(key)} vanishes at the source")
    return False


def _leading_form(quotients: Quotients, order: int) -> Callable[[Vector], arb]:
    terms = {key: value for key, value in quotients.expansion.terms.items() if sum(key) == order}

    def form(direction: Vector) -> arb:
        products = (value * ball_from(math.prod(map(pow, direction, key))) for key, value in terms.items())
        return sum(products, arb(0))

    return form


def _wide_directions(n: int) -> Iterator[tuple[sp.Rational, ...]]:
    yield from directions(n)
    for entries in product(range(-3, 4), repeat=min(n, 4)):
        yield tuple(map(sp.Integer, (*entries, *([0] * (n - len(entries))))))


def _too_steep(quotients: Quotients, prosecutor: Prosecutor, order: int) -> FieldWitness | None:
    form = _leading_form(quotients, order)
    signs = {d: form(d) for d in _wide_directions(quotients.n)}
    for direction, value in signs.items():
        if value < 0 and (found := prosecutor.not_lower_on_ray(direction, outward=False)):
            if order == 1:
                return replace(found, statement=f"the gradient at the source is not zero: {found.statement}")
            return found
    for direction, value in signs.items():
        if value > 0:
            detail = f"the numerator vanishes only to the order {order}"
            if order % 2 == 0:
                detail += f", which is κ = {order // 2}"
            return prosecutor.limit(direction, False, outward=False, limit="∞", detail=detail)
    raise Undefined(f"the field has a term of order {order} at the source, of a sign that was not found")


def degenerate_direction(field: Field, quotients: Quotients, prosecutor: Prosecutor) -> FieldWitness | None:
    """A direction in which the form of order 2κ is not positive, where one can be found exactly."""
    top = 2 * field.kappa
    form = _leading_form(quotients, top)
    for direction in _wide_directions(quotients.n):
        if not any(direction):
            continue
        value = form(direction)
        if value < 0:
            return prosecutor.not_lower_on_ray(direction, outward=False)
        if value.is_zero():
            detail = f"the terms of order {top} vanish in this direction"
            return prosecutor.limit(direction, False, outward=False, limit="0", detail=detail)
    if field.kappa == 1:
        hessian = field.hessian_at_source
        for kernel in hessian.nullspace(simplify=True):
            if all(map(vanishes, hessian * kernel)):
                detail = "the Hessian at the source is singular"
                return prosecutor.limit(tuple(kernel), False, outward=False, limit="0", detail=detail)
    return None
