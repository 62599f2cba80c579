"""Nested integrals by hand lie in their enclosures, which are narrow, and others do not."""

import pytest
import sympy as sp
from flint import arb

from ptproof.balls.ball import enclose, precision
from ptproof.balls.nested import Functions

theta, a = sp.symbols("theta a", real=True)
pi, R = sp.pi, sp.Rational
SQUARE = sp.Piecewise((1, theta < pi), (-1, True))

# f_j, f_i, the end of the interval, and the integral of f_j times the antiderivative of f_i from 0
BY_HAND = [
    (sp.sin(theta), sp.cos(theta), 2 * pi, pi),
    (theta**3, theta, 1, R(1, 12)),
    (sp.Integer(2), sp.Integer(3), 2, 12),
    (sp.exp(theta), sp.exp(theta), 1, (sp.E - 1) ** 2 / 2),
    (1 / (1 + theta), sp.Integer(1), 1, 1 - sp.log(2)),
    (SQUARE, sp.Integer(1), 2 * pi, -(pi**2)),
    (sp.sign(sp.sin(theta)), sp.Heaviside(theta - pi), 2 * pi, -(pi**2) / 2),
    (sp.ceiling(theta), sp.Integer(1), 2, R(7, 2)),
    (sp.Mod(theta, 1), sp.Integer(1), 2, R(7, 6)),
    (sp.asin(sp.sin(theta)), sp.Integer(1), pi, pi**3 / 8),
    (sp.acos(sp.cos(theta)), sp.Integer(1), 2 * pi, pi**3),
    (sp.atan(sp.tan(theta)), sp.Integer(1), pi, -(pi**3) / 24),
]


@pytest.mark.parametrize(("outer", "inner", "end", "exact"), BY_HAND, ids=lambda entry: str(entry)[:40])
def test_the_integral_by_hand_lies_in_a_narrow_enclosure(outer, inner, end, exact):
    with precision(80):
        top = enclose(sp.sympify(end), bits=80)
        found = Functions((outer, inner), theta, top, {}).nested_integrals([pi / 2, pi, sp.Integer(1)])[0, 1]
        assert found.rad() < 1e-9
        assert found.overlaps(enclose(sp.sympify(exact), bits=80))


def test_breaks_that_are_missing_or_wrong_cost_no_rigour():
    with precision(80):
        functions = Functions((SQUARE, sp.Abs(theta - 3)), theta, 2 * arb.pi(), {})
        right, wrong, none = (functions.nested_integrals(breaks)[0, 1] for breaks in ([pi, sp.S(3)], [sp.S.One], []))
    assert right.overlaps(wrong)
    assert right.overlaps(none)


def test_symbols_have_the_values_that_are_given():
    with precision(80):
        found = Functions((a * sp.sin(theta), sp.cos(a * theta)), theta, 2 * arb.pi(), {a: arb(2)}).nested_integrals()
    # 2 sin θ · sin(2θ)/2 over a period
    assert found[0, 1].contains(0)
    assert found[0, 1].rad() < 1e-9


def test_what_is_smooth_nowhere_near_a_point_needs_too_many_panels():
    with precision(80), pytest.raises(ArithmeticError, match="too many panels"):
        Functions((sp.floor(10**6 * theta),), theta, arb(1), {}).nested_integrals()
