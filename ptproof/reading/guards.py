"""What is not built from a text from outside: numbers too large to be written down, what is not a finite real number.

Each function says why it refuses, or nothing. They look before SymPy is asked: it would take minutes for some of this,
and gives another meaning to some.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import sympy as sp

INFINITE = frozenset({sp.zoo, sp.nan, sp.oo, -sp.oo})
DEEPEST = 80
"""How many levels SymPy can build, print and change within Python's own limit."""
_LARGEST_EXPONENT = 10_000
# Python itself writes no integer of more than 4300 digits; what is read can also be printed.
_LARGEST_BITS = 14_000
_MOST_COMPARED = 12
_TINY = 1e-60
_GROWING = ("exp", "sinh", "cosh")


def value_refused(value: Any) -> str:
    """Of a number or condition that SymPy has just made."""
    if isinstance(value, int | sp.Rational):
        numerator, denominator = (value, 1) if isinstance(value, int) else (int(value.p), int(value.q))
        large = max(abs(numerator), denominator).bit_length() > _LARGEST_BITS
        return "a number that is too large" if large else ""
    if value in INFINITE or not INFINITE.isdisjoint(value.args) or isinstance(value, sp.AccumBounds):
        return "a value that is not finite"
    # A sum of real numbers is real; to ask it again for each of its parts would take long.
    if isinstance(value, sp.Expr) and not value.is_Add and value.is_number and value.is_real is False:
        return f"{short(value)}, which is not a finite real number,"
    return ""


def power_refused(base: sp.Expr, exponent: sp.Expr) -> str:
    """Of a power that would fill the memory before anybody could look at it."""
    if exponent.is_number and _size(exponent) > _LARGEST_EXPONENT:
        return f"an exponent over {_LARGEST_EXPONENT}"
    if base.is_number and exponent.is_number and base != 0:
        # The parts of a fraction, since 1 + 10**-300 is near 1 and its powers are long all the same.
        parts = (base.p, base.q) if base.is_Rational else (base,)
        if max(map(_bits, parts)) * _size(exponent) > _LARGEST_BITS:
            return "a number that is too large"
    return ""


def divisor_refused(divisor: sp.Expr) -> str:
    """Of what is 0, and of a number such as sin(1)**2 + cos(1)**2 - 1 that looks like it."""
    looks = not divisor.is_Rational and divisor.is_number and _size(divisor) < _TINY
    return "a division by zero" if divisor.is_zero or looks else ""


def arguments_refused(name: str, values: Sequence[sp.Expr]) -> str:
    """Of the arguments of a function."""
    if name in _GROWING and values and values[0].is_number and _size(values[0]) > _LARGEST_EXPONENT:
        return f"an exponent over {_LARGEST_EXPONENT}"
    if name in ("Max", "Min") and len(values) > _MOST_COMPARED:
        return f"{name} of more than {_MOST_COMPARED} values"
    if name == "Mod" and len(values) == 2:
        return divisor_refused(values[1])
    if name in ("log", "ln") and len(values) == 2 and (values[1].is_positive is False or values[1] == 1):
        return "a logarithm to such a base"
    return ""


def is_deep(value: sp.Basic) -> bool:
    """Whether it is nested more deeply than :data:`DEEPEST`."""
    level = {value}
    for _ in range(DEEPEST):
        level = {argument for node in level for argument in node.args}
        if not level:
            return False
    return True


def short(value: Any) -> str:
    """The value as text, cut to 60 characters."""
    text = str(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _size(number: sp.Expr) -> float:
    """About the absolute value of a number; infinite where that is beyond a floating-point number."""
    try:
        return abs(complex(number.evalf(15)))
    except OverflowError:
        return math.inf


def _bits(number: Any) -> float:
    """About the absolute value of the logarithm of a number to the base 2; 0 for what may be 0."""
    if isinstance(number, int) or number.is_Integer:
        return int(number).bit_length()
    near = sp.Abs(number.evalf(15))
    return 0.0 if near == 0 else abs(float(sp.log(near, 2).evalf(15)))
