"""How large a number of the attacker is, how well it is known, and its value as a float."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

from flint import arb as Ball
from flint import fmpq as Exact

NOTHING = -math.inf
ORDINARY = (1e-290, 1e290)  # sizes that a float can have


@cache
def power_of_two(exponent: int) -> Ball:
    """2**``exponent``, which is exact."""
    return Ball(2) ** exponent


def widened(ball: Ball, error: float) -> Ball:
    """The ball with a radius of 2**``error`` about its middle, or more."""
    return ball if error == NOTHING else ball + Ball(0, power_of_two(math.ceil(error)))


def size(value: Any) -> float:
    """The smallest integer n with abs(middle) < 2**n; minus infinity for 0."""
    return _length(value.mid()) if type(value) is Ball else _length(Ball(value).mid())


def spread(value: Any) -> float:
    """The smallest integer n with radius < 2**n; minus infinity for a value that is exact."""
    return _length(value.rad()) if type(value) is Ball else NOTHING


def as_float(value: Any) -> float:
    """A value for people and for searches, not for decisions; one of a size that no float has is infinite."""
    return float(value) if type(value) is Ball else float(Ball(value))


def _length(end: Ball) -> float:
    rough = abs(float(end))
    if ORDINARY[0] < rough < ORDINARY[1]:
        return float(math.frexp(rough)[1])
    mantissa, exponent = end.man_exp()
    return float(int(exponent) + mantissa.bit_length()) if mantissa else NOTHING


def exact_root(base: Exact, degree: int) -> Exact | None:
    """The rational root of a positive rational, if it has one."""
    parts = []
    for number in (int(base.p), int(base.q)):
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
    return Exact(parts[0], parts[1])
