"""assert_average and assert_converges_to_average, each with near misses that must not pass."""

import pytest
import sympy as sp

from ptproof.averaging import PoweredProblem, average, first_correction, with_powers
from ptproof.averaging.problem import DitherProblem, FastStates
from ptproof.errors import InputError
from ptproof.system import DitherSystem, System
from ptproof.testing import assert_average, assert_converges_to_average

tau, theta, x, x1, x2, z = sp.symbols("tau theta x x1 x2 z", real=True)
omega, k = sp.symbols("omega k", positive=True)
F = sp.Function("F", real=True)(x)
G = sp.Function("F", real=True)(x1, x2)

line = DitherSystem(tau, theta, omega, (x,), (0,), ((1,), (k * F,)), (sp.cos(theta), sp.sin(theta)))
heading = omega * tau - k * G
plane = System(tau, (x1, x2), (sp.sqrt(omega) * sp.cos(heading), sp.sqrt(omega) * sp.sin(heading)))
square = sp.Piecewise((1, theta < sp.pi), (-1, True))
shifted = sp.Piecewise((1, theta < sp.pi / 2), (-1, theta < 3 * sp.pi / 2), (1, True))
squares = DitherSystem(tau, theta, omega, (x,), (0,), ((1,), (k * F,)), (shifted, square))


@pytest.mark.parametrize(
    "expected",
    [
        [k * F.diff(x) / 2],
        "k*Derivative(F(x), x)/2",
        ["k/2*Derivative(F(x), x)"],
        sp.Matrix([k * F.diff(x) / 2]),
        System(tau, (x,), (k * F.diff(x) / 2,)),
    ],
)
def test_the_right_average_passes_in_every_form(expected):
    assert_average(line, expected)


def test_a_plain_system_is_split_first():
    assert_average(plane, ["k/2*Derivative(F(x1,x2), x1)", "k/2*Derivative(F(x1,x2), x2)"], omega=omega)


def test_fast_states_are_at_their_quasi_steady_state():
    dithered = DitherSystem(tau, theta, omega, (x,), (0,), ((1,), (k * z,)), (sp.cos(theta), sp.sin(theta)))
    assert_average(DitherProblem(dithered, FastStates((z,), (F - z,))), [k * F.diff(x) / 2])


def test_powers_of_the_frequency():
    dithers = (sp.cos(theta), sp.cos(2 * theta))
    powered = with_powers(
        DitherSystem(tau, theta, omega, (x,), (0,), ((1,), (k * F,)), dithers), [sp.Rational(2, 3)] * 2
    )
    assert_average(powered, ["-k/8*Derivative(F(x), x, x)"])
    with pytest.raises(AssertionError, match="not the expected one"):
        assert_average(PoweredProblem(powered), ["-3*k/8*Derivative(F(x), x, x)"])


def test_the_average_of_square_waves_is_exact():
    assert_average(squares, [sp.pi / 4 * k * F.diff(x)])


@pytest.mark.parametrize(
    ("system", "wrong"),
    [
        (line, k * F.diff(x)),
        (line, -k * F.diff(x) / 2),
        (line, k * F.diff(x) / 2 + x / 1000),
        (line, 0),
        (squares, 8 / sp.pi**2 * k * F.diff(x)),
        (squares, k * F.diff(x) / 2),
    ],
    ids=["missing 1/2", "commutator sign", "small addition", "nothing", "first harmonic", "as for sines"],
)
def test_a_near_miss_fails_with_the_difference_and_a_witness(system, wrong):
    with pytest.raises(AssertionError, match=r"(?s)not the expected one: refuted.*derived:.*difference:.*witness:"):
        assert_average(system, [wrong])


def test_the_message_shows_the_two_sides_and_their_difference():
    with pytest.raises(AssertionError) as failed:
        assert_average(line, [k * F.diff(x)])
    text = str(failed.value)
    assert "dx/dtau derived:  k*Derivative(F(x), x)/2" in text
    assert "dx/dtau expected: k*Derivative(F(x), x)" in text
    assert "difference:       k*Derivative(F(x), x)/2  (expected - derived)" in text


def test_only_the_entries_that_differ_are_shown():
    with pytest.raises(AssertionError) as failed:
        assert_average(plane, [k * G.diff(x1) / 2, k * G.diff(x2) / 3], omega=omega)
    assert "dx2/dtau" in str(failed.value)
    assert "dx1/dtau" not in str(failed.value)


def with_dithers(*dithers, drift=0):
    return DitherSystem(tau, theta, omega, (x,), (drift,), ((1,), (k * F,)), dithers)


