"""Clocks that are none cannot be made, however well their formulas undo each other; their right twins can."""

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.statement import le
from ptproof.transforms.clocks import (
    CappedClock,
    Clock,
    clock_from_formula,
    clock_from_rate,
    identity_clock,
    length,
    prescribed_time_clock,
)

t, tau, h = sp.symbols("t tau h", real=True)
T = sp.Symbol("T", positive=True)
below, c = sp.Symbol("n", negative=True), sp.Symbol("c")
wrong_t, whole_t, early_t = sp.Symbol("t"), sp.Symbol("t", integer=True), sp.Symbol("t", negative=True)
r = sp.Function("r", positive=True)

# A right clock (a, inverse, t0, horizon), and after it those with another branch of the inverse, or one thing wrong.
TWINS = {
    "another branch that falls": [
        (T * t / (T - t), T * tau / (T + tau), 0, T),
        (-sp.sqrt(t / (T - t)), T * tau**2 / (1 + tau**2), 0, T),
        (-sp.sqrt(T * t / (T - t)), T * tau**2 / (T + tau**2), 0, T),
        (-sp.sqrt(t), tau**2, 0, sp.oo),
        (-sp.tan(sp.sqrt(t)), sp.atan(tau) ** 2, 0, sp.oo),
        (-sp.sqrt(sp.exp(t) - 1), sp.log(1 + tau**2), 0, sp.oo),
        (-sp.sqrt(-T * sp.log(1 - t / T)), T * (1 - sp.exp(-(tau**2) / T)), 0, T),
        (-sp.log(1 + sp.sqrt(t)), (sp.exp(-tau) - 1) ** 2, 0, sp.oo),
        (-sp.asinh(sp.sqrt(t)), sp.sinh(tau) ** 2, 0, sp.oo),
        (1 - sp.sqrt(1 + 2 * t), ((1 - tau) ** 2 - 1) / 2, 0, sp.oo),
        (-t, -tau, 0, sp.oo),
        (below * t, tau / below, 0, sp.oo),
    ],
    "a rate that vanishes or is infinite": [
        (t + t**2 / 2, sp.sqrt(1 + 2 * tau) - 1, 0, sp.oo),
        (t**2, sp.sqrt(tau), 0, sp.oo),
        (t**3, sp.cbrt(tau), 0, sp.oo),
        (sp.sqrt(t), tau**2, 0, sp.oo),
        ((t - 1) ** 3 + 1, 1 + sp.cbrt(tau - 1), 0, sp.oo),
    ],
    "no value or a jump on the way": [
        (sp.tan(t), sp.atan(tau), 0, sp.pi / 2),
        (sp.tan(t), sp.atan(tau), 0, sp.pi),
        (t / (1 - t), tau / (1 + tau), 0, 2),
        (t / (1 - t), tau / (1 + tau), 0, sp.oo),
        ((t**2 - t) / (t - 1), tau, 0, sp.oo),
        (t * (t - 2) ** 2 / (t - 2) ** 2 + sp.Piecewise((0, t < 1), (1, True)), tau, 0, sp.oo),
        (sp.Piecewise((t, t < 1), (t + 1, True)), sp.Piecewise((tau, tau < 1), (tau - 1, True)), 0, sp.oo),
        (t + sp.floor(t), tau - sp.floor(tau / 2), 0, sp.oo),
        (sp.sqrt(t - 1) - sp.I, (tau + sp.I) ** 2 + 1, 0, sp.oo),
        (-T * sp.log(1 - t / T), T * (1 - sp.exp(-tau / T)), 0, 2 * T),
        (r(t), tau, 0, sp.oo),
    ],
    "a wrong start, horizon or symbol": [
        (t / (1 - t / T), tau / (1 + tau / T), 0, T),
        (t / (1 - t / T), tau / (1 + tau / T), 0, 2 * T),
        (t / (1 - t / T), tau / (1 + tau / T), 0, -T),
        (t / (1 - t / T), tau / (1 + tau / T), 1, T),
        (t / (1 - t / h), tau / (1 + tau / h), 0, h),
        (t, tau, 0, 0),
        (t, tau, 0, sp.I),
        (t, tau, 0, sp.nan),
        (t, tau, 0, t + 1),
        (t, tau, t, sp.oo),
        (t, tau, c, sp.oo),
        (t, tau, sp.oo, sp.oo),
        (t + 1, tau - 1, 0, sp.oo),
        (h * t, tau / h, 0, sp.oo),
        (c * t, tau / c, 0, sp.oo),
        (tau, t, 0, sp.oo),
        (t + tau, tau, 0, sp.oo),
    ],
}


