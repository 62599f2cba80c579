"""Critical points of a field besides its source: exact ones, and boxes that certainly contain exactly one."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import sympy as sp
from flint import arb

from ptproof.balls.ball import BALLS, ball_from, enclosure_text
from ptproof.balls.newton import krawczyk, newton
from ptproof.balls.tape import Undefined, compile_tape
from ptproof.certify.certificate import FieldWitness, distance_to
from ptproof.certify.domain import Domain
from ptproof.certify.quotients import Quotients
from ptproof.problem.field import Field
from ptproof.proof.signs import vanishes


@dataclass(frozen=True)
class CriticalPoints:
    """Looks for points with ∇F = 0 in a domain without the source."""

    field: Field
    quotients: Quotients
    domain: Domain

    def near(self, start: Sequence[float]) -> FieldWitness | None:
        """One that Newton's method reaches from the offset ``start``, in all coordinates or along an axis."""
        n = self.quotients.n
        drop, offsets = self.quotients.drop, self.quotients.offsets
        axes = []
        for index in range(n if n > 1 else 0):
            rest = {y: 0 for i, y in enumerate(offsets) if i != index}
            if all(vanishes(sp.diff(drop, y).subs(rest)) for y in rest):  # the gradient stays on the axis
                axes.append([index])
        return next((found for kept in [list(range(n)), *axes] if (found := self._newton(start, kept))), None)

    def _newton(self, start: Sequence[float], kept: Sequence[int]) -> FieldWitness | None:
        active = [self.quotients.offsets[i] for i in kept]
        drop = self.quotients.drop.subs({y: 0 for y in self.quotients.offsets if y not in active})
        try:
            gradient = compile_tape([sp.diff(drop, y) for y in active], active)
            hessian = compile_tape([sp.diff(drop, y, z) for y in active for z in active], active)
        except Undefined:  # a gradient with a kink
            return None
        begin = [start[i] for i in kept]
        if len(kept) < len(start):
            begin = [math.copysign(math.hypot(*start), begin[0])]
        found = newton(gradient, hessian, begin)
        if found is None or math.hypot(*map(float, found)) < 1e-6:
            return None
        full = [0.0] * len(start)
        for index, entry in zip(kept, found, strict=True):
            full[index] = float(entry)
        return self._exact(full) or self._enclosed(found, kept, gradient, hessian)

    def _exact(self, offset: Sequence[float]) -> FieldWitness | None:
        for y in short_points(offset):
            if max(abs(float(a) - b) for a, b in zip(y, offset, strict=True)) > 1e-6 or not self.domain.contains(y):
                continue
            x = tuple(s + entry for s, entry in zip(self.field.source, y, strict=True))
            at = dict(zip(self.field.variables, x, strict=True))
            if all(vanishes(entry.subs(at)) for entry in self.field.gradient):
                return self._witness(values_at(self.field, x), "∇F(x) = 0 exactly", length(y))
        return None

    def _enclosed(self, found: Sequence[arb], kept: Sequence[int], gradient: Any, hessian: Any) -> FieldWitness | None:
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
        x = [enclosure_text(ball_from(s) + y, 12) for s, y in zip(self.field.source, full, strict=True)]
        left = "∇F(x) = 0 at exactly one point x of this box (interval Newton method)"
        return self._witness(values_at(self.field, x), left, float(square.upper()) ** 0.5 * (1 + 1e-12))

    def _witness(self, values: dict[str, str], left: str, distance: float) -> FieldWitness:
        right = f"‖∇F(x)‖ ≥ b1{distance_to(2 * self.field.kappa - 1)} > 0"
        return FieldWitness("the field has a second critical point", values, left, right, distance)


def short_points(near: Sequence[float]) -> Iterator[tuple[sp.Rational, ...]]:
    """Exact points with short fractions for coordinates, ever closer to ``near``."""
    for denominator in (1, 12, 1000):
        yield tuple(sp.Rational(Fraction(entry).limit_denominator(denominator)) for entry in near)


def values_at(field: Field, x: Sequence[Any]) -> dict[str, str]:
    """The coordinates of a point by the names of the field's variables."""
    return {str(variable): str(entry) for variable, entry in zip(field.variables, x, strict=True)}


def length(offset: Sequence[sp.Expr]) -> float:
    """A float that is at least ‖offset‖, and hardly more."""
    return float(sp.sqrt(sum((entry**2 for entry in offset), sp.Integer(0)))) * (1 + 1e-12)
