"""Every closed-form bound lies above the averaged system, for random data; ``random_sets.py`` runs more of them."""

import dataclasses

import pytest
import random_sets
import sympy as sp

from ptproof.gains import nonvanishing, vanishing


@pytest.mark.parametrize("first", range(0, 30, 10))
def test_the_bounds_hold_along_the_averaged_system(first):
    worst = max(random_sets.violations(seed) for seed in range(first, first + 10))
    assert worst <= 1 + 1e-6


@pytest.mark.parametrize("clock", ["power", "logarithmic", "exponential", "tangent"])
def test_the_bounds_hold_under_every_clock(clock):
    assert max(random_sets.violations(seed, clock) for seed in range(8)) <= 1 + 1e-6


def test_the_gain_of_another_clock_gives_a_bound_that_is_violated(monkeypatch):
    monkeypatch.setitem(random_sets.GAINS, "power", random_sets.GAINS["logarithmic"])
    assert any(random_sets.violations(seed, "power") > 1.01 for seed in range(12))


def corrupt(case, **factors):
    bounds = case.data.bounds
    wrong = {name: getattr(bounds, name) * factor for name, factor in factors.items()}
    data = dataclasses.replace(case.data, bounds=dataclasses.replace(bounds, **wrong))
    return dataclasses.replace(case, data=data)


def test_wrong_constants_give_a_bound_that_is_violated(monkeypatch):
    """The check can fail: with b1 and b2 twice too large some bound is false."""
    make = random_sets.make
    monkeypatch.setattr(random_sets, "make", lambda *asked: corrupt(make(*asked), b1=2, b2=2))
    assert any(random_sets.violations(seed) > 1.01 for seed in range(12))


def test_a_gain_that_is_not_applied_gives_a_bound_that_is_violated(monkeypatch):
    make = random_sets.make

    def stronger(*asked):
        case = make(*asked)
        return dataclasses.replace(case, data=dataclasses.replace(case.data, nu_min=case.data.nu_min / 2))

    distances = random_sets.distances
    monkeypatch.setattr(random_sets, "make", stronger)
    monkeypatch.setattr(
        random_sets,
        "distances",
        lambda case, times: distances(
            dataclasses.replace(case, data=dataclasses.replace(case.data, nu_min=case.data.nu_min * 2)), times
        ),
    )
    assert any(random_sets.violations(seed) > 1.01 for seed in range(12))


@pytest.mark.parametrize("seed", range(12))
def test_the_ultimate_bound_is_not_left_by_the_clipped_seeker(seed):
    """Started inside the ultimate bound's Lyapunov level, the averaged system stays within the bound."""
    import numpy as np
    from scipy.integrate import solve_ivp

    case = next(
        case
        for case in (random_sets.make(s) for s in range(1000 * seed, 1000 * seed + 100))
        if case.data.drift_bound is not None
    )
    data = case.data
    gain = 1 / data.nu_min**2
    bound = float(nonvanishing.ultimate_bound(data.bounds, data.k, data.drift_bound, gain))
    rate = float(data.k * gain / 2)

    def rhs(e, x):
        g = case.gradient(x)
        return case.drift(e, x, g) + rate * g

    inner = float(data.bounds.a2 / data.bounds.a1) ** (1 / (2 * int(data.bounds.kappa))) * bound
    run = solve_ivp(rhs, (0, 20 / rate), case.start / np.linalg.norm(case.start) * inner, rtol=1e-8, atol=1e-12)
    assert np.linalg.norm(run.y, axis=0).max() <= bound * (1 + 1e-6)


@pytest.mark.parametrize("seed", range(15))
def test_the_residual_is_met_at_the_clip_that_is_named_and_not_above_it(seed):
    case = next(
        case
        for case in (random_sets.make(s) for s in range(500 * seed, 500 * seed + 100))
        if case.data.drift_bound is None and case.data.bounds.kappa < 3
    )
    data = case.data
    residual = data.x0_norm / 3

    def end(nu_min, chain):
        return vanishing.distance_bound(dataclasses.replace(data, nu_min=nu_min), data.T, chain)

    for chain in ("printed", "split"):
        nu = vanishing.clip_for_residual(data, chain, residual)
        if nu is None:
            assert end(sp.Rational(1, 1000), chain) is None
            continue
        assert float(end(nu, chain)) <= float(residual) * (1 + 1e-9)
        if float(nu) < 0.95:
            above = end(nu * sp.Rational(101, 100), chain)
            assert above is None or float(above) > float(residual)
