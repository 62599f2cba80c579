"""Rigorous values of SymPy expressions: real balls from python-flint, and nothing but balls.

A ball is a midpoint with a radius and contains the exact value. Comparisons of balls are three-valued: only a
comparison that is True means anything.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager
from functools import lru_cache, reduce
from itertools import pairwise
from typing import Any

import flint
import sympy as sp
from flint import arb

from ptproof.balls.rounding import up
from ptproof.balls.tape import Tape, compile_tape
from ptproof.balls.tape import Undefined as Undefined


def precision(bits: int) -> AbstractContextManager[Any]:
    """Work with ``bits`` bits inside, and put python-flint's global precision back afterwards."""
    return flint.ctx.workprec(bits)


def interval(low: Any, high: Any) -> arb:
    """A ball that contains [low, high], whose ends are balls or integers."""
    return arb(low).union(arb(high))


def finite(ball: arb, what: object) -> arb:
    """``ball``, if it is finite; raises :class:`Undefined` with ``what`` has no value otherwise."""
    if not ball.is_finite():
        raise Undefined(f"{what} has no finite value there")
    return ball


class _Balls:
    """The arithmetic of balls; each operation either encloses or raises :class:`Undefined`."""

    def constant(self, value: arb) -> arb:
        return value

    def call(self, name: str, value: Any) -> Any:
        return finite(getattr(value, name)(), name)

    def integer_power(self, base: Any, exponent: int) -> Any:
        if exponent < 0:
            return finite(1 / self.integer_power(base, -exponent), "a division by something that may be zero")
        if exponent < 2:
            return base if exponent == 1 else arb(1)
        if base.rel_accuracy_bits() > 20:
            return base**exponent
        # The library's own power is not defined on balls that contain zero, and a product forgets the sign:
        # go by the ends, between which the power is monotone.
        if exponent % 2 or base > 0 or base < 0:
            return interval(base.lower() ** exponent, base.upper() ** exponent)
        top = finite(base.abs_upper() ** exponent, "a power")
        return interval(0, top).nonnegative_part() if top > 0 else arb(0)

    def root(self, base: Any, numerator: int, denominator: int, nonnegative: bool) -> Any:
        if not (nonnegative or base >= 0):
            raise Undefined("a root of something that may be negative")
        base = base.nonnegative_part()
        if denominator == 2:
            value = base.sqrt()
        elif base > 0:
            value = base.root(denominator)
        else:
            upper = base.upper()
            value = interval(0, upper.root(denominator)) if upper > 0 else arb(0)
        return self.integer_power(finite(value, "a root"), numerator)

    def power(self, base: Any, exponent: Any) -> Any:
        if base.is_zero() and exponent > 0:
            return arb(0)
        if not base > 0:
            raise Undefined("a symbolic power of something that may not be positive")
        return finite((exponent * base.log()).exp(), "a power")

    def absolute(self, value: Any) -> Any:
        if value >= 0:
            return value
        return -value if value <= 0 else interval(0, value.abs_upper())

    def sign(self, value: Any) -> Any:
        known = self.order(value)
        return interval(-1, 1) if known is None else arb(known)

    def maximum(self, left: Any, right: Any) -> Any:
        return left.max(right)

    def minimum(self, left: Any, right: Any) -> Any:
        return left.min(right)

    def floor(self, value: Any) -> Any:
        return value.floor()

    def angle(self, y: Any, x: Any) -> Any:
        if not (x > 0 or x < 0 or y > 0 or y < 0):
            raise Undefined("the angle of a point that may be the origin")
        return finite(arb.atan2(y, x), "an angle")

    def either(self, values: Sequence[Any]) -> Any:
        return reduce(arb.union, values)

    def order(self, value: Any) -> int | None:
        if value > 0:
            return 1
        if value < 0:
            return -1
        return 0 if value.is_zero() else None


BALLS = _Balls()


@lru_cache(maxsize=512)
def _tape(expression: sp.Expr, symbols: tuple[sp.Symbol, ...]) -> Tape:
    return compile_tape([expression], symbols)


