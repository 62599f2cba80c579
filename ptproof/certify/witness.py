"""Witnesses against the assumption: points that are higher than the source, critical points, failing limits."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import sympy as sp
from flint import arb

from ptproof.balls.ball import ball_from, enclose, enclosure_text, fraction, separated
from ptproof.balls.growth import GROWTHS, Exponent, Growth, coordinates
from ptproof.balls.tape import Undefined
from ptproof.certify.certificate import FieldWitness, distance_to
from ptproof.certify.critical import CriticalPoints, length, short_points, values_at
from ptproof.certify.domain import Domain
from ptproof.certify.evaluator import Place
from ptproof.certify.quotients import Quotients
from ptproof.problem.field import Field
from ptproof.proof.signs import vanishes

Vector = Sequence[sp.Rational]


def directions(n: int) -> Iterator[tuple[sp.Rational, ...]]:
    """Directions to try: the axes, the diagonals up to dimension 4, and in the plane those of small fractions."""
    for index in range(n):
        for sign in (1, -1):
            yield tuple(sp.Integer(sign * (i == index)) for i in range(n))
    if 1 < n <= 4:
        for entries in product((-1, 0, 1), repeat=n):
            if sum(map(abs, entries)) > 1:
                yield tuple(map(sp.Integer, entries))
    if n == 2:
        for entries in product(range(-4, 5), repeat=2):
            if max(map(abs, entries)) > 1 and math.gcd(*entries) == 1:
                yield tuple(map(sp.Integer, entries))


@dataclass(frozen=True)
class Prosecutor:
    """Looks for witnesses against one field on one domain."""

    field: Field
    quotients: Quotients
    domain: Domain

    def point(self, offset: Vector) -> tuple[sp.Expr, ...]:
        """x* + offset."""
        return tuple(s + y for s, y in zip(self.field.source, offset, strict=True))

    # Points that are not lower than the source.

    def not_lower(self, offset: Vector) -> FieldWitness | None:
        """The witness F(x) ≥ F(x*) at x = x* + offset, if that is certain there."""
        if not self.domain.contains(offset):
            return None
        x = self.point(offset)
        value, peak = self.field.value(x), self.field.peak
        try:
            sign = separated(value, peak)
            if sign == -1 or (sign is None and not vanishes(value - peak)):
                return None
            left = f"F(x) = {_shown(value)}"
        except (Undefined, TypeError, ValueError):
            return None
        relation = "lies above" if sign == 1 else "equals"
        return FieldWitness(
            f"F(x) {relation} F(x*) at another point x",
            values_at(self.field, x),
            left,
            f"F(x) < F(x*) = {_shown(peak)}",
            length(offset),
        )

    def not_lower_near(self, target: Sequence[float]) -> FieldWitness | None:
        """The same at a point with short coordinates near ``target``."""
        for digits in (0, 1, 2, 3, 4, 6, 9, 12):
            offset = tuple(sp.Rational(str(round(entry, digits))) for entry in target)
            if found := self.not_lower(offset):
                return found
        return None

    def not_lower_on_ray(self, direction: Vector, *, outward: bool) -> FieldWitness | None:
        """The same at a point x* + 2^±k·direction, far out or near the source."""
        for k in range(60):
            factor = sp.Integer(2) ** (k if outward else -k)
            if found := self.not_lower(tuple(factor * entry for entry in direction)):
                return found
        return None

    # Limits.

    def limit(
        self, direction: Vector, slope: bool, *, outward: bool, limit: str, detail: str, start: Vector | None = None
    ) -> FieldWitness:
        """The witness that a quotient tends to ``limit`` ("0", "at most 0" or "∞") along the ray x* + start + r·d.

        ``start`` is at right angles to the direction d; left out, it is 0.
        """
        power = 2 * self.field.kappa - slope
        quotient = f"{'‖∇F(x)‖' if slope else '(F(x*) − F(x))'}/{distance_to(power)}"
        r = sp.Symbol("r", positive=True)
        begin = start if start is not None else (sp.Integer(0),) * len(direction)
        origin = "from" if not any(begin) else "beside"
        name = ("b1" if slope else "a2") if limit != "∞" else ("b2" if slope else "a1")
        where = "r → ∞" if outward else "r → 0"
        right = f"{name} > 0" if limit != "∞" else f"a finite {name}"
        return FieldWitness(
            f"{quotient} tends to {limit} for {where} along a ray {origin} the source ({detail})",
            values_at(self.field, [s + c + r * d for s, c, d in zip(self.field.source, begin, direction, strict=True)]),
            f"{quotient} → {limit} for {where}",
            right,
            math.inf if outward else 0.0,
        )

    def at_infinity(self) -> FieldWitness | None:
        """A ray along which a quotient tends to 0 or to infinity far from the source, found by growth.

        The rays start at the source, or beside it at right angles, for a field may behave otherwise there.
        """
        n = self.quotients.n
        rays = [(direction, (sp.Integer(0),) * n) for direction in directions(n)]
        for index in range(n):
            ahead = tuple(sp.Integer(i == index) for i in range(n))
            for other in range(n):
                if other != index:
                    beside = tuple(sp.Rational(int(i == other), 2) for i in range(n))
                    rays += [(ahead, beside), (tuple(-entry for entry in ahead), beside)]
        for direction, start in rays:
            for slope in (False, True):
                if found := self._along_ray(direction, start, slope):
                    return found
        return None

    def _along_ray(self, direction: Vector, start: Vector, slope: bool) -> FieldWitness | None:
        top = 2 * self.field.kappa - slope
        balls = [ball_from(entry) for entry in direction]
        for k in (1, 4, 8, 16, 32):
            reach = arb(1) / 2**k
            far = [y + ball_from(c) for y, c in zip(coordinates(balls, reach), start, strict=True)]
            try:
                outputs = self.quotients.tape(slope).run(far, GROWTHS)
            except Undefined:
                continue
            heads = [_head(output, reach) for output in outputs]
            if all(finite and degree < top for degree, _, finite in heads):
                degree = max(degree for degree, _, _ in heads)
                detail = f"the numerator grows no faster than r^{degree}"
                return self.limit(direction, slope, outward=True, limit="0", detail=detail, start=start)
            for degree, sign, _ in heads:
                if degree <= top or sign == 0:
                    continue
                if sign < 0 and not slope:
                    return self.not_lower_on_ray(direction, outward=True)
                detail = f"the numerator grows at least like r^{degree}"
                return self.limit(direction, slope, outward=True, limit="∞", detail=detail, start=start)
        return None

    # Places that a search has come upon.

    def at_place(self, place: Place, best: float, slope: bool) -> FieldWitness | None:
        """What the best place of a search for a smallest quotient proves, where it is certainly at most −``best``."""
        value_is_zero_or_less, exactly_zero = best >= 0, best == 0
        if place.is_limit:
            if not value_is_zero_or_less:
                return None
            u = [fraction(entry) for entry in place.box.face.cube_point(place.point[1:])]
            outward = place.box.outer
            if not slope and (found := self.not_lower_on_ray(u, outward=outward)):
                return found
            value = "0" if exactly_zero else "at most 0"
            return self.limit(u, slope, outward=outward, limit=value, detail="by enclosure of the limit")
        offset = place.offset()
        if value_is_zero_or_less and not slope and (found := self.not_lower_near(offset)):
            return found
        return CriticalPoints(self.field, self.quotients, self.domain).near(offset)

    def undefined_near(self, target: Sequence[float]) -> FieldWitness | None:
        """The witness that F has no finite real value at a point with short coordinates near ``target``."""
        for x in short_points([float(s) + y for s, y in zip(self.field.source, target, strict=True)]):
            offset = tuple(entry - s for entry, s in zip(x, self.field.source, strict=True))
            value = self.field.value(x)
            if self.domain.contains(offset) and (value.has(sp.zoo, sp.nan, sp.oo, -sp.oo) or value.is_real is False):
                right = "a function that is twice continuously differentiable"
                left = f"F(x) = {value}"
                return FieldWitness("F is not defined at x", values_at(self.field, x), left, right, length(offset))
        return None


def _head(output: Any, reach: arb) -> tuple[Exponent, int, bool]:
    """(degree, sign of the leading behaviour or 0 where not certain, whether every coefficient is finite)."""
    growth = output if isinstance(output, Growth) else Growth({}, reach).lift(output)
    if not growth.terms:
        return -1, 0, True
    degree, head = growth.head()
    finite = all(c.low.is_finite() and c.high.is_finite() for c in growth.terms.values())
    return degree, 1 if head.low > 0 else -1 if head.high < 0 else 0, finite


def _shown(value: sp.Expr) -> str:
    text = str(value)
    if value.is_Rational and len(text) < 30:
        return text
    ball = enclosure_text(enclose(value))
    return f"{text} = {ball}" if len(text) < 60 else ball
