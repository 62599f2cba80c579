"""Clocks: every map undoes itself, does to systems and solutions what it should, and can't be made wrong."""

from functools import cache

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.engines.limits import limit_of
from ptproof.proof.signs import vanishes
from ptproof.system import System
from ptproof.transforms.clocks import (
    CappedClock,
    Clock,
    capped,
    clock_from_formula,
    clock_from_rate,
    dilated_length,
    exponential_clock,
    growing_clock,
    identity_clock,
    logarithmic_clock,
    named_clock,
    power_clock,
    prescribed_time_clock,
    tangent_clock,
)
from ptproof.transforms.clocks.algebra import is_positive, limit_at_infinity, settle
from ptproof.transforms.solutions import bring_solution, carry_solution, solves
from ptproof.transforms.time import contract, dilate

t, tau, t0, x = sp.symbols("t tau t0 x", real=True)
T, m, g, k, w = sp.symbols("T m g k w", positive=True)
f = sp.Function("f", real=True)
HERE = {"start": t0, "horizon": T}
s, e = t - t0, tau - t0
nu = 1 - s / T
half = sp.Rational(1, 2)

MAKERS = {
    "prescribed time": lambda: prescribed_time_clock(t, tau, **HERE),
    "identity": lambda: identity_clock(t, tau, start=t0),
    "power m": lambda: power_clock(t, tau, order=m, **HERE),
    "power 2": lambda: power_clock(t, tau, order=2, **HERE),
    "power 1/2": lambda: power_clock(t, tau, order=half, **HERE),
    "logarithmic": lambda: logarithmic_clock(t, tau, **HERE),
    "exponential": lambda: exponential_clock(t, tau, **HERE),
    "tangent": lambda: tangent_clock(t, tau, **HERE),
    "growing": lambda: growing_clock(t, tau, start=t0, growth=g),
}
RATES = {
    "prescribed time": nu**-2,
    "identity": sp.S.One,
    "power m": nu ** (-m - 1),
    "power 2": nu**-3,
    "power 1/2": nu ** sp.Rational(-3, 2),
    "logarithmic": 1 / nu,
    "exponential": nu**-2 * sp.exp(s / (T - s)),
    "tangent": 1 + sp.tan(sp.pi * s / (2 * T)) ** 2,
    "growing": sp.exp(g * s),
}
# A power with the order m and one with a fraction hold what a whole order has.
EACH = [name for name in MAKERS if name != "power 2"]
clocks = pytest.mark.parametrize("name", EACH)
finite = pytest.mark.parametrize("name", [name for name in EACH if name not in ("identity", "growing")])


@cache
def made(name):
    return MAKERS[name]()


@clocks
def test_contract_undoes_dilate(name):
    clock = made(name)
    system = System(t, (x,), (f(t, x) + k * x**2 * sp.cos(t),))
    again = contract(dilate(system, clock), clock)
    assert again.time == t
    assert vanishes(clock.on_interval(again.rhs[0] - system.rhs[0]))


@clocks
def test_dilate_divides_by_the_rate(name):
    clock = made(name)
    (dilated,) = dilate(System(t, (x,), (k * x * RATES[name],)), clock).rhs
    assert vanishes(settle(dilated.subs(tau, t0 + sp.Symbol("e", positive=True)) - k * x))


@clocks
def test_a_solution_in_tau_becomes_a_solution_in_t_and_back(name):
    clock = made(name)
    system = System(tau, (x,), (-k * x,))
    solution = {x: sp.exp(-k * e)}
    assert solves(system, solution)
    carried = carry_solution(solution, clock)
    assert solves(contract(system, clock), carried, clock)
    assert not solves(contract(system, clock), {x: carried[x] ** 2}, clock)
    values = {t0: 1, T: 2, m: 3, g: half, k: half, tau: sp.Rational(5, 3)}
    back = bring_solution(carried, clock)[x]
    assert abs((back - solution[x]).subs(values).evalf(30)) < 1e-25


def test_under_the_logarithmic_map_an_exponential_becomes_a_power():
    carried = carry_solution({x: sp.exp(-k * e)}, made("logarithmic"))[x]
    assert vanishes(made("logarithmic").on_interval(carried - nu ** (k * T)))


@finite
def test_the_end_of_the_interval_is_infinitely_late(name):
    clock = made(name)
    back, forth = limit_at_infinity(clock.to_t, tau), limit_of(clock.to_tau, t, t0 + T, "-")
    assert forth is sp.oo if back is None else vanishes(back - t0 - T)


@clocks
def test_a_clock_shows_itself_as_a_formula(name):
    text = made(name)._repr_latex_()
    assert text.startswith("$\\displaystyle \\begin{aligned}\\tau &=")
    assert r"\frac{\mathrm{d} \tau}{\mathrm{d} t} &=" in text


