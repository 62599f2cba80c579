"""Enclosures contain the exact value, and refuse where there is none."""

import flint
import hypothesis.strategies as st
import pytest
import sympy as sp
from flint import arb
from hypothesis import given, settings

from ptproof.balls.ball import Undefined, enclose, enclosure_text, precision, separated

x, y = sp.symbols("x y", real=True)
positive = sp.Symbol("p", positive=True)
third = sp.Rational(1, 3)


@pytest.mark.parametrize(
    ("expression", "values"),
    [
        (sp.sin(x) * sp.exp(-(x**2)) + sp.log(x), {x: third}),
        (sp.sqrt(x) + x ** sp.Rational(2, 3) + x**-3, {x: third}),
        (sp.atan(x) + sp.asin(x) - sp.acos(x) + sp.tan(x), {x: third}),
        (sp.sinh(x) - sp.cosh(x) + sp.tanh(x) + sp.asinh(x) + sp.cot(x) + sp.erf(x), {x: third}),
        (positive**x, {positive: 2, x: third}),
        (sp.Abs(x) + sp.sign(x) + sp.floor(x) + sp.Mod(x, 2), {x: -third}),
        (sp.Max(x, y) * sp.Min(x, y, 1), {x: 2, y: third}),
        (sp.atan2(y, x), {x: -1, y: third}),
        (sp.Piecewise((x, x < 0), (x**2, sp.And(x > 0, x < 1)), (5, True)), {x: third}),
        (sp.pi * sp.E + sp.GoldenRatio + sp.EulerGamma, {}),
        (sp.Derivative(x**3, x), {x: third}),
    ],
)
def test_enclosure_agrees_with_independent_evaluation(expression, values):
    ball = enclose(expression, values, bits=128)
    expected = str(sp.N(expression.doit().subs(values), 30))
    with precision(128):
        assert abs(ball - arb(expected)) < arb("1e-25")


@settings(max_examples=70, derandomize=True, deadline=None)
@given(st.fractions(-3, 3), st.fractions(0, 1), st.fractions(-1, 1))
def test_ball_of_a_range_contains_the_value_at_each_point(centre, radius, offset):
    expression = x**4 - 3 * x**3 * sp.cos(x) + sp.exp(x) / (1 + x**2) - sp.Abs(x)
    point = centre + radius * offset
    wide = enclose(expression, {x: arb(_ball(centre), _ball(radius).upper())})
    assert wide.contains(enclose(expression, {x: sp.Rational(point)}, bits=400))


def _ball(fraction):
    return arb(flint.fmpq(fraction.numerator, fraction.denominator))


@pytest.mark.parametrize("exponent", [2, 4, 6])
def test_even_power_of_a_ball_around_zero_is_finite(exponent):
    ball = enclose(x**exponent, {x: arb(0, 1)})
    assert ball.is_finite()
    assert ball.contains(0)
    assert ball.contains(1)


def test_even_power_lets_a_root_be_taken():
    assert enclose(sp.sqrt(x**2 + y**4), {x: arb(0, 1), y: arb(0, 1)}).contains(arb(2).sqrt().mid())


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        (1 / x, 0),
        (1 / x, arb(0, 1)),
        (1 / (x - x**2), 1),
        (sp.log(x), arb("0.5", "0.6")),
        (sp.log(x), -1),
        (sp.sign(sp.log(x)), -1),
        (sp.Max(sp.log(x), 1), -1),
        (sp.sqrt(x), -1),
        (sp.sqrt(x), arb(0, 1)),
        (x**third, -8),
        (2 ** (1 / x), 0),
        (sp.tan(x), arb("1.5", "0.2")),
        (sp.acos(x), 2),
        (sp.atan2(x, x), 0),
        (sp.exp(1 / x), 0),
        (sp.Piecewise((x, x < 0)), 1),
        (x + sp.I, 1),
        (x + sp.oo, 1),
        (sp.gamma(x), 1),
        (sp.Function("f")(x), 1),
        (x + y, 1),
        (sp.Float("0.1") * x, 1),
        (x, 0.1),
        (x, True),
        (x, sp.Float("0.1")),
        (x, arb("nan")),
        (x, y),
    ],
)
def test_undefined_is_raised_not_guessed(expression, value):
    with pytest.raises(Undefined):
        enclose(expression, {x: value})


def test_value_that_contradicts_the_declaration_is_refused():
    # sqrt(p**2) has become p, which would be -1 here.
    with pytest.raises(Undefined, match="declaration"):
        enclose(sp.sqrt(positive**2), {positive: -1})


def test_branch_that_does_not_apply_may_be_undefined():
    assert enclose(sp.Piecewise((1 / x, x > 0), (7, True)), {x: 0}) == 7


def test_undecided_conditions_give_the_hull_of_the_branches():
    ball = enclose(sp.Piecewise((3, x > 0), (-5, True)), {x: arb(0, 1)})
    assert ball.contains(3)
    assert ball.contains(-5)


def test_undecided_conditions_with_an_undefined_branch_are_undefined():
    with pytest.raises(Undefined):
        enclose(sp.Piecewise((1 / x, x > 0), (7, True)), {x: arb(0, 1)})


def test_global_precision_is_put_back():
    before = flint.ctx.prec
    enclose(sp.sin(x), {x: 1}, bits=500)
    with pytest.raises(Undefined):
        enclose(sp.log(x), {x: -1}, bits=500)
    assert flint.ctx.prec == before


@pytest.mark.parametrize(
    ("left", "right", "sign"),
    [
        (sp.pi, sp.Rational(355, 113), -1),
        (sp.exp(sp.pi) - sp.pi, 20, -1),
        (sp.exp(sp.pi * sp.sqrt(163)), 262537412640768744, -1),
        (sp.exp(sp.pi * sp.sqrt(163)), 262537412640768743, 1),
        (sp.sqrt(2) * sp.sqrt(3), sp.sqrt(6) + sp.Rational(1, 10**40), -1),
        (sp.sin(1) ** 2 + sp.cos(1) ** 2, 1, None),
        (sp.log(-1, evaluate=False), 1, None),
    ],
)
def test_separated(left, right, sign):
    assert separated(left, right) == sign


def test_three_valued_comparison_of_balls_is_what_the_package_relies_on():
    ball = arb(0, 1)
    assert not (ball < 0)
    assert not (ball >= 0)
    assert (ball**2).is_nan()


@pytest.mark.parametrize("text", ["0.5236", "1e-30", "123456.789", "-7"])
def test_text_reads_back_as_an_interval_that_contains_the_ball(text):
    ball = arb(text, abs(arb(text)) / 10**5)
    assert arb(enclosure_text(ball).replace("±", "+/-")).contains(ball)