@pytest.mark.parametrize("parts", [clocks[0] for clocks in TWINS.values()], ids=str)
def test_the_right_twin_is_made(parts):
    clock = Clock(t, tau, *parts)
    assert clock.rate.subs(t, 0) == 1


@pytest.mark.parametrize("parts", [parts for clocks in TWINS.values() for parts in clocks[1:]], ids=str)
def test_the_wrong_one_is_refused(parts):
    with pytest.raises(InputError):
        Clock(t, tau, *parts)


@pytest.mark.parametrize("time", [wrong_t, whole_t, early_t], ids=lambda time: str(time.assumptions0.get("real")))
def test_a_time_is_a_plain_real_symbol(time):
    with pytest.raises(InputError, match="must be declared real, and nothing more"):
        Clock(time, tau, time, tau, 0, sp.oo)
    with pytest.raises(InputError, match="must be declared real, and nothing more"):
        Clock(tau, time, tau, time, 0, sp.oo)


def test_an_inverse_that_tends_to_the_end_once_more_later_is_no_prescribed_time(monkeypatch):
    monkeypatch.setattr(length, "SECONDS", 0.5)  # SymPy finds no antiderivative, however long it is left to look
    # On [0, 1) the map rises to 1 only; its inverse is 1 at τ = 1, and tends to 1 again as τ grows.
    formula, inverse = (sp.sqrt(1 + 4 * t * (1 - t)) - 1) / (2 * (1 - t)), 1 - (1 - tau) / (1 + tau**2)
    with pytest.raises(InputError):
        clock_from_formula(t, tau, formula, start=0, horizon=1, inverse=inverse)


@pytest.mark.parametrize(
    ("rate", "horizon"),
    [
        (t**2, sp.oo),
        ((t - 1) ** 2, sp.oo),
        (-1 / (1 - t / T) ** 2, T),
        (1 / (1 - 2 * t / T) ** 2, T),
        (1 / sp.sqrt(1 - t / T), T),
        (1 / sp.sqrt(t), sp.oo),
        (sp.sqrt(t - 1), sp.oo),
        (2 + sp.sign(t - 1), sp.oo),
        (sp.Piecewise((1, t < 1), (2, True)), sp.oo),
        (sp.Piecewise((1, t < 1)), sp.oo),
        (1 / (1 - t / h) ** 2, h),
        (1 / (1 - t) ** 2, -1),
        (sp.I, sp.oo),
        (c, sp.oo),
        (r(t), sp.oo),
        (sp.S(1), 1),
    ],
    ids=str,
)
def test_a_rate_that_makes_no_clock_is_refused(rate, horizon):
    with pytest.raises(InputError):
        clock_from_rate(t, tau, rate, start=0, horizon=horizon)


PAPER, ALWAYS = prescribed_time_clock(t, tau, start=0, horizon=T), identity_clock(t, tau, start=0)


@pytest.mark.parametrize(
    ("clock", "corner"),
    [(PAPER, T), (PAPER, -T / 2), (PAPER, h), (PAPER, T / (1 + t**2)), (PAPER, sp.I * T / 2), (PAPER, sp.nan),
     (PAPER, T / (2 + tau**2)), (ALWAYS, T / (1 + t**2)), (ALWAYS, sp.oo), (ALWAYS, -1)],
    ids=str,
)  # fmt: skip
def test_a_corner_in_the_wrong_place_is_refused(clock, corner):
    assert CappedClock(clock, T / 2).until == T / 2
    with pytest.raises(InputError):
        CappedClock(clock, corner)


def test_what_is_given_of_a_corner_may_not_contradict_itself():
    nu = sp.Symbol("nu", positive=True)
    assert CappedClock(PAPER, T * (1 - nu), (le(nu, 1),)).until == T * (1 - nu)
    with pytest.raises(InputError, match="contradicts itself"):
        CappedClock(PAPER, T * (1 - nu), (le(nu, -1),))
