"""Truncated Taylor series over the attacker's numbers: derivatives that are exact, also nested and of any order.

A :class:`Series` has a tag. Its coefficients are numbers or series with smaller tags, so that a derivative inside
another derivative keeps its own variable.
"""

from __future__ import annotations

from itertools import islice
from typing import NamedTuple, TypeAlias

from ptproof.proof.attack.magnitudes import size, spread
from ptproof.proof.attack.numbers import ONE, ZERO, Arithmetic, Ball, Exact, NotReal, Number, Undefined, Unsure

HALF = Exact(1, 2)


class Series(NamedTuple):
    """Σ ``terms[k]`` εᵏ in the variable ε of ``tag``, up to the power ``len(terms) - 1``."""

    tag: int
    terms: tuple[Value, ...]


Value: TypeAlias = Number | Series


def base(value: Value) -> Number:
    """The number at the expansion point."""
    while isinstance(value, Series):
        value = value.terms[0]
    return value


class Calculus:
    """The operations of :class:`~ptproof.proof.attack.numbers.Arithmetic`, for series too."""

    def __init__(self, digits: int) -> None:
        self.numbers = Arithmetic(digits)

    def add(self, terms: list[Value]) -> Value:
        for term in terms:
            if type(term) is Series:
                return self._sum(terms)
        return self.numbers.add(terms)

    def _sum(self, terms: list[Value]) -> Value:
        tag = max(term.tag for term in terms if type(term) is Series)
        moving = [term.terms for term in terms if type(term) is Series and term.tag == tag]
        start = self.add([term.terms[0] if type(term) is Series and term.tag == tag else term for term in terms])
        if len(moving) == 1:
            return Series(tag, (start, *moving[0][1:]))
        return Series(tag, (start, *(self.add(list(row)) for row in islice(zip(*moving, strict=True), 1, None))))

    def neg(self, value: Value) -> Value:
        if isinstance(value, Series):
            return Series(value.tag, tuple(map(self.neg, value.terms)))
        return self.numbers.neg(value)

    def sub(self, left: Value, right: Value) -> Value:
        return self.add([left, self.neg(right)])

    def mul(self, left: Value, right: Value) -> Value:
        if type(left) is not Series:
            if type(right) is not Series:
                return self.numbers.mul(left, right)
            left, right = right, left
        elif type(right) is Series and right.tag > left.tag:
            left, right = right, left
        if type(right) is not Series or right.tag < left.tag:
            return Series(left.tag, tuple([self.mul(term, right) for term in left.terms]))
        order = range(len(left.terms))
        return Series(left.tag, tuple([self._convolution(left.terms, right.terms, k) for k in order]))

    def product(self, factors: list[Value]) -> Value:
        """The product of at least one factor, from left to right."""
        total = factors[0]
        for factor in factors[1:]:
            if type(total) is Series or type(factor) is Series:
                total = self.mul(total, factor)
            else:
                total = self.numbers.mul(total, factor)
        return total

    def _convolution(self, left: tuple[Value, ...], right: tuple[Value, ...], k: int) -> Value:
        products = [
            self.mul(left[j], right[k - j]) for j in range(k + 1) if not (_nothing(left[j]) or _nothing(right[k - j]))
        ]
        return ZERO if not products else products[0] if len(products) == 1 else self.add(products)

    def inverse(self, value: Value) -> Value:
        if not isinstance(value, Series):
            return self.numbers.inverse(value)
        first = self.inverse(value.terms[0])
        found: list[Value] = [first]
        for k in range(1, len(value.terms)):
            rest = self.add([self.mul(value.terms[j], found[k - j]) for j in range(1, k + 1)])
            found.append(self.neg(self.mul(first, rest)))
        return Series(value.tag, tuple(found))

    def sign(self, value: Value) -> int:
        """The sign of the number at the expansion point; of a series that starts with 0 it is not constant."""
        sign = self.numbers.sign(base(value))
        if sign == 0 and isinstance(value, Series) and not is_zero(value):
            raise Unsure("a derivative at a place where something changes its sign")
        return sign

    def power(self, value: Value, exponent: Value) -> Value:
        if type(value) is not Series and type(exponent) is not Series:
            return self.numbers.power(value, exponent)
        if isinstance(exponent, Series):
            return self.exp(self.mul(exponent, self.log(value)))
        assert isinstance(value, Series)
        if type(exponent) is Exact and exponent.q == 1 and abs(exponent) < 100:
            return self._integer_power(value, int(exponent.p))
        start = self.numbers.sign(base(value))
        if start < 0:
            return Series(value.tag, (self.numbers.power(base(value), exponent),))  # which says why it has no value
        if start == 0:
            return self._power_at_zero(value, exponent)
        found: list[Value] = [self.power(value.terms[0], exponent)]
        first = self.inverse(value.terms[0])
        for k in range(1, len(value.terms)):
            parts = []
            for j in range(1, k + 1):
                factor = self.numbers.sub(self.numbers.mul(exponent, Exact(j)), Exact(k - j))
                parts.append(self.mul(factor, self.mul(value.terms[j], found[k - j])))
            found.append(self.mul(self.mul(first, Exact(1, k)), self.add(parts)))
        return Series(value.tag, tuple(found))

    def _integer_power(self, value: Value, exponent: int) -> Value:
        if exponent < 0:
            return self.inverse(self._integer_power(value, -exponent))
        result: Value = ONE
        while exponent:
            if exponent & 1:
                result = self.mul(result, value)
            value, exponent = (self.mul(value, value) if exponent > 1 else value), exponent >> 1
        return result

    def _power_at_zero(self, value: Series, exponent: Number) -> Value:
        """ε to a power that is larger than the order leaves nothing; any other has a kink or a pole there."""
        if self.numbers.sign(exponent) < 0:
            raise Undefined("a negative power of zero")
        order = len(value.terms) - 1
        vanishing = next((k for k, term in enumerate(value.terms) if not _nothing(term)), order + 1)
        least = self.numbers.sub(self.numbers.mul(exponent, Exact(vanishing)), Exact(order))
        if not any(isinstance(term, Series) for term in value.terms) and self.numbers.sign(least) > 0:
            return Series(value.tag, (ZERO,) * (order + 1))
        raise Unsure("a derivative of a root of zero")

    def exp(self, value: Value) -> Value:
        if not isinstance(value, Series):
            return self.numbers.exp(value)
        found: list[Value] = [self.exp(value.terms[0])]
        for k in range(1, len(value.terms)):
            parts = [self.mul(Exact(j, k), self.mul(value.terms[j], found[k - j])) for j in range(1, k + 1)]
            found.append(self.add(parts))
        return Series(value.tag, tuple(found))

    def log(self, value: Value) -> Value:
        if not isinstance(value, Series):
            return self.numbers.log(value)
        return self._integrated(value, self.log(value.terms[0]), self.inverse(value))

    def _integrated(self, value: Series, start: Value, slope: Value) -> Value:
        """The series y with y(0) = start and y' = slope · value'."""
        order = len(value.terms)
        rate: tuple[Value, ...] = (*(self.mul(Exact(k), value.terms[k]) for k in range(1, order)), ZERO)
        product = self.mul(slope, Series(value.tag, rate))
        assert isinstance(product, Series)
        rest = tuple(self.mul(Exact(1, k), product.terms[k - 1]) for k in range(1, order))
        return Series(value.tag, (start, *rest))

    def sine_cosine(self, value: Value) -> tuple[Value, Value]:
        if not isinstance(value, Series):
            return (ZERO, ONE) if _nothing(value) else self.numbers.sine_cosine(value)
        first = self.sine_cosine(value.terms[0])
        sines, cosines = [first[0]], [first[1]]
        for k in range(1, len(value.terms)):
            rates = [self.mul(Exact(j, k), value.terms[j]) for j in range(1, k + 1)]
            sines.append(self.add([self.mul(rate, cosines[k - j]) for j, rate in enumerate(rates, 1)]))
            cosines.append(self.neg(self.add([self.mul(rate, sines[k - j]) for j, rate in enumerate(rates, 1)])))
        return Series(value.tag, tuple(sines)), Series(value.tag, tuple(cosines))

    def sine(self, value: Value) -> Value:
        if isinstance(value, Series):
            return self.sine_cosine(value)[0]
        return ZERO if _nothing(value) else self.numbers.smooth(Ball.sin, value)

    def cosine(self, value: Value) -> Value:
        if isinstance(value, Series):
            return self.sine_cosine(value)[1]
        return ONE if _nothing(value) else self.numbers.smooth(Ball.cos, value)

    def arctangent(self, value: Value) -> Value:
        if not isinstance(value, Series):
            return ZERO if _nothing(value) else self.numbers.smooth(Ball.atan, value)
        slope = self.inverse(self.add([ONE, self.mul(value, value)]))
        return self._integrated(value, self.arctangent(value.terms[0]), slope)

    def arcsine(self, value: Value) -> Value:
        if isinstance(value, Series):
            slope = self.power(self.sub(ONE, self.mul(value, value)), -HALF)
            return self._integrated(value, self.arcsine(value.terms[0]), slope)
        if _nothing(value):
            return ZERO
        if type(value) is Exact and abs(value) == ONE:
            return self.numbers.mul(value, self.right_angle())
        room = self.numbers.sub(ONE, self.numbers.mul(value, value))
        if self.numbers.sign(room) < 0:
            raise NotReal("the arc sine of a number larger than 1")
        clear = self.numbers.ball(room)
        if spread(clear) > size(clear) - 3:
            raise Unsure("the arc sine near 1")
        return self.numbers.smooth(Ball.asin, value)

    def right_angle(self) -> Number:
        return self.numbers.mul(HALF, self.numbers.constant("Pi"))

    def absolute(self, value: Value) -> Value:
        if isinstance(value, Series):
            return value if self.sign(value) >= 0 else self.neg(value)
        self.numbers.ready()
        return abs(value)

    def _open(self, value: Number) -> bool:
        try:
            self.numbers.sign(value)
        except Unsure:
            return True
        return False

    def larger(self, left: Value, right: Value) -> Value:
        difference = self.sub(left, right)
        if not isinstance(left, Series) and not isinstance(right, Series) and self._open(base(difference)):
            return self.numbers.hull(left, right)
        return left if self.sign(difference) >= 0 else right


def _nothing(value: Value) -> bool:
    """Whether the value is the exact number 0."""
    return type(value) is Exact and not value


def hashable(value: Value | None) -> object:
    """What is equal for equal values, and can be a key: a ball itself cannot."""
    if isinstance(value, Series):
        return (value.tag, *map(hashable, value.terms))
    number: Number = value
    if type(number) is not Ball:
        return number
    return tuple(tuple(map(int, end.man_exp())) for end in (number.mid(), number.rad()))


def is_zero(value: Value) -> bool:
    """Whether every coefficient is exactly 0."""
    return all(map(is_zero, value.terms)) if isinstance(value, Series) else _nothing(value)