def ball_from(value: Any) -> arb:
    """The ball of an exact value at the present precision: a ball, an integer, a fraction or an exact expression.

    Raises :class:`Undefined` for floating-point numbers (which are not exact) and for what has no real value.
    """
    if isinstance(value, arb):
        return value
    if isinstance(value, bool | float):
        raise Undefined(f"{value!r} is not exact; give an integer, a fraction or a ball")
    if isinstance(value, flint.fmpq | flint.fmpz):
        return arb(value)
    return finite(_tape(sp.sympify(value), ()).run((), BALLS)[0], value)


def enclose(expression: sp.Expr, values: Mapping[sp.Symbol, Any] | None = None, *, bits: int = 128) -> arb:
    """A ball that contains every value of ``expression`` for values of its symbols out of ``values``.

    Parameters
    ----------
    expression
        Arithmetic, powers and the functions of :data:`ptproof.balls.tape.METHODS`, ``Abs``, ``sign``, ``floor``,
        ``Mod``, ``Max``, ``Min``, ``atan2``, ``Piecewise`` and derivatives that can be carried out. Where the
        conditions of a ``Piecewise`` are not decided on the balls, the result covers every branch that may apply.
    values
        For each free symbol a ball, an integer, or an exact expression without symbols.
    bits
        The working precision.

    Raises
    ------
    Undefined
        Where the balls touch a singularity or leave a domain of definition, and for what is not supported.

    Examples
    --------
    >>> x = sp.Symbol("x", real=True)
    >>> enclose(sp.sin(x) / x, {x: sp.pi / 2}) > arb("0.6366")
    True
    """
    table = dict(values or {})
    symbols = tuple(sorted(table, key=str))
    with precision(bits):
        inputs = [ball_from(table[symbol]) for symbol in symbols]
        for symbol, ball in zip(symbols, inputs, strict=True):
            _respect(symbol, ball)
        return finite(_tape(sp.sympify(expression), symbols).run(inputs, BALLS)[0], expression)


def largest_along(
    expression: sp.Expr, values: Mapping[sp.Symbol, Any], symbol: sp.Symbol, ends: tuple[Any, Any], pieces: int
) -> float:
    """What ``expression`` does not exceed while ``symbol`` runs from one end to the other, cut into equal pieces.

    ``values`` are those of the other symbols, as for :func:`enclose`; raises :class:`Undefined` as it does.
    """
    low, high = map(ball_from, ends)
    marks = [low + (high - low) * i / pieces for i in range(pieces + 1)]
    return max(up(enclose(expression, {symbol: interval(*pair), **values})) for pair in pairwise(marks))


def _respect(symbol: sp.Symbol, ball: arb) -> None:
    # SymPy has already simplified under the assumptions of the symbol, for example sqrt(x**2) to x.
    finite(ball, symbol)
    wrong = (symbol.is_positive and ball <= 0) or (symbol.is_nonnegative and ball < 0)
    if wrong or (symbol.is_negative and ball >= 0) or (symbol.is_nonpositive and ball > 0):
        raise Undefined(f"the value of {symbol} contradicts its declaration")


def separated(
    left: Any,
    right: Any,
    values: Mapping[sp.Symbol, Any] | None = None,
    bits_ladder: Sequence[int] = (64, 128, 256, 1024),
) -> int | None:
    """The sign of ``left - right`` at exact ``values`` where disjoint enclosures show it, else None.

    The precision is raised step by step; None says only that none of these precisions separates the two sides.

    Examples
    --------
    >>> separated(sp.pi, sp.Rational(355, 113))
    -1
    >>> separated(sp.sqrt(2) ** 2, 2) is None
    True
    """
    for bits in bits_ladder:
        try:
            first, second = enclose(left, values, bits=bits), enclose(right, values, bits=bits)
        except Undefined:
            continue
        with precision(bits):
            if first > second:
                return 1
            if first < second:
                return -1
    return None


def fraction(ball: arb) -> sp.Rational:
    """The number that an exact ball is."""
    value = ball.fmpq()
    return sp.Rational(int(value.p), int(value.q))


def enclosure_text(ball: arb, digits: int = 8) -> str:
    """The ball for people: ``0.5236 ± 1e-9``, or the number alone where it is exact and short.

    The printed interval contains the ball.
    """
    text = ball.str(digits).strip("[]").replace("+/-", "±")
    return f"0 {text}" if text.startswith("±") else text
