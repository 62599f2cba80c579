"""Sampled loops: the order in the sample time, held inputs, noise from its seed, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.problem import TIME, example
from ptproof.simulation import Outcome, ensemble, simulate
from ptproof.simulation.question import Question
from ptproof.simulation.sampled import sample_instants

EARLY = {"until": 0.2}


@pytest.mark.parametrize("name", ["vanishing", "saturated"])
def test_the_sampled_loop_tends_to_the_continuous_one_with_order_one(name):
    ideal = simulate(name, seeker=example(name).default_seeker, **EARLY)
    ends = [simulate(name, seeker=example(name).default_seeker, sample_time=h, **EARLY) for h in (4e-5, 2e-5, 1e-5)]
    gaps = [float(np.linalg.norm(run.x[:2, -1] - ideal.x[:2, -1])) for run in ends]
    assert [str(run.outcome) for run in ends] == ["reached the time asked for"] * 3
    orders = np.log2(np.array(gaps[:-1]) / np.array(gaps[1:]))
    assert np.all(abs(orders - 1) < 0.25), gaps


def direction(theta):
    return np.array([np.cos(theta), np.sin(theta)])


def by_hand(sample_time, end, drawn):
    """A sampled loop of its own: the filter in closed form, the vehicle by many small steps of Euler's midpoint."""
    p = example("vanishing")
    k, omega, mu, T = (float(getattr(p.tuning, name)) for name in ("k", "omega", "mu", "T"))
    F = sp.lambdify(p.variables, p.field.expression, "math")
    f = sp.lambdify((TIME, *p.variables), p.drift.rate, "math")
    x, theta, z, t = np.array([-2.0, -2.0]), 0.0, F(-2.0, -2.0), 0.0
    for i in range(round(end / sample_time)):
        y, K = F(*x) + drawn[i], 1 / (1 - t / T) ** 2
        u1, u2, steps = K * omega**0.5, K * (omega - k / mu * (y - z)), 20
        h = sample_time / steps
        for _ in range(steps):
            middle = x + h / 2 * (np.array(f(t, *x)) + u1 * direction(theta))
            x = x + h * (np.array(f(t + h / 2, *middle)) + u1 * direction(theta + h / 2 * u2))
            theta, t = theta + h * u2, t + h
        z = y + (z - y) * np.exp(-K * sample_time / mu)
    return np.array([*x, theta, z])


@pytest.mark.parametrize("noise", [0, 0.05])
def test_it_is_what_a_controller_does_that_measures_and_holds(noise):
    h, end = 1e-4, 0.05
    drawn = noise * np.random.default_rng(np.random.SeedSequence(3)).standard_normal(round(end / h))
    run = simulate("vanishing", until=end, sample_time=h, noise=noise, noise_seed=3)
    assert run.x[:, -1] == pytest.approx(by_hand(h, end, drawn), abs=2e-6)


def test_inputs_are_held_between_samples():
    slow = replace(example("vanishing"), tuning=replace(example("vanishing").tuning, mu=sp.Rational(1, 20)))
    run = simulate(slow, until=0.1, sample_time=5e-3)
    assert len(run.t) == 21
    turned = np.diff(run["theta"]) / np.diff(run.t)
    assert turned == pytest.approx(run["u2"][1:], rel=1e-9)
    assert run["u2"][0] == run["u2"][1]


def test_noise_is_drawn_from_its_seed_and_members_have_their_own():
    same = [simulate("vanishing", noise=0.1, sample_time=1e-4, noise_seed=s, until=0.05).x[:, -1] for s in (1, 1, 2)]
    assert np.array_equal(same[0], same[1])
    assert not np.allclose(same[0], same[2])
    many = [ensemble("vanishing", n, noise=0.1, sample_time=1e-4, until=0.05, vary={"k": (1, 1)}) for n in (2, 4)]
    assert np.array_equal(many[0].x, many[1].x[:, :2])
    assert len(np.unique(many[1].x[0])) == 4


def test_sampling_too_seldom_is_an_outcome():
    run = simulate("vanishing", sample_time=0.01)
    assert run.outcome is Outcome.FAILED
    assert "sample more often" in run.message
    assert np.isfinite(run.x).all()


def test_left_out_the_sample_time_follows_from_the_filter():
    setup = Question("vanishing", noise=0.01).setup()
    assert setup.defaults["sample_time"] == pytest.approx(0.001 * 0.3**2 / 20, rel=1e-3)


def test_instants_end_at_the_end():
    assert sample_instants(0, 1, 0.3).tolist() == pytest.approx([0, 0.3, 0.6, 0.9, 1])
    assert len(sample_instants(0, 1, 0.1)) == 11
    assert sample_instants(0, 1, 5).tolist() == [0, 1]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"noise": -1}, "not negative"),
        ({"noise": "nan"}, "noise"),
        ({"sample_time": 0}, "positive"),
        ({"sample_time": "1/0"}, "sample_time"),
        ({"sample_time": 1e-9}, "samples"),
        ({"noise": 1, "frame": "tau"}, "in t"),
        ({"noise": 1, "model": "average"}, "closed loop"),
        ({"noise": 1, "coordinates": "reduced"}, "full"),
        ({"noise": 1, "engine": "casadi"}, "leave the engine out"),
        ({"noise": 1, "noise_seed": -1}, "noise_seed"),
    ],
)
def test_refused(options, message):
    with pytest.raises(InputError, match=message):
        simulate("vanishing", **options)


def test_a_system_has_no_measurement():
    with pytest.raises(InputError, match="need a problem"):
        simulate(example("vanishing").closed_loop(), initial=[0, 0, 0, 0], span=(0, 1), noise=1)
