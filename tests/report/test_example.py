"""A witness put into the formula that it defeats."""

import pytest
import sympy as sp

from ptproof.proof import eq, every, gt, le
from ptproof.report.example import Point, example_of

x, y, k = sp.Symbol("x", real=True), sp.Symbol("y", real=True), sp.Symbol("k", positive=True)
F = sp.Function("F", real=True)
SQUARE = {"F": ((x,), x**2 + 1)}


def example(statement, left, right, functions=None, radius=0.0, **values):
    symbols = {symbol: sp.Rational(values[symbol.name]) for symbol in (x, y, k) if symbol.name in values}
    return example_of(statement, Point(symbols, functions or {}), (sp.S(left), 0.0), (sp.S(right), radius), {})


@pytest.mark.parametrize(
    ("statement", "sides", "values", "put", "compared"),
    [
        (gt(k, 2 * x * y**2), (3, 16), {"k": 3, "x": 2, "y": 2}, "", r"3 > 2 \cdot 2 \cdot 2^{2} = 16"),
        (eq(x + y, x * y), (-1, -6), {"x": -3, "y": 2},
         r"\left(-3\right) + 2 = \left(-3\right) \cdot 2", "-1 = -6"),
        (le(x, y), (2, 1), {"x": 2, "y": 1}, "", r"2 \le 1"),
        (eq(F(x), sp.Derivative(F(x), x) * y), (5, 4), {"x": 2, "y": 1}, "", r"5 = 4 \cdot 1 = 4"),
        (every(eq(x, x), eq(y, sp.sqrt(k))), (1, sp.sqrt(2)), {"x": 1, "y": 1, "k": 2}, "",
         r"1 = \sqrt{2} = \sqrt{2} \approx 1.41421"),
    ],
)  # fmt: skip
def test_values_stand_in_the_formula_and_nothing_is_multiplied_out(statement, sides, values, put, compared):
    found = example(statement, *sides, SQUARE, **values)
    assert (found.put, found.compared) == (put, compared)


def test_two_numbers_that_differ_look_different():
    found = example(le(sp.sqrt(x), sp.sqrt(y)), sp.sqrt(2), sp.sqrt(sp.Rational("1.9999999")), x=2, y="1.9999999")
    assert found.compared == r"\sqrt{2} \approx 1.41421356 \le \frac{\sqrt{199999990}}{10000} \approx 1.41421353"


@pytest.mark.parametrize("sides", [(3, 15), (2, 16)])
def test_what_the_witness_does_not_say_is_not_shown(sides):
    assert example(gt(k, 2 * x * y**2), *sides, k=3, x=2, y=2) is None


@pytest.mark.parametrize(("radius", "shown"), [(1e-3, True), (1e-5, False)])
def test_a_side_may_be_said_by_a_ball(radius, shown):
    found = example(gt(k, sp.sqrt(x)), 1, "1.4141", radius=radius, k=1, x=2)
    assert (found is not None) is shown


def test_what_has_no_value_is_not_shown():
    assert example(gt(k, 2 * x), 3, 4, k=3) is None


def test_what_is_too_long_is_said_by_its_sides():
    found = example(eq(sum(x**n for n in range(1, 30)), y), 29, 1, x=1, y=1)
    assert (found.put, found.compared) == ("", "29 = 1")
