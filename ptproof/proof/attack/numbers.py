"""The attacker's own numbers: exact rationals, and values with a bound of their error, on mpmath.

Nothing here is shared with the engines. A bound is the base-2 logarithm of an absolute error; it only grows, so that
what two values with bounds show to differ does differ. What cannot be told at this precision raises :class:`Unsure`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from functools import cache
from typing import Any, NamedTuple, TypeAlias

import mpmath

BITS_OF_A_DIGIT = math.log2(10)
_LARGEST = 1 << 30  # of the logarithm of a size: beyond it neither error bounds nor exponentials mean anything
_LONGEST = 3000  # bits of an exact rational, before it becomes a value with a bound
EXACT = -math.inf


class Unsure(Exception):
    """This cannot be evaluated, or not be told, at this precision: nothing follows from it."""


class Undefined(Exception):
    """The expression has no value here: a division by zero, the logarithm of zero, a derivative at a kink."""


class NotReal(Exception):
    """The expression has no real value here."""


class Ball(NamedTuple):
    """A real number within 2**``error`` of ``middle``."""

    middle: Any
    error: float


Number: TypeAlias = Fraction | Ball


@cache
def context(digits: int) -> Any:
    """An mpmath context of its own for this precision; the global one is never touched."""
    own = mpmath.MPContext()
    own.dps = digits
    return own


class Arithmetic:
    """Real arithmetic with bounded errors at one precision.

    Exact rationals stay exact wherever the result is rational. A sum in which a term was too small to be seen sets
    ``absorbed``: from then on a difference that looks like zero is not taken for zero.
    """

    def __init__(self, digits: int) -> None:
        self.digits = digits
        self.mp = context(digits)
        self.bits: int = self.mp.prec
        self.negligible = -0.6 * digits * BITS_OF_A_DIGIT
        self.absorbed = False

    def ball(self, value: Number) -> Ball:
        """The value as one with a bound."""
        if isinstance(value, Ball):
            return value
        middle = self.mp.mpf(value.numerator) / value.denominator
        return Ball(middle, size(middle) - self.bits + 1)

    def constant(self, middle: Any) -> Ball:
        """A value that mpmath has rounded correctly, or within a few units in the last place."""
        if not self.mp.isfinite(middle):
            raise Unsure("the value is not finite at this precision")
        return Ball(middle, size(middle) - self.bits + 3)

    def tidy(self, value: Fraction) -> Number:
        """An exact rational that became too long, as a value with a bound."""
        if value.denominator.bit_length() + value.numerator.bit_length() > _LONGEST:
            return self.ball(value)
        return value

    def sign(self, value: Number) -> int:
        """-1, 0 or 1; a value that is 0 to nearly all digits counts as 0 where no term was lost."""
        if isinstance(value, Fraction):
            return (value > 0) - (value < 0)
        if size(value.middle) - 1 > value.error:
            return 1 if value.middle > 0 else -1
        if value.error <= self.negligible and not self.absorbed:
            return 0
        raise Unsure("a sign cannot be told")

    def add(self, terms: list[Number]) -> Number:
        exact = sum((term for term in terms if isinstance(term, Fraction)), Fraction(0))
        balls = [term for term in terms if isinstance(term, Ball)]
        if not balls:
            return self.tidy(exact)
        if exact:
            balls.append(self.ball(exact))
        total, largest, error = self.mp.zero, EXACT, EXACT
        for term in balls:
            total = total + term.middle
            bits = size(term.middle)
            largest, error = max(largest, bits, size(total)), max(error, term.error)
        if any(size(term.middle) < largest - self.bits / 2 and term.middle for term in balls):
            self.absorbed = True
        return Ball(total, max(error, largest - self.bits) + math.log2(2 * len(balls)))

    def sub(self, left: Number, right: Number) -> Number:
        return self.add([left, self.neg(right)])

    def neg(self, value: Number) -> Number:
        return -value if isinstance(value, Fraction) else Ball(-value.middle, value.error)

    def mul(self, left: Number, right: Number) -> Number:
        if isinstance(left, Fraction) and isinstance(right, Fraction):
            return self.tidy(left * right)
        if left == 0 or right == 0:
            return Fraction(0)
        a, b = self.ball(left), self.ball(right)
        middle = a.middle * b.middle
        first, second = size(a.middle), size(b.middle)
        errors = max(a.error + second, b.error + first, a.error + b.error, first + second - self.bits)
        return Ball(middle, errors + 2)

    def inverse(self, value: Number) -> Number:
        if isinstance(value, Fraction):
            if value == 0:
                raise Undefined("division by zero")
            return 1 / value
        if self.sign(value) == 0:
            raise Undefined("division by zero")
        bits = self._clear(value)
        middle = 1 / value.middle
        return Ball(middle, max(value.error - 2 * (bits - 2), size(middle) - self.bits) + 1)

    def _clear(self, value: Ball) -> float:
        """The size of a value that is known to two bits at least."""
        bits = size(value.middle)
        if value.error > bits - 3:
            raise Unsure("a value is too close to a singular one")
        if abs(bits) > _LARGEST:
            raise Unsure("a value is too large or too small")
        return bits

    def integer_power(self, base: Number, exponent: int) -> Number:
        """base**exponent for an integer exponent; 0**0 is 1."""
        if exponent == 0:
            return Fraction(1)
        if exponent < 0:
            return self.inverse(self.integer_power(base, -exponent))
        if isinstance(base, Fraction):
            length = max(base.numerator.bit_length(), base.denominator.bit_length())
            if length <= 1 or length * exponent <= 2 * _LONGEST:
                return self.tidy(base**exponent)
            base = self.ball(base)
        bits = max(size(base.middle), base.error)
        if abs(bits * exponent) > _LARGEST:
            raise Unsure("a power is too large or too small")
        middle = base.middle**exponent
        if base.error > size(base.middle) - math.log2(exponent) - 3:
            return Ball(middle, exponent * (bits + 1) + 1)
        relative = max(base.error - size(base.middle) + 1, -self.bits + 2) + math.log2(exponent) + 1
        return Ball(middle, size(middle) + relative)

    def power(self, base: Number, exponent: Number) -> Number:
        """The real power: a negative base has one for integer exponents only, 0 for exponents that are not negative."""
        if isinstance(exponent, Fraction) and exponent.denominator == 1 and abs(exponent) < 10**6:
            if exponent < 0 and not isinstance(base, Fraction) and self.sign(base) == 0:
                raise Undefined("a negative power of zero")
            return self.integer_power(base, int(exponent))
        sign = self.sign(base)
        if sign < 0:
            self._needs_an_integer(exponent)
        if sign == 0:
            if self.sign(exponent) < 0:
                raise Undefined("a negative power of zero")
            if self.sign(exponent) == 0:
                return Fraction(1)
            return self._power_of_nothing(base, exponent)
        if base == 1:
            return base
        if isinstance(exponent, Fraction) and isinstance(base, Fraction):
            # An integer this large is left to the logarithm.
            root = _exact_root(base, exponent.denominator) if 1 < exponent.denominator <= 12 else None
            if root is not None:
                return self.power(root, Fraction(exponent.numerator))
        return self.exp(self.mul(exponent, self.log(base)))

    def _needs_an_integer(self, exponent: Number) -> None:
        if isinstance(exponent, Fraction) and exponent.denominator != 1:
            raise NotReal("a power of a negative number")
        if isinstance(exponent, Ball):
            nearest = self.mp.nint(exponent.middle)
            if self.sign(self.sub(exponent, Fraction(int(nearest)))) != 0:
                raise NotReal("a power of a negative number")
        raise Unsure("a power of a negative number")

    def _power_of_nothing(self, base: Number, exponent: Number) -> Number:
        if isinstance(base, Fraction):
            return Fraction(0)
        bits = (max(size(base.middle), base.error) + 1) * float(self.ball(exponent).middle)
        return Ball(self.mp.zero, bits)

    def exp(self, value: Number) -> Number:
        if value == 0:
            return Fraction(1)
        argument = self.ball(value)
        if size(argument.middle) > 29 and argument.error < size(argument.middle) - 3 and argument.middle < 0:
            self.absorbed = True  # something is too small to be seen: from here on nothing counts as 0
            return Ball(self.mp.zero, -float(1 << 28))
        if size(argument.middle) > 29 or argument.error > -1:
            raise Unsure("an exponential is too large or too small")
        middle = self.mp.exp(argument.middle)
        return Ball(middle, size(middle) + max(argument.error + 1, -self.bits) + 2)

    def log(self, value: Number) -> Number:
        if value == 1:
            return Fraction(0)
        sign = self.sign(value)
        if sign == 0:
            raise Undefined("the logarithm of zero")
        if sign < 0:
            raise NotReal("the logarithm of a negative number")
        argument = self.ball(value)
        bits = self._clear(argument)
        middle = self.mp.log(argument.middle)
        return Ball(middle, max(argument.error - bits + 2, size(middle) - self.bits) + 2)

    def smooth(self, function: Callable[[Any], Any], value: Number, slope: float) -> Number:
        """A function of mpmath whose derivative is at most 2**slope near the value."""
        argument = self.ball(value)
        if size(argument.middle) > 400 or argument.error > 0:
            raise Unsure("an argument is too large, or not known well enough")
        middle = function(argument.middle)
        if not self.mp.isfinite(middle):
            raise Unsure("a function has no finite value at this precision")
        return Ball(middle, max(argument.error + slope, size(middle) - self.bits) + 2)

    def hull(self, left: Number, right: Number) -> Number:
        """A value that may be either of two that cannot be told apart."""
        a, b = self.ball(left), self.ball(right)
        return Ball(a.middle, max(a.error, b.error, size(a.middle - b.middle)) + 2)


def size(middle: Any) -> float:
    """The smallest integer n with abs(middle) < 2**n; minus infinity for 0."""
    _, mantissa, exponent, length = middle._mpf_
    return float(exponent + length) if mantissa else EXACT


def _exact_root(base: Fraction, degree: int) -> Fraction | None:
    """The rational root of a positive rational, if it has one."""
    parts = []
    for number in (base.numerator, base.denominator):
        if degree == 2:
            root = math.isqrt(number)
        else:
            if number.bit_length() > 900:
                return None
            root = round(number ** (1 / degree))
            root = next((guess for guess in (root - 1, root, root + 1) if guess**degree == number), 0)
        if root**degree != number:
            return None
        parts.append(root)
    return Fraction(parts[0], parts[1])
