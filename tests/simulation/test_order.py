"""The order of the gap: right averages pass, wrong ones don't; and where the seeker hovers."""

import numpy as np
import pytest
import sympy as sp

from derivations.pt_seeker.experiments.gallery import problem_order
from ptproof.averaging.correction import first_correction
from ptproof.errors import InputError
from ptproof.problem import SEEKERS, TAU, example, parameters
from ptproof.problem.loops import generic_dithers
from ptproof.simulation import gap_order, hover_radius, simulate
from ptproof.simulation.order import fit_order
from ptproof.system import DitherSystem, System, gradient

DITHERS, AVERAGE = generic_dithers(SEEKERS["pt"].law)
X1, X2 = DITHERS.state
F = sp.Function("F", real=True)(X1, X2)
G = [sp.Function(name, real=True)(TAU, X1, X2) for name in ("g1", "g2")]
K = parameters.k
VALUES = {
    F: -(X1**2 + 2 * X2**2 + X1 * X2) / 2 + sp.cos(X1) / 3, G[0]: sp.sin(TAU) * X2 / 3, G[1]: X1 / 5,
    K: sp.Rational(3, 2), parameters.p0: sp.Rational(2, 5),
}  # fmt: skip
QUESTION = {"initial": [1, -0.5], "end": 2, "values": VALUES}


def test_the_derived_average_has_the_order_one_half():
    gaps = gap_order(DITHERS, AVERAGE, **QUESTION)
    assert gaps.slope == pytest.approx(-0.5, abs=0.03)
    assert gaps.agrees


def test_the_first_correction_gains_one_order():
    gaps = gap_order(DITHERS, first_correction(DITHERS), **QUESTION)
    assert gaps.expected == -1
    assert gaps.slope == pytest.approx(-1, abs=0.03)
    assert gaps.agrees


SLOPES = gradient(F, (X1, X2))
WRONG = {
    "factor 1/2 missing": [G[0] + K * SLOPES[0], G[1] + K * SLOPES[1]],
    "sign": [G[0] - K / 2 * SLOPES[0], G[1] - K / 2 * SLOPES[1]],
    "transposed": [G[0] + K / 2 * SLOPES[1], G[1] + K / 2 * SLOPES[0]],
    "ten percent in one entry": [G[0] + sp.Rational(9, 20) * K * SLOPES[0], G[1] + K / 2 * SLOPES[1]],
    "no drift": [K / 2 * SLOPES[0], K / 2 * SLOPES[1]],
}


@pytest.mark.parametrize("case", WRONG)
def test_a_wrong_average_does_not_pass(case):
    wrong = System(AVERAGE.time, AVERAGE.state, tuple(WRONG[case]))
    assert not gap_order(DITHERS, wrong, **QUESTION).agrees


def test_an_average_that_is_wrong_by_a_percent_shows_in_the_sharp_comparison():
    almost = System(
        AVERAGE.time, AVERAGE.state, (G[0] + sp.Rational(101, 200) * K * SLOPES[0], G[1] + K / 2 * SLOPES[1])
    )
    ladder = {"omegas": (400, 800, 1600, 3200), "sharp": True}
    assert gap_order(DITHERS, AVERAGE, **ladder, **QUESTION).agrees
    assert not gap_order(DITHERS, almost, **ladder, **QUESTION).agrees
    assert gap_order(DITHERS, almost, **QUESTION).agrees


def test_the_sharp_comparison_needs_a_dither_system():
    with pytest.raises(InputError, match="sharp"):
        gap_order(AVERAGE, AVERAGE, sharp=True, **QUESTION)


def test_the_plain_average_does_not_pass_for_a_corrected_one():
    assert not gap_order(DITHERS, AVERAGE, expected=-1.0, **QUESTION).agrees


