"""How an expression grows far away from the source: a sum of powers of r with interval coefficients.

A :class:`Growth` encloses a function on the region r ≥ r₀ ≥ 1, for a set of directions: f = Σ cₑ rᵉ, where each
coefficient may be any function whose values lie in an interval. Sine, cosine and the like are bounded by 1,
exp(−c rᵈ) by a negative power, log r by a root of r. Intervals may have an infinite end, so that growth that is
too fast is seen as such.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, reduce
from itertools import combinations_with_replacement, product
from typing import Any

from flint import arb, fmpq

from ptproof.balls.arithmetic import Ring, collected
from ptproof.balls.ball import interval
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
