"""How an expression grows far away from the source: a sum of powers of r with interval coefficients.

A :class:`Growth` encloses a function on the region r ≥ r₀ ≥ 1, for a set of directions: f = Σ cₑ rᵉ, where each
coefficient may be any function whose values lie in an interval. Sine, cosine and the like are bounded by 1,
exp(−c rᵈ) by a negative power, log r by a root of r. Intervals may have an infinite end, so that growth that is
too fast is seen as such.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, reduce
from itertools import combinations_with_replacement, product
from typing import Any

from flint import arb, fmpq

from ptproof.balls.arithmetic import Ring, collected
from ptproof.balls.ball import BALLS, interval
from ptproof.balls.lifted import Lifted
from ptproof.balls.tape import Undefined


@dataclass(frozen=True)
class Span:
    """The interval from ``low`` to ``high``, whose ends may be infinite."""

    low: arb
    high: arb

    def __add__(self, other: Span) -> Span:
        return Span(self.low + other.low, self.high + other.high)

    def __neg__(self) -> Span:
        return Span(-self.high, -self.low)

    def __mul__(self, other: Span) -> Span:
        pairs = product((self.low, self.high), (other.low, other.high))
        ends = [arb(0) if a.is_zero() or b.is_zero() else a * b for a, b in pairs]  # also with an infinite end
        return Span(reduce(arb.min, ends), reduce(arb.max, ends))

    def square(self) -> Span:
        """The interval of the squares."""
        square = self * self
        return square if self.low > 0 or self.high < 0 else Span(arb(0), square.high)

    def hull(self, other: Span) -> Span:
        """The interval that contains both."""
        return Span(self.low.min(other.low), self.high.max(other.high))

    def common(self, other: Span) -> Span:
        """The interval of what both contain."""
        return Span(self.low.max(other.low), self.high.min(other.high))

    @property
    def is_zero(self) -> bool:
        """Whether the interval is exactly 0."""
        return bool(self.low.is_zero() and self.high.is_zero())

    def ball(self) -> arb:
        """The interval as a ball; raises :class:`Undefined` where an end is infinite."""
        if not (self.low.is_finite() and self.high.is_finite()):
            raise Undefined("it grows too fast")
        return self.low if self.is_zero else interval(self.low, self.high)


def span(ball: arb) -> Span:
    """The interval of a ball."""
    return Span(ball.lower(), ball.upper()) if not ball.is_exact() else Span(ball, ball)


INFINITY = arb.pos_inf()
Exponent = int | Fraction


def power_of(base: arb, exponent: Exponent) -> arb:
    """``base**exponent`` for base ≥ 0, with 0⁰ = 1."""
    if exponent == 0:
        return arb(1)
    if base.is_zero():
        return arb(0) if exponent > 0 else INFINITY
    return base ** arb(fmpq(exponent.numerator, exponent.denominator))


@dataclass(frozen=True)
class Growth(Ring):
    """Σ terms[e]·rᵉ for r ≥ 1/``reach``, ``reach`` an exact number in (0, 1].

    ``bounds`` gives an interval of all values that is known otherwise, for instance that a square is not negative; it
    is computed only where it is needed.
    """

    terms: Mapping[Exponent, Span]
    reach: arb
    bounds: Callable[[], Span] | None = None

    def make(self, terms: Mapping[Exponent, Span], bounds: Callable[[], Span] | None = None) -> Growth:
        """Another growth on the same region."""
        return Growth({key: value for key, value in terms.items() if not value.is_zero}, self.reach, bounds)

    def lift(self, other: Any) -> Growth:
        """``other`` as a growth; a ball is a constant."""
        return other if isinstance(other, Growth) else self.make({0: span(other)})

    def __add__(self, other: Any) -> Growth:
        lifted = self.lift(other)
        terms = collected((*self.terms.items(), *lifted.terms.items()))
        return self.make(terms, lambda: self.range + lifted.range)

    def __neg__(self) -> Growth:
        return self.make({exponent: -value for exponent, value in self.terms.items()}, lambda: -self.range)

    def __mul__(self, other: Any) -> Growth:
        lifted = self.lift(other)
        products = ((e + f, a * b) for e, a in self.terms.items() for f, b in lifted.terms.items())
        return self.make(collected(products), lambda: self.range * lifted.range)

    def square(self) -> Growth:
        """The square, which knows that the squares of the terms are not negative."""
        pairs, two = combinations_with_replacement(self.terms.items(), 2), Span(arb(2), arb(2))
        products = ((e + f, a.square() if e == f else two * a * b) for (e, a), (f, b) in pairs)
        return self.make(collected(products), lambda: self.range.square())

    def head(self) -> tuple[Exponent, Span]:
        """(d, h) with f = rᵈ·h: the largest exponent, and the interval of what remains."""
        if not self.terms:
            return 0, Span(arb(0), arb(0))
        degree = max(self.terms)
        total = Span(arb(0), arb(0))
        for exponent, value in self.terms.items():
            falls = degree - exponent
            total = total + value * Span(power_of(arb(0), falls), power_of(self.reach, falls))
        return degree, total

    @cached_property
    def range(self) -> Span:
        """The interval of all values; its ends may be infinite."""
        total = Span(arb(0), arb(0))
        for exponent, value in self.terms.items():
            near = power_of(self.reach, -exponent)
            powers = Span(near, INFINITY) if exponent > 0 else Span(arb(0) if exponent < 0 else near, near)
            total = total + value * powers
        degree, head = self.head()
        least = power_of(self.reach, -degree)
        if head.low > 0 and degree > 0:
            total = total.common(Span(head.low * least, INFINITY))
        if head.high < 0 and degree > 0:
            total = total.common(Span(-INFINITY, head.high * least))
        return total if self.bounds is None else total.common(self.bounds())


def coordinates(directions: Sequence[arb], reach: arb) -> list[Growth]:
    """The growth of y = r·w, for each coordinate of the directions w."""
    return [Growth({1: span(w)} if not w.is_zero() else {}, reach) for w in directions]


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

    def inverse(self, value: Any) -> Any:
        return _inverse(value)

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
