"""The simulated average that bounds are compared with."""

import dataclasses
import math

import pytest
import sympy as sp

from ptproof.problem import example
from ptproof.problem.field import Field
from ptproof.simulation.fleet import worst_distance

ENDS = {  # of the stretched time through T = 1 with a cap at ν = 3/10, by hand
    "paper": 17 / 3,
    "power": (0.3**-2 - 1) / 2 + 0.3**-2,
    "logarithmic": 1 - math.log(0.3),
    "exponential": math.exp(0.7 / 0.3) * (1 + 1 / 0.3) - 1,
    "tangent": 2 / math.pi * math.tan(0.35 * math.pi) + 0.3 * (1 + math.tan(0.35 * math.pi) ** 2),
}


@pytest.mark.parametrize("clock", list(ENDS))
def test_without_drift_the_average_of_a_quadratic_field_is_an_exponential_in_the_clock_s_time(clock):
    problem = example("saturated")
    tuning = dataclasses.replace(problem.tuning, clock=clock, exponent=sp.Integer(2) if clock == "power" else None)
    found = worst_distance(dataclasses.replace(problem, tuning=tuning), sp.Integer(2), starts=4)
    assert found.worst == pytest.approx(2 * math.exp(-0.7 * ENDS[clock]), rel=1e-6)
    assert found.curves[0][1][0] == pytest.approx(2)


def test_where_there_is_no_seeker_nothing_is_simulated():
    base = example("saturated")
    y = sp.Symbol("y", real=True)
    problem = dataclasses.replace(
        base, field=Field((y,), -(y**2), (0,), 1),
        drift=dataclasses.replace(base.drift, rate=(sp.Integer(0),)),
        initial=dataclasses.replace(base.initial, x=(sp.Integer(1),)),
    )  # fmt: skip
    found = worst_distance(problem, sp.Integer(1))
    assert found.worst is None
    assert found.why == "the seeker moves in the plane, but the field has 1 variable"


def test_without_a_clip_there_is_nothing_to_compare():
    base = example("saturated")
    problem = dataclasses.replace(base, tuning=dataclasses.replace(base.tuning, nu_min=None))
    assert worst_distance(problem, sp.Integer(1)).worst is None


def test_a_distance_below_what_a_run_resolves_is_not_compared_with_a_bound():
    problem = example("vanishing")
    fast = dataclasses.replace(
        problem, tuning=dataclasses.replace(problem.tuning, nu_min=sp.Rational(1, 10), clock="power", exponent=sp.S(2))
    )
    found = worst_distance(fast, sp.sqrt(8), starts=4)
    assert found.worst is None
    assert "closer than a run can tell" in found.why


def test_a_field_that_jumps_has_no_average_to_simulate():
    base = example("saturated")
    x, y = base.variables
    field = dataclasses.replace(base.field, expression=-(x**2 + y**2) * sp.Piecewise((1, y < 1), (2, True)))
    found = worst_distance(dataclasses.replace(base, field=field), sp.Integer(1))
    assert found.worst is None
    assert "no average to simulate: Piecewise((1, x2 < 1), (2, True)) is not shown" in found.why
