"""The reduced model and the average of a problem, against the paper's printed right-hand sides."""

from dataclasses import replace

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.problem import SEEKERS, TAU, TIME, example, parameters
from ptproof.problem.loops import averaged_system, closed_loop, symbolic_clock
from ptproof.proof.algebra import is_zero

P = parameters
NU = sp.Max(P.nu_min, 1 - (TIME - P.t0) / P.T)


@pytest.mark.parametrize("name", ["vanishing", "nonvanishing"])
def test_the_average_in_t_is_the_drift_plus_half_the_gain_times_the_gradient(name):
    problem = example(name)
    system = problem.averaged("pt", "t", symbolic=True)
    expected = sp.Matrix(problem.drift.rate) + P.k / 2 / NU**2 * problem.field.gradient
    point = {TIME: sp.Rational(1, 3), P.t0: 0, P.T: 2, P.nu_min: sp.Rational(3, 10), P.k: sp.Rational(7, 5)}
    point |= dict(zip(problem.variables, (sp.Rational(1, 3), sp.Rational(-5, 4)), strict=True))
    for left, right in zip(system.rhs, expected, strict=True):
        assert abs((left - right).subs(point).evalf(30)) < 1e-25
        # A missing 1/2 would be seen here.
        assert abs((left - 2 * right).subs(point).evalf(30)) > 1e-3


def test_the_average_of_the_asymptotic_seeker_has_the_gain_one():
    problem = example("vanishing")
    system = problem.averaged("asymptotic", "tau", symbolic=True)
    expected = (P.k / 2 - 1) * problem.field.gradient
    assert all(is_zero(left - right) for left, right in zip(system.rhs, expected, strict=True))


def test_the_reduced_model_is_the_loop_with_the_measured_field_for_z():
    problem = example("nonvanishing")
    loop = problem.closed_loop("pt", "tau", coordinates="reduced", symbolic=True)
    model = problem.reduced_model("pt", "tau", symbolic=True)
    for left, right in zip(model.rhs, loop.rhs[:2], strict=True):
        assert left == right.subs(loop.state[2], problem.field.expression)
    assert TAU in model.rhs[0].free_symbols


def test_a_saturated_seeker_is_not_averaged():
    with pytest.raises(InputError, match="saturated"):
        example("saturated").averaged("saturated")


def test_a_law_of_ones_own_is_a_record_and_has_all_systems():
    """Three times as fast: the gain is 3, tau runs at the rate 3, and the heading is solved for."""
    problem, brisk = example("nonvanishing"), replace(SEEKERS["asymptotic"], name="brisk", gain=sp.Integer(3))
    clock = symbolic_clock("paper", False, True, brisk.gain)
    full, reduced = (
        closed_loop(problem.field, problem.drift, brisk, clock, "t", coordinates) for coordinates in ("full", "reduced")
    )
    theta = full.state[2]
    heading = P.p0 + 3 * P.omega * (TIME - P.t0) - P.k * full.state[3]
    for i, j in ((0, 0), (1, 1), (3, 2)):
        assert is_zero(full.rhs[i].subs(theta, heading) - reduced.rhs[j])
    mean = averaged_system(problem.field, problem.drift, brisk, clock, "t")
    for left, drift, slope in zip(mean.rhs, problem.drift.rate, problem.field.gradient, strict=True):
        assert is_zero(left - drift - 3 * P.k / 2 * slope)
