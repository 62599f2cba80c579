"""The flow against the closed loop that is integrated: SymPy's derivatives along its right-hand side."""

from dataclasses import replace

import mpmath
import pytest
import sympy as sp
from flint import acb, arb

from ptproof.balls.ball import ball_from, precision
from ptproof.certify.loop.flow import Flow, lyapunov
from ptproof.certify.loop.jets import FIELD
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


def number(ball):
    return mpmath.mpc(str(ball.real.mid().str(50, radius=False)), str(ball.imag.mid().str(50, radius=False)))


def value(part, letters, heading, q, delta):
    """A polynomial at numbers."""
    return mpmath.fsum(
        number(factor) * delta**g * mpmath.expj(n * heading) * q**p * mpmath.fprod(letters[item] for item in names)
        for (g, n, p, names), factor in part.items()
    )


@pytest.mark.parametrize("phase", [0, 1])
@pytest.mark.parametrize("drift", DRIFTS)
def test_the_rate_is_the_derivative_along_the_closed_loop(drift, phase):
    with precision(160):
        assert difference(drift, phase) < 1e-20


def test_a_flow_without_its_drift_is_another_one():
    with precision(160):
        assert difference("gradient", 0, drifting=False) > 1e-6


def difference(drift, phase, drifting=True):
    """dW/dτ by differences along the problem's own right-hand side, minus the polynomial of the rate, at one point."""
    problem, span, found = made(drift, phase)
    jets, tuning = found.flow.jets, problem.tuning
    rate = replace(found.flow, drifting=drifting).derivative(found.function)
    names = sorted({item for part in (found.function, rate, found.flow.manifold) for key in part for item in key[3]})
    table = sp.lambdify((*jets.position, jets.time), [jets.expression(item) for item in names], "mpmath")
    field = sp.lambdify(problem.variables, problem.field.expression, "mpmath")
    system = problem.closed_loop("pt", "t")
    slope = sp.lambdify((TIME, *system.state), [*system.rhs], "mpmath")
    with mpmath.workdps(50):
        omega, mu = mpmath.mpf(int(tuning.omega)), mpmath.mpf(tuning.mu.p) / tuning.mu.q
        delta = 1 / mpmath.sqrt(omega)

        def at(part, time, first, second, heading, z):
            y = first - delta * mpmath.sin(heading), second - 1 + delta * mpmath.cos(heading)
            letters = dict(zip(names, table(*y, time), strict=True))
            g = (field(first, second) - z) / (mu * mpmath.sqrt(omega))
            q = g - value(found.flow.manifold, letters, heading, mpmath.mpf(1), delta)
            return value(part, letters, heading, q, delta)

        time = mpmath.mpf("0.3") if phase == 0 else mpmath.mpf("0.8")
        place = [mpmath.mpf(2) / 3, mpmath.mpf(7) / 5]
        here = [time, *place, mpmath.mpf(9) / 4, field(*place) - mu]
        step = [1, *slope(*here)]
        h = mpmath.mpf("1e-14")
        ahead, behind = ([a + sign * h * b for a, b in zip(here, step, strict=True)] for sign in (1, -1))
        along = (at(found.function, *ahead) - at(found.function, *behind)) / (2 * h)
        gain = mpmath.mpf(1) * sp.N(span.rate.subs(TIME, sp.Rational(3, 10) if phase == 0 else sp.Rational(4, 5)), 50)
        return abs(along / gain - at(rate, *here) * omega)


def test_w_has_no_letter_that_jumps_at_the_clip():
    with precision(128):
        _, _, found = made("bounded")
    assert not any(letter.late for key in found.function for letter in key[3])


def test_low_orders_are_left_with_their_mean_alone():
    with precision(128):
        _, _, found = made("gradient")
    left = [abs(complex(value)) for key, value in found.rate.items() if key[0] < 2 and key[1] and not key[2]]
    assert max(left) < 1e-10


def test_sums_leave_out_what_is_zero_and_keep_what_may_not_be():
    key = (0, 0, 0, ())
    assert collected([(key, acb(0))]) == {}
    assert list(collected([(key, acb(arb(0, 1e-20)))])) == [key]
