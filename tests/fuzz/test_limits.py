"""Limits and integrals: every value that is given, against numbers near the point and against quadrature."""

from __future__ import annotations

from typing import Any

import hypothesis.strategies as st
import sympy as sp
from hypothesis import event, given

from ptproof.proof.engines.evaluation import carried_out, continuous, definite
from ptproof.proof.engines.limits import limit_of
from tests.fuzz import oracle, trees
from tests.fuzz.oracle import MP
from tests.fuzz.sizes import fuzz, or_nothing

X, P, Q = trees.x, trees.p, trees.q
SECONDS = 1.0
STEPS = (6, 12)
PARAMETERS = {P: sp.Rational(3, 2), Q: sp.Integer(2), trees.y: sp.Rational(-1, 3), trees.z: sp.Integer(-2)}
approaches = st.sampled_from(
    [(sp.S.Zero, "+"), (sp.S.Zero, "-"), (sp.S.One, "-"), (sp.S.One, "+"), (P, "-"), (P, "+"), (sp.oo, "-"),
    (-sp.oo, "+"),
     (sp.Rational(-1, 3), "+"), (sp.pi, "-")]
)  # fmt: skip
inside = trees.expressions(
    (X, X, P, trees.y, trees.z),
    functions=(sp.exp, sp.log, sp.sin, sp.cos, sp.tanh, sp.atan, sp.sqrt, sp.Abs),
    symbolic=True,
    leaves=7,
)


@given(inside, approaches, st.booleans())
@fuzz(30)
def test_a_limit_is_what_the_values_tend_to(expression: Any, approach: tuple[Any, str], shifted: bool) -> None:
    point, side = approach
    if shifted and point not in (sp.oo, -sp.oo):
        expression = expression.subs(X, X - point)
        if not trees.is_plain(expression):
            return
    try:
        found = or_nothing(SECONDS, limit_of, expression, X, point, side)
    except (sp.PolynomialError, NotImplementedError, TypeError, ValueError, ZeroDivisionError, AttributeError) as error:
        raise AssertionError(f"{expression} at {point}{side} ends in {type(error).__name__}: {error}") from error
    if found is None:
        return
    event("answered")
    near, far = (_near(expression, point, side, step) for step in STEPS)
    if near is None or far is None:
        return
    if found in (sp.oo, -sp.oo):
        sign = 1 if found is sp.oo else -1
        assert sign * far > sign * near, f"{expression} at {point}{side}: {near}, {far}, not {found}"
        return
    try:
        limit, error = oracle.certain(found, PARAMETERS)
    except oracle.Unsure:
        return
    gaps = [abs(value - limit) - error for value in (near, far)]
    assert gaps[1] < max(MP.mpf(10) ** -4, gaps[0] * 0.97), f"{expression} at {point}{side}: {near}, {far}, not {found}"


def _near(expression: Any, point: Any, side: str, step: int) -> Any:
    h = sp.Rational(1, 10**step)
    if point in (sp.oo, -sp.oo):
        at: Any = sp.sign(point) / h
    else:
        base = oracle.value(point, PARAMETERS)
        at = base + oracle.value(h if side == "+" else -h, {})
    try:
        return oracle.certain(expression, {**PARAMETERS, X: at})[0]
    except oracle.Unsure:
        return None
    except oracle.NoValue as error:
        raise AssertionError(f"{expression} has a limit at {point}{side}, and no value near it: {error}") from None


ends = st.sampled_from(
    [sp.S.Zero, sp.S.One, sp.Integer(-1), sp.pi, 2 * sp.pi, P, Q, sp.oo, sp.Rational(1, 2), 7 * sp.pi, -sp.oo]
)
integrands = st.one_of(
    trees.expressions((X, X, P), functions=(sp.exp, sp.sin, sp.cos, sp.sqrt, sp.Abs), powers=st.sampled_from([2,
    3, -1, -2, sp.Rational(1, 2), sp.Rational(-1, 2)]), leaves=4),
    st.builds(
        lambda a, b, c, k: a * sp.exp(-b * X) * sp.cos(k * X) ** 2 + c / (b + X) ** k,
        trees.fractions, st.sampled_from([P, sp.S.One, Q, sp.Integer(-1)]), trees.integers, st.integers(1, 3),
    ),
    st.builds(lambda a, b, k: a / (1 + b * sp.cos(k * X)), trees.integers, st.sampled_from([sp.Rational(1, 2),
    P]), st.integers(1, 2)),
)  # fmt: skip


@given(integrands, ends, ends)
@fuzz(2)
def test_an_integral_is_what_quadrature_says(integrand: Any, low: Any, high: Any) -> None:
    if low is sp.oo or high is -sp.oo or low == high:
        low, high = sp.S.Zero, sp.S.One
    node = sp.Integral(integrand, (X, low, high))
    if not isinstance(node, sp.Integral):
        return
    found = or_nothing(SECONDS, definite, node)
    if found is None:
        return
    event("answered")
    _agrees(found, node)


@given(integrands, ends, trees.expressions((P, Q), functions=(sp.exp, sp.sin), leaves=3))
@fuzz(2)
def test_what_is_carried_out_has_the_same_value(integrand: Any, high: Any, factor: Any) -> None:
    high = sp.S.One if high is -sp.oo else high
    expression = factor * sp.Integral(integrand, (X, 0, high)) + sp.Derivative(integrand * factor, P).subs(X, 1)
    found = or_nothing(SECONDS, carried_out, expression)
    if found is not None and trees.is_plain(found):
        _agrees(found, expression)


def _agrees(found: Any, expression: Any) -> None:
    with MP.workdps(17):
        try:
            numeric, exact = oracle.value(expression, PARAMETERS), oracle.value(found, PARAMETERS)
        except oracle.NoValue:
            return
    assert abs(exact - numeric) < 1e-5 * (1 + abs(numeric)), f"{expression} is {numeric}, not {found}"


@given(
    trees.expressions(
        (X, P, trees.w), functions=(sp.exp, sp.log, sp.sqrt, sp.sin, sp.Abs, sp.tan), symbolic=True, leaves=5
    ),
    trees.seeds,
)
@fuzz(30)
def test_what_is_continuous_is_defined_everywhere(expression: Any, seed: int) -> None:
    if not expression.has(X) or not or_nothing(SECONDS, continuous, expression, X):
        return
    constants = [point | {X: sp.S.Half} for point in trees.points(expression.free_symbols, 3, seed)]
    for constant in constants:
        try:
            oracle.certain(expression, constant)
        except oracle.NoValue:
            continue  # not X is at fault
        for point in trees.points({X}, 5, seed):
            try:
                oracle.certain(expression, constant | point)
            except oracle.Unsure:
                continue
            except oracle.NoValue as error:
                raise AssertionError(f"{expression} at {constant | point}: {error}") from None
