"""Elementary functions of one variable, and whether a value is of a declared kind."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

from ptproof.proof.attack.numbers import ONE, ZERO, Exact, NotReal, Number, Undefined, Unsure
from ptproof.proof.attack.series import HALF, Calculus, Series, Value, base

_HELD = {"positive": (1,), "negative": (-1,), "zero": (0,), "nonnegative": (0, 1), "nonpositive": (-1, 0)}

ANYTHING = (None, None)
"""What is :func:`asked` of a value that may be any real number."""


@lru_cache(maxsize=4096)
def asked(declared: Any) -> tuple[bool | None, frozenset[int] | None]:
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
    return meets(asked(declared), value, calculus)


def meets(wanted: tuple[bool | None, frozenset[int] | None], value: Number, calculus: Calculus) -> bool:
    """Whether a value is what is :func:`asked`."""
    integer, signs = wanted
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


def below(calculus: Calculus, value: Value) -> Exact:
    """The largest integer that is not larger."""
    number = base(value)
    if type(number) is Exact:
        found = Exact(number.floor())
    else:
        nearest = calculus.numbers.nearest(number)
        away = calculus.numbers.sign(calculus.numbers.sub(number, nearest))
        found = nearest - 1 if away < 0 else nearest
    if isinstance(value, Series) and type(number) is Exact and number == found:
        raise Unsure("a derivative at a jump")
    return found


def angle(calculus: Calculus, y: Value, x: Value) -> Value:
    """The angle of a place."""
    half = calculus.right_angle()
    if (sign := calculus.sign(x)) > 0:
        return calculus.arctangent(calculus.mul(y, calculus.inverse(x)))
    side = calculus.sign(y)
    if sign == 0:
        if side == 0:
            raise Undefined("the angle of the origin")
        return calculus.sub(calculus.mul(Exact(side), half), calculus.arctangent(calculus.mul(x, calculus.inverse(y))))
    turn = calculus.mul(Exact(2 if side >= 0 else -2), half)
    return calculus.add([calculus.arctangent(calculus.mul(y, calculus.inverse(x))), turn])


UNARY: dict[str, Callable[[Calculus, Value], Value]] = {
    "exp": lambda c, v: c.exp(v),
    "log": lambda c, v: c.log(v),
    "sin": lambda c, v: c.sine(v),
    "cos": lambda c, v: c.cosine(v),
    "tan": lambda c, v: _quotient(c, True, v),
    "cot": lambda c, v: _quotient(c, False, v),
    "sec": lambda c, v: c.inverse(c.cosine(v)),
    "csc": lambda c, v: c.inverse(c.sine(v)),
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