@pytest.mark.parametrize(
    ("system", "reason"),
    [
        (with_dithers(1 + sp.cos(theta), sp.sin(theta)), "mean 1"),
        (with_dithers(sp.cos(theta / 3), sp.sin(theta)), "period"),
        (with_dithers(sp.cos(theta), sp.sin(theta), drift=-tau * x), "tends to -oo"),
    ],
)
def test_a_system_outside_the_theorem_fails_with_the_reason_even_if_the_formula_is_right(system, reason):
    with pytest.raises(AssertionError, match=rf"(?s)does not cover the system: refused.*{reason}"):
        assert_average(system, [k * F.diff(x) / 2 + system.drift[0]])


bounded_only = sp.Function("c", real=True)(tau)
uncertain = with_dithers(sp.cos(theta), sp.sin(theta), drift=bounded_only)


def test_an_undecided_assumption_is_a_failure_that_says_so():
    with pytest.raises(AssertionError, match=r"(?s)could not all be shown: undecided.*assuming="):
        assert_average(uncertain, [k * F.diff(x) / 2 + bounded_only])


def test_an_assumption_can_be_taken_on_trust_by_its_letter_and_only_that_one():
    assert_average(uncertain, [k * F.diff(x) / 2 + bounded_only], assuming="B")
    with pytest.raises(AssertionError, match="undecided"):
        assert_average(uncertain, [k * F.diff(x) / 2 + bounded_only], assuming="A")


def test_trust_does_not_make_a_wrong_average_right():
    with pytest.raises(AssertionError, match="refuted"):
        assert_average(uncertain, [k * F.diff(x) + bounded_only], assuming=("A", "B", "C"))


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        ((line, [0, 0]), InputError, "2 entries for the states x"),
        ((line, ["foo"]), InputError, "unknown name 'foo'"),
        ((line, [0.5]), InputError, "not exact"),
        ((line, System(tau, (x1,), (0,))), InputError, "its states are x1, not x"),
        ((line, System(theta, (x,), (0,))), InputError, "runs in theta"),
        ((line, 3.5), TypeError, "expected"),
        ((3, [0]), TypeError, "got int"),
        ((plane, [0, 0]), InputError, "omega"),
    ],
)
def test_bad_use_is_refused(arguments, error, words):
    with pytest.raises(error, match=words):
        assert_average(*arguments)


def test_an_unknown_letter_is_refused():
    with pytest.raises(InputError, match="'Z' is not an assumption"):
        assert_average(line, [k * F.diff(x) / 2], assuming="Z")


LADDER = {"initial": [1], "end": 1, "values": {k: 2, F: -(x**2) / 2}, "omegas": (100, 200, 400)}


def test_a_system_converges_to_its_average():
    assert_converges_to_average(line, average(line), **LADDER)


def test_a_corrected_average_is_one_order_better():
    assert_converges_to_average(line, first_correction(line), **LADDER)


def test_a_plain_average_is_not_one_order_better():
    with pytest.raises(AssertionError, match=r"(?s)observed.*expected: +omega\*\*\(-1\)"):
        assert_converges_to_average(line, average(line), **LADDER, order=-1.0)


@pytest.mark.parametrize("factor", [1, -sp.Rational(1, 2), sp.Rational(2, 5)])
def test_a_system_does_not_converge_to_a_wrong_average(factor):
    wrong = System(tau, (x,), (factor * k * F.diff(x),))
    with pytest.raises(AssertionError, match=r"(?s)does not converge.*omega = 400: +largest gap"):
        assert_converges_to_average(line, wrong, **LADDER)


def test_runs_that_do_not_arrive_are_undecided():
    escaping = {**LADDER, "values": {k: 2, F: x**3}}
    with pytest.raises(AssertionError, match=r"(?s)undecided.*escaped"):
        assert_converges_to_average(line, average(line), **escaping)


@pytest.mark.parametrize(
    ("system", "mean", "changes", "error", "words"),
    [
        (line, 3, {}, TypeError, "average: expected a System"),
        (3, average(line), {}, TypeError, "system: expected a DitherSystem"),
        (line, average(line), {"initial": [1, 2]}, InputError, "2 values for 1 states"),
        (line, average(line), {"omegas": (100, 200)}, InputError, "at least three"),
        (line, System(tau, (z,), (0,)), {}, InputError, "not a state"),
    ],
)
def test_bad_use_of_the_order_check_is_refused(system, mean, changes, error, words):
    with pytest.raises(error, match=words):
        assert_converges_to_average(system, mean, **{**LADDER, **changes})