def test_the_power_map_of_order_one_is_the_papers():
    one = power_clock(t, tau, order=1, **HERE)
    assert vanishes(one.to_tau - made("prescribed time").to_tau)


def twin(name, **changes):
    def make():
        parts = {part: getattr(made(name), part) for part in ("to_tau", "to_t", "start", "horizon")}
        return Clock(t, tau, **{**parts, **changes})

    return make


@pytest.mark.parametrize(
    "make",
    [
        twin("prescribed time", to_t=t0 + e / (1 + 2 * e / T)),
        twin("prescribed time", to_t=t0 + e / (1 - e / T)),
        twin("prescribed time", to_tau=t0 + s / (1 - 2 * s / T), to_t=t0 + e / (1 + 2 * e / T)),
        twin("power m", to_t=t0 + T * (1 - (1 + e / T) ** (-1 / m))),
        twin("power 2", to_t=t0 + T * (1 + (1 + 2 * e / T) ** -half)),
        twin("logarithmic", to_t=t0 + T * (1 - sp.exp(-2 * e / T))),
        twin("logarithmic", to_t=t0 + T * (1 - sp.exp(e / T))),
        twin("exponential", to_t=t0 + T * sp.log(1 + e / T)),
        twin("tangent", to_t=t0 + 4 * T / sp.pi * sp.atan(sp.pi * e / (2 * T))),
        twin("tangent", to_t=t0 + T + 2 * T / sp.pi * sp.atan(sp.pi * e / (2 * T))),
        twin("tangent", to_tau=t0 + T / sp.pi * sp.tan(sp.pi * s / T), to_t=t0 + T / sp.pi * sp.atan(sp.pi * e / T)),
        twin("growing", to_t=t0 + sp.log(1 + e / g) / g),
        twin("growing", start=t0 + 1),
        twin("identity", to_tau=2 * t0 - t, to_t=2 * t0 - tau),
        twin("identity", to_tau=t0 + s**2, to_t=t0 - sp.sqrt(e)),
    ],
)
def test_a_clock_with_a_wrong_inverse_a_pole_or_a_wrong_direction_cannot_be_made(make):
    with pytest.raises(InputError, match="does not hold, or cannot be shown"):
        make()


def test_the_two_times_must_differ():
    with pytest.raises(InputError, match="distinct"):
        Clock(t, t, t, t, t0, T)


@pytest.mark.parametrize("order", [0, -1, sp.Float(2.0), t])
def test_the_order_of_a_power_map_is_positive_and_exact(order):
    with pytest.raises(InputError, match="order"):
        power_clock(t, tau, order=order, **HERE)


@pytest.mark.parametrize(
    "formula",
    [
        t0 + s / nu,
        t0 - T * sp.log(nu),
        t0 + s / (1 - s**2 / T**2),
        t0 + 2 * T / sp.pi * sp.tan(sp.pi * s / (2 * T)),
    ],
)
def test_the_inverse_of_a_formula_is_found(formula):
    clock = clock_from_formula(t, tau, formula, **HERE)
    values = {t0: 1, T: 2, t: sp.Rational(9, 5)}
    assert abs((clock.to_t.subs(tau, formula) - t).subs(values).evalf(30)) < 1e-25


def test_an_inverse_that_is_not_found_is_asked_for_and_can_be_given():
    late = {"start": sp.S.Zero, "horizon": sp.oo}
    formula = t + 1 - sp.exp(-t)
    inverse = tau - 1 + sp.LambertW(sp.exp(1 - tau))
    with pytest.raises(InputError, match="give it as an expression in tau with inverse="):
        clock_from_formula(t, tau, t + sp.sin(t) / 2, **late)
    with pytest.raises(InputError, match="cannot be shown"):
        clock_from_formula(t, tau, formula, inverse=inverse + 1, **late)
    given = clock_from_formula(t, tau, 2 * t, inverse=tau / 2, **late)
    assert given.to_t == tau / 2


def test_a_wrong_inverse_that_is_given_is_refused():
    with pytest.raises(InputError, match="the inverse undoes the map"):
        clock_from_formula(t, tau, t0 + s / nu, inverse=t0 + e / (1 + e / (2 * T)), **HERE)


@pytest.mark.parametrize(
    ("rate", "name"),
    [
        (nu**-2, "prescribed time"),
        (1 / nu, "logarithmic"),
        (nu**-3, "power 2"),
        (nu ** sp.Rational(-3, 2), "power 1/2"),
    ],
)
def test_a_clock_is_made_from_its_rate(rate, name):
    clock = clock_from_rate(t, tau, rate, **HERE)
    assert vanishes(clock.on_interval(clock.to_tau - made(name).to_tau))
    assert vanishes(clock.on_interval(clock.rate - rate))


