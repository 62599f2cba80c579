"""Floats and decimals that lie outside of a ball, so that a bound stays a bound when it leaves ball arithmetic."""

from __future__ import annotations

import math
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal

from flint import arb


def up(ball: arb) -> float:
    """A float that is not below any number of the ball; infinite where there is none."""
    return _outward(ball.upper(), math.inf)


def down(ball: arb) -> float:
    """A float that is not above any number of the ball; −∞ where there is none."""
    return _outward(ball.lower(), -math.inf)


def _outward(end: arb, towards: float) -> float:
    value = float(end)  # less than one place away
    if end.is_zero():
        return 0.0
    return towards if math.isnan(value) else math.nextafter(value, towards)


def decimal_up(value: float, digits: int) -> Decimal:
    """The decimal of ``digits`` digits that is not below ``value`` and nearest to it."""
    return Context(prec=digits, rounding=ROUND_CEILING).plus(Decimal(value))


def decimal_down(value: float, digits: int) -> Decimal:
    """The decimal of ``digits`` digits that is not above ``value`` and nearest to it."""
    return Context(prec=digits, rounding=ROUND_FLOOR).plus(Decimal(value))


def at_most(value: float, digits: int = 4) -> str:
    """An upper bound as a person reads it: never a smaller number than was proved.

    >>> at_most(0.24191, 4), at_most(2.0), at_least(2.8284271, 6), at_least(0.3)
    ('0.2420', '2', '2.82842', '0.3')
    """
    return f"{decimal_up(value, digits):g}"


def at_least(value: float, digits: int = 4) -> str:
    """How far something that was proved reaches, as a person reads it; the number 0.3 is not read as 0.2999."""
    return f"{Context(prec=digits, rounding=ROUND_FLOOR).create_decimal(repr(value)):g}"
