"""Steps from system to system promise equality along every motion; what does not keep the promise is refused."""

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.system import DitherSystem, System
from ptproof.transforms import (
    bring_solution,
    carry_solution,
    change_variable,
    change_variables,
    contract,
    dilate,
    prescribed_time_clock,
    scale_time,
    solve_state,
    solves,
    split,
)
from ptproof.transforms.clocks import capped

t, tau, x, y, z, p, a = sp.symbols("t tau x y z p a", real=True)
T, k, mu, b = sp.symbols("T k mu b", positive=True)
F = sp.Function("F", real=True)
CLOCK = prescribed_time_clock(t, tau, start=0, horizon=T)


def pair(rate, other=sp.S.Zero):
    """dx/dt = other beside dz/dt = rate."""
    return System(t, (x, z), (sp.sympify(other), sp.sympify(rate)))


# (the system, a solution for z, the solution spoilt)
SOLVED = [
    (pair(k), k * t + a, k * t**2),
    (pair(x), x * t, x * t + t),
    (pair(x + t, 1), x * t, x * t**2),
    (pair(-z + x + 1, 1), x, x + 1),
    (pair(2 * x * F(x), F(x)), x**2, x**3),
    (pair(sp.cos(t)), sp.sin(t), sp.cos(t)),
    (pair(z), sp.exp(t), sp.exp(2 * t)),
    (pair(z**2), 1 / (1 - t), 1 / (1 + t)),
]
# (the system, what does not solve it)
UNSOLVED = [
    (pair(x, 1), x * t),
    (pair(x, F(x)), x * t),
    (pair(0), sp.Piecewise((0, t < 1), (1, True))),
    (pair(0), sp.sign(t)),
    (pair(0), sp.Heaviside(t - 1)),
    (pair(0), sp.Piecewise((0, x < 1), (1, True))),
    (pair(0, 1), sp.floor(x)),
    (pair(-1 / (1 + t**2)), sp.acot(t)),
    (pair(-t / z), sp.I * sp.sqrt(1 + t**2)),
    (pair(-t / z), sp.sqrt(-1 - t**2)),
    (pair(0), z),
    (pair(z), z * sp.exp(t)),
    (pair(0), sp.Symbol("c")),
    (pair(1), sp.zoo),
]


@pytest.mark.parametrize(("system", "solution", "spoilt"), SOLVED, ids=str)
def test_a_state_is_solved_along_the_motion_of_the_others(system, solution, spoilt):
    reduced = solve_state(system, z, solution)
    assert reduced.state == (x,)
    with pytest.raises(InputError, match="does not solve"):
        solve_state(system, z, spoilt)


def test_a_state_at_rest_may_stand_in_a_solution():
    assert solve_state(pair(x), z, x * t).rhs == (0,)


@pytest.mark.parametrize(("system", "solution"), UNSOLVED, ids=str)
def test_what_only_looks_solved_is_refused(system, solution):
    with pytest.raises(InputError):
        solve_state(system, z, solution)


def test_only_a_state_can_be_solved_or_exchanged():
    with pytest.raises(InputError, match="not one of the states"):
        solve_state(pair(1), y, t)
    with pytest.raises(InputError, match="not one of the states"):
        change_variable(pair(1), y, p, y + x, p - x)


CHANGES = [
    (p, z + k * x, p - k * x),
    (p, z + t * x, p - t * x),
    (p, z * (1 + x**2), p / (1 + x**2)),
    (b, sp.exp(z), sp.log(b)),
    (p, 2 * z + F(x), (p - F(x)) / 2),
]
NO_CHANGES = [
    (p, z + k * x, p + k * x),
    (p, z**2, sp.sqrt(p)),
    (p, z**3, sp.cbrt(p)),
    (p, 1 / z, 1 / p),
    (p, x * z, p / x),
    (p, z / a, p * a),
    (p, sp.tan(z), sp.atan(p)),
    (p, sp.exp(z), sp.log(p)),
    (b, z, b),
    (p, z + sp.sign(x), p - sp.sign(x)),
    (p, z + sp.Piecewise((0, t < 1), (1, True)), p - sp.Piecewise((0, t < 1), (1, True))),
    (p, z + sp.Abs(x), p - sp.Abs(x)),
    (p, sp.I * z, -sp.I * p),
    (x, z + x, x),
    (t, z + x, t - x),
    (k, z + x, k - x),
    (z, z, z),
    (sp.Symbol("x"), z + 1, sp.Symbol("x") - 1),
    (p, z + p, p - p),
]


