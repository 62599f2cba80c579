"""The attacker's own numbers: exact rationals, and balls that contain the value, on python-flint.

The engine for enclosures (:mod:`ptproof.balls`) uses the same library of arithmetic, and nothing else is shared with
it: what an expression means, and how it is taken apart, is written here once more. A ball contains the exact value, so
that what two balls show to differ does differ. What cannot be told at this precision raises :class:`Unsure`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from fractions import Fraction
from functools import cache
from typing import Any, TypeAlias

import flint

from ptproof.proof.attack.magnitudes import NOTHING, ORDINARY, exact_root, power_of_two, size

BITS_OF_A_DIGIT = math.log2(10)
_LONGEST = 3000  # bits of an exact rational, before it becomes a ball
SHORT = _LONGEST // 2  # bits of either part of one, with which it does not

Ball: TypeAlias = flint.arb
Exact: TypeAlias = flint.fmpq
Number: TypeAlias = Any  # an Exact or a Ball: python-flint's types are not known to the type checker
ZERO, ONE = Exact(0), Exact(1)


class Unsure(Exception):
    """This cannot be evaluated, or not be told, at this precision: nothing follows from it."""


class Undefined(Exception):
    """The expression has no value here: a division by zero, the logarithm of zero, a derivative at a kink."""


class NotReal(Exception):
    """The expression has no real value here."""


def exact(value: Fraction | int | Exact) -> Exact:
    """The rational as the attacker's own kind of number."""
    return value if type(value) is Exact else Exact(value.numerator, value.denominator)


def fraction(value: Exact) -> Fraction:
    """The rational as one of Python's."""
    return Fraction(int(value.p), int(value.q))


@contextmanager
def undisturbed() -> Iterator[None]:
    """Whatever is evaluated inside, python-flint's global precision is afterwards as it was."""
    before = flint.ctx.prec
    try:
        yield
    finally:
        flint.ctx.prec = before


@cache
def _precision(digits: int) -> tuple[int, float, float, Ball]:
    """The bits of a ball, the base-2 logarithm of what counts as 0, as what a term is hidden, and what counts as 0."""
    bits, negligible = round(digits * BITS_OF_A_DIGIT) + 3, -0.6 * digits * BITS_OF_A_DIGIT
    return bits, negligible, 2.0 ** (-bits / 2), power_of_two(math.floor(negligible))


