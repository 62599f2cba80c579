"""Inequalities on boxes, proved by a cover of small boxes or refuted at an exact point."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp
from flint import arb

from ptproof.balls.ball import BALLS, ball_from, enclose, enclosure_text, precision
from ptproof.balls.jet import Bound, Side, middle, upper_bound
from ptproof.balls.tape import Tape, Undefined, compile_tape
from ptproof.errors import InputError

BITS = 128
RELATIONS = ("<", "<=", ">", ">=")


@dataclass(frozen=True)
class CoverResult:
    """What a cover says about ``expression relation 0`` on a box.

    ``holds`` is True where a cover shows it, False at the exact counterexample ``point``, where ``value`` (as text)
    encloses the expression, and None where neither was found. ``boxes`` counts the boxes that were looked at.
    """

    holds: bool | None
    detail: str
    boxes: int
    seconds: float
    point: Mapping[sp.Symbol, sp.Expr] | None = None
    value: str | None = None


def holds_on_box(
    expression: sp.Expr,
    relation: str,
    box: Mapping[sp.Symbol, tuple[Any, Any]],
    *,
    max_boxes: int = 100_000,
    seconds: float = 10.0,
) -> CoverResult:
    """Decide ``expression relation 0`` for all values of its symbols in a closed box.

    Parameters
    ----------
    expression
        As for :func:`ptproof.balls.ball.enclose`.
    relation
        One of ``<``, ``<=``, ``>``, ``>=``.
    box
        For every free symbol its exact smallest and largest value.
    max_boxes, seconds
        Where to give up.

    Returns
    -------
    CoverResult
        True: on every box of a cover the enclosure has the right sign. False: at an exact point the enclosure has the
        wrong sign. None: neither within the limits, for instance where both sides touch.

    Raises
    ------
    InputError
        For an unknown relation, a symbol without a range, or an empty range.
    Undefined
        Where the expression contains something that has no enclosure anywhere.

    Examples
    --------
    >>> x = sp.Symbol("x", real=True)
    >>> print(holds_on_box(sp.cos(x) - 1 + x**2 / 2, ">", {x: (sp.Rational(1, 100), 3)}).holds)
    True
    """
    if relation not in RELATIONS:
        raise InputError(f"the relation must be one of {', '.join(RELATIONS)}, not {relation!r}")
    expression = sp.sympify(expression)
    if missing := expression.free_symbols - set(box):
        raise InputError(f"no range is given for {', '.join(sorted(map(str, missing)))}")
    symbols = tuple(box)
    negated = -expression if relation[0] == ">" else expression
    with precision(BITS):
        start = _Start.read(box)
        search = _Search(compile_tape([negated], symbols), start, strict=len(relation) == 1)
        holds, point, detail = search.run(max_boxes, seconds)
    value = None
    if point is not None:
        value = enclosure_text(enclose(expression, point, bits=BITS))
        detail = f"{expression} {relation} 0 fails at " + ", ".join(f"{key} = {point[key]}" for key in symbols)
    return CoverResult(holds, detail, search.boxes, time.perf_counter() - search.began, point, value)


@dataclass(frozen=True)
class _Start:
    """The box in balls, with the exact ends that are no dyadic fractions remembered by the ball's identity."""

    symbols: tuple[sp.Symbol, ...]
    sides: tuple[Side, ...]
    exact: Mapping[int, sp.Expr]

    @staticmethod
    def read(box: Mapping[sp.Symbol, tuple[Any, Any]]) -> _Start:
        sides, exact = [], {}
        for symbol, ends in box.items():
            low, high = (sp.sympify(end) for end in ends)
            try:
                balls = ball_from(low), ball_from(high)
            except Undefined as error:
                raise InputError(f"the range of {symbol} must have exact real ends: {error}") from None
            if balls[0] > balls[1]:
                raise InputError(f"the range of {symbol} is empty: {low} > {high}")
            sides.append(balls)
            exact.update({id(balls[0]): low, id(balls[1]): high})
        return _Start(tuple(box), tuple(sides), exact)

    def exact_point(self, point: Sequence[arb]) -> dict[sp.Symbol, sp.Expr]:
        """The exact coordinates of a point whose balls are ends of the start or exact themselves."""
        return {
            symbol: self.exact[id(ball)] if id(ball) in self.exact else _rational(ball)
            for symbol, ball in zip(self.symbols, point, strict=True)
        }


def _rational(ball: arb) -> sp.Rational:
    fraction = ball.fmpq()
    return sp.Rational(int(fraction.p), int(fraction.q))


class _Search:
    """The subdivision for ``expression < 0`` (or <= 0)."""

    def __init__(self, tape: Tape, start: _Start, strict: bool) -> None:
        self.tape, self.start, self.strict = tape, start, strict
        self.boxes = 0
        self.began = time.perf_counter()

    def function(self, values: Sequence[Any], arithmetic: Any) -> Any:
        return self.tape.run(values, arithmetic)[0]

    def run(self, max_boxes: int, seconds: float) -> tuple[bool | None, Mapping[sp.Symbol, sp.Expr] | None, str]:
        stack = [self.start.sides]
        smallest: tuple[Side, ...] = self.start.sides
        while stack:
            if self.boxes >= max_boxes or time.perf_counter() - self.began > seconds:
                return None, None, self.gave_up(len(stack), smallest)
            sides = stack.pop()
            self.boxes += 1
            try:
                bound: Bound | None = upper_bound(self.function, sides)
            except Undefined:
                bound = None
            if bound is not None and (bound.upper < 0 or (bound.upper <= 0 and not self.strict)):
                continue
            corners = (tuple(low for low, _ in sides), tuple(high for _, high in sides))
            for point in (bound.point if bound else corners[0], tuple(map(middle, sides)), *corners):
                if self.fails(point):
                    return False, self.start.exact_point(point), ""
            index = _where(sides, bound)
            if index is None:
                return None, None, self.gave_up(len(stack) + 1, sides)
            cut = middle(sides[index])
            smallest = sides
            for half in ((cut, sides[index][1]), (sides[index][0], cut)):
                stack.append((*sides[:index], half, *sides[index + 1 :]))
        return True, None, f"a cover of {self.boxes} boxes, each with the right sign at {BITS} bits"

    def fails(self, point: Sequence[arb]) -> bool:
        try:
            value = self.function(point, BALLS)
        except Undefined:
            return False
        return bool(value > 0 or (self.strict and value.is_zero()))

    def gave_up(self, left: int, sides: Sequence[Side]) -> str:
        place = ", ".join(
            f"{symbol} in [{float(low):.6g}, {float(high):.6g}]"
            for symbol, (low, high) in zip(self.start.symbols, sides, strict=True)
        )
        return f"{self.boxes} boxes in {time.perf_counter() - self.began:.1f} s, {left} left; resisting: {place}"


def _where(sides: Sequence[Side], bound: Bound | None) -> int | None:
    """The coordinate to halve: the one that spreads most, or the widest; None where there is nothing to halve."""
    widths = [float(high - low) for low, high in sides]
    if bound is not None and bound.split is not None and widths[bound.split] > 0:
        return bound.split
    if not sides:
        return None
    index = max(range(len(sides)), key=widths.__getitem__)
    cut = middle(sides[index])
    return index if cut > sides[index][0] and cut < sides[index][1] else None
