"""python-control objects: any system, the block diagram in both readings, the linearization at the source."""

import control
import numpy as np
import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.problem import example
from ptproof.simulation.blocks import compare_figure, figure_loop, linearize_at_source, to_control, washout_transfer
from ptproof.simulation.run import simulate
from ptproof.system import System


def test_a_system_responds_as_in_the_simulation():
    problem = example("vanishing")
    average = problem.averaged("pt", "t")
    times = np.linspace(0, 0.5, 6)
    response = control.input_output_response(
        to_control(average), times, X0=[-2, -2], solve_ivp_kwargs={"rtol": 1e-10, "atol": 1e-10}
    )
    ours = simulate(problem, model="average", until=0.5, samples=5)
    assert np.max(np.abs(response.outputs - ours.x)) < 1e-7


def test_parameters_are_the_object_s_parameters():
    t, x = sp.symbols("t x", real=True)
    k = sp.Symbol("k", positive=True)
    made = to_control(System(t, (x,), (-k * x,)), {"k": 2})
    assert made.dynamics(0, [3], []) == pytest.approx([-6])
    assert made.dynamics(0, [3], [], params={"k": 5}) == pytest.approx([-15])
    with pytest.raises(InputError, match="no value for k"):
        to_control(System(t, (x,), (-k * x,)))


@pytest.fixture(scope="module", params=["vanishing", "nonvanishing"])
def comparison(request):
    return compare_figure(example(request.param), points=20)


def test_with_the_filter_in_dilated_time_the_figure_is_the_closed_loop(comparison):
    assert comparison.rhs_dilated < 1e-12


def test_as_drawn_the_figure_is_not_the_closed_loop(comparison):
    assert comparison.rhs_drawn > 0.1
    assert comparison.largest_gap > 0.05


def test_the_responses_agree_with_the_filter_in_dilated_time():
    problem = example("vanishing")
    loop = figure_loop(problem, dilated_filter=True)
    start = [-2, -2, 0, float(problem.measured)]
    response = control.input_output_response(
        loop, np.linspace(0, 0.02, 3), X0=start, solve_ivp_method="LSODA", solve_ivp_kwargs={"rtol": 1e-9, "atol": 1e-9}
    )
    ours = simulate(problem, until=0.02, samples=2)
    assert np.max(np.abs(response.states - ours.x)) < 1e-6
    assert response.outputs[1] == pytest.approx(ours["u1"], rel=1e-9)


def test_the_filter_as_drawn_is_the_printed_transfer_function():
    problem = example("vanishing")
    printed = washout_transfer(problem)
    mu = float(problem.tuning.mu)
    built = control.ss([[-1 / mu]], [[1 / mu]], [[-1 / mu]], [[1 / mu]])
    for s in (1j, 300j, 2 + 1000j):
        assert built(s) == pytest.approx(printed(s), rel=1e-12)


def test_the_linearization_is_the_paper_s_matrix():
    # (E + k/2) Hessian with E = -I: (0.9 - 1) (-diag(2 pi^2/9 + 1, 1)) at the start, where K = 1.
    A = linearize_at_source(example("vanishing")).A
    assert np.allclose(A, 0.1 * np.diag([2 * np.pi**2 / 9 + 1, 1]), rtol=1e-12)
    late = linearize_at_source(example("vanishing"), time=sp.Rational(9, 10)).A
    assert np.all(np.linalg.eigvals(late) < 0)