@pytest.mark.parametrize(
    ("rate", "value"),
    [
        (sp.S(5), "5*T"),
        (1 / sp.sqrt(nu), "2*T"),
        (nu ** sp.Rational(-9, 10), "10*T"),
        (2 - nu, "3*T/2"),
        (1 / sp.Max(sp.Rational(3, 10), nu) ** 2, "17*T/3"),
        (sp.Min(9, nu**-2), "5*T"),
        (sp.Piecewise((nu**-2, t <= t0 + T * sp.Rational(7, 10)), (sp.Rational(100, 9), True)), "17*T/3"),
        (1 / sp.Max(k, nu) ** 2, r"-T*(k - 2)/k (for k <= 1)"),
    ],
)
def test_a_gain_with_a_finite_integral_is_refused_with_the_value(rate, value):
    with pytest.raises(InputError) as refused:
        clock_from_rate(t, tau, rate, **HERE)
    assert f"is {value}, which is finite, so this is no prescribed-time gain" in str(refused.value)


def test_the_same_rate_is_a_clock_where_no_prescribed_time_is_meant():
    clock = clock_from_rate(t, tau, 1 / sp.sqrt(nu), prescribed_time=False, **HERE)
    assert vanishes(clock.on_interval(clock.rate - 1 / sp.sqrt(nu)))


@pytest.mark.parametrize("rate", [nu**-2 - 3, -1 / nu, 1 - 2 * nu, 1 / (half - s / T) ** 2])
def test_a_rate_that_is_not_positive_or_has_a_pole_is_refused(rate):
    with pytest.raises(InputError, match="is positive all the time"):
        clock_from_rate(t, tau, rate, **HERE)


def test_a_rate_whose_integral_is_not_known_is_not_guessed():
    with pytest.raises(InputError, match="cannot tell whether"):
        clock_from_rate(t, tau, nu**-k, **HERE)


@pytest.mark.parametrize("order", [half, sp.Rational(99, 100), 1, sp.Rational(101, 100), 2, 3])
def test_the_integral_of_a_power_is_infinite_from_order_one_on(order):
    length = dilated_length(nu**-order, t, **HERE)
    expected = sp.oo if order >= 1 else T / (1 - order)
    assert length.value is sp.oo if expected is sp.oo else vanishes(length.value - expected)


def test_a_pole_before_the_end_is_not_integrated_over():
    assert dilated_length(1 / (half - s / T) ** 2, t, **HERE) is None


CORNER = t0 + T * w / (1 + w)  # at ν = 1/(1 + w)


@pytest.mark.parametrize("name", ["prescribed time", "power 2", "logarithmic", "tangent"])
def test_a_clipped_map_goes_on_with_its_last_rate(name):
    clipped = CappedClock(made(name), CORNER)
    values = {t0: 1, T: 2, w: 3}
    corner = CORNER.subs(values)
    rate = clipped.rate.subs(values)
    assert sp.simplify(rate.subs(t, corner + 5) - RATES[name].subs(values).subs(t, corner)) == 0
    assert sp.simplify(rate.subs(t, corner) - RATES[name].subs(values).subs(t, corner)) == 0
    for instant in (sp.Rational(3, 2), corner, corner + 1, sp.Integer(7)):
        there = clipped.to_tau.subs(values).subs(t, instant)
        assert abs((clipped.to_t.subs(values).subs(tau, there) - instant).evalf(30)) < 1e-25


@pytest.mark.parametrize("name", ["prescribed time", "logarithmic"])
def test_contracting_what_a_clipped_map_dilated_gives_the_system_back(name):
    clipped = CappedClock(made(name), CORNER)
    system = System(t, (x,), (f(t, x) + k * x**2 * sp.cos(t),))
    dilated = dilate(system, clipped)
    assert dilated.time == tau
    assert dilated.rhs[0].has(sp.Piecewise)
    again = contract(dilated, clipped)
    assert not again.rhs[0].has(sp.Piecewise)
    assert vanishes(again.rhs[0] - system.rhs[0])


def test_a_clipped_gain_is_one_in_the_clipped_maps_time():
    clipped = CappedClock(made("prescribed time"), CORNER)
    dilated = dilate(System(t, (x,), (clipped.rate * k * x,)), clipped)
    assert vanishes(dilated.rhs[0] - k * x)


def test_it_is_the_map_of_the_papers_clipped_gain():
    clock = capped(prescribed_time_clock(t, tau, start=sp.S.Zero, horizon=sp.S(2)), sp.Rational(3, 10))
    for instant in (half, sp.Rational(7, 5), sp.Rational(9, 5), sp.S(3), sp.S(8)):
        assert clock.rate.subs(t, instant) == 1 / sp.Max(sp.Rational(3, 10), 1 - instant / 2) ** 2


