"""A source that moves: the loop in moving coordinates is the loop that stands still, and what is refused."""

import numpy as np
import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.problem import TIME, example
from ptproof.problem.model import GAIN
from ptproof.problem.moving import moving_source
from ptproof.simulation import simulate
from ptproof.system import System

MOTION = ("t/2", "sin(3*t)")


def standing(problem, motion):
    """The closed loop of F(x − d(t)), made from the seeker's law, where a drift E∇F moves along and another does not."""
    shift = {x: x - sp.sympify(d).subs(sp.Symbol("t"), TIME) for x, d in zip(problem.variables, motion, strict=True)}
    field, drift = problem.field.expression.subs(shift, simultaneous=True), problem.drift.rate
    if problem.drift.kind == "gradient":
        drift = tuple(f.subs(shift, simultaneous=True) for f in drift)
    loop = problem.seeker("pt").law(field, drift, GAIN, problem.states)
    rates = (rate.subs(GAIN, problem.clock.rate).subs(dict(problem.values)) for rate in loop.rhs)
    return System(TIME, loop.state, tuple(rates))


@pytest.mark.parametrize("name", ["vanishing", "nonvanishing"])
def test_a_run_is_the_same_as_with_the_moving_field_written_out(name):
    problem, until = example(name), 0.3
    run = simulate(problem, motion=MOTION, until=until, rtol=1e-9)
    loop = standing(problem, MOTION)
    start = [*problem.initial.x, 0, problem.measured]
    other = simulate(loop, initial=start, span=(0, until), parameters={}, rtol=1e-9)
    assert run.x[:, -1] == pytest.approx(other.x[:, -1], abs=1e-6)
    source = np.array([until / 2, np.sin(3 * until)])
    assert run.source[:, -1] == pytest.approx(source)
    assert run.final_distance == pytest.approx(float(np.linalg.norm(run.x[:2, -1] - source)))
    assert run.x[:2, 0] == pytest.approx([float(v) for v in problem.initial.x])


def test_the_drift_has_the_velocity_subtracted_and_its_bound_grows_by_the_speed():
    moved = moving_source(example("nonvanishing"), ("3*t", "4*t"))
    assert sp.simplify(moved.drift.bound - example("nonvanishing").drift.bound) == 5
    assert moved.drift.rate[0] == sp.cos(moved.variables[0] + 3 * TIME) * (sp.sin(3 * TIME) + 1) - 3


def test_a_source_that_rests_elsewhere_is_only_a_shift():
    moved = simulate("vanishing", motion=(1, -2), initial={"x1": -1, "x2": -4}, until=0.2)
    still = simulate("vanishing", until=0.2)
    assert moved.x[:2, -1] - [1, -2] == pytest.approx(still.x[:2, -1], abs=1e-7)


@pytest.mark.parametrize(
    ("motion", "message"),
    [
        (("t",), "1 entries for 2"),
        ("t", "1 entries for 2"),
        (("t", "x1"), "motion\\[1\\]"),
        (("t", "abs(t - 1/2)"), "velocity"),
        (("t", sp.Symbol("q")), "t alone"),
        (("t", "nan"), "finite"),
    ],
)
def test_refused(motion, message):
    with pytest.raises(InputError, match=message):
        moving_source(example("vanishing"), motion)
