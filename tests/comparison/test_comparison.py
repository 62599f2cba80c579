"""Closed-form bounds from scalar differential inequalities, against numerical integration and corrupted twins."""

import random

import pytest
import sympy as sp
from scipy.integrate import solve_ivp

from ptproof.comparison import (
    DampedBound,
    DilatedBound,
    LinearBound,
    PowerBound,
    fading_input,
    power_bound,
)
from ptproof.errors import InputError

tau = sp.Symbol("tau", real=True)
t0 = sp.Symbol("t0", real=True)
V0, T, g, h, k, e, c1, c2, sigma = sp.symbols("V0 T g h k e c1 c2 sigma", positive=True)
kappa = sp.Symbol("kappa", integer=True, positive=True)


def integrate(rate, start, initial, end, events=None):
    result = solve_ivp(rate, (start, end), [initial], method="LSODA", rtol=1e-10, atol=1e-14, events=events)
    assert result.success
    return result


@pytest.mark.parametrize("power", [sp.Integer(1), sp.Rational(1, 2), sp.Rational(3, 2), sp.Integer(3), 1 + sigma])
def test_a_bound_is_made_for_every_power(power):
    bound = power_bound(time=tau, rate=-k * c1**2 / 2, power=power, initial=V0, start=t0)
    assert bound.bound.subs(tau, t0).subs(t0, 0) == V0


def test_the_power_of_the_paper_is_accepted_with_a_symbol_for_the_order():
    bound = power_bound(time=tau, rate=-k, power=2 - 1 / kappa, initial=V0, start=t0)
    assert sp.cancel(bound.sigma - (1 - 1 / kappa)) == 0


@pytest.mark.parametrize("seed", range(12))
def test_power_bounds_agree_with_integration(seed):
    rng = random.Random(seed)
    p = rng.choice([sp.Integer(1), sp.Rational(3, 2), sp.Integer(2), sp.Rational(5, 3), sp.Rational(1, 2)])
    a, b, start, initial = (sp.Rational(rng.randint(1, 30), 10) for _ in range(4))
    rate = a * sp.cos(tau) - b - a
    bound = power_bound(time=tau, rate=rate, power=p, initial=initial, start=start)
    end = start + sp.Rational(1, 4)
    exact = integrate(
        sp.lambdify((tau, sp.Symbol("u")), rate * sp.Symbol("u") ** p), float(start), float(initial), float(end)
    )
    assert float(bound.denominator.subs(tau, end)) > 0
    assert float(bound.bound.subs(tau, end)) == pytest.approx(exact.y[0, -1], rel=1e-7)


@pytest.mark.parametrize(
    ("integral", "message"),
    [(-2 * tau, "starts at zero"), (-3 * (tau - t0), "derivative is the rate"), ((tau - t0) ** 2, "derivative")],
)
def test_a_wrong_integral_is_refused(integral, message):
    with pytest.raises(InputError, match=message):
        PowerBound(tau, t0, V0, sp.Integer(-2), sp.Integer(2), integral)


def test_a_rate_without_known_antiderivative_is_refused():
    with pytest.raises(InputError, match="give the integral"):
        power_bound(time=tau, rate=sp.Function("alpha")(tau), power=sp.Integer(1), initial=V0)


def test_a_negative_initial_value_is_refused():
    with pytest.raises(InputError, match="not positive"):
        power_bound(time=tau, rate=sp.Integer(-1), power=sp.Integer(1), initial=sp.Integer(-1))


@pytest.mark.parametrize("exponent", [sp.Integer(0), sp.Rational(1, 2), sp.Rational(2, 3), sigma])
def test_dilated_bound_in_letters(exponent):
    bound = DilatedBound(tau, t0, V0, T, c2**2 * e, k * c1**2 / 2, exponent)
    assert bound.bound.subs(tau, t0).subs(t0, 0).simplify() == V0


