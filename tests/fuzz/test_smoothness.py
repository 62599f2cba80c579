"""Smoothness: what is said to be C^k has a value everywhere, and derivatives on both sides of a point that meet."""

from __future__ import annotations

from typing import Any

import hypothesis.strategies as st
import sympy as sp
from hypothesis import event, given

from ptproof.proof.engines.smoothness import smoothness
from ptproof.proof.statement import Relation
from ptproof.proof.verdict import Verdict
from tests.fuzz import oracle, trees
from tests.fuzz.oracle import MP
from tests.fuzz.sizes import fuzz, or_nothing

X, Y = trees.x, trees.y
SECONDS = 4.0
heads = (sp.sin, sp.exp, sp.sqrt, sp.Abs, sp.log, sp.tanh, sp.tan, sp.sign, sp.asin)
powers = st.sampled_from(
    [
        sp.Integer(2),
        sp.Integer(3),
        sp.Integer(-1),
        *(sp.Rational(k, 4) for k in (1, 2, 3, 5, 6, 9, 10, -2)),
        sp.Rational(4, 3),
    ]
)
side = st.sampled_from([X, Y, X - Y, X * Y, X**2 - Y, X**2 + Y**2, X + 1, sp.sin(X), X**3, X**2, X**2 * Y**2])
glued = st.one_of(
    st.builds(lambda a, k: sp.Abs(a) ** k, side, st.sampled_from([1, 2, 3, sp.Rational(3, 2), sp.Rational(5, 2)])),
    st.builds(lambda a, k: a**k, side, powers),
    st.builds(
        lambda a, k, c: sp.Piecewise((a**k, a > 0), (c * a**2, True)),
        side,
        st.integers(1, 4),
        st.sampled_from([0, 1, -1]),
    ),
    st.builds(lambda a, b: sp.Max(a, b), side, side),
    st.builds(lambda a, k: sp.Max(a, 0) ** k, side, st.integers(1, 3)),
    st.builds(lambda a, b: a * sp.Abs(a) * b, side, side),
    st.builds(lambda a, b, k: a**3 / (b**2) ** k, side, side, powers),
    st.builds(lambda a, c: sp.Piecewise((sp.exp(-1 / a), a > 0), (c, True)), side, st.sampled_from([0, 1])),
    st.builds(lambda a, b: sp.atan2(a, b), side, side),
)
expressions = st.one_of(
    glued,
    st.builds(lambda a, b: a + b, glued, trees.expressions((X, Y), functions=heads, powers=powers, leaves=3)),
    st.builds(lambda a, b: a * b, glued, trees.expressions((X, Y), functions=heads, powers=powers, leaves=3)),
    st.builds(lambda a, head: head(a), glued, st.sampled_from(heads)),
    trees.expressions((X, Y), functions=heads, powers=powers, kinks=True, leaves=5),
)
boxes = st.sampled_from([(), (Relation(sp.S.Zero, "<=", X),), (Relation(X, ">=", sp.S.Zero), Relation(Y, ">",
sp.S.Zero)),
                         (Relation(X, "<=", sp.S.One), Relation(sp.Integer(-1), "<=", X), Relation(Y, ">=",
                         sp.S.One))])  # fmt: skip
BASES = [(0, 0), (1, 1), (0, 1), (1, 0), (-1, 1), (2, 4), (1, -1)]
DIRECTIONS = [(1, 0), (0, 1), (1, 2), (3, -1), (-1, 0), (0, -1), (1, 1), (1, -1)]


@given(expressions, st.integers(0, 2), boxes)
@fuzz(10)
def test_what_is_shown_smooth_is_smooth_along_lines(expression: Any, order: int, domain: Any) -> None:
    if not trees.is_plain(expression):
        return
    found = or_nothing(SECONDS, lambda: smoothness(expression, (X, Y), order, domain=domain))
    if found is None or found.verdict is not Verdict.PROVED:
        return
    event("answered")
    for base in BASES:
        for direction in DIRECTIONS:
            _check_line(expression, order, domain, base, direction)


def _check_line(expression: Any, order: int, domain: Any, base: Any, direction: Any) -> None:
    def at(step: sp.Rational) -> dict[Any, sp.Rational]:
        return {X: base[0] + step * direction[0], Y: base[1] + step * direction[1]}

    def allowed(step: sp.Rational) -> bool:
        return all(not oracle.fails(item.left, item.sign, item.right, at(step)) for item in domain)

    def difference(h: sp.Rational, sign: int) -> Any:
        """The order-th difference quotient of the function on one side of the base."""
        d = h / 8
        values = [oracle.value(expression, at(sign * (h + k * d))) for k in range(order + 1)]
        if order == 2:
            values = [values[0] - 2 * values[1] + values[2]]
        elif order == 1:
            values = [sign * (values[1] - values[0])]
        return values[0] / oracle.value(d, {}) ** order

    ends = [sp.Rational(1, 10**k) for k in (6, 9)]
    if not all(allowed(step) for step in (sp.S.Zero, ends[0] * 2, -ends[0] * 2)):
        return
    try:
        gaps = [abs(difference(h, 1) - difference(h, -1)) for h in ends]
        oracle.value(expression, at(sp.S.Zero))
        size = max(abs(difference(h, 1)) for h in ends)
    except oracle.Unsure:
        return
    except oracle.NoValue as error:
        raise AssertionError(f"{expression} has no value near {base}: {error}") from None
    limit = MP.mpf(10) ** -2 * (1 + size)
    assert gaps[1] < limit or gaps[1] < gaps[0] * 0.9, (
        f"{expression} is not C^{order} at {base} along {direction}: {gaps}"
    )
    assert size < 10**6 or abs(difference(ends[1], 1)) < 20 * abs(difference(ends[0], 1)), (
        f"{expression} at {base}: unbounded"
    )
