"""Balls with their partial derivatives, and the mean value form that they give.

For a function that is differentiable on a box, f(x) lies in f(p) + Σ ∂f/∂xᵢ(box)·(xᵢ − pᵢ) for every point p of
the box, and where ∂f/∂xᵢ has one sign the largest value lies on a side of the box. The error of this form is of
second order in the width of the box.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from flint import arb

from ptproof.balls.arithmetic import Ring
from ptproof.balls.ball import BALLS, finite, interval
from ptproof.balls.boxes import Side, middle
from ptproof.balls.lifted import Lifted
from ptproof.balls.tape import Undefined

Slopes = tuple[arb | None, ...]


class Jet(Ring):
    """A ball and the balls of its partial derivatives (None where a derivative is exactly zero)."""

    __slots__ = ("slopes", "value")

    def __init__(self, value: arb, slopes: Slopes) -> None:
        self.value, self.slopes = value, slopes

    def __add__(self, other: Any) -> Jet:
        if isinstance(other, Jet):
            slopes = tuple(
                b if a is None else a if b is None else a + b for a, b in zip(self.slopes, other.slopes, strict=True)
            )
            return Jet(self.value + other.value, slopes)
        return Jet(self.value + other, self.slopes)

    def __neg__(self) -> Jet:
        return Jet(-self.value, tuple(None if a is None else -a for a in self.slopes))

    def __mul__(self, other: Any) -> Jet:
        u = self.value
        if isinstance(other, Jet):
            v = other.value
            slopes = tuple(
                (None if b is None else u * b) if a is None else a * v if b is None else a * v + u * b
                for a, b in zip(self.slopes, other.slopes, strict=True)
            )
            return Jet(_product(u, v), slopes)
        return self.scaled(_product(u, other) if isinstance(other, arb) else u * other, other)

    def scaled(self, value: arb, factor: arb) -> Jet:
        """The jet of a function of this one: its value, and its derivative as factor."""
        return Jet(value, tuple(None if a is None else a * factor for a in self.slopes))


def _product(u: arb, v: arb) -> arb:
    """The product; of two wide balls by their ends, for a product of balls forgets that both are positive."""
    if u.rel_accuracy_bits() > 3 or v.rel_accuracy_bits() > 3:
        return u * v
    if u < 0:
        return -_product(-u, v)
    if not u > 0 or not (v > 0 or v < 0):
        return u * v
    return interval(u.lower() * v.lower(), u.upper() * v.upper()) if v > 0 else -_product(u, -v)


def slopes_of(number: Any, n: int) -> list[arb]:
    """The n partial derivatives of a jet, or of a constant."""
    slopes = number.slopes if isinstance(number, Jet) else (None,) * n
    return [arb(0) if slope is None else slope for slope in slopes]


def variables(box: Sequence[arb]) -> list[Jet]:
    """One jet per coordinate of ``box``, each with slope 1 in its own direction."""
    one, places = arb(1), range(len(box))
    return [Jet(ball, tuple(one if j == i else None for j in places)) for i, ball in enumerate(box)]


_DERIVATIVES: Mapping[str, Callable[[arb, arb], arb]] = {
    "exp": lambda x, y: y,
    "log": lambda x, y: 1 / x,
    "sin": lambda x, y: x.cos(),
    "cos": lambda x, y: -x.sin(),
    "tan": lambda x, y: 1 + BALLS.integer_power(y, 2),
    "cot": lambda x, y: -1 - BALLS.integer_power(y, 2),
    "sinh": lambda x, y: x.cosh(),
    "cosh": lambda x, y: x.sinh(),
    "tanh": lambda x, y: 1 / BALLS.integer_power(x.cosh(), 2),
    "asin": lambda x, y: (1 - BALLS.integer_power(x, 2)).rsqrt(),
    "acos": lambda x, y: -((1 - BALLS.integer_power(x, 2)).rsqrt()),
    "atan": lambda x, y: 1 / (1 + BALLS.integer_power(x, 2)),
    "asinh": lambda x, y: (1 + BALLS.integer_power(x, 2)).rsqrt(),
    "erf": lambda x, y: 2 / arb.pi().sqrt() * (-BALLS.integer_power(x, 2)).exp(),
}


class _Jets(Lifted):
    """The arithmetic of jets."""

    kind = Jet

    def call(self, name: str, value: Any) -> Any:
        result = BALLS.call(name, value.value)
        return _checked(value.scaled(result, _DERIVATIVES[name](value.value, result)))

    def integer_power(self, base: Any, exponent: int) -> Any:
        if exponent == 0:
            return arb(1)
        value = BALLS.integer_power(base.value, exponent)
        return base.scaled(value, exponent * BALLS.integer_power(base.value, exponent - 1))

    def root(self, base: Any, numerator: int, denominator: int, nonnegative: bool) -> Any:
        value = BALLS.root(base.value, numerator, denominator, nonnegative)
        slope = BALLS.root(base.value, numerator - denominator, denominator, nonnegative)
        return base.scaled(value, slope * numerator / denominator)

    def absolute(self, value: Any) -> Any:
        return self.maximum(value, -value)

    def maximum(self, left: Any, right: Any) -> Any:
        known = self.order(left - right)
        if known is not None:
            return left if known >= 0 else right
        # Both may be the larger one. The slope of a maximum lies between the slopes of the two.
        n = len((left if isinstance(left, Jet) else right).slopes)
        columns = zip(slopes_of(left, n), slopes_of(right, n), strict=True)
        return Jet(_value(left).max(_value(right)), tuple(map(BALLS.either, columns)))

    def floor(self, value: Any) -> Any:
        result = BALLS.floor(_value(value))
        if not result.is_exact():
            raise Undefined("a jump of floor")
        return result

    def angle(self, y: Any, x: Any) -> Any:
        first, second = _value(y), _value(x)
        if second <= 0 and not (first > 0 or first < 0):
            raise Undefined("a jump of the angle")
        square = BALLS.integer_power(first, 2) + BALLS.integer_power(second, 2)
        turned = y * second - x * first
        return _checked(turned.scaled(BALLS.angle(first, second), 1 / square))

    def order(self, value: Any) -> int | None:
        return BALLS.order(_value(value))


def _value(number: Any) -> arb:
    return number.value if isinstance(number, Jet) else number


def _checked(jet: Jet) -> Jet:
    if not all(slope is None or slope.is_finite() for slope in jet.slopes):
        raise Undefined("a derivative has no finite value there")
    return jet


JETS = _Jets()


@dataclass(frozen=True)
class Bound:
    """An upper bound of a function on a box, and where to look next.

    ``upper`` bounds every value, ``point`` is a point of the box, ``split`` the coordinate whose halving promises
    most, or None where the function is monotone in every coordinate. ``value`` is the function at ``point``, where
    it has been computed.
    """

    upper: arb
    point: tuple[arb, ...]
    split: int | None
    value: arb | None = None


def upper_bound(function: Callable[[Sequence[Any], Any], Any], box: Sequence[Side]) -> Bound:
    """Bound ``function(coordinates, arithmetic)`` from above on ``box`` by the mean value form.

    Raises :class:`Undefined` where the function or a derivative has no finite enclosure on the box.
    """
    balls = [interval(low, high) for low, high in box]
    try:
        jet = function(variables(balls), JETS)
    except Undefined:
        jet = None
    if not isinstance(jet, Jet):
        # Not differentiable here, or constant: what remains is the range of the function on the balls.
        natural = (function(balls, BALLS) if jet is None else jet).upper()
        widest = max(range(len(box)), key=lambda index: float(balls[index].rad()), default=None)
        return Bound(finite(natural, "a function"), tuple(map(middle, box)), None if jet is not None else widest)
    point: list[arb] = []
    spread = arb(0)
    split, largest = None, -1.0
    for index, (side, ball, slope) in enumerate(zip(box, balls, jet.slopes, strict=True)):
        if slope is None or ball.is_exact() or slope >= 0:
            point.append(side[1])
        elif slope <= 0:
            point.append(side[0])
        else:
            centre = middle(side)
            point.append(centre)
            step = slope * (ball - centre)
            spread += step
            size = float(step.abs_upper())
            if size > largest:
                split, largest = index, size
    value = function(point, BALLS)
    upper = (value + spread).upper()
    natural = jet.value.upper()
    if not upper.is_finite() or natural < upper:
        upper = natural
    return Bound(finite(upper, "a function"), tuple(point), split, value)
