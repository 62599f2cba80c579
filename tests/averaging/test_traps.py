"""What only looks like a hypothesis met, or one broken, is neither proved nor refuted; its right twin is."""

from dataclasses import replace

import pytest
import sympy as sp

from ptproof.averaging import (
    AveragingRefused,
    AveragingUndecided,
    DitherProblem,
    FastStates,
    average,
    split_dithers,
    study,
)
from ptproof.averaging.bounded import bounded_in_time
from ptproof.averaging.correction import first_correction
from ptproof.averaging.samples import masked_functions, sample_points
from ptproof.errors import InputError
from ptproof.proof.statement import le
from ptproof.proof.verdict import Verdict
from ptproof.system import DitherSystem, System

tau, theta, x, y, z, w, p = sp.symbols("tau theta x y z w p", real=True)
omega, k = sp.symbols("omega k", positive=True)
F, a, f = (sp.Function(name, real=True) for name in "Faf")
J, B = sp.Function("J", positive=True), sp.Function("B", nonnegative=True)
s, c, pi = sp.sin, sp.cos, sp.pi
P, R, U = Verdict.PROVED, Verdict.REFUTED, Verdict.UNDECIDED
one, two, half = sp.Integer(1), sp.Integer(2), sp.Rational(1, 2)
SIMPLE = DitherSystem(tau, theta, omega, (x,), (0,), ((1,), (x,)), (c(theta), s(theta)))


def dithered(*dithers, period=2 * pi):
    return replace(SIMPLE, dithers=dithers if len(dithers) == 2 else (*dithers, s(theta)), period=period)


def letter(problem, name):
    return study(problem).ledger.entries[name].verdict


def fast(*rates, steady=None, **region):
    letters = {"x": x, "z": z, "w": w}
    return DitherProblem(
        SIMPLE, FastStates((z, w)[: len(rates)], rates, steady), region={letters[n]: ends for n, ends in region.items()}
    )


# --- amplitudes in the slow time -------------------------------------------------------------------------------------

AMPLITUDES = [
    (a(tau), P),
    (a(2 * tau + 1), P),
    (a(k * tau), P),
    (a(tau + x), P),
    (a(3), P),
    (c(a(tau)) * a(tau) ** 2, P),
    (f(tau, x**2), P),
    (a(tau**2), U),
    (a(tau * x), U),
    (a(x * tau + 1), U),
    (a(-tau), U),
    (a(p * tau), U),
    (a(sp.exp(tau)), U),
    (a(s(tau)), P),
    (a(tau + s(tau**2)), U),
    (a(sp.sqrt(1 + tau**2)), U),
    (f(x, tau), U),
    (f(tau, tau), U),
    (f(tau, tau * x), U),
    (f(tau**2, x), U),
    (sp.Function("a", positive=True)(tau), U),
    (a(tau, x), U),
]


@pytest.mark.parametrize(("amplitude", "verdict"), AMPLITUDES, ids=str)
def test_bounded_is_the_function_itself_at_times_that_run_on_evenly(amplitude, verdict):
    found = bounded_in_time(amplitude, tau, [x], sp.S.Zero, [le(0, tau)], (a(tau), f(tau, x)))
    assert found.verdict is verdict


def test_all_real_times_run_both_ways():
    assert bounded_in_time(a(-tau), tau, [x], None, [], (a(tau),)).verdict is P


def test_growth_counts_only_inside_the_region():
    growing = replace(SIMPLE, drift=(tau * sp.Max(x, 0),))
    assert letter(DitherProblem(growing, region={x: (-two, -one)}), "B") is not R
    assert letter(DitherProblem(growing, region={x: (one, two)}), "B") is R
    signed = replace(SIMPLE, drift=(tau * (J(x) - sp.Abs(J(x))),))
    assert letter(signed, "B") is not R


# --- dithers ---------------------------------------------------------------------------------------------------------