def test_square_waves_have_the_order_one_half_too():
    tau, theta, x = (sp.Symbol(name, real=True) for name in ("tau", "theta", "x"))
    omega = sp.Symbol("omega", positive=True)
    square = sp.Piecewise((1, theta < sp.pi), (-1, True))
    shifted = sp.Piecewise((1, theta < sp.pi / 2), (-1, theta < 3 * sp.pi / 2), (1, True))
    system = DitherSystem(tau, theta, omega, (x,), (0,), ((1,), (x**2 - x / 3,)), (square, shifted))
    # v_21 = -pi/4 by hand: the mean of the shifted wave times the triangle wave that the square one integrates to.
    right = System(tau, (x,), (-sp.pi / 4 * (2 * x - sp.Rational(1, 3)),))
    asked = {"initial": [1], "end": 1, "omegas": (50, 100, 200, 400)}
    assert gap_order(system, right, **asked).agrees
    # What the first harmonics alone would give: (4/pi)^2 / 2 in the place of pi/4.
    harmonic = System(tau, (x,), (-8 / sp.pi**2 * (2 * x - sp.Rational(1, 3)),))
    assert gap_order(system, right, sharp=True, **asked).agrees
    assert not gap_order(system, harmonic, sharp=True, **asked).agrees


@pytest.mark.parametrize("name", ["vanishing", "nonvanishing"])
def test_the_closed_loop_with_its_filter_has_the_order_one_half(name):
    assert problem_order(example(name)).agrees


def test_a_run_that_does_not_get_through_does_not_agree():
    tau, x, omega = sp.Symbol("tau", real=True), sp.Symbol("x", real=True), sp.Symbol("omega", positive=True)
    system = System(tau, (x,), (x**3 + sp.cos(omega * tau),))
    asked = {"initial": [1], "end": 1, "omega": omega, "omegas": (10, 20, 40)}
    gaps = gap_order(system, System(tau, (x,), (x**3,)), **asked)
    assert not gaps.agrees
    assert gaps.message == "at omega = 10 the system ended as escaped"
    gaps = gap_order(System(tau, (x,), (sp.cos(omega * tau),)), System(tau, (x,), (x**3,)), **asked)
    assert not gaps.agrees
    assert gaps.message == "at omega = 10 the average ended as escaped"


def test_states_that_don_t_fit_are_named():
    with pytest.raises(InputError, match="x2 is not a state"):
        gap_order(AVERAGE.rename({X2: sp.Symbol("y", real=True)}), AVERAGE, **QUESTION)


def test_a_ladder_has_at_least_three_rungs():
    with pytest.raises(InputError, match="three positive"):
        gap_order(DITHERS, AVERAGE, omegas=(10, 20), **QUESTION)


def test_the_fit_finds_an_exact_power():
    omegas = np.array([10.0, 20, 40, 80])
    fit = fit_order(omegas, 3 * omegas**-0.5, -0.5)
    assert (fit.slope, fit.tail) == (pytest.approx(-0.5), pytest.approx(-0.5))
    assert fit.spread < 1e-12


def test_on_a_radial_field_the_seeker_ends_on_the_hover_circle():
    run = simulate("saturated", "pt", until=6, rtol=1e-9)
    assert run.final_distance == pytest.approx(hover_radius(30.0), abs=1e-7)


def test_the_distance_left_is_the_hover_radius_to_leading_order():
    # A field without symmetry, no drift: distance · √ω → 1, with an error that falls at least like 1/√ω.
    tau, x1, x2 = TAU, X1, X2
    none = {G[0]: sp.Integer(0), G[1]: sp.Integer(0)}
    errors, omegas = [], (50.0, 200.0, 800.0)
    system = DITHERS.to_system().with_values(VALUES | none | {F: -(x1**2 + 2 * x2**2 + x1 * x2) / 2 + x1**3 / 9})
    for omega in omegas:
        run = simulate(
            system, initial=[0.3, -0.2], span=(0, 30), parameters={"omega": omega}, engine="heyoka", samples=8000
        )
        late = run.t > 28
        errors.append(np.max(np.abs(np.linalg.norm(run.x[:, late], axis=0) * np.sqrt(omega) - 1)))
    assert errors[-1] < 0.005
    assert fit_order(omegas, errors, -0.5).slope < -0.45
    assert tau in system.time.free_symbols


def test_the_hover_radius_is_exact_for_symbols():
    omega = sp.Symbol("omega", positive=True)
    assert hover_radius(omega) == 1 / sp.sqrt(omega)
