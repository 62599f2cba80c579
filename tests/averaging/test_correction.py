"""The terms of order 1/√ω: with them the error is of order 1/ω, without any one of them it is not."""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp

from ptproof.averaging import Correction, first_correction, study
from ptproof.averaging.coefficients import signals
from ptproof.proof.algebra import is_zero
from ptproof.proof.verdict import Verdict
from ptproof.system import DitherSystem

tau, theta = sp.symbols("tau theta", real=True)
x1, x2 = x = sp.symbols("x1:3", real=True)
omega = sp.Symbol("omega", positive=True)
s, c, R = sp.sin, sp.cos, sp.Rational
SQUARE = sp.Piecewise((1, theta < sp.pi), (-1, True))
PULSES = sp.Piecewise((2, theta < 2 * sp.pi / 3), (-1, True))
FIELDS = ((c(x2) + x1 / 2, x1), (s(x1) + x2 / 3, x1 * x2 / 2))
FREQUENCIES = (100, 200, 400)
END = 1.2
TIMES = np.linspace(0, END, 301)
INITIAL = (0.4, -0.7)


def seeker(*dithers: sp.Expr) -> DitherSystem:
    return DitherSystem(tau, theta, omega, x, (-x1 + s(tau), -x2 * x1), FIELDS, dithers)


def numbers(expressions: tuple[sp.Expr, ...], frequency: int) -> Callable[[float, Any], np.ndarray]:
    function = sp.lambdify((tau, x1, x2), [entry.subs(omega, frequency) for entry in expressions], "math")
    return lambda t, y: np.array(function(t, *y), float)


def solve(rate: Callable[[float, Any], np.ndarray], initial: Any, step: float = np.inf) -> np.ndarray:
    return solve_ivp(
        rate, (0, END), initial, method="DOP853", rtol=1e-7, atol=1e-9, max_step=step, t_eval=TIMES
    ).y  # fmt: skip


@cache
def of_system(system: DitherSystem, frequency: int) -> np.ndarray:
    return solve(numbers(system.to_system().rhs, frequency), INITIAL, 2 * np.pi / frequency / 6)