def test_the_paper_s_quadratic_is_the_denominator():
    bound = DilatedBound(tau, t0, V0, T, c2**2 * e, k * c1**2 / 2, sigma)
    w = sigma * V0**sigma
    gamma2 = w * k * c1**2 / 2
    gamma1 = 1 - w * (c2**2 * e * T - k * c1**2 / 2 * (T - 2 * t0))
    gamma0 = w * t0 * (c2**2 * e * T + k * c1**2 / 2 * (t0 - T)) - t0 + T
    ours = bound.quadratic.subs(sp.Symbol("s", nonnegative=True), tau - t0)
    assert sp.expand(ours - (gamma2 * tau**2 + gamma1 * tau + gamma0)) == 0


def dilated(rng, factor):
    """A random dilated bound with g > h whose initial value is ``factor`` times the critical one."""
    exponent = rng.choice([sp.Rational(1, 2), sp.Rational(2, 3), sp.Rational(3, 4)])
    decay = sp.Rational(rng.randint(1, 20), 10)
    growth = decay * (1 + sp.Rational(rng.randint(1, 30), 10))
    horizon = sp.Rational(rng.randint(1, 30), 10)
    bound = DilatedBound(tau, 0, 1, horizon, growth, decay, exponent)
    critical = bound.critical_initial_at(bound.turning_elapsed).evalf(30)
    critical = sp.Rational(sp.nsimplify(critical, rational=True))
    return DilatedBound(tau, 0, critical * factor, horizon, growth, decay, exponent)


@pytest.mark.parametrize("seed", range(12))
def test_above_the_critical_value_the_bound_escapes_at_the_stated_time(seed):
    bound = dilated(random.Random(seed), sp.Rational(12, 10))
    assert bound.excess.evalf() > 0
    escape = float(bound.escape_elapsed.evalf())
    rate = sp.lambdify((tau, sp.Symbol("u")), bound.result.rate * sp.Symbol("u") ** (1 + bound.sigma))

    def large(t, u):
        return u[0] - 1e8 * float(bound.initial)

    large.terminal = True
    run = integrate(rate, 0.0, float(bound.initial), 1.01 * escape, events=large)
    assert run.t[-1] < escape
    # What is left of u after u = L is L^(-σ)/(σ·rate), so the event comes shortly before the escape.
    left = (1e8 * float(bound.initial)) ** -float(bound.sigma) / float(bound.sigma)
    slope = float(bound.result.rate.subs(tau, sp.Float(escape)))
    assert run.t[-1] == pytest.approx(escape - left / slope, rel=1e-3)


@pytest.mark.parametrize("seed", range(12))
def test_below_the_critical_value_the_bound_stays_finite(seed):
    bound = dilated(random.Random(seed), sp.Rational(9, 10))
    assert bound.excess.evalf() < 0
    assert bound.discriminant.evalf() < 0
    top = float(bound.result.bound.subs(tau, bound.turning_elapsed))
    rate = sp.lambdify((tau, sp.Symbol("u")), bound.result.rate * sp.Symbol("u") ** (1 + bound.sigma))
    run = integrate(rate, 0.0, float(bound.initial), 5 * float(bound.turning_elapsed) + 1)
    assert run.y.max() <= top * (1 + 1e-6)
    assert run.y.max() == pytest.approx(top, rel=2e-2)


def test_the_value_that_is_critical_at_a_time_makes_the_denominator_vanish_there():
    bound = DilatedBound(tau, 0, 1, 2, sp.Integer(3), sp.Rational(1, 2), sp.Rational(1, 2))
    at = sp.Rational(3, 4)
    critical = bound.critical_initial_at(at)
    twin = DilatedBound(tau, 0, critical, 2, sp.Integer(3), sp.Rational(1, 2), sp.Rational(1, 2))
    assert sp.simplify(twin.result.denominator.subs(tau, at)) == 0
    smallest = (bound.sigma * bound.largest_integral) ** (-1 / bound.sigma)
    assert sp.simplify(bound.critical_initial_at(bound.turning_elapsed) - smallest) == 0