square = sp.Piecewise((1, theta < pi), (-1, True))
GOOD = [
    (c(theta), 2 * pi, half),
    (c(theta), 4 * pi, half),
    (square, 2 * pi, 0),
    (sp.Piecewise((1, theta < pi), (5, theta < pi), (-1, True)), 2 * pi, 0),
    (sp.Abs(c(theta)) - 2 / pi, 2 * pi, 0),
    (sp.Abs(c(theta)) - 2 / pi, 4 * pi, 0),
    (sp.sign(c(theta)), 2 * pi, 2 / pi),
    (sp.Abs(s(theta / 2)) - 2 / pi, 2 * pi, -2 / (3 * pi)),
    (s(sp.Mod(theta, 2 * pi) / 2) - 2 / pi, 2 * pi, -2 / (3 * pi)),
]


@pytest.mark.parametrize(("dither", "period", "value"), GOOD, ids=str)
def test_a_dither_of_the_class_is_averaged(dither, period, value):
    found = study(dithered(dither, period=period))
    assert found.ledger.entries["D"].verdict is P
    assert sp.simplify(found.v[2, 1] - value) == 0


BAD = [
    (c(theta), pi, R),
    (c(theta), 3 * pi, R),
    (c(theta) + c(sp.sqrt(2) * theta), 2 * pi, R),
    (c(theta**2), 2 * pi, U),
    (theta, 2 * pi, R),
    (sp.Abs(c(theta / 2)) - 2 / pi, pi, R),
    (sp.sign(c(theta / 2)), 2 * pi, R),
    (sp.Abs(s(theta / 2)), 2 * pi, R),
    (s(theta / 2) * sp.sign(s(theta / 2)), 2 * pi, R),
    (sp.Piecewise((1, theta < pi), (-1, theta > pi)), 2 * pi, U),
    (sp.Piecewise((1, theta < pi), (-1, theta < 3 * pi / 2)), 2 * pi, U),
    (sp.Piecewise((1, theta > 0), (1, theta < 0)) * c(theta), 2 * pi, U),
    (square, 4 * pi, R),
    (square + half, 2 * pi, R),
    (c(theta / 2) * square, 2 * pi, R),
    (sp.exp(sp.I * theta), 2 * pi, U),
    (sp.I * c(theta), 2 * pi, U),
    (sp.sqrt(p) * c(theta), 2 * pi, U),
    (c(theta) / p, 2 * pi, U),
    (sp.Symbol("A") * c(theta), 2 * pi, U),
    (c(theta + sp.Symbol("A")), 2 * pi, U),
    (sp.log(p) * c(theta), 2 * pi, U),
    (a(tau), 2 * pi, U),
    (c(theta) + sp.Symbol("n", even=True), 2 * pi, U),
    (c(p * theta), 2 * pi, R),
    (sp.tan(theta), 2 * pi, U),
]


@pytest.mark.parametrize(("dither", "period", "verdict"), BAD, ids=str)
def test_a_dither_outside_the_class_is_never_averaged(dither, period, verdict):
    system = dithered(dither, period=period)
    found = study(system)
    assert found.system is None
    assert found.ledger.entries["D"].verdict is verdict
    with pytest.raises((AveragingRefused, AveragingUndecided)):
        average(system)


@pytest.mark.parametrize("dither", [sp.tan(theta), 1 / s(theta), sp.log(s(theta) ** 2), c(theta**2)], ids=str)
def test_a_dither_that_is_not_read_is_not_called_bounded(dither):
    assert letter(dithered(dither), "C") is U
    assert letter(dithered(c(theta)), "C") is P


def test_a_mean_that_vanishes_at_the_times_asked_about_is_not_refuted():
    late = DitherProblem(dithered(c(theta) + sp.Max(0, 1 - tau)), start=two)
    assert letter(late, "D") is not R


@pytest.mark.parametrize("name", ["tau", "theta", "omega", "x"])
def test_a_letter_of_the_systems_name_but_another_kind_is_refused(name):
    twin = sp.Symbol(name, real=True, nonzero=True)
    with pytest.raises(InputError, match=f"two symbols are called {name}"):
        replace(SIMPLE, drift=(twin,))


