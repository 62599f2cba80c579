"""python-control objects: any system, a seeker, its block diagram, the linearization at the source."""

import numpy as np
import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.problem import example
from ptproof.simulation import block_diagram, linearize_at_source, simulate, to_control
from ptproof.system import System


@pytest.fixture
def control():
    """Imported where it is used: it takes seconds, which each of pytest's workers would spend to collect."""
    import control

    return control


def test_a_system_responds_as_in_the_simulation(control):
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


def test_the_responses_agree_with_the_filter_in_dilated_time(control):
    problem = example("vanishing")
    loop = block_diagram(problem)
    start = [-2, -2, 0, float(problem.measured)]
    response = control.input_output_response(
        loop, np.linspace(0, 0.02, 3), X0=start, solve_ivp_method="LSODA", solve_ivp_kwargs={"rtol": 1e-9, "atol": 1e-9}
    )
    ours = simulate(problem, until=0.02, samples=2)
    assert np.max(np.abs(response.states - ours.x)) < 1e-6
    assert response.outputs[1] == pytest.approx(ours["u1"], rel=1e-9)


def test_an_example_s_closed_loop_has_its_own_numbers():
    loop, reduced = to_control("vanishing"), to_control("vanishing", {"k": "3"}, frame="tau", coordinates="reduced")
    assert loop.state_labels == ["x1", "x2", "theta", "z"]
    assert loop.params["k"] == 1.8
    assert (reduced.nstates, reduced.params["k"]) == (3, 3.0)
    system = example("vanishing").closed_loop("pt", "t")
    truth = [
        float(entry.subs(dict(zip(system.state, (1, 2, 3, 4), strict=True)) | {system.time: 0.5}))
        for entry in system.rhs
    ]
    assert loop.dynamics(0.5, [1, 2, 3, 4], []) == pytest.approx(truth)


def test_the_linearization_is_the_paper_s_matrix():
    # (E + k/2) Hessian with E = -I: (0.9 - 1) (-diag(2 pi^2/9 + 1, 1)) at the start, where K = 1.
    A = linearize_at_source(example("vanishing")).A
    assert np.allclose(A, 0.1 * np.diag([2 * np.pi**2 / 9 + 1, 1]), rtol=1e-12)
    late = linearize_at_source(example("vanishing"), time=sp.Rational(9, 10)).A
    assert np.all(np.linalg.eigvals(late) < 0)


def test_an_instant_given_as_text_is_exact():
    assert np.array_equal(
        linearize_at_source("vanishing", time="9/10").A, linearize_at_source("vanishing", time=sp.Rational(9, 10)).A
    )


def test_what_is_no_problem_is_named():
    with pytest.raises(InputError, match="expected a problem or an example's name, got int"):
        to_control(3)
