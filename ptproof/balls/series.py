"""Power series along a ray from the source, and the coefficients that bound a Taylor remainder."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import flint
from flint import arb, arb_series, fmpq

from ptproof.balls.ball import BALLS
from ptproof.balls.tape import Tape, Undefined


@contextmanager
def series_length(count: int) -> Iterator[None]:
    """Work with ``count`` coefficients inside, and put python-flint's global length back afterwards."""
    before = flint.ctx.cap
    flint.ctx.cap = count
    try:
        yield
    finally:
        flint.ctx.cap = before


class _Series:
    """The arithmetic of power series in one variable, with balls as coefficients."""

    def constant(self, value: arb) -> Any:
        return value

    def call(self, name: str, value: Any) -> Any:
        if not isinstance(value, arb_series):
            return BALLS.call(name, value)
        if name in ("exp", "log", "sin", "cos", "tan", "atan", "asin", "acos", "erf"):
            return _finite(getattr(value, name)())
        if name == "cot":
            return _finite(_divide(value.cos(), value.sin()))
        if name == "asinh":
            return _finite((value + (1 + value * value).sqrt()).log())
        rising, falling = value.exp(), (-value).exp()
        if name == "tanh":
            return _finite(_divide(rising - falling, rising + falling))
        return (rising - falling if name == "sinh" else rising + falling) / 2

    def integer_power(self, base: Any, exponent: int) -> Any:
        if not isinstance(base, arb_series):
            return BALLS.integer_power(base, exponent)
        power = base ** abs(exponent)
        return power if exponent >= 0 else _finite(_divide(arb_series([1]), power))

    def root(self, base: Any, numerator: int, denominator: int, nonnegative: bool) -> Any:
        if not isinstance(base, arb_series):
            return BALLS.root(base, numerator, denominator, nonnegative)
        if not base[0] > 0:
            raise Undefined("a root that is not smooth")
        return _finite(base ** fmpq(numerator, denominator))

    def power(self, base: Any, exponent: Any) -> Any:
        if not isinstance(base, arb_series) and not isinstance(exponent, arb_series):
            return BALLS.power(base, exponent)
        return self.call("exp", exponent * self.call("log", base))

    def absolute(self, value: Any) -> Any:
        return value * self.sign(value)

    def sign(self, value: Any) -> Any:
        known = self.order(value)
        if known is None or (known == 0 and not isinstance(value, arb)):
            raise Undefined("a kink or a jump")
        return arb(known)

    def maximum(self, left: Any, right: Any) -> Any:
        known = self.order(left - right)
        if known is None or known == 0:
            raise Undefined("a kink")
        return left if known > 0 else right

    def minimum(self, left: Any, right: Any) -> Any:
        return -self.maximum(-left, -right)

    def floor(self, value: Any) -> Any:
        result = BALLS.floor(_start(value))
        if not result.is_exact() or (not isinstance(value, arb) and BALLS.order(_start(value) - result) != 1):
            raise Undefined("a jump")
        return result

    def angle(self, y: Any, x: Any) -> Any:
        if isinstance(y, arb) and isinstance(x, arb):
            return BALLS.angle(y, x)
        if not _start(x) > 0:
            raise Undefined("an angle that is not smooth")
        return self.call("atan", y * self.integer_power(x, -1))

    def either(self, values: Sequence[Any]) -> Any:
        raise Undefined("a Piecewise that may jump")

    def order(self, value: Any) -> int | None:
        known = BALLS.order(_start(value))
        return None if known == 0 and not isinstance(value, arb) else known


def _divide(numerator: arb_series, denominator: arb_series) -> arb_series:
    if not (denominator[0] > 0 or denominator[0] < 0):
        raise Undefined("a division by something that may be zero")
    return numerator / denominator


def _start(value: Any) -> arb:
    return value if isinstance(value, arb) else value[0]


def _finite(value: Any) -> Any:
    if not all(coefficient.is_finite() for coefficient in value.coeffs()):
        raise Undefined("not analytic there")
    return value


SERIES = _Series()


def coefficient_along(tape: Tape, start: arb, direction: Sequence[arb], order: int) -> list[arb]:
    """The coefficient of εᵒʳᵈᵉʳ in each output of ``tape`` at the point (``start`` + ε)·direction.

    With balls it encloses all those coefficients, hence the remainder of the Taylor polynomial of that order by
    Lagrange's form. Raises :class:`Undefined` where an output may not be analytic.
    """
    with series_length(order + 1):
        inputs = [arb_series([start * w, w], order + 1) for w in direction]
        results = []
        for output in tape.run(inputs, SERIES):
            value = arb(0) if isinstance(output, arb) else output[order]
            if not value.is_finite():
                raise Undefined("not analytic there")
            results.append(value if order or not isinstance(output, arb) else output)
        return results