@pytest.mark.parametrize("field", ["horizon", "decay", "initial", "growth", "sigma"])
def test_data_of_the_wrong_sign_are_refused(field):
    data = {"initial": 1, "horizon": 1, "growth": 1, "decay": 1, "sigma": 0} | {field: -1}
    with pytest.raises(InputError, match=field):
        DilatedBound(tau, sp.Integer(0), **{name: sp.Integer(value) for name, value in data.items()})


@pytest.mark.parametrize("r", [1, 3, 5, 7])
def test_a_damped_bound_lies_above_the_solution(r):
    rng = random.Random(r)
    for _ in range(6):
        u0, damping, zeta = (sp.Rational(rng.randint(1, 40), 10) for _ in range(3))
        bound = DampedBound(tau, 0, u0, damping, r, zeta)
        run = integrate(lambda t, u, d=float(damping), z=float(zeta): -d * u**r + z, 0.0, float(u0), 5.0)
        values = sp.lambdify(tau, bound.bound)(run.t)
        assert (values >= run.y[0] * (1 - 1e-8)).all()


def test_a_damped_bound_with_a_symbol_for_the_order():
    bound = DampedBound(tau, t0, V0, h, 2 * kappa - 1, g)
    assert bound.rest == (g / h) ** (1 / (2 * kappa - 1))


def test_without_superadditivity_the_damped_bound_is_refused():
    with pytest.raises(InputError, match="≥ 1"):
        DampedBound(tau, 0, 1, 1, sp.Rational(1, 2), 1)


@pytest.mark.parametrize("seed", range(8))
def test_the_bound_for_a_fading_input_is_the_solution(seed):
    rng = random.Random(seed)
    u0, damping, horizon, zeta = (sp.Rational(rng.randint(1, 30), 10) for _ in range(4))
    bound = fading_input(time=tau, start=0, initial=u0, damping=damping, horizon=horizon, input=zeta)
    d, z, T_ = float(damping), float(zeta), float(horizon)
    run = integrate(lambda t, u: -d * u + z / (1 + t / T_) ** 2, 0.0, float(u0), 3.0)
    assert float(bound.bound.subs(tau, 3)) == pytest.approx(run.y[0, -1], rel=1e-6)


def test_a_corrupted_convolution_is_refused():
    good = fading_input(time=tau, start=t0, initial=V0, damping=h, horizon=T, input=g)
    for wrong in (good.convolution * 2, good.convolution + 1, good.convolution.subs(T, 2 * T)):
        with pytest.raises(InputError):
            LinearBound(tau, t0, V0, h, good.input, wrong)


def test_the_first_escape_is_the_smaller_root():
    bound = DilatedBound(tau, 0, 4, 1, 4, 1, sp.Rational(1, 2))
    s = sp.Symbol("s", nonnegative=True)
    roots = sorted(float(root) for root in sp.Poly(bound.quadratic, s).nroots())
    assert float(bound.escape_elapsed) == pytest.approx(roots[0])
    assert roots[0] > 0


@pytest.mark.parametrize(
    ("rate", "integral"),
    [
        (1 / (tau - 2), None),
        (1 / (tau - 2) ** 2, None),
        (sp.tan(tau) ** 2 + 1, sp.tan(tau)),
        (sp.S.One, tau + sp.Piecewise((0, tau < 2), (-5, True))),
        (sp.S.One, tau - 5 * sp.Heaviside(tau - 2)),
    ],
)
def test_a_rate_with_a_pole_and_an_integral_that_jumps_bound_nothing(rate, integral):
    with pytest.raises(InputError, match="jump, kink or pole"):
        power_bound(time=tau, rate=rate, power=sp.S.One, initial=sp.Integer(3), integral=integral)


def test_a_convolution_that_jumps_bounds_nothing():
    forced = 1 - sp.exp(-tau)
    assert LinearBound(tau, 0, 1, 1, 1, forced).bound == 1
    with pytest.raises(InputError, match="jump, kink or pole"):
        LinearBound(tau, 0, 1, 1, 1, forced - sp.Piecewise((0, tau < 2), (5 * sp.exp(-tau), True)))
