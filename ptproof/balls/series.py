"""Power series along a ray from the source, the field's Taylor polynomial there, and polynomials in nested form."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import pairwise
from operator import add
from typing import Any

import flint
from flint import arb, arb_series, fmpq

from ptproof.balls.arithmetic import Ring, collected
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


Exponents = tuple[int, ...]


@dataclass(frozen=True)
class Taylor(Ring):
    """A polynomial in ``dimension`` variables, with balls as coefficients, cut off above total degree ``order``."""

    terms: Mapping[Exponents, arb]
    order: int
    dimension: int

    def make(self, terms: Mapping[Exponents, arb]) -> Taylor:
        """Another one of the same kind; coefficients that are exactly zero are left out."""
        kept = {key: value for key, value in terms.items() if not value.is_zero()}
        return Taylor(kept, self.order, self.dimension)

    def constant(self, value: arb) -> Taylor:
        """The constant polynomial."""
        return self.make({self.origin: value})

    def __add__(self, other: Any) -> Taylor:
        added = other if isinstance(other, Taylor) else self.constant(other)
        return self.make(collected((*self.terms.items(), *added.terms.items())))

    def __neg__(self) -> Taylor:
        return self.make({key: -value for key, value in self.terms.items()})

    def __mul__(self, other: Any) -> Taylor:
        if not isinstance(other, Taylor):
            return self.make({key: value * other for key, value in self.terms.items()})
        products = (
            (tuple(map(add, e, f)), a * b)
            for e, a in self.terms.items()
            for f, b in other.terms.items()
            if sum(e) + sum(f) <= self.order
        )
        return self.make(collected(products))

    @property
    def origin(self) -> Exponents:
        """The exponents of the constant term."""
        return (0,) * self.dimension

    @property
    def start(self) -> arb:
        """The constant term."""
        return self.terms.get(self.origin, arb(0))

    def compose(self, outer: Any) -> Taylor:
        """The composition with a function of one variable, given on power series."""
        with series_length(self.order + 1):
            series = outer(arb_series([self.start, 1], self.order + 1))
            if isinstance(series, arb):
                return self.constant(series)
            coefficients = [series[k] for k in range(self.order + 1)]
        step = self.make({key: value for key, value in self.terms.items() if key != self.origin})
        result = self.constant(coefficients[-1])
        for coefficient in reversed(coefficients[:-1]):
            result = result * step + coefficient
        return result

    def derivative(self, index: int) -> Taylor:
        """The partial derivative in variable ``index``."""
        lowered = {}
        for key, value in self.terms.items():
            if key[index]:
                lowered[(*key[:index], key[index] - 1, *key[index + 1 :])] = value * key[index]
        return self.make(lowered)


class _Taylors(Lifted):
    """The arithmetic of Taylor polynomials: what is not a sum or a product is a composition with a series."""

    kind = Taylor

    def call(self, name: str, value: Any) -> Any:
        return value.compose(lambda series: SERIES.call(name, series))

    def root(self, base: Any, numerator: int, denominator: int, nonnegative: bool) -> Any:
        return base.compose(lambda series: SERIES.root(series, numerator, denominator, nonnegative))

    def floor(self, value: Any) -> Any:
        return value.compose(SERIES.floor)

    def inverse(self, value: Any) -> Any:
        return value.compose(lambda series: SERIES.integer_power(series, -1))

    def order(self, value: Any) -> int | None:
        return BALLS.order(value.start) or None  # where the polynomial starts at 0 its sign changes


TAYLORS = _Taylors()


def taylor(tape: Tape, dimension: int, order: int) -> list[Taylor]:
    """The Taylor polynomials of the outputs of ``tape`` around the origin, up to total degree ``order``."""
    units = [tuple(int(i == j) for j in range(dimension)) for i in range(dimension)]
    inputs = [Taylor({unit: arb(1)}, order, dimension) for unit in units]
    return [
        output if isinstance(output, Taylor) else inputs[0].constant(output) for output in tape.run(inputs, TAYLORS)
    ]


class Nested:
    """A polynomial in nested form, which runs on any kind of number.

    ``terms`` maps exponents to balls; ``run`` takes one number per variable.
    """

    def __init__(self, terms: Mapping[Exponents, arb]) -> None:
        self.form = _nest(terms)

    def run(self, values: Sequence[Any]) -> Any:
        """The value, a number or a ball."""
        return _horner(self.form, values, 0)


def _nest(terms: Mapping[Exponents, arb]) -> Any:
    if not terms:
        return arb(0)
    if not next(iter(terms)):
        return next(iter(terms.values()))
    groups: dict[int, dict[Exponents, arb]] = {}
    for key, value in terms.items():
        groups.setdefault(key[0], {})[key[1:]] = value
    return sorted(((power, _nest(rest)) for power, rest in groups.items()), key=lambda item: -item[0])


def _horner(form: Any, values: Sequence[Any], depth: int) -> Any:
    if isinstance(form, arb):
        return form
    total: Any = None
    x = values[depth]
    for (power, inner), (following, _) in pairwise([*form, (0, None)]):
        value = _horner(inner, values, depth + 1)
        total = value if total is None else total + value
        for _ in range(power - following):
            total = total * x
    return total