@pytest.mark.parametrize(("by", "forward", "backward"), CHANGES, ids=str)
def test_a_changed_variable_moves_as_the_chain_rule_says(by, forward, backward):
    system = pair(k * x * z + sp.cos(t), -x + z)
    changed = change_variable(system, z, by, forward, backward)
    assert changed.state == (x, by)
    back = changed.rhs[1].subs(by, forward) - system.derivative_along(forward)
    assert sp.simplify(back) == 0


@pytest.mark.parametrize(("by", "forward", "backward"), NO_CHANGES, ids=str)
def test_a_change_that_is_none_everywhere_or_a_letter_in_use_is_refused(by, forward, backward):
    with pytest.raises(InputError):
        change_variable(pair(k * x * z, x), z, by, forward, backward)


def test_a_solution_is_one_only_without_jumps_and_states():
    still = System(t, (x, z), (0, 0))
    assert solves(still, {x: a, z: 1})
    assert not solves(still, {x: a, z: t})
    for jump in (sp.Piecewise((0, t < 1), (1, True)), sp.sign(t), sp.Heaviside(t), sp.zoo, sp.nan):
        assert not solves(still, {x: jump, z: 1})
    with pytest.raises(InputError, match="contains a state"):
        solves(still, {x: z, z: x})
    assert not solves(System(t, (x,), (-t / x,)), {x: sp.I * sp.sqrt(1 + t**2)})
    assert not solves(System(t, (x,), (-t / x,)), {x: sp.sqrt(-1 - t**2)})
    assert solves(System(t, (x,), (-t / x,)), {x: sp.sqrt(1 - t**2)})


def test_on_the_interval_of_a_clock_a_solution_has_no_pole():
    blown = System(t, (x,), (x**2,))
    assert solves(blown, {x: 1 / (1 - t)})
    assert solves(blown, {x: 1 / (2 * T - t)}, CLOCK)
    assert not solves(blown, {x: 2 / (T - 2 * t)}, CLOCK)
    with pytest.raises(InputError, match="runs in tau"):
        solves(System(tau, (x,), (x,)), {x: sp.exp(tau)}, CLOCK)


def test_the_other_time_is_no_letter_of_a_solution_or_a_system():
    for value in (t * sp.exp(-tau), sp.Symbol("t", positive=True) * tau):
        with pytest.raises(InputError, match="already contains"):
            carry_solution({x: value}, CLOCK)
    with pytest.raises(InputError, match="already contains"):
        bring_solution({x: tau * sp.exp(-t)}, CLOCK)
    for letter in (tau, sp.Symbol("tau", positive=True)):
        with pytest.raises(InputError, match="already in use"):
            dilate(System(t, (x,), (-letter * x,)), CLOCK)
    for letter in (t, sp.Symbol("t")):
        with pytest.raises(InputError, match="already in use"):
            contract(System(tau, (x,), (-letter * x,)), CLOCK)


def test_a_choice_in_time_goes_through_a_capped_clock():
    choice = sp.Piecewise((x, t < T / 3), (2 * x, True))
    clock = capped(CLOCK, sp.Rational(1, 2))
    dilated = dilate(System(t, (x,), (choice,)), clock)
    values = {T: 3, x: 1}
    for instant in (sp.Rational(1, 2), sp.Rational(5, 4), sp.Integer(2)):
        there = clock.to_tau.subs(values).subs(t, instant)
        expected = (choice / clock.rate).subs(values).subs(t, instant)
        assert dilated.rhs[0].subs(values).subs(tau, there) == expected


@pytest.mark.parametrize(
    ("factor", "time"), [(-mu, tau), (t, tau), (a, tau), (0, tau), (mu, x), (mu, mu), (mu, sp.Symbol("x"))], ids=str
)
def test_time_is_scaled_by_a_positive_constant_into_a_letter_of_its_own(factor, time):
    system = System(t, (x,), (-x * t,))
    assert scale_time(system, mu, tau).rhs == (-(mu**2) * tau * x,)
    with pytest.raises(InputError):
        scale_time(system, factor, time)