def slope(
    correction: Correction, *, drift: bool = True, shift: bool = True, start: bool = True, scale: int = 1
) -> float:
    """The order of the largest error in 1/ω, by a fit over the frequencies."""
    errors = []
    for frequency in (entry // scale for entry in FREQUENCIES):
        full = of_system(correction.system, frequency)
        initial = numbers(correction.initial_state, frequency)(0.0, INITIAL) if start else INITIAL
        averaged = correction.corrected_average if drift else correction.average
        mean = solve(numbers(averaged.rhs, frequency), initial)
        first_order = numbers(correction.expressions, frequency)
        guess = np.array([first_order(t, y) for t, y in zip(TIMES, mean.T, strict=True)]).T if shift else mean
        errors.append(np.linalg.norm(full - guess, axis=0).max())
    return float(-np.polyfit(np.log(FREQUENCIES), np.log(errors), 1)[0])


RESONANT = seeker(s(theta), c(2 * theta))


@pytest.mark.parametrize(
    "dithers",
    [(c(theta), s(theta)), (s(theta), c(2 * theta)), (s(theta) + c(tau) * s(2 * theta) / 2, c(2 * theta))],
    ids=str,
)
def test_the_corrected_average_is_one_order_better(dithers: tuple[sp.Expr, ...]) -> None:
    assert slope(first_correction(seeker(*dithers))) == pytest.approx(1, abs=0.15)


def test_with_piecewise_dithers_as_well() -> None:
    correction = first_correction(seeker(PULSES, SQUARE))
    assert any(correction.drift)
    assert slope(correction, scale=2) == pytest.approx(1, abs=0.2)


@pytest.mark.parametrize("left_out", ["drift", "shift", "start"])
def test_without_any_one_term_the_order_is_one_half(left_out: str) -> None:
    correction = first_correction(RESONANT)
    assert slope(correction, **{left_out: False}) == pytest.approx(0.5, abs=0.2)


def test_the_drift_vanishes_for_one_harmonic_and_not_for_two() -> None:
    assert not any(first_correction(seeker(c(theta), s(theta))).drift)
    assert any(first_correction(RESONANT).drift)


def test_the_drift_is_minus_the_definition_by_hand() -> None:
    # One field is constant, the other linear: [[b1, b2], b1] = 0 and [[b1, b2], b2] is computed by hand.
    y = sp.Symbol("y", real=True)
    system = DitherSystem(tau, theta, omega, (y,), (0,), ((1,), (y**2 / 2,)), (s(theta), c(2 * theta)))
    correction = first_correction(system)
    # U1 = −cos θ, U2 = sin 2θ / 2; ⟨u2 U1²⟩ = 1/4, ⟨u1 U1 U2⟩ = −1/8; [b1, b2] = y, [[b1, b2], b1] = −1.
    assert correction.drift == (R(1, 3) * (R(1, 4) + R(1, 8)),)


def test_the_antiderivative_has_zero_mean_and_the_right_slope() -> None:
    found = signals(seeker(SQUARE, PULSES))
    for signal in found:
        assert sp.simplify(signal.primitive.mean) == 0
        for piece, rate in zip(signal.primitive.pieces, signal.pieces, strict=True):
            assert is_zero(sp.diff(piece.expression(theta), theta) - rate.expression(theta))


def test_the_piecewise_antiderivative_is_continuous() -> None:
    primitive = signals(seeker(PULSES, SQUARE))[0].primitive
    for place, (left, right) in enumerate(zip(primitive.pieces, primitive.pieces[1:], strict=False), start=1):
        assert is_zero(left.at(primitive.points[place]) - right.at(primitive.points[place]))
    assert is_zero(primitive.pieces[0].at(sp.S.Zero) - primitive.pieces[-1].at(primitive.period))


def test_expressions_for_the_unicycle() -> None:
    k = sp.Symbol("k", positive=True)
    F = sp.Function("F", real=True)(x1, x2)
    fields = ((c(k * F), -s(k * F)), (s(k * F), c(k * F)))
    correction = first_correction(DitherSystem(tau, theta, omega, x, (0, 0), fields, (c(theta), s(theta))))
    turn = omega * tau - k * F
    assert not any(correction.drift)
    for entry, expected in zip(
        correction.expressions, (x1 + s(turn) / sp.sqrt(omega), x2 - c(turn) / sp.sqrt(omega)), strict=True
    ):
        assert is_zero(entry - expected)
    for entry, symbol, at_start in zip(correction.expressions, x, correction.initial_state, strict=True):
        assert is_zero(entry + at_start - 2 * symbol)


def test_the_correction_needs_one_order_of_smoothness_more() -> None:
    assert first_correction(RESONANT).hypotheses().verdict is Verdict.PROVED
    kinked = DitherSystem(
        tau, theta, omega, (x1,), (0,), ((1,), (x1 * sp.Abs(x1) ** 2 + sp.Abs(x1) ** 3,)), (c(theta), s(theta))
    )
    assert study(kinked).ledger.verdict is Verdict.PROVED
    assert first_correction(kinked).hypotheses().verdict is Verdict.REFUTED


def test_the_full_equation_extends_pieces_periodically() -> None:
    system = DitherSystem(tau, theta, omega, (x1,), (0,), ((1,),), (SQUARE,))
    rate = sp.lambdify((tau, omega), system.to_system().rhs[0])
    assert [float(rate(t, 1)) for t in (1, 4, 7, 11, -1)] == [1, -1, 1, -1, -1]


def test_sympy_prints_multiples_of_mod_wrongly() -> None:
    # The reason why periodic extensions are written with floor; −2 Mod(5, π) is −2·(5 − π).
    value = sp.lambdify(tau, -2 * sp.Mod(5 * tau, sp.pi), "math")(1.0)
    assert abs(value - -2 * (5 - np.pi)) > 1
