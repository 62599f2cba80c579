"""Power series along a ray from the source, and the coefficients that bound a Taylor remainder."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import flint
from flint import arb, arb_series, fmpq

from ptproof.balls.ball import BALLS
from ptproof.balls.lifted import Lifted
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


class _Series(Lifted):
    """The arithmetic of power series in one variable, with balls as coefficients."""

    kind = arb_series

    def call(self, name: str, value: Any) -> Any:
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
        power = base ** abs(exponent)
        return power if exponent >= 0 else _finite(_divide(arb_series([1]), power))

    def root(self, base: Any, numerator: int, denominator: int, nonnegative: bool) -> Any:
        if not base[0] > 0:
            raise Undefined("a root that is not smooth")
        return _finite(base ** fmpq(numerator, denominator))

    def floor(self, value: Any) -> Any:
        result = BALLS.floor(value[0])
        if not result.is_exact() or BALLS.order(value[0] - result) != 1:
            raise Undefined("a jump")
        return result

    def order(self, value: Any) -> int | None:
        return BALLS.order(value[0]) or None  # where the series starts at 0 its sign changes


def _divide(numerator: arb_series, denominator: arb_series) -> arb_series:
    if not (denominator[0] > 0 or denominator[0] < 0):
        raise Undefined("a division by something that may be zero")
    return numerator / denominator


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
