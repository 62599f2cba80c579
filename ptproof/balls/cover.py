"""Inequalities on boxes, proved by a cover of small boxes or refuted at an exact point."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp
from flint import arb

from ptproof.balls.ball import BALLS, ball_from, enclose, enclosure_text, fraction, precision
from ptproof.balls.boxes import Side, Sides, halves, middle, widest, widths
from ptproof.balls.jet import Bound, upper_bound
from ptproof.balls.rounding import down, up
from ptproof.balls.search import Look, Search
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
    relation, box
        One of ``<``, ``<=``, ``>``, ``>=``; for every free symbol its exact smallest and largest value.
    max_boxes, seconds
        Where to give up.

    Returns
    -------
    CoverResult
        True: on every box of a cover the enclosure has the right sign. False: at an exact point the enclosure has the
        wrong sign. None: neither within the limits, for instance where both sides touch.

    Raises
    ------
    InputError, Undefined
        For an unknown relation or a missing or empty range; for what has no enclosure anywhere.

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
    began = time.perf_counter()
    with precision(BITS):
        start = _Start.read(box)
        tape = compile_tape([-expression if relation[0] == ">" else expression], start.symbols)
        strict = len(relation) == 1
        search = Search(lambda sides, _: _look(tape, sides, strict), [start.sides], depth_first=True)
        search.run(lambda: search.point is not None, deadline=began + seconds, most=max_boxes)
    if search.point is not None:
        return _counterexample(expression, relation, start.exact_point(search.point), search.looks)
    if search.left:
        ends = zip(start.symbols, search.next or start.sides, strict=True)
        place = ", ".join(f"{symbol} in [{float(low):.6g}, {float(high):.6g}]" for symbol, (low, high) in ends)
        detail = f"{search.looks} boxes in {time.perf_counter() - began:.1f} s, {search.left} left; resisting: {place}"
        return CoverResult(None, detail, search.looks)
    detail = f"a cover of {search.looks} boxes, each with the right sign at {BITS} bits"
    return CoverResult(True, detail, search.looks)


def _counterexample(expression: sp.Expr, relation: str, point: Mapping[sp.Symbol, sp.Expr], boxes: int) -> CoverResult:
    where = ", ".join(f"{symbol} = {value}" for symbol, value in point.items())
    value = enclosure_text(enclose(expression, point, bits=BITS))
    return CoverResult(False, f"{expression} {relation} 0 fails at {where}", boxes, point, value)


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
            symbol: self.exact[id(ball)] if id(ball) in self.exact else fraction(ball)
            for symbol, ball in zip(self.symbols, point, strict=True)
        }


def _look(tape: Tape, sides: Sides, strict: bool) -> Look[Sides, tuple[arb, ...]]:
    """Whether ``tape`` is certainly negative on a box (or not positive), or certainly not at one of its points."""
    try:
        bound: Bound | None = upper_bound(lambda values, arithmetic: tape.run(values, arithmetic)[0], sides)
    except Undefined:
        bound = None
    if bound is not None and (bound.upper < 0 or (bound.upper <= 0 and not strict)):
        return Look(up(bound.upper), settled=True)
    low, high = (tuple(side[end] for side in sides) for end in (0, 1))
    for point in (bound.point if bound else low, tuple(map(middle, sides)), low, high):
        try:
            value = tape.run(point, BALLS)[0]
        except Undefined:
            continue
        if value > 0 or (strict and value.is_zero()):
            return Look(math.inf, lower=max(0.0, down(value)), point=point)
    index = bound.split if bound is not None else None
    if index is None or not widths(sides)[index] > 0:
        index = widest(sides)
    # The lower half is looked at last, so that the search goes on with it.
    return Look(math.inf, halves=None if index is None else lambda: halves(sides, index)[::-1])
