"""The closed loops: one right-hand side in all frames and coordinates, equal to the seekers' own."""

import itertools

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.problem import SEEKERS, TAU, TIME, example, parameters
from ptproof.problem.seekers import asymptotic_seeker, prescribed_time_seeker
from ptproof.proof.algebra import is_zero
from ptproof.transforms import capped, dilate, identity_clock, prescribed_time_clock

P = parameters


def unclipped(name="vanishing"):
    from dataclasses import replace

    problem = example(name)
    return replace(problem, tuning=replace(problem.tuning, nu_min=None))


@pytest.fixture(scope="module")
def clock():
    return prescribed_time_clock(TIME, TAU, start=P.t0, horizon=P.T)


def test_in_t_it_is_the_prescribed_time_seeker(clock):
    problem = example("nonvanishing")
    expected = prescribed_time_seeker(
        problem.field.expression, problem.drift, k=P.k, omega=P.omega, mu=P.mu, clock=clock, minimum=P.nu_min,
        states=problem.states,
    )  # fmt: skip
    assert problem.closed_loop("pt", "t", symbolic=True).rhs == expected.rhs


def test_in_tau_it_is_the_dilated_seeker(clock):
    problem = unclipped("nonvanishing")
    plain = prescribed_time_seeker(problem.field.expression, problem.drift, k=P.k, omega=P.omega, mu=P.mu, clock=clock)
    ours = problem.closed_loop("pt", "tau", symbolic=True)
    point = {TAU: 2, P.t0: sp.Rational(1, 2), P.T: 3, P.k: 2, P.omega: 5, P.mu: sp.Rational(1, 7)}
    point |= dict(zip(ours.state, (sp.Rational(1, 3), -1, 2, sp.Rational(5, 2)), strict=True))
    for left, right in zip(ours.rhs, dilate(plain, clock).rhs, strict=True):
        assert abs((left - right).subs(point).evalf(30)) < 1e-25


def test_the_asymptotic_seeker_has_no_clock():
    problem = example("vanishing")
    expected = asymptotic_seeker(problem.field.expression, problem.drift, k=P.k, omega=P.omega, mu=P.mu, time=TIME)
    assert problem.closed_loop("asymptotic", "t", symbolic=True).rhs == expected.rhs
    dilated = dilate(expected, identity_clock(TIME, TAU, start=P.t0))
    assert all(
        is_zero(a - b)
        for a, b in zip(problem.closed_loop("asymptotic", "tau", symbolic=True).rhs, dilated.rhs, strict=True)
    )


@pytest.mark.parametrize(("seeker", "frame"), list(itertools.product(("pt", "asymptotic"), ("t", "tau"))))
@pytest.mark.parametrize("late", [False, True])
def test_reduced_coordinates_are_the_full_ones_with_the_heading_put_in(seeker, frame, late):
    problem = example("nonvanishing")
    full = problem.closed_loop(seeker, frame)
    reduced = problem.closed_loop(seeker, frame, coordinates="reduced")
    letters = problem.states
    # T = 2 and nu_min = 0.3: the clip is at t = 1.4 and tau = 14/3; after it the rate is 100/9.
    time = sp.Rational(17, 10) if late else sp.Rational(1, 2)
    tau = time
    if seeker == "pt":
        tau = sp.Rational(14, 3) + sp.Rational(3, 10) * sp.Rational(100, 9) if late else sp.Rational(2, 3)
    now = {TIME: time, TAU: tau}
    x1, x2 = problem.variables
    at = {x1: sp.Rational(1, 3), x2: -1, letters.filter: sp.Rational(5, 2)}
    p0 = problem.values[P.p0]
    heading = p0 + 50 * tau - at[letters.filter]
    expected = [full.rhs[i].subs(now).subs(at).subs(letters.heading, heading) for i in (0, 1, 3)]
    for left, right in zip(reduced.rhs, expected, strict=True):
        assert abs((left.subs(now).subs(at) - right).evalf(30)) < 1e-20


def test_the_clipped_clock_continues_the_papers_map(clock):
    clipped = capped(clock, P.nu_min)
    values = {P.t0: 1, P.T: 2, P.nu_min: sp.Rational(3, 10)}
    for t in (1, sp.Rational(3, 2), sp.Rational(12, 5), sp.Rational(5, 2), 3):
        tau = clipped.to_tau.subs(values).subs(TIME, t)
        assert clipped.to_t.subs(values).subs(TAU, tau) == t
        gain = 1 / sp.Max(sp.Rational(3, 10), 1 - sp.Rational(t - 1) / 2) ** 2
        assert clipped.rate_back.subs(values).subs(TAU, tau) == 1 / gain


@pytest.mark.parametrize("seeker", SEEKERS)
def test_no_symbol_is_left_when_values_are_put_in(seeker):
    assert example("saturated").closed_loop(seeker).parameters == ()


def test_problems_that_differ_in_values_share_one_symbolic_system():
    from dataclasses import replace

    one = example("vanishing")
    other = replace(one, tuning=replace(one.tuning, k=3, omega=100), initial=replace(one.initial, x=(1, 1)))
    assert one.closed_loop(symbolic=True).rhs == other.closed_loop(symbolic=True).rhs
    assert one.closed_loop().rhs != other.closed_loop().rhs


def test_a_coordinate_named_like_a_state_keeps_its_name():
    from dataclasses import replace

    problem = example("saturated")
    theta, z = sp.symbols("theta z", real=True)
    renamed = replace(problem, field=replace(problem.field, variables=(theta, z), expression=-(theta**2) - z**2))
    assert [symbol.name for symbol in renamed.closed_loop().state] == ["theta", "z", "theta_", "z_"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"seeker": "ptt"}, "seeker: 'ptt'"),
        ({"frame": "s"}, "frame: 's'"),
        ({"coordinates": "polar"}, "coordinates: 'polar'"),
        ({"seeker": "saturated"}, r"\[saturation\]"),
    ],
)
def test_words_that_are_none_are_refused(arguments, message):
    with pytest.raises(InputError, match=message):
        example("vanishing").closed_loop(**arguments)


def test_a_saturated_seeker_has_no_reduced_coordinates():
    with pytest.raises(InputError, match="reduced"):
        example("saturated").closed_loop("saturated", coordinates="reduced")
