"""The flow against the closed loop that is integrated: SymPy's derivatives along its right-hand side."""

from dataclasses import replace

import pytest
import sympy as sp
from flint import acb, arb

from ptproof.balls.ball import ball_from, precision
from ptproof.certify.loop.flow import Flow
from ptproof.certify.loop.jets import FIELD
from ptproof.certify.loop.lyapunov import lyapunov
from ptproof.certify.loop.polynomials import ZERO, Letter, collected, term
from ptproof.certify.loop.setup import jets_of, numbers, phases
from ptproof.problem import Problem
from ptproof.problem.drift import bounded_drift, gradient_drift, no_drift
from ptproof.problem.field import Field
from ptproof.problem.model import TIME, Initial, Tuning

x1, x2 = sp.symbols("x1 x2", real=True)
HILL = 2 - x1**2 - 2 * (x2 - 1) ** 2 - x1**4 / 5 + x1 * x2 / 7
DRIFTS = {
    "none": no_drift(),
    "gradient": gradient_drift([[-1, sp.Rational(1, 2)], [0, 1]], HILL, (x1, x2)),
    "bounded": bounded_drift([(1 + TIME) * x2, TIME**2 - x1]),
}
POINT = {"x": (sp.Rational(2, 3), sp.Rational(7, 5)), "theta": sp.Rational(9, 4), "g": sp.Rational(1, 3)}


def problem_of(drift):
    tuning = Tuning(
        k=sp.Rational(7, 5), omega=sp.Integer(9), mu=sp.Rational(1, 100), T=sp.Integer(1), nu_min=sp.Rational(1, 2)
    )
    return Problem(Field((x1, x2), HILL, (0, 1), 1), DRIFTS[drift], tuning, Initial((1, 1)))


def made(drift, phase=0):
    problem = problem_of(drift)
    span = phases(problem)[phase]
    values = numbers(problem)
    matrix = problem.drift.matrix
    rows = None if matrix is None else tuple(tuple(ball_from(item) for item in matrix.row(i)) for i in (0, 1))
    flow = Flow(jets_of(problem, span, 4), values["k"], values["m"], rows, drift != "none", ZERO)
    return problem, span, lyapunov(flow, term(acb(-1), Letter(FIELD)), 3, 1, 0.25)


def exact(ball):
    return sp.Float(str(ball.real.mid().str(40, radius=False)), 40) + sp.I * sp.Float(
        ball.imag.mid().str(40, radius=False), 40
    )


def symbolic(part, jets, heading, q, delta):
    return sp.Add(*(
        exact(value) * delta**g * sp.exp(sp.I * n * heading) * q**p * sp.Mul(*map(jets.expression, letters))
        for (g, n, p, letters), value in part.items()
    ))  # fmt: skip


@pytest.mark.parametrize("phase", [0, 1])
@pytest.mark.parametrize("drift", DRIFTS)
def test_the_rate_is_the_derivative_along_the_closed_loop(drift, phase):
    with precision(160):
        assert abs(difference(drift, phase)) < sp.Float("1e-25")


def test_a_flow_without_its_drift_is_another_one():
    with precision(160):
        assert abs(difference("gradient", 0, drifting=False)) > sp.Float("1e-6")


def difference(drift, phase, drifting=True):
    """dW/dτ by SymPy from the problem's own right-hand side, minus the polynomial of the rate, at one point."""
    problem, span, found = made(drift, phase)
    rate = found.flow.derivative(found.function)
    if not drifting:
        rate = replace(found.flow, drifting=False).derivative(found.function)
    tuning, states = problem.tuning, problem.states
    delta, jets, heading = 1 / sp.sqrt(tuning.omega), found.flow.jets, states.heading
    centre = (x1 - delta * sp.sin(heading), x2 - 1 + delta * sp.cos(heading))
    moved = dict(zip(jets.position, centre, strict=True))
    g = (problem.field.expression - states.filter) / (tuning.mu * sp.sqrt(tuning.omega))
    q = sp.Symbol("q")
    manifold = symbolic(found.flow.manifold, jets, heading, sp.S.One, delta).subs(moved, simultaneous=True)
    parts = (
        symbolic(part, jets, heading, q, delta).subs(moved, simultaneous=True).subs(q, g - manifold)
        for part in (found.function, rate)
    )
    function, claimed = parts
    system = problem.closed_loop("pt", "t")
    time = span.start + (span.end - span.start) / 3
    derivative = sum(function.diff(state) * entry for state, entry in zip(system.state, system.rhs, strict=True))
    derivative = (derivative + function.diff(TIME)) / span.rate
    at = dict(zip(states.position, POINT["x"], strict=True)) | {heading: POINT["theta"], TIME: time}
    at[states.filter] = problem.field.value(POINT["x"]) - POINT["g"] * tuning.mu * sp.sqrt(tuning.omega)
    return sp.N((derivative - claimed / delta**2).subs(at), 40)


def test_w_has_no_letter_that_jumps_at_the_clip():
    with precision(128):
        _, _, found = made("bounded")
    assert not any(letter.late for key in found.function for letter in key[3])


def test_low_orders_are_left_with_their_mean_alone():
    with precision(128):
        _, _, found = made("gradient")
    left = [abs(complex(value)) for key, value in found.rate_rest.items() if key[0] < 2 and key[1] and not key[2]]
    assert max(left) < 1e-10


def test_sums_leave_out_what_is_zero_and_keep_what_may_not_be():
    key = (0, 0, 0, ())
    assert collected([(key, acb(0))]) == {}
    assert list(collected([(key, acb(arb(0, 1e-20)))])) == [key]