class Arithmetic:
    """Real arithmetic with bounded errors at one precision.

    Exact rationals stay exact wherever the result is rational. A sum in which a term was too small to be seen sets
    ``absorbed``: from then on a difference that looks like zero is not taken for zero.
    """

    def __init__(self, digits: int) -> None:
        self.digits = digits
        self.absorbed = False
        self.bits, self.negligible, self._hidden, self._nearly_zero = _precision(digits)

    def ready(self) -> None:
        """Compute with this precision: it is one for the whole process, and others may have changed it."""
        if flint.ctx.prec != self.bits:
            flint.ctx.prec = self.bits

    def ball(self, value: Number) -> Ball:
        """The value as a ball."""
        if type(value) is Ball:
            return value
        self.ready()
        return Ball(value)

    def constant(self, name: str) -> Ball:
        """One of the constants that have a name in SymPy."""
        self.ready()
        match name:
            case "Pi":
                return Ball.pi()
            case "Exp1":
                return Ball.const_e()
            case "GoldenRatio":
                return (1 + Ball(5).sqrt()) / 2
            case "EulerGamma":
                return Ball.const_euler()
            case "Catalan":
                return Ball.const_catalan()
        raise Unsure(f"the value of {name} is not known")

    def tidy(self, value: Exact) -> Number:
        """An exact rational that became too long, as a ball."""
        if value.height_bits() > SHORT and value.p.bit_length() + value.q.bit_length() > _LONGEST:
            return self.ball(value)
        return value

    def sign(self, value: Number) -> int:
        """-1, 0 or 1; a value that is 0 to nearly all digits counts as 0 where no term was lost."""
        if type(value) is Exact:
            return (1 if value.p > 0 else -1) if value else 0
        if value > 0:
            return 1
        if value < 0:
            return -1
        if not self.absorbed and abs(value) <= self._nearly_zero:
            return 0
        raise Unsure("a sign cannot be told")

    def add(self, terms: list[Number]) -> Number:
        rational, balls = None, []
        for term in terms:
            if type(term) is Exact:
                rational = term if rational is None else rational + term
            else:
                balls.append(term)
        if not balls:
            return ZERO if rational is None else self.tidy(rational)
        self.ready()
        if rational:
            balls.append(Ball(rational))
        total = balls[0]
        if len(balls) > 1:
            for term in balls[1:]:
                total = total + term
            if not self.absorbed and self._hides(balls):
                self.absorbed = True
        return _finite(total)

    def _hides(self, balls: list[Ball]) -> bool:
        """Whether a term is so much smaller than another one that most of its digits are lost in the sum."""
        sizes = [abs(float(term)) for term in balls]
        if all(ORDINARY[0] < size < ORDINARY[1] for size in sizes):
            return min(sizes) < max(sizes) * self._hidden
        lengths = [length for length in map(size, balls) if length != NOTHING]
        return bool(lengths) and min(lengths) < max(lengths) - self.bits / 2

    def sub(self, left: Number, right: Number) -> Number:
        if type(left) is Exact and type(right) is Exact:
            return self.tidy(left - right)
        return self.add([left, self.neg(right)])

    def neg(self, value: Number) -> Number:
        if type(value) is Ball:
            self.ready()
        return -value

    def mul(self, left: Number, right: Number) -> Number:
        if type(left) is Exact:
            if type(right) is Exact:
                return self.tidy(left * right)
            if not left:
                return ZERO
        elif type(right) is Exact and not right:
            return ZERO
        self.ready()
        return _finite(left * right)

    def inverse(self, value: Number) -> Number:
        if self.sign(value) == 0:
            raise Undefined("division by zero")
        if type(value) is Ball:
            self.ready()
        return 1 / value

    def integer_power(self, base: Number, exponent: int) -> Number:
        """base**exponent for an integer exponent; 0**0 is 1."""
        if exponent == 1:
            return base
        if exponent == 0:
            return ONE
        if exponent < 0:
            return self.inverse(self.integer_power(base, -exponent))
        if type(base) is Exact:
            length = base.height_bits()
            if length <= 1 or length * exponent <= 2 * _LONGEST:
                return self.tidy(base**exponent)
        self.ready()
        return _finite(Ball(base) ** exponent)

    def whole_power(self, base: Number, exponent: int) -> Number:
        """The same, undefined for a negative power of what counts as 0."""
        if exponent < 0 and type(base) is Ball and self.sign(base) == 0:
            raise Undefined("a negative power of zero")
        return self.integer_power(base, exponent)

    def power(self, base: Number, exponent: Number) -> Number:
        """The real power: a negative base has one for integer exponents only, 0 for exponents that are not negative."""
        if type(exponent) is Exact and exponent.q == 1 and abs(exponent) < 10**6:
            return self.whole_power(base, int(exponent.p))
        sign = self.sign(base)
        if sign < 0:
            self._needs_an_integer(exponent)
        if sign == 0:
            if self.sign(exponent) < 0:
                raise Undefined("a negative power of zero")
            if self.sign(exponent) == 0:
                return ONE
            return self._power_of_nothing(base, exponent)
        if type(base) is Exact:
            if base == ONE:
                return base
            if type(exponent) is Exact:
                # An integer this large is left to the logarithm.
                root = exact_root(base, int(exponent.q)) if 1 < exponent.q <= 12 else None
                if root is not None:
                    return self.power(root, Exact(exponent.p))
        return self.exp(self.mul(exponent, self.log(base)))

    def _needs_an_integer(self, exponent: Number) -> None:
        if type(exponent) is Exact and exponent.q != 1:
            raise NotReal("a power of a negative number")
        if type(exponent) is Ball and self.sign(self.sub(exponent, self.nearest(exponent))) != 0:
            raise NotReal("a power of a negative number")
        raise Unsure("a power of a negative number")

    def nearest(self, value: Ball) -> Exact:
        """The integer next to the middle of a ball."""
        self.ready()
        found = (value.mid() + Ball(0.5)).floor().unique_fmpz()
        if found is None:
            raise Unsure("a value is too large for its nearest integer")
        return Exact(found)

    def _power_of_nothing(self, base: Number, exponent: Number) -> Number:
        if type(base) is Exact:
            return ZERO
        return _finite(Ball(0, abs(base).abs_upper() ** self.ball(exponent).abs_lower()))

    def exp(self, value: Number) -> Number:
        if type(value) is Exact and not value:
            return ONE
        argument = self.ball(value)
        self.ready()
        if not abs(argument) < _TOO_LARGE:
            if argument < -_TOO_LARGE:
                self.absorbed = True  # something is too small to be seen: from here on nothing counts as 0
                return Ball(0, power_of_two(-(1 << 28)))
            raise Unsure("an exponential is too large or too small")
        return _finite(argument.exp())

    def log(self, value: Number) -> Number:
        sign = self.sign(value)
        if sign == 0:
            raise Undefined("the logarithm of zero")
        if sign < 0:
            raise NotReal("the logarithm of a negative number")
        if type(value) is Exact and value == ONE:
            return ZERO
        argument = self.ball(value)
        self.ready()
        return _finite(argument.log())

    def smooth(self, function: Callable[[Ball], Ball], value: Number) -> Ball:
        """A function of balls that is smooth near the value."""
        argument = self.ball(value)
        self.ready()
        if argument.rad() > 1:
            raise Unsure("an argument is not known well enough")
        return _finite(function(argument))

    def sine_cosine(self, value: Number) -> tuple[Ball, Ball]:
        """Both at once."""
        argument = self.ball(value)
        self.ready()
        if argument.rad() > 1:
            raise Unsure("an argument is not known well enough")
        sine, cosine = argument.sin_cos()
        return _finite(sine), _finite(cosine)

    def hull(self, left: Number, right: Number) -> Ball:
        """A ball for a value that may be either of two that cannot be told apart."""
        return self.ball(left).union(self.ball(right))


_TOO_LARGE = Ball(1 << 29)


def _finite(ball: Ball) -> Ball:
    if not ball.is_finite():
        raise Unsure("the value is not finite at this precision")
    return ball
