"""Ball arithmetic: what an enclosure, a slope, a series or a growth says, held against mpmath at points inside."""

from __future__ import annotations

import math
from typing import Any

import hypothesis.strategies as st
import sympy as sp
from flint import arb, fmpq
from hypothesis import given

from ptproof.balls.ball import Undefined, enclose, interval, precision
from ptproof.balls.cover import RELATIONS, holds_on_box
from ptproof.balls.growth import GROWTHS, Growth, coordinates, power_of
from ptproof.balls.jet import JETS, Jet, upper_bound, variables
from ptproof.balls.series import taylor
from ptproof.balls.tape import compile_tape
from tests.fuzz import oracle, trees
from tests.fuzz.oracle import MP
from tests.fuzz.sizes import fuzz, or_nothing

X, Y = trees.x, trees.y
BITS = 128
SECONDS = 3.0
HEADS = (sp.sin, sp.cos, sp.tan, sp.exp, sp.log, sp.atan, sp.tanh, sp.sinh, sp.cosh, sp.sqrt, sp.asin, sp.acos,
sp.erf,
         sp.asinh, sp.floor, sp.cot)  # fmt: skip
SMOOTH = (sp.sin, sp.cos, sp.exp, sp.atan, sp.tanh, sp.log, sp.sqrt, sp.cosh, sp.erf, sp.asinh)
ranges = st.lists(st.fractions(-4, 4, max_denominator=8), min_size=2, max_size=2).map(sorted)
expressions = trees.expressions((X, Y), functions=HEADS, kinks=True, symbolic=True, leaves=7)


def ball(value: Any) -> arb:
    return arb(fmpq(int(value.numerator), int(value.denominator)))


