"""Arithmetic and functions of growths: how sums, products, roots, exponentials and the like grow."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from functools import reduce
from typing import Any

from flint import arb, fmpq

from ptproof.balls.ball import BALLS, interval
from ptproof.balls.growth import INFINITY, Growth, Span, power_of
from ptproof.balls.lifted import Lifted
from ptproof.balls.tape import Undefined

FAST = 16
"""The power of r by which a decaying or growing exponential is replaced."""


class _Growths(Lifted):
    """The arithmetic of growths."""

    kind = Growth

    def call(self, name: str, value: Any) -> Any:
        if name == "exp":
            return _exponential(value)
        if name == "log":
            return _logarithm(value)
        if name in ("sinh", "cosh"):
            rising, falling = _exponential(value), _exponential(-value)
            return (rising + falling if name == "cosh" else rising - falling) * (arb(1) / 2)
        values = value.range
        if values.low.is_finite() and values.high.is_finite():
            return value.lift(BALLS.call(name, values.ball()))
        if name in ("sin", "cos"):
            return value.lift(interval(-1, 1))
        if name in ("atan", "tanh", "erf"):
            top = arb.pi() / 2 if name == "atan" else arb(1)
            low = BALLS.call(name, values.low) if values.low.is_finite() else -top
            high = BALLS.call(name, values.high) if values.high.is_finite() else top
            return value.lift(interval(low, high))
        raise Undefined(f"no bound for {name} of something unbounded")

    def integer_power(self, base: Any, exponent: int) -> Any:
        if exponent < 0:
            return _inverse(self.integer_power(base, -exponent))
        result: Any = arb(1)
        for bit in bin(exponent)[2:]:
            if isinstance(result, Growth):
                result = result.square()
            if bit == "1":
                result = base * result
        return result

    def root(self, base: Any, numerator: int, denominator: int, nonnegative: bool) -> Any:
        if numerator < 0:
            return _inverse(self.root(base, -numerator, denominator, nonnegative))
        whole, rest = divmod(numerator, denominator)
        degree, head = base.head()
        part = Fraction(rest, denominator)
        if head.low > 0 and head.high.is_finite():
            first = base.make({degree * part: Span(power_of(head.low, part), power_of(head.high, part))})
        elif nonnegative or base.range.low >= 0:
            # A concave power of a sum is at most the sum of the powers.
            first = base.make(
                {e * part: Span(arb(0), power_of(c.high.max(-c.low), part)) for e, c in base.terms.items()}
            )
        else:
            raise Undefined("a root of something that may be negative")
        return self.integer_power(base, whole) * first if whole else first

    def absolute(self, value: Any) -> Any:
        values = value.range
        if values.low >= 0 or values.high <= 0:
            return value if values.low >= 0 else -value
        return value.make({e: Span(arb(0), c.high.max(-c.low)) for e, c in value.terms.items()})

    sign = type(BALLS).sign

    def maximum(self, left: Any, right: Any) -> Any:
        return self.either([left, right])

    def floor(self, value: Any) -> Any:
        return value + interval(-1, 0)

    def angle(self, y: Any, x: Any) -> Any:
        return interval(-arb.pi(), arb.pi())

    def either(self, values: Sequence[Any]) -> Any:
        model = next((value for value in values if isinstance(value, Growth)), None)
        if model is None:
            return BALLS.either(values)
        lifted = [model.lift(value) for value in values]
        zero = Span(arb(0), arb(0))
        terms = {}
        for exponent in set().union(*(value.terms for value in lifted)):
            terms[exponent] = reduce(Span.hull, (value.terms.get(exponent, zero) for value in lifted))
        return model.make(terms)

    def order(self, value: Any) -> int | None:
        values = value.range
        return 1 if values.low > 0 else -1 if values.high < 0 else None


def _inverse(value: Any) -> Any:
    if not isinstance(value, Growth):
        return BALLS.integer_power(value, -1)
    degree, head = value.head()
    if (head.low > 0 or head.high < 0) and head.low.is_finite() and head.high.is_finite():
        return value.make({-degree: Span(1 / head.high, 1 / head.low)})
    values = value.range
    if values.low > 0:
        return value.make({0: Span(1 / values.high if values.high.is_finite() else arb(0), 1 / values.low)})
    if values.high < 0:
        return -_inverse(-value)
    raise Undefined("a division by something that may be zero")


def _exponential(value: Growth) -> Growth:
    degree, head = value.head()
    values = value.range
    if degree > 0 and head.high < 0:
        # exp(-c rᵈ) ≤ C r^(-FAST), C the largest r^FAST exp(-c rᵈ), which is at r₀ once r₀ is past its peak.
        rate, near = -head.high, 1 / value.reach
        if rate * arb(fmpq(degree.numerator, degree.denominator)) * power_of(near, degree) >= FAST:
            largest = near**FAST * (-rate * power_of(near, degree)).exp()
            decayed = Span(arb(0), (-rate * power_of(near, degree)).exp().upper())
            return value.make({-FAST: Span(arb(0), largest.upper())}, lambda: decayed)
    if degree > 0 and head.low > 0:
        # exp(g) ≥ gᵐ/m! for g ≥ 0.
        count = int(FAST / degree) + 1
        return value.make({degree * count: Span((head.low**count / math.factorial(count)).lower(), INFINITY)})
    low = values.low.exp().lower() if values.low.is_finite() else arb(0)
    high = values.high.exp().upper() if values.high.is_finite() else INFINITY
    return value.make({0: Span(low.max(arb(0)), high)})


def _logarithm(value: Growth) -> Growth:
    degree, head = value.head()
    near = 1 / value.reach
    # log r / √r falls from r = e² on and is nowhere above 2/e.
    steep = near.log() / near.sqrt() if near >= 8 else 2 / arb.const_e()
    weight = arb(fmpq(degree.numerator, degree.denominator))
    if head.low > 0 and head.high.is_finite():
        slow = Span(weight, weight) * Span(arb(0), steep.upper())
        return value.make({0: Span(head.low.log(), head.high.log())}) + value.make({Fraction(1, 2): slow})
    values = value.range
    size = sum((c.high.max(-c.low) * power_of(value.reach, degree - e) for e, c in value.terms.items()), arb(0))
    if not (values.low > 0 and degree >= 0 and size.is_finite()):
        raise Undefined("a logarithm of something that may not be positive")
    low = values.low.log()
    constant = value.make({0: Span(low, size.log().max(low))})
    return constant + value.make({Fraction(1, 2): Span(arb(0), (weight * steep).upper())})


GROWTHS = _Growths()
