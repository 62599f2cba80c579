"""Elementary functions of one variable, and whether a value is of a declared kind."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ptproof.proof.attack.numbers import ONE, ZERO, Exact, NotReal, Number
from ptproof.proof.attack.series import HALF, Calculus, Value, base


def fits(declared: Any, value: Number, calculus: Calculus) -> bool:
    """Whether a value is one that a symbol, or an applied undefined function, was declared to take."""
    if declared.is_integer and not (type(value) is Exact and value.q == 1):
        return False
    if declared.is_integer is False and type(value) is Exact and value.q == 1:
        return False
    signs = {"positive": (1,), "negative": (-1,), "zero": (0,), "nonnegative": (0, 1), "nonpositive": (-1, 0)}
    sign = calculus.numbers.sign(value) if any(getattr(declared, f"is_{word}") is not None for word in signs) else 0
    return all(getattr(declared, f"is_{word}") is not (sign not in held) for word, held in signs.items())


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
