"""Witnesses against the assumption: points that are higher than the source, critical points, failing limits."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import Any

import sympy as sp
from flint import arb

from ptproof.balls.ball import BALLS, ball_from, enclose, enclosure_text, separated
from ptproof.balls.growth import Exponent, Growth, coordinates
from ptproof.balls.growths import GROWTHS
from ptproof.balls.newton import krawczyk, newton
from ptproof.balls.tape import Undefined, compile_tape
from ptproof.certify.certificate import FieldWitness
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

    def inside(self, offset: Vector) -> bool:
        """Whether x* + offset certainly lies in the domain."""
        square = sum((entry**2 for entry in offset), sp.Integer(0))
        if square == 0:
            return False
        low = self.domain.inner == 0 or separated(square, self.domain.inner**2) == 1 or square == self.domain.inner**2
        outer = self.domain.outer
        return low and (outer is None or square == outer**2 or separated(square, outer**2) == -1)

    def point(self, offset: Vector) -> tuple[sp.Expr, ...]:
        """x* + offset."""
        return tuple(s + y for s, y in zip(self.field.source, offset, strict=True))

    def _values(self, x: Sequence[Any]) -> dict[str, str]:
        return {str(variable): str(entry) for variable, entry in zip(self.field.variables, x, strict=True)}

    # Points that are not lower than the source.

    def not_lower(self, offset: Vector) -> FieldWitness | None:
        """The witness F(x) ≥ F(x*) at x = x* + offset, if that is certain there."""
        if not self.inside(offset):
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
            self._values(x),
            left,
            f"F(x) < F(x*) = {_shown(peak)}",
            _length(offset),
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
        numerator = "‖∇F(x)‖" if slope else "(F(x*) − F(x))"
        quotient = f"{numerator}/‖x − x*‖^{power}".replace("^1", "") if power == 1 else f"{numerator}/‖x − x*‖^{power}"
        r = sp.Symbol("r", positive=True)
        begin = start if start is not None else (sp.Integer(0),) * len(direction)
        origin = "from" if not any(begin) else "beside"
        name = ("b1" if slope else "a2") if limit != "∞" else ("b2" if slope else "a1")
        where = "r → ∞" if outward else "r → 0"
        right = f"{name} > 0" if limit != "∞" else f"a finite {name}"
        return FieldWitness(
            f"{quotient} tends to {limit} for {where} along a ray {origin} the source ({detail})",
            self._values([s + c + r * d for s, c, d in zip(self.field.source, begin, direction, strict=True)]),
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
            u = [_fraction(entry) for entry in place.box.face.cube_point(place.point[1:])]
            outward = place.box.outer
            if not slope and (found := self.not_lower_on_ray(u, outward=outward)):
                return found
            value = "0" if exactly_zero else "at most 0"
            return self.limit(u, slope, outward=outward, limit=value, detail="by enclosure of the limit")
        offset = place.offset()
        if value_is_zero_or_less and not slope and (found := self.not_lower_near(offset)):
            return found
        return self.critical_point_near(offset)

    def undefined_near(self, target: Sequence[float]) -> FieldWitness | None:
        """The witness that F has no finite real value at a point with short coordinates near ``target``."""
        source = [float(entry) for entry in self.field.source]
        for denominator in (1, 12, 1000):
            x = tuple(
                sp.Rational(Fraction(s + y).limit_denominator(denominator)) for s, y in zip(source, target, strict=True)
            )
            offset = tuple(entry - s for entry, s in zip(x, self.field.source, strict=True))
            value = self.field.value(x)
            if self.inside(offset) and (value.has(sp.zoo, sp.nan, sp.oo, -sp.oo) or value.is_real is False):
                right = "a function that is twice continuously differentiable"
                left = f"F(x) = {value}"
                return FieldWitness("F is not defined at x", self._values(x), left, right, _length(offset))
        return None

    # Critical points besides the source.

    def critical_point_near(self, start: Sequence[float]) -> FieldWitness | None:
        """A second point with ∇F = 0, exact or enclosed with proof, reached from ``start`` by Newton's method."""
        n = self.quotients.n
        everything = list(range(n))
        for kept in [everything] + [[index] for index in range(n) if n > 1 and self._gradient_stays_on_axis(index)]:
            if found := self._newton(start, kept):
                return found
        return None

    def _gradient_stays_on_axis(self, index: int) -> bool:
        offsets = self.quotients.offsets
        rest = {y: 0 for i, y in enumerate(offsets) if i != index}
        slopes = (sp.diff(self.quotients.drop, y).subs(rest) for y in rest)
        return all(vanishes(slope) for slope in slopes)

    def _newton(self, start: Sequence[float], kept: Sequence[int]) -> FieldWitness | None:
        offsets = self.quotients.offsets
        active = [offsets[i] for i in kept]
        drop = self.quotients.drop.subs({y: 0 for y in offsets if y not in active})
        gradient = compile_tape([sp.diff(drop, y) for y in active], active)
        hessian = compile_tape([sp.diff(drop, y, z) for y in active for z in active], active)
        begin = [start[i] for i in kept]
        if len(kept) < len(start):
            begin = [math.copysign(math.sqrt(sum(entry**2 for entry in start)), begin[0])]
        found = newton(gradient, hessian, begin)
        if found is None:
            return None
        full = [0.0] * len(start)
        for index, entry in zip(kept, found, strict=True):
            full[index] = float(entry)
        size = math.sqrt(sum(entry**2 for entry in full))
        if size < 1e-6:
            return None
        return self._exact_critical(full) or self._enclosed_critical(found, kept, gradient, hessian)

    def _exact_critical(self, offset: Sequence[float]) -> FieldWitness | None:
        for denominator in (1, 12, 1000):
            x = tuple(
                s + sp.Rational(Fraction(entry).limit_denominator(denominator))
                for s, entry in zip(self.field.source, offset, strict=True)
            )
            y = tuple(entry - s for entry, s in zip(x, self.field.source, strict=True))
            if max(abs(float(a) - b) for a, b in zip(y, offset, strict=True)) > 1e-6 or not self.inside(y):
                continue
            at = dict(zip(self.field.variables, x, strict=True))
            if all(vanishes(entry.subs(at)) for entry in self.field.gradient):
                return self._critical(self._values(x), "∇F(x) = 0 exactly", _length(y))
        return None

    def _enclosed_critical(
        self, found: Sequence[arb], kept: Sequence[int], gradient: Any, hessian: Any
    ) -> FieldWitness | None:
        box = krawczyk(found, gradient, hessian)
        if box is None:
            return None
        square = sum((BALLS.integer_power(ball, 2) for ball in box), arb(0))
        low, high = self.domain.inner, self.domain.outer
        if not square > 0 or (low != 0 and not square > ball_from(low**2)):
            return None
        if high is not None and not square < ball_from(high**2):
            return None
        full = [arb(0)] * self.quotients.n
        for index, ball in zip(kept, box, strict=True):
            full[index] = ball
        x = [ball_from(s) + y for s, y in zip(self.field.source, full, strict=True)]
        values = {str(v): _interval_text(entry) for v, entry in zip(self.field.variables, x, strict=True)}
        left = "∇F(x) = 0 at exactly one point x of this box (interval Newton method)"
        return self._critical(values, left, float(square.upper()) ** 0.5 * (1 + 1e-12))

    def _critical(self, values: dict[str, str], left: str, distance: float) -> FieldWitness:
        power = 2 * self.field.kappa - 1
        right = f"‖∇F(x)‖ ≥ b1‖x − x*‖^{power} > 0".replace("^1 ", " ")
        return FieldWitness("the field has a second critical point", values, left, right, distance)


def _head(output: Any, reach: arb) -> tuple[Exponent, int, bool]:
    """(degree, sign of the leading behaviour or 0 where not certain, whether every coefficient is finite)."""
    growth = output if isinstance(output, Growth) else Growth({}, reach).lift(output)
    if not growth.terms:
        return -1, 0, True
    degree, head = growth.head()
    finite = all(c.low.is_finite() and c.high.is_finite() for c in growth.terms.values())
    return degree, 1 if head.low > 0 else -1 if head.high < 0 else 0, finite


def _fraction(ball: arb) -> sp.Rational:
    value = ball.fmpq()
    return sp.Rational(int(value.p), int(value.q))


def _length(offset: Vector) -> float:
    return float(sp.sqrt(sum((entry**2 for entry in offset), sp.Integer(0)))) * (1 + 1e-12)


def _interval_text(ball: arb) -> str:
    return enclosure_text(ball, 12)


def _shown(value: sp.Expr) -> str:
    text = str(value)
    if value.is_Rational and len(text) < 30:
        return text
    ball = enclosure_text(enclose(value))
    return f"{text} = {ball}" if len(text) < 60 else ball
