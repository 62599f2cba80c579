"""Concrete trajectories of assumed systems of differential equations, and what a grid may not be believed."""

from __future__ import annotations

import pytest
import sympy as sp

from ptproof.proof import ForAll, Goal, eq, ge, gt, le, lt
from ptproof.proof.attack import attack, points_of
from ptproof.proof.attack.trajectories import trajectories

s, t = sp.symbols("s t", real=True)
k = sp.Symbol("k", positive=True)
n = sp.Symbol("n", positive=True, integer=True)
X, Y = (sp.Function(name, real=True)(s) for name in "XY")
P, N = sp.Function("P", positive=True)(s), sp.Function("N", negative=True)(s)
radius = X**2 + Y**2

SOLVED = {
    "linear": {X: -k * X, Y: -2 * Y},
    "a rate that depends on time": {X: -X / (1 + s) ** 2, Y: Y},
    "radial": {X: -(radius**n) * X, Y: -(radius**n) * Y},
    "a rate with a letter as its power": {P: (k / (k + s) ** 2 - 1) * (P**2 + Y**2) ** (n + 1) / P, Y: P * Y},
}
UNSOLVED = {
    "nobody may rest": {X: Y + 1, Y: X + 1},
    "a value that is never 0 beside a negative one": {P: P * N, N: P * N},
    "a sum of powers": {X: X**3 - X, Y: Y**3 + Y**2},
    "a rate with a slope by a state": {X: sp.Derivative(sp.Function("F", real=True)(X, Y), X), Y: -X},
    "a rate with an unknown function": {X: sp.Function("F", real=True)(X), Y: sp.Function("F", real=True)(Y)},
}


def system(rates):
    return [ForAll((s,), eq(sp.Derivative(state, s), rate), (ge(s, 0), le(s, t))) for state, rate in rates.items()]


@pytest.mark.parametrize("name", SOLVED)
def test_the_one_that_moves_satisfies_its_equation(name):
    rates = SOLVED[name]
    found = list(trajectories(system(rates)))
    assert found
    moving = {function: concrete for function, concrete in reversed(found) if concrete.body != 0}  # the first of each
    for function, concrete in moving.items():
        state = next(state for state in rates if state.func == function)
        (place,) = concrete.arguments
        value = concrete.body.xreplace({place: s})
        rest = {other: 0 for other in rates if other != state}
        difference = sp.diff(value, s) - rates[state].subs(rest).subs(state, value)
        numbers = {s: 0.3, k: 0.7, n: 2, sp.Symbol("_start", positive=True): 5}
        assert abs(sp.N(difference.subs(numbers))) < 1e-12


@pytest.mark.parametrize("name", UNSOLVED)
def test_finds_nothing_where_none_moves_alone(name):
    assert not list(trajectories(system(UNSOLVED[name])))


def radial_goal(growth):
    moves = {P: -(P**2 + Y**2) * P, Y: -(P**2 + Y**2) * Y}
    return Goal("radial", le(P.subs(s, t), growth * P.subs(s, 0)), (*system(moves), ge(t, 0)))


def test_a_false_claim_about_a_system_is_hit_on_its_trajectory():
    assert attack(radial_goal(sp.Rational(1, 2))).hit is not None


def test_a_true_claim_about_a_system_is_not_hit():
    done = attack(radial_goal(1))
    assert done.points
    assert done.hit is None


x, y = sp.symbols("x y", real=True)
a, b = sp.symbols("a b", positive=True)


def test_an_assumption_on_several_numbers_is_not_believed_on_a_grid():
    """x·y ≤ a(x² + y²)/2 for all x, y says a ≥ 1; which is met by less at the places of a coarse grid."""
    form = ForAll((x, y), lt(-x * y - a * (x**2 + y**2) / 2, 0), (gt(x**2 + y**2, 0),))
    goal = Goal("form", gt(a, 1), (form,))
    assert attack(goal).hit is None
    assert next(points_of(goal, points=1), None) is None
