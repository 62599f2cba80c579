"""The explicit method within CasADi: its coefficients, the error that is asked for, and what it leaves to CVODES."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import DOP853

from ptproof.simulation import simulate
from ptproof.simulation.question import Question
from ptproof.simulation.run import prepared
from ptproof.simulation.runge_kutta import FIFTH, STAGES, STEP, THIRD, through, trials
from ptproof.simulation.settings import Budget, Settings
from ptproof.system import System

t, x, y = sp.symbols("t x y", real=True)


def job(system, initial, span, **settings):
    return prepared(Question(system, initial=initial, span=span), Settings(**settings))


def followed(made, count=1, plan=None):
    """The states (n × count), or None where they are left to another method."""
    found = through(plan or made.plan, made.batch, [count], Budget(made.plan.settings))
    return found[0] if found else None


@pytest.mark.parametrize(
    ("ours", "theirs"), [*zip(STAGES, DOP853.A, strict=True), (STEP, DOP853.B), (FIFTH, DOP853.E5), (THIRD, DOP853.E3)]
)
def test_the_coefficients_are_those_of_scipy(ours, theirs):
    assert [ours.get(j, 0.0) for j in range(len(theirs))] == pytest.approx(list(theirs), rel=1e-15, abs=1e-17)


@pytest.mark.parametrize("rtol", [1e-3, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize("count", [1, 7])
def test_the_error_is_below_the_one_asked_for(rtol, count):
    states = followed(job(System(t, (x, y), (y, -x)), [1, 0], (0, 10), rtol=rtol, atol=rtol), count)
    times = np.linspace(0, 10, count + 1)[1:]
    np.testing.assert_allclose(states, [np.cos(times), -np.sin(times)], atol=rtol + 1e-13)


def test_a_looser_tolerance_is_not_as_exact():
    tight, loose = (followed(job(System(t, (x, y), (y, -x)), [1, 0], (0, 10), rtol=r, atol=r)) for r in (1e-12, 1e-3))
    assert abs(loose - tight).max() > 1e-9


def test_the_time_in_the_rates_is_that_of_the_system():
    states = followed(job(System(t, (x,), (2 * t,)), [9.0], (3, 5), rtol=1e-10), 4)
    np.testing.assert_allclose(states[0], np.linspace(3, 5, 5)[1:] ** 2, rtol=1e-12)


KINK = sp.Piecewise((1, t < sp.Rational(1, 2)), (-1, True))


@pytest.mark.parametrize(
    ("rate", "span", "why"),
    [
        (sp.Abs(x), (0, 1), "a kink in the state"),
        (sp.sign(sp.sin(40 * t)), (0, 1), "a dither that jumps"),
        (KINK, (0, 1), "a jump at an instant that is not said"),
        (x**2, (0, 2), "an escape in finite time"),
        (1e5 * (sp.cos(t) - x), (0, 1), "a stiff rate"),
        (sp.log(1 - t) + x, (0, 2), "rates that are no numbers"),
    ],
)
def test_what_does_not_suit_it_is_left_to_others(rate, span, why):
    assert followed(job(System(t, (x,), (rate,)), [1.0], span, rtol=1e-8)) is None, why


def test_the_same_without_the_trouble_is_taken():
    for rate, span in ((x, (0, 1)), (sp.sin(40 * t), (0, 1)), (x**2, (0, 0.9)), (10 * (sp.cos(t) - x), (0, 1))):
        assert followed(job(System(t, (x,), (rate,)), [1.0], span, rtol=1e-8)) is not None


def test_many_samples_are_no_reason_to_leave_it_to_others():
    states = followed(job(System(t, (x, y), (y, -x)), [1, 0], (0, 10), rtol=1e-8), 5000)
    np.testing.assert_allclose(states[0], np.cos(np.linspace(0, 10, 5001)[1:]), atol=1e-8)


def test_who_leaves_the_ball_is_not_through():
    made = job(System(t, (x,), (x,)), [1.0], (0, 2), rtol=1e-8)
    assert followed(made) is not None
    assert followed(made, plan=replace(made.plan, radius=7.0)) is None


def test_a_stop_at_a_limit_is_still_named():
    run = simulate(System(t, (x,), (sp.cos(t),)), initial=[0], span=(0, 3), engine="casadi", max_steps=3, samples=2)
    assert run.limit == "max_steps"


def test_where_one_piece_is_too_long_the_ones_before_are_kept():
    made = prepared(Question("vanishing", frame="tau", coordinates="reduced"), Settings(rtol=3e-6, samples=1))
    found = through(made.plan, made.batch, [1, 1], Budget(made.plan.settings))
    run = simulate("vanishing", frame="tau", coordinates="reduced", rtol=3e-6, samples=1, engine="casadi")
    assert len(found) == 1
    np.testing.assert_array_equal(run.x[:, 1], found[0][:, 0])
    assert run.outcome == "reached T"


def test_other_values_build_nothing():
    simulate("vanishing", model="average", engine="casadi")
    before = trials.cache_info().misses
    simulate("vanishing", model="average", engine="casadi", rtol=1e-5, parameters={"k": 2, "T": 3}, samples=7)
    assert before
    assert trials.cache_info().misses == before


def test_who_is_not_stiff_is_followed_however_many_steps_it_takes():
    states = followed(job(System(t, (x, y), (y, -x)), [1, 0], (0, 2000), rtol=1e-8), 5)
    np.testing.assert_allclose(states[0], np.cos(np.linspace(0, 2000, 6)[1:]), atol=1e-6)


def test_what_turns_stiff_on_the_way_is_kept_as_far_as_it_is_not():
    made = job(System(t, (x,), (1e5 * t**8 * (sp.cos(t) - x),)), [1.0], (0, 4), rtol=1e-8)
    states = followed(made, 40)
    assert 0 < states.shape[1] < 40
    run = simulate(made.plan.system, initial=[1], span=(0, 4), samples=40, rtol=1e-8, engine="casadi")
    assert run.outcome == "reached T"
    np.testing.assert_allclose(run.x[0, 1 : states.shape[1] + 1], states[0], rtol=1e-12)
    reference = simulate(made.plan.system, initial=[1], span=(0, 4), samples=40, rtol=1e-10, engine="radau")
    np.testing.assert_allclose(run.x, reference.x, atol=1e-7)


def test_an_escape_is_followed_to_the_last_sample_before_it():
    made = job(System(t, (x,), (x**2,)), [1.0], (0, 2), rtol=1e-8)
    states = followed(made, 10)
    np.testing.assert_allclose(states[0], 1 / (1 - np.array([0.2, 0.4, 0.6, 0.8])), rtol=1e-6)
    run = simulate(made.plan.system, initial=[1], span=(0, 2), samples=10, rtol=1e-8, engine="casadi")
    assert run.outcome == "escaped"
    assert run.t[-1] == pytest.approx(1, abs=1e-5)


def test_no_more_trials_are_made_than_steps_are_allowed():
    made = job(System(t, (x, y), (y, -x)), [1, 0], (0, 2000), rtol=1e-8, max_steps=200)
    assert followed(made) is None
