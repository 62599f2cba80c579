"""Elementary functions of one variable, and whether a value is of a declared kind."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

from ptproof.proof.attack.numbers import ONE, ZERO, Exact, NotReal, Number
from ptproof.proof.attack.series import HALF, Calculus, Value, base

_HELD = {"positive": (1,), "negative": (-1,), "zero": (0,), "nonnegative": (0, 1), "nonpositive": (-1, 0)}


@lru_cache(maxsize=4096)
def _asked(declared: Any) -> tuple[bool | None, frozenset[int] | None]:
    """Whether a value has to be an integer, or must not be one; and the signs that it may have, where that is asked."""
    known = {word: getattr(declared, f"is_{word}") for word in _HELD}
    signs = None
    if any(truth is not None for truth in known.values()):
        signs = frozenset(
            n for n in (-1, 0, 1) if all(known[word] is not (n not in held) for word, held in _HELD.items())
        )
    return declared.is_integer, signs


def fits(declared: Any, value: Number, calculus: Calculus) -> bool:
    """Whether a value is one that a symbol, or an applied undefined function, was declared to take."""
    integer, signs = _asked(declared)
    if integer is not None and integer is not (type(value) is Exact and value.q == 1):
        return False
    return signs is None or calculus.numbers.sign(value) in signs


def _quotient(calculus: Calculus, sine: bool, value: Value) -> Value:
    up, down = calculus.sine_cosine(value)
    return calculus.mul(up, calculus.inverse(down)) if sine else calculus.mul(down, calculus.inverse(up))


def _hyperbolic(calculus: Calculus, value: Value) -> tuple[Value, Value]:
    up = calculus.exp(value)
    down = calculus.exp(calculus.neg(value))
    return calculus.mul(HALF, calculus.sub(up, down)), calculus.mul(HALF, calculus.add([up, down]))


def _tanh(calculus: Calculus, value: Value) -> Value:
    sine, cosine = _hyperbolic(calculus, value)
    return calculus.mul(sine, calculus.inverse(cosine))


def _arcosine(calculus: Calculus, value: Value) -> Value:
    if type(value) is Exact and value == ONE:
        return ZERO
    return calculus.sub(calculus.right_angle(), calculus.arcsine(value))


def _arsinh(calculus: Calculus, value: Value) -> Value:
    root = calculus.power(calculus.add([calculus.mul(value, value), ONE]), HALF)
    return calculus.log(calculus.add([value, root]))


def _artanh(calculus: Calculus, value: Value) -> Value:
    ratio = calculus.mul(calculus.add([ONE, value]), calculus.inverse(calculus.sub(ONE, value)))
    return calculus.mul(HALF, calculus.log(ratio))


def _arcosh(calculus: Calculus, value: Value) -> Value:
    if calculus.numbers.sign(calculus.numbers.sub(base(value), ONE)) < 0:
        raise NotReal("the area cosine of a number below 1")
    root = calculus.power(calculus.sub(calculus.mul(value, value), ONE), HALF)
    return calculus.log(calculus.add([value, root]))


UNARY: dict[str, Callable[[Calculus, Value], Value]] = {
    "exp": lambda c, v: c.exp(v),
    "log": lambda c, v: c.log(v),
    "sin": lambda c, v: c.sine_cosine(v)[0],
    "cos": lambda c, v: c.sine_cosine(v)[1],
    "tan": lambda c, v: _quotient(c, True, v),
    "cot": lambda c, v: _quotient(c, False, v),
    "sec": lambda c, v: c.inverse(c.sine_cosine(v)[1]),
    "csc": lambda c, v: c.inverse(c.sine_cosine(v)[0]),
    "asin": lambda c, v: c.arcsine(v),
    "acos": _arcosine,
    "atan": lambda c, v: c.arctangent(v),
    "sinh": lambda c, v: _hyperbolic(c, v)[0],
    "cosh": lambda c, v: _hyperbolic(c, v)[1],
    "tanh": _tanh,
    "asinh": _arsinh,
    "acosh": _arcosh,
    "atanh": _artanh,
    "Abs": lambda c, v: c.absolute(v),
    "re": lambda c, v: v,
    "conjugate": lambda c, v: v,
}

COMPARISONS: dict[str, Callable[[int], bool]] = {
    "Equality": lambda sign: sign == 0,
    "Unequality": lambda sign: sign != 0,
    "LessThan": lambda sign: sign <= 0,
    "StrictLessThan": lambda sign: sign < 0,
    "GreaterThan": lambda sign: sign >= 0,
    "StrictGreaterThan": lambda sign: sign > 0,
}
"""By the name of SymPy's relation: what it says of the sign of the difference."""