def inside(ranges: Any, seed: int, count: int = 4) -> list[dict[Any, sp.Rational]]:
    """The corners' first and last, and points between."""
    parts = [sp.Rational(k, 7) for k in (0, 7, 1 + seed % 6, 1 + seed // 7 % 6)][:count]
    found = []
    for k, part in enumerate(parts):
        point = {}
        for symbol, (low, high), turn in zip((X, Y), ranges, (0, seed // 49 % 2), strict=False):
            a, b = sp.Rational(low.numerator, low.denominator), sp.Rational(high.numerator, high.denominator)
            point[symbol] = a + (b - a) * (1 - part if turn and k > 1 else part)
        found.append(point)
    return found


def lies_in(enclosure: arb, value: Any, error: Any) -> bool:
    with precision(400):
        return bool(enclosure.overlaps(arb(MP.nstr(value, 80), MP.nstr(error, 5))))


def each_value(expression: Any, points: list[Any]) -> Any:
    for point in points:
        try:
            yield point, *oracle.certain(expression, point)
        except oracle.NoValue:
            continue


@given(expressions, ranges, ranges, trees.seeds)
@fuzz(12)
def test_a_ball_contains_every_value(expression: Any, first: Any, second: Any, seed: int) -> None:
    values = {X: interval(*map(ball, first)), Y: interval(*map(ball, second))}
    try:
        found = or_nothing(SECONDS, enclose, expression, values)
    except Undefined:
        return
    if found is None:
        return
    for point, value, error in each_value(expression, inside((first, second), seed)):
        assert lies_in(found, value, error), f"{expression} at {point}: {value} is not in {found}"


@given(expressions, ranges, ranges, trees.seeds)
@fuzz(12)
def test_an_upper_bound_is_one(expression: Any, first: Any, second: Any, seed: int) -> None:
    def work() -> Any:
        with precision(BITS):
            tape = compile_tape([expression], (X, Y))
            box = [tuple(map(ball, first)), tuple(map(ball, second))]
            return upper_bound(lambda values, arithmetic: tape.run(values, arithmetic)[0], box)

    try:
        found = or_nothing(SECONDS, work)
    except Undefined:
        return
    for point, value, error in each_value(expression, inside((first, second), seed)):
        assert value - error <= MP.mpf(math.nextafter(float(found.upper), math.inf)) or lies_in(
            found.upper, value, error
        ), f"{expression} at {point}: {value} is above {found.upper}"


@given(
    trees.expressions((X, Y), functions=HEADS, kinks=True, leaves=6),
    st.sampled_from(RELATIONS),
    ranges,
    ranges,
    trees.seeds,
)
@fuzz(10)
def test_what_a_cover_shows_holds_everywhere(
    expression: Any, relation: str, first: Any, second: Any, seed: int
) -> None:
    ends = [[sp.Rational(v.numerator, v.denominator) for v in pair] for pair in (first, second)]
    box = {X: tuple(ends[0]), Y: tuple(ends[1])}
    shift = sp.Rational(1, 1 + seed % 5)
    for candidate in (expression, expression - shift):
        try:
            found = holds_on_box(candidate, relation, box, seconds=1.0, max_boxes=60)
        except Undefined:
            continue
        if found.holds is None:
            continue
        if found.holds:
            for point in inside((first, second), seed):
                try:
                    assert not oracle.fails(candidate, relation, sp.S.Zero, point), (
                        f"{candidate} {relation} 0 at {point}"
                    )
                except oracle.NoValue:
                    continue
        else:
            try:
                side = oracle.sign(candidate, found.point)
            except oracle.NoValue:
                continue
            allowed = {"<": (0, 1), "<=": (1,), ">": (0, -1), ">=": (-1,)}[relation]
            assert side in allowed or (side == 0 and len(relation) == 1)


@given(trees.expressions((X, Y), functions=HEADS, symbolic=True, kinks=True, leaves=6), ranges, ranges, trees.seeds)
@fuzz(10)
def test_slopes_of_a_jet_bound_the_differences(expression: Any, first: Any, second: Any, seed: int) -> None:
    """By the mean value theorem on the straight line between two points of the box."""

    def work() -> Any:
        with precision(BITS):
            box = [interval(*map(ball, first)), interval(*map(ball, second))]
            return compile_tape([expression], (X, Y)).run(variables(box), JETS)[0]

    try:
        found = or_nothing(SECONDS, work)
    except Undefined:
        return
    if not isinstance(found, Jet):
        return
    known = list(each_value(expression, inside((first, second), seed)))
    for a, (here, low, low_error) in enumerate(known):
        for there, high, high_error in known[:a]:
            with precision(400):
                steps = [arb(fmpq(int(d.p), int(d.q))) for d in (there[X] - here[X], there[Y] - here[Y])]
                total = sum((arb(0) if s is None else s * d for s, d in zip(found.slopes, steps, strict=True)), arb(0))
            assert lies_in(total, high - low, high_error + low_error), f"{expression} between {here} and {there}"


@given(
    trees.expressions(
        (X, Y), functions=SMOOTH, powers=st.sampled_from([sp.Integer(2), sp.Integer(-1), sp.Rational(1, 2)]), leaves=6
    )
)
@fuzz(15)
def test_a_taylor_polynomial_has_the_derivatives_of_its_function(expression: Any) -> None:
    def work() -> Any:
        with precision(BITS):
            return taylor(compile_tape([expression], (X, Y)), 2, 3)[0]

    try:
        found = or_nothing(SECONDS, work)
    except Undefined:
        return
    if found is None:
        return
    # The remainder on a short ray is of fourth order: halving the ray divides it by 16 or so.
    rest = []
    for exponent in (8, 9):
        step = sp.Rational(1, 10**exponent)
        point = {X: step, Y: -2 * step}
        try:
            value, error = oracle.certain(expression, point)
        except oracle.NoValue:
            return
        with precision(400):
            total = sum(
                (c * arb(fmpq(1, 10**exponent)) ** sum(e) * (-2) ** e[1] for e, c in found.terms.items()), arb(0)
            )
            gap = (total - arb(MP.nstr(value, 80), MP.nstr(error, 5))).abs_lower()
        rest.append(float(gap) * 10.0 ** (4 * exponent))
    assert rest[1] <= max(1.0, 100 * rest[0]) or rest[1] < 1e12, f"{expression}: {rest}"


@given(
    trees.expressions((X, Y), functions=HEADS, kinks=True, symbolic=True, leaves=6),
    ranges,
    ranges,
    trees.seeds,
    st.sampled_from([1, 8]),
)
@fuzz(12)
def test_a_growth_encloses_the_values_far_away(expression: Any, first: Any, second: Any, seed: int, start: int) -> None:
    def work() -> Any:
        with precision(BITS):
            w = [interval(*(ball(end) / 4 for end in pair)) for pair in (first, second)]
            return compile_tape([expression], (X, Y)).run(coordinates(w, arb(1) / start), GROWTHS)[0]

    try:
        found = or_nothing(SECONDS, work)
    except Undefined:
        return
    if found is None:
        return
    if not isinstance(found, Growth):
        found = Growth({}, arb(1) / start).lift(found)
    for direction in inside((first, second), seed):
        for r in (start, 3 * start, 40 * start):
            point = {symbol: value * r / 4 for symbol, value in direction.items()}
            for _, value, error in each_value(expression, [point]):
                with precision(BITS):
                    low = sum((c.low * power_of(arb(r), e) for e, c in found.terms.items()), arb(0)).lower()
                    high = sum((c.high * power_of(arb(r), e) for e, c in found.terms.items()), arb(0)).upper()
                    values = found.range
                for below, above in ((low, high), (values.low.lower(), values.high.upper())):
                    near = arb(MP.nstr(value, 80), MP.nstr(error + abs(value) * MP.mpf(10) ** -30, 5))
                    assert not near < below, f"{expression} at {point}"
                    assert not near > above, f"{expression} at {point}"