@pytest.mark.parametrize("entry", [1 / p, sp.sqrt(p), sp.log(p), sp.I, sp.zoo, sp.nan, sp.Symbol("C"), sp.oo], ids=str)
def test_a_constant_has_to_be_a_number_too(entry):
    assert letter(replace(SIMPLE, drift=(k,)), "A") is P
    assert letter(replace(SIMPLE, drift=(entry,)), "A") is not P
    assert letter(replace(SIMPLE, fields=((entry,), (x,))), "A") is not P


def test_the_claimed_average_is_compared_inside_the_region_and_where_both_are_defined():
    region = {x: (one, two)}
    known = replace(SIMPLE, fields=((1,), (2 * x,)), drift=(x,))  # x + 1
    assert study(DitherProblem(known, expected=(x + 1,))).expected.verdict is P
    assert study(DitherProblem(known, expected=(sp.Abs(x) + 1,))).expected.verdict is R
    assert study(DitherProblem(known, expected=(sp.Abs(x) + 1,), region=region)).expected.verdict is not R
    assert study(DitherProblem(known, expected=(x + 2,), region=region)).expected.verdict is R


def test_the_order_one_half_needs_amplitudes_that_are_smooth_enough():
    smooth, kinked = (first_correction(dithered(entry * c(theta))) for entry in (tau, sp.Abs(tau - 1) * (tau - 1)))
    assert smooth.hypotheses().verdict is P
    assert kinked.hypotheses().verdict is not P


# --- fast states -----------------------------------------------------------------------------------------------------

JUMP = sp.Piecewise((-z, z < 1), (5 - z, True))  # its derivative is -1 for SymPy, and it has a second zero at 5
LAYERS = [
    (fast(x * (F(x) - z), x=(one, two)), P),
    (fast(x * (F(x) - z), x=(-one, two)), R),
    (fast(x * (F(x) - z)), R),
    (fast(x * (F(x) - z), x=(sp.S.Zero, two)), U),
    (fast((1 + J(x)) * (F(x) - z)), P),
    (fast(J(x) * (F(x) - z)), U),
    (fast(-J(x) * (F(x) - z)), R),
    (fast(F(x) * (x - z)), R),
    (fast((1 + sp.diff(F(x), x) ** 2) * (x - z)), P),
    (fast(sp.diff(F(x), x) * (x - z)), R),
    (fast(sp.diff(B(x), x) * (x - z)), R),
    (fast((B(x) + 1) * (x - z)), P),
    (fast(p * (x - z)), R),
    (fast(k * (x - z)), P),
    (fast(-z), P),
    (fast(z - x), R),
    (fast(JUMP, steady=(sp.S.Zero,)), U),
    (fast(-z + sp.Piecewise((0, z < 1), (5, True)), steady=(sp.S.Zero,)), U),
    (fast(x - z + 2 * sp.Max(z - x, 0) / 3, steady=(x,)), P),
    (fast(w, -z), R),
    (fast(w, -z - w), P),
]


@pytest.mark.parametrize(("problem", "verdict"), LAYERS, ids=lambda entry: str(getattr(entry, "fast", entry)))
def test_a_boundary_layer_is_judged_inside_the_region(problem, verdict):
    assert letter(problem, "boundary layer") is verdict


STEADY = [
    (fast(x - z), P),
    (fast(x - z, steady=(2 * x,)), R),
    (fast(sp.Abs(x) - z, steady=(x,), x=(one, two)), U),
    (fast(sp.Abs(x) - z, steady=(x,), x=(-two, two)), R),
    (fast(z**2 - x**2, x=(one, two), z=(sp.S.Zero, sp.Integer(5))), U),
    (fast(z**2 - x**2, x=(one, two), z=(-sp.Integer(5), sp.Integer(5))), R),
    (fast(z**2 - x, x=(-two, -one)), R),
    (fast(z * (z - x), z=(one, two), x=(one, two)), U),
    (fast(JUMP, steady=(sp.S.Zero,)), U),
    (fast(F(z) - z, steady=None), U),
    (fast(1 / z - z, steady=(one,)), R),
    (fast(J(x) * (x - z)), P),
    (fast(F(x) * (x - z)), U),
    (fast(-z - z**3), P),
]


