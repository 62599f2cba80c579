"""Every clock with every seeker: the right gain, and one trajectory in both times."""

from dataclasses import replace

import numpy as np
import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.problem import SEEKERS, TAU, TIME, example, load
from ptproof.problem.model import Tuning
from ptproof.proof.signs import vanishes
from ptproof.simulation import simulate
from ptproof.transforms import CLOCKS

HALF, TENTH = sp.Rational(1, 2), sp.Rational(1, 10)
# K at ν = 1/2, and from ν = 1/10 on, by hand; the power clock's exponent is 2.
GAINS = {
    "paper": (4, 100),
    "power": (8, 1000),
    "logarithmic": (2, 10),
    "exponential": (4 * sp.E, 100 * sp.exp(9)),
    "tangent": (2, 1 / sp.sin(sp.pi / 20) ** 2),
}
TEXT = """
[field]
variables = ["x1", "x2"]
expression = "-x1**2 - x2**2"
source = [0, 0]
kappa = 1
[drift]
kind = "none"
[seeker]
k = 1
omega = 30
mu = "0.001"
T = 1
nu_min = "0.1"
clock = "{clock}"
{exponent}
[initial]
x = [1, 1]
"""


def with_clock(name, clock, **changes):
    problem = example(name)
    exponent = sp.Integer(2) if clock == "power" else None
    return replace(problem, tuning=replace(problem.tuning, clock=clock, exponent=exponent, **changes))


def test_the_list_of_clocks_is_complete():
    assert set(GAINS) == set(CLOCKS)


@pytest.mark.parametrize("clock", CLOCKS)
def test_the_gain_is_the_clocks_rate_and_its_cap_is_the_rate_at_nu_min(clock, tmp_path):
    path = tmp_path / "problem.toml"
    path.write_text(TEXT.format(clock=clock, exponent="exponent = 2" if clock == "power" else ""))
    problem = load(path)
    before, cap = GAINS[clock]
    for found in (problem.clock, problem.seeker_clock("pt")):
        rate = found.rate.subs(dict(problem.values))
        for instant, value in ((HALF, before), (1 - TENTH, cap), (1, cap), (sp.Integer(50), cap)):
            assert abs(sp.N(rate.subs(TIME, instant) / value - 1, 30)) < 1e-20
    loop = problem.closed_loop("pt", "t")
    heading = loop.state[2]
    speed = loop.rhs[0].subs({heading: 0, TIME: HALF})
    assert vanishes(sp.nsimplify(speed) - before * sp.sqrt(30))


# In reduced coordinates the map is part of the right-hand side, beside its rate.
@pytest.mark.parametrize(
    ("clock", "coordinates"), [*((clock, "reduced") for clock in CLOCKS), ("paper", "full"), ("tangent", "full")]
)
def test_a_run_in_t_and_a_run_in_tau_are_one_trajectory(clock, coordinates):
    problem = with_clock("vanishing", clock)
    ends = [simulate(problem, frame=frame, coordinates=coordinates, samples=20) for frame in ("t", "tau")]
    assert all(str(run.outcome) == "reached T" for run in ends)
    assert [run.t[-1] for run in ends] == pytest.approx([1, 1], abs=1e-9)
    assert ends[0].tau[-1] == pytest.approx(ends[1].tau[-1], rel=1e-9)
    assert np.max(np.abs(ends[0].x[:2, -1] - ends[1].x[:2, -1])) < 2e-6


@pytest.mark.parametrize(
    ("clock", "model"),
    [*((clock, "average") for clock in CLOCKS), ("paper", "reduced model"), ("power", "reduced model")],
)
def test_so_are_runs_of_the_reduced_model_and_of_the_average(clock, model):
    problem = with_clock("nonvanishing", clock)
    ends = [simulate(problem, frame=frame, model=model, samples=20).x[:, -1] for frame in ("t", "tau")]
    assert np.max(np.abs(ends[0] - ends[1])) < 2e-6


@pytest.mark.parametrize(
    ("clock", "seeker"),
    [("power", "saturated"), ("exponential", "saturated-constant"), ("exponential", "asymptotic")],
)
def test_the_other_seekers_too(clock, seeker):
    problem = with_clock("saturated", clock)
    ends = [simulate(problem, seeker, frame=frame, samples=20) for frame in ("t", "tau")]
    assert all(str(run.outcome) == "reached T" for run in ends)
    assert np.max(np.abs(ends[0].x[:2, -1] - ends[1].x[:2, -1])) < 1e-4
    assert set(ends[0].inputs) == ({"u1", "u2"} if seeker == "asymptotic" else {"u1", "a"})


@pytest.mark.parametrize("clock", CLOCKS)
def test_a_gain_that_is_never_clipped_is_followed_as_far_as_its_size_allows(clock):
    problem = with_clock("vanishing", clock, nu_min=None)
    run = simulate(problem, model="average", frame="tau", samples=10)
    rate = problem.clock.rate.subs(TIME, float(run.t[-1]))
    assert float(rate) <= 1.001e8
    assert "infinite at T" in run.message
    assert 0.9 < run.t[-1] < 1


def test_a_clip_at_one_is_a_constant_gain_from_the_start():
    problem = with_clock("vanishing", "power", nu_min=sp.S.One)
    assert problem.clock.rate.subs(TIME, HALF) == 1
    ends = [simulate(problem, seeker, samples=10).x[:2, -1] for seeker in ("pt", "asymptotic")]
    assert np.max(np.abs(ends[0] - ends[1])) < 1e-6


def test_tau_runs_at_the_rate_of_a_constant_gain():
    problem = example("saturated")
    clock = problem.seeker_clock("saturated-constant")
    assert clock.rate.subs(dict(problem.values)) == sp.Rational(1111, 100)
    assert clock.to_t.subs(dict(problem.values)).subs(TAU, sp.Rational(1111, 100)) == 1


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"clock": "powr"}, r"seeker\.clock: 'powr' is not one of paper, power"),
        ({"clock": "power"}, r"seeker\.exponent: the clock 'power' needs one"),
        ({"exponent": 2}, r"seeker\.exponent: the clock 'paper' takes none"),
        ({"clock": "power", "exponent": -1}, r"seeker\.exponent: must be positive"),
    ],
)
def test_clocks_that_are_none_are_refused(changes, message):
    with pytest.raises(InputError, match=message):
        Tuning(k=1, omega=1, mu=1, T=1, **changes)


def test_a_problem_is_meant_for_the_seeker_whose_tables_it_has():
    assert [example(name).default_seeker for name in ("vanishing", "saturated")] == ["pt", "saturated"]
    assert replace(example("saturated"), name="mine").default_seeker == "saturated"
    assert list(SEEKERS)[:2] == ["pt", "asymptotic"]


def test_a_late_start_and_a_short_time_overflow_nothing():
    problem = with_clock("saturated", "exponential", t0=sp.Integer(100), T=TENTH)
    ends = [simulate(problem, frame=frame, samples=10) for frame in ("t", "tau")]
    assert all(str(run.outcome) == "reached T" for run in ends)
    assert np.max(np.abs(ends[0].x[:2, -1] - ends[1].x[:2, -1])) < 1e-6
