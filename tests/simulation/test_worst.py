"""The simulated average that bounds are compared with."""

import dataclasses
import math

import pytest
import sympy as sp

from ptproof.problem import example
from ptproof.problem.field import Field
from ptproof.simulation import simulate
from ptproof.simulation.worst import _directions, averaged_system, worst_distance


@pytest.mark.parametrize("n", [1, 2, 3])
def test_directions_are_unit_vectors_on_all_sides(n):
    directions = _directions(n, 60)
    assert all(math.hypot(*u) == pytest.approx(1) for u in directions)
    assert all(abs(sum(u[i] for u in directions)) < 1.5 for i in range(n))


def test_without_drift_the_average_of_a_quadratic_field_is_an_exponential():
    problem = example("saturated")
    found = worst_distance(problem, sp.Integer(2), starts=4)
    exact = 2 * math.exp(-0.7 * 17 / 3)
    assert found.worst == pytest.approx(exact, rel=1e-6)
    assert found.curves[0][1][0] == pytest.approx(2)


@pytest.mark.parametrize("name", ["vanishing", "nonvanishing"])
def test_the_written_average_is_the_derived_one(name):
    problem = example(name)
    start = dict(zip(("x1", "x2"), map(float, problem.initial.x), strict=True))
    derived = simulate(problem, model="average")
    written = simulate(averaged_system(problem), initial=start, span=(problem.tuning.t0, problem.tuning.T))
    assert [written[v][-1] for v in ("x1", "x2")] == pytest.approx([derived[v][-1] for v in ("x1", "x2")], rel=1e-5)


def test_on_a_line_both_sides_are_tried():
    base = example("saturated")
    y = sp.Symbol("y", real=True)
    problem = dataclasses.replace(
        base, field=Field((y,), -(y**2), (0,), 1),
        drift=dataclasses.replace(base.drift, rate=(sp.Integer(0),)),
        initial=dataclasses.replace(base.initial, x=(sp.Integer(1),)),
    )  # fmt: skip
    found = worst_distance(problem, sp.Integer(1))
    assert len(found.curves) == 2
    assert found.worst == pytest.approx(math.exp(-1.4 * 17 / 3), rel=1e-6)


def test_without_a_clip_there_is_nothing_to_compare():
    base = example("saturated")
    problem = dataclasses.replace(base, tuning=dataclasses.replace(base.tuning, nu_min=None))
    assert worst_distance(problem, sp.Integer(1)).worst is None