@pytest.mark.parametrize(
    ("slow", "fast", "steady"),
    [
        (-x, (F(x) - z) / mu, (z,)),
        (-x, (F(x) - z) / mu, (2 * F(x),)),
        (-x, (F(x) - z) / mu, (F(x), x)),
        (-x, 0, (z,)),
        (-x, (F(x) - z) / mu, (F(x) + 0 * mu, 1)),
        (z / mu, (F(x) - z) / mu, (F(x),)),
        (-x, (F(x) - z - mu) / mu, (F(x),)),
        (-x, (F(x) - z) / mu**2, (F(x),)),
    ],
    ids=str,
)
def test_what_is_no_slow_and_fast_system_is_not_split(slow, fast, steady):
    assert split(pair((F(x) - z) / mu, -x), [z], mu, (F(x),)).unique
    with pytest.raises(InputError):
        split(pair(fast, slow), [z], mu, steady)


@pytest.mark.parametrize("letters", [((x,), p), ((y,), x), ((k,), p), ((y, p), a), ((sp.Symbol("x"),), p)], ids=str)
def test_a_boundary_layer_has_letters_of_its_own(letters):
    parts = split(pair((k * x - z) / mu, -x), [z], mu)
    assert parts.boundary_layer((y,), p).rhs == (-y,)
    with pytest.raises(InputError):
        parts.boundary_layer(*letters)


def test_two_symbols_of_one_name_are_not_told_apart():
    with pytest.raises(InputError, match="two symbols are called x"):
        System(t, (x,), (sp.Symbol("x") + x,))
    with pytest.raises(InputError, match="two symbols are called k"):
        System(t, (x,), (k + sp.Symbol("k", real=True),))
    theta, omega = sp.Symbol("theta", real=True), sp.Symbol("omega", positive=True)
    with pytest.raises(InputError, match="two symbols are called omega"):
        DitherSystem(t, theta, omega, (x,), (sp.Symbol("omega", real=True),), ((1,),), (sp.cos(theta),))


def test_a_renamed_state_stays_what_it_was():
    assert pair(k * z, x).rename({z: p}).rhs == (x, k * p)
    assert pair(z, x).rename({z: x, x: z}).rhs == (z, x)
    for new in (x, k, t, sp.Symbol("q", positive=True)):
        with pytest.raises(InputError):
            pair(k * z, x).rename({z: new})


def test_putting_a_function_in_evaluates_no_integral():
    integral = sp.Integral(sp.Abs(sp.sin(y)), (y, 0, 7 * sp.pi))
    assert pair(F(x) * integral).with_values({F(x): x}).rhs[1] == x * integral


TURN = sp.Matrix([[sp.cos(k * t), -sp.sin(k * t)], [sp.sin(k * t), sp.cos(k * t)]])
TURNED = TURN * sp.Matrix([p, y])
TURNED_BACK = TURN.T * sp.Matrix([x, z])


def test_a_frame_that_turns():
    """In the frame of dx/dt = −kz, dz/dt = kx nothing moves; in the one that turns the other way all moves twice."""
    circling = System(t, (x, z), (-k * z, k * x))
    there, back = dict(zip((x, z), TURNED, strict=True)), dict(zip((p, y), TURNED_BACK, strict=True))
    still = change_variables(circling, there, back)
    assert still.state == (p, y)
    assert [sp.simplify(rate) for rate in still.rhs] == [0, 0]
    other = System(t, (x, z), (k * z, -k * x))
    assert [sp.simplify(rate) for rate in change_variables(other, there, back).rhs] == [2 * k * y, -2 * k * p]


@pytest.mark.parametrize(
    ("backward", "forward", "message"),
    [
        (dict(zip((x, z), TURNED, strict=True)), dict(zip((p, y), TURN * sp.Matrix([x, z]), strict=True)), "undo"),
        ({x: p, z: y}, {p: x}, "1 states for 2"),
        ({x: p, z: y}, {p: x, y: y}, "has to be given by"),
    ],
)
def test_what_is_no_exchange_of_several_states(backward, forward, message):
    with pytest.raises(InputError, match=message):
        change_variables(System(t, (x, z), (-k * z, k * x)), backward, forward)
