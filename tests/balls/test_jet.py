"""Balls with derivatives: the slopes are the derivatives, the mean value form bounds the function."""

import pytest
import sympy as sp
from flint import arb

from ptproof.balls.ball import BALLS, Undefined, enclose, precision
from ptproof.balls.jet import JETS, upper_bound, variables
from ptproof.balls.tape import compile_tape

x, y = sp.symbols("x y", real=True)
POINT = {x: sp.Rational(1, 3), y: sp.Rational(-2, 5)}


@pytest.mark.parametrize(
    "expression",
    [
        x**3 * y - 2 * y**-2 + 5,
        sp.sin(x * y) + sp.cos(x - y) + sp.tan(x) + sp.cot(y),
        sp.exp(x * y) * sp.log(x + 1),
        sp.sinh(x) * sp.cosh(y) - sp.tanh(x + y),
        sp.asin(x) - sp.acos(y) + sp.atan(x * y) + sp.asinh(y) + sp.erf(x),
        sp.sqrt(x + y**2) + (2 + x) ** sp.Rational(2, 3),
        (1 + x) ** y + 2**x + sp.E**y,
        sp.Abs(y) * sp.Max(x, y) + sp.Min(x, y, 7) + sp.sign(y) * x,
        sp.atan2(y, x),
        sp.Piecewise((x**2, x < y), (x * y, True)),
    ],
)
def test_slopes_are_the_partial_derivatives(expression):
    with precision(128):
        box = [arb(str(0)) + enclose(value) for value in POINT.values()]
        jet = compile_tape([expression], [x, y]).run(variables(box), JETS)[0]
    smooth = sp.Piecewise((expression, True)).rewrite(sp.Piecewise) if expression.has(sp.Abs, sp.Max) else expression
    for variable, slope in zip((x, y), jet.slopes, strict=True):
        expected = enclose(sp.diff(smooth, variable).doit(), POINT)
        assert slope.overlaps(expected)
        assert slope.rad() < 1e-9


def test_kink_has_every_slope_in_between():
    jet = compile_tape([sp.Abs(x)], [x]).run(variables([arb(0, 1)]), JETS)[0]
    assert jet.slopes[0].contains(-1)
    assert jet.slopes[0].contains(1)


@pytest.mark.parametrize("expression", [sp.sign(x), sp.floor(x), sp.Piecewise((1, x > 0), (0, True))])
def test_jump_has_no_slope(expression):
    with pytest.raises(Undefined):
        compile_tape([expression * x], [x]).run(variables([arb(0, 1)]), JETS)


@pytest.mark.parametrize(
    ("expression", "low", "high", "largest"),
    [
        (x * (1 - x), 0, 1, "0.25"),
        (x - x**2 / 2 + x**3 / 6, 0, 1, "0.6666666667"),
        (sp.cos(x) ** 2 + sp.sin(x) ** 2, 0, 1, "1"),
    ],
)
def test_mean_value_form_is_above_and_its_excess_is_of_second_order(expression, low, high, largest):
    tape = compile_tape([expression], [x])
    excess = []
    for parts in (4, 8):
        pieces = [(arb(low) + arb(i) / parts, arb(low) + arb(i + 1) / parts) for i in range(parts)]
        uppers = [upper_bound(lambda v, a: tape.run(v, a)[0], [piece]).upper for piece in pieces]
        excess.append(max(map(float, uppers)) - float(largest))
    assert all(value > -1e-8 for value in excess)
    assert excess[1] < 0.5 * excess[0] + 1e-8


def test_monotone_function_is_bounded_exactly_at_a_corner():
    tape = compile_tape([x - y**3 - y], [x, y])
    bound = upper_bound(lambda v, a: tape.run(v, a)[0], [(arb(0), arb(2)), (arb(1), arb(3))])
    assert bound.split is None
    assert (float(bound.upper), [float(end) for end in bound.point]) == (0.0, [2.0, 1.0])


def test_balls_and_jets_mix():
    jet = variables([arb(2)])[0]
    assert (arb(3) * jet + arb(1)).value == 7
    assert (arb(3) - jet).slopes[0] == -1
    assert BALLS.order((arb(1) * jet).value) == 1