# (dτ/dt at ν = 1/2, dτ/dt from ν = 1/10 on), by hand
CAPS = {
    "paper": (4, 100),
    "power": (8, 1000),
    "logarithmic": (2, 10),
    "exponential": (4 * sp.E, 100 * sp.exp(9)),
    "tangent": (2, 1 / sp.sin(sp.pi / 20) ** 2),
}


@pytest.mark.parametrize("name", CAPS)
@pytest.mark.parametrize("symbolic", [False, True])
def test_the_cap_is_the_clocks_own_rate_where_nu_is_the_smallest(name, symbolic):
    nu_min = sp.Symbol("nu_min", positive=True)
    m = sp.Symbol("m", positive=True) if name == "power" else None
    values = {t0: 1, T: 2, nu_min: sp.Rational(1, 10), sp.Symbol("m", positive=True): 2}
    if symbolic:
        clock = capped(named_clock(name, t, tau, **HERE, exponent=m), nu_min)
    else:
        order = None if m is None else sp.S(2)
        numbers = {"start": sp.S(1), "horizon": sp.S(2)}
        clock = capped(named_clock(name, t, tau, **numbers, exponent=order), sp.Rational(1, 10))
    rate = clock.rate.subs(values)
    before, after = CAPS[name]
    for instant, value in ((sp.S(2), before), (sp.Rational(28, 10), after), (sp.S(3), after), (sp.S(30), after)):
        assert abs((rate.subs(t, instant) - value).evalf(30)) < 1e-20 * sp.N(value)
    there = clock.to_tau.subs(values)
    for instant in (sp.S(1), sp.S(2), sp.Rational(28, 10), sp.S(3), sp.S(4)):
        assert abs((clock.to_t.subs(values).subs(tau, there.subs(t, instant)) - instant).evalf(30)) < 1e-20
    for choice in (clock.rate, clock.to_tau, clock.rate_back, clock.to_t):
        assert {condition for _, condition in choice.args} <= {*clock.conditions, sp.true}


@pytest.mark.parametrize("name", CAPS)
def test_a_cap_at_one_is_a_constant_rate_from_the_start(name):
    clock = capped(named_clock(name, t, tau, **HERE, exponent=sp.S(3) if name == "power" else None), sp.S(1))
    assert (clock.until, clock.last_rate, clock.corner_tau) == (t0, 1, t0)
    assert vanishes(clock.to_tau.subs(t, t0 + 5) - t0 - 5)


@pytest.mark.parametrize("nu_min", [sp.S(0), sp.S(-1), sp.S(2), sp.Rational(11, 10)])
def test_a_cap_outside_the_interval_is_refused(nu_min):
    with pytest.raises(InputError, match="not shown to lie between"):
        capped(made("prescribed time"), nu_min)


@pytest.mark.parametrize(
    ("name", "exponent", "message"),
    [
        ("papers", None, "clock: 'papers' is not one of paper, power"),
        ("power", None, "exponent: the clock 'power' needs one"),
        ("tangent", 2, "exponent: the clock 'tangent' takes none"),
    ],
)
def test_names_that_no_clock_has_are_refused(name, exponent, message):
    with pytest.raises(InputError, match=message):
        named_clock(name, t, tau, exponent=exponent, **HERE)


@pytest.mark.parametrize("corner", [t0 - 1, t0 + T, t0 + 2 * T, t])
def test_a_corner_outside_the_interval_is_refused(corner):
    with pytest.raises(InputError, match="is not shown to lie between"):
        CappedClock(made("prescribed time"), corner)


@pytest.mark.parametrize(
    ("expression", "positive"),
    [
        (1 + w, True),
        (w - 1, False),
        (w**2 - w + 1, True),
        (w**2 - w, False),
        (1 / (w - 1) ** 2, False),
        (1 + sp.tan(sp.pi * w / (2 + 2 * w)) ** 2, True),
        (1 + sp.tan(sp.pi * w) ** 2, False),
        (sp.tan(sp.pi * w / (2 + 2 * w)), False),
    ],
)
def test_positive_is_said_only_where_it_is_shown_without_poles(expression, positive):
    assert is_positive(expression) is positive


@pytest.mark.parametrize(
    ("expression", "limit"),
    [
        (T * (1 - sp.exp(-tau / T)), T),
        (sp.atan(tau), sp.pi / 2),
        (sp.atan(-tau), -sp.pi / 2),
        (sp.atan(1 / tau), 0),
        (sp.log(1 + tau), sp.oo),
        (sp.sin(tau), None),
    ],
)
def test_limits_at_infinity(expression, limit):
    assert limit_at_infinity(expression, tau) == limit


def test_arctan_undoes_tan_only_within_a_quarter_turn():
    inside, outside = sp.pi * w / (2 + 2 * w), sp.pi * w
    assert settle(sp.atan(sp.tan(inside))) == inside
    assert settle(sp.atan(sp.tan(outside))) == sp.atan(sp.tan(outside))