@pytest.mark.parametrize(("problem", "verdict"), STEADY, ids=lambda entry: str(getattr(entry, "fast", entry)))
def test_a_quasi_steady_state_is_judged_inside_the_region(problem, verdict):
    assert letter(problem, "F") is verdict


def test_a_quasi_steady_state_is_given_by_slow_states_and_a_dither_by_none():
    with pytest.raises(InputError, match="contains a fast state"):
        FastStates((z, w), (z - w, z - w), (w, w))
    with pytest.raises(InputError, match="depends on a fast state"):
        DitherProblem(dithered(z * c(theta)), FastStates((z,), (-z,)))


# --- where hypotheses may fail ---------------------------------------------------------------------------------------


def test_samples_are_of_the_declared_kind_and_in_the_region():
    n, q = sp.Symbol("n", integer=True, negative=True), sp.Symbol("q", nonnegative=True)
    points = list(sample_points({n, q, x}, [le(two, x), le(x, sp.Integer(3))]))
    assert points
    assert all(point[n].is_integer and point[n] < 0 <= point[q] and 2 <= point[x] <= 3 for point in points)
    assert not list(sample_points({x}, [le(x, 0), le(1, x)]))


def test_a_function_has_one_value_at_one_place_and_is_flat_at_a_zero_that_its_sign_forbids_to_cross():
    expression, back = masked_functions(F(x) - F(y) + B(x) + sp.diff(B(x), x))
    assert not expression.has(sp.Function, sp.Derivative)
    names = {str(node): symbol for symbol, node in back.items()}
    points = list(sample_points(expression.free_symbols, (), back))
    assert points
    for point in points:
        assert point[x] != point[y] or point[names["F(x)"]] == point[names["F(y)"]]
        assert point[names["B(x)"]] >= 0
        assert point[names["B(x)"]] != 0 or point[names["Derivative(B(x), x)"]] == 0


@pytest.mark.parametrize(
    ("rate", "verdict"),
    [
        (x - z, P),
        (sp.Max(-z, -2 * z), P),
        (sp.sqrt(1 + sp.Abs(z)) - z, P),
        (sp.Abs(x) * sp.Abs(z) - z, P),
        (-sp.sign(z), R),
        (sp.Piecewise((-z, z < 0), (1 - z, True)), R),
        (1 / sp.Abs(z) - z, R),
        (sp.floor(z) - z, R),
        (-sp.sqrt(sp.Abs(z)), U),
        (-(z ** sp.Rational(1, 3)), U),
        (-z * sp.log(sp.Abs(z)), U),
        (sp.Max(1 / z, z), U),
        (sp.Min(z, sp.sqrt(x)) - z, U),
        (-z * s(1 / z), U),
    ],
    ids=str,
)
def test_locally_lipschitz_is_more_than_continuous(rate, verdict):
    assert letter(fast(rate, steady=(x,)), "E") is verdict


ROOT = sp.sqrt(omega)


@pytest.mark.parametrize(
    "rate",
    [
        c(omega * tau),
        c(omega * tau) / ROOT,
        ROOT * c(omega**2 * tau),
        ROOT * c(tau),
        ROOT * sp.Abs(c(omega * tau)),
        ROOT * F(c(omega * tau)),
        ROOT * sp.exp(sp.I * omega * tau),
        ROOT * c(omega * tau) ** 2,
        ROOT * c(omega * (tau + x)),
        ROOT * c(omega * tau) * theta,
        sp.sqrt(omega * x**2) * c(omega * tau) * omega ** sp.Rational(1, 3),
        ROOT * sp.Piecewise((1, s(omega * tau) > 0), (-1, True)),
    ],
    ids=str,
)
def test_what_is_no_sum_of_dithers_is_not_split(rate):
    assert split_dithers(System(tau, (x,), (ROOT * c(omega * tau + F(x)),)), omega).fields == ((c(F(x)),), (-s(F(x)),))
    with pytest.raises((AveragingRefused, AveragingUndecided)):
        split_dithers(System(tau, (x,), (rate,)), omega)
