"""One trajectory: known truths, an independent code, frames, engines, outcomes, and bad input."""

import itertools
import math
import re
from dataclasses import replace

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp

import ptproof
from ptproof.errors import InputError
from ptproof.problem import example
from ptproof.simulation import Limit, Outcome, Question, Settings, ensemble, simulate
from ptproof.simulation.drawing import BLUE
from ptproof.simulation.engines import names
from ptproof.system import System
from tests.pictures import shown

t, x, y = sp.symbols("t x y", real=True)
k = sp.Symbol("k", positive=True)


@pytest.mark.parametrize("engine", names())
def test_the_papers_scalar_example_has_its_closed_form(engine):
    # eq:pt_example with T = 2, stopped before T: x0 exp(-k (t - t0)/nu).
    system = System(t, (x,), (-k * x / (1 - t / 2) ** 2,))
    run = simulate(system, initial=[3], span=(0, 1.6), parameters={k: 0.5}, engine=engine, rtol=1e-10)
    assert run.outcome is Outcome.REACHED
    assert np.max(np.abs(run.x[0] - 3 * np.exp(-0.5 * run.t / (1 - run.t / 2)))) < 3e-9


@pytest.mark.parametrize("engine", names())
def test_a_rotation_keeps_its_radius(engine):
    run = simulate(System(t, (x, y), (-y, x)), initial={"x": 1, "y": 0}, span=(0, 20), engine=engine, rtol=1e-9)
    assert np.max(np.abs(run["x"] - np.cos(run.t))) < 1e-7


# Independent of everything here: the right-hand sides written by hand, scipy's DOP853 at 1e-12, restarted at the clip.
def vanishing(gain):
    def rhs(time, state):
        x1, x2, th, z = state
        K = gain(time)
        F = 2.5 + 0.5 * math.cos(2 * math.pi / 3 * x1) - 0.5 * (x1 * x1 + x2 * x2)
        fx, fy = math.pi / 3 * math.sin(2 * math.pi / 3 * x1) + x1, x2
        return [
            fx + K * math.sqrt(30) * math.cos(th), fy + K * math.sqrt(30) * math.sin(th),
            K * (30 - 1800 * (F - z)), K * 1000 * (F - z),
        ]  # fmt: skip

    return rhs


def integrate(rhs, state, *edges, method="DOP853"):
    for a, b in itertools.pairwise(edges):
        state = solve_ivp(rhs, (a, b), state, method=method, rtol=1e-12, atol=1e-12).y[:, -1]
    return state


@pytest.fixture(scope="module")
def vanishing_truth():
    start = [-2, -2, 0, 2.5 - 0.25 - 4]
    pt = integrate(vanishing(lambda s: 1 / max(0.3, 1 - s) ** 2), start, 0, 0.7, 1, method="LSODA")
    return pt, integrate(vanishing(lambda s: 1.0), start, 0, 1, method="LSODA")


FRAMES = [("t", "full"), ("t", "reduced"), ("tau", "full"), ("tau", "reduced")]


@pytest.mark.parametrize(("frame", "coordinates"), FRAMES)
@pytest.mark.parametrize("engine", ["casadi", "heyoka"])
def test_every_frame_and_engine_ends_where_an_independent_code_does(vanishing_truth, frame, coordinates, engine):
    run = simulate("vanishing", frame=frame, coordinates=coordinates, engine=engine, rtol=1e-9, samples=50)
    assert run.outcome is Outcome.REACHED
    assert run.t[-1] == pytest.approx(1, abs=1e-12)
    truth = vanishing_truth[0]
    expected = truth if coordinates == "full" else truth[[0, 1, 3]]
    assert np.max(np.abs(run.x[:, -1] - expected)) < 2e-7
    assert np.max(np.abs(run.x[:2, -1] - truth[:2])) < 5e-9
    assert run.final_distance == pytest.approx(math.hypot(*truth[:2]), abs=5e-9)


def test_the_asymptotic_seeker_ends_where_an_independent_code_does(vanishing_truth):
    run = simulate("vanishing", "asymptotic", rtol=1e-9)
    # The repulsive drift amplifies every error by a factor of about a hundred on the way.
    assert np.max(np.abs(run.x[:2, -1] - vanishing_truth[1][:2])) < 2e-8


@pytest.mark.parametrize("until", [0.3, 1.4, 2.0])
def test_the_frames_agree_at_common_instants(until):
    ends = [simulate("nonvanishing", frame=f, coordinates=c, rtol=1e-9, until=until, samples=3) for f, c in FRAMES]
    for end in ends[1:]:
        assert np.max(np.abs(end.x[:2, -1] - ends[0].x[:2, -1])) < 1e-8
        assert end.t[-1] == pytest.approx(until, abs=1e-12)


def test_the_frames_agree_along_the_whole_way():
    runs = [simulate("nonvanishing", frame=frame, coordinates=c, rtol=1e-9) for frame, c in FRAMES]
    for one, other in (runs[:2], runs[2:]):
        assert np.array_equal(one.t, other.t)
        assert np.max(np.abs(one.x[:2] - other.x[:2])) < 1e-7
    assert np.max(np.abs(runs[0].tau[[0, -1]] - runs[2].tau[[0, -1]])) < 1e-12


def test_the_saturated_seekers_end_where_an_independent_code_does():
    def rhs_with(gain):
        def rhs(time, state):
            _x1, _x2, th, u2, z = state
            C, F = gain(time), -0.5 * (state[0] ** 2 + state[1] ** 2)
            u = -u2 + C * (30 - 1400 * (F - z))
            return [
                C * math.sqrt(30) * math.cos(th), C * math.sqrt(30) * math.sin(th), u2,
                min(4.0, max(-4.0, u)) / 0.0004, C * 1000 * (F - z),
            ]  # fmt: skip

        return rhs

    start = [2, 2, 0, 0, -4]
    for seeker, gain in (("saturated", lambda s: 1 / max(0.3, 1 - s) ** 2), ("saturated-constant", lambda _: 11.11)):
        truth = integrate(rhs_with(gain), start, 0, 0.3, method="LSODA")
        run = simulate("saturated", seeker, until=0.3, rtol=1e-9)
        assert np.max(np.abs(run.x[:2, -1] - truth[:2])) < 1e-6


def test_average_and_reduced_model_run_too():
    average = simulate("vanishing", model="average")
    # Averaged, x2 obeys dx2/dt = (1 - K k/2) x2, whose integral is in closed form.
    tau = 7 / 3 + 0.3 / 0.09
    assert average["x2"][-1] == pytest.approx(-2 * math.exp(1 - 0.9 * tau), rel=1e-6)
    reduced, full = simulate("vanishing", model="reduced model"), simulate("vanishing")
    assert np.max(np.abs(reduced.x[:, -1] - full.x[:2, -1])) < 0.05


def test_the_boundary_layer_decays():
    from ptproof.problem import SEEKERS, parameters
    from ptproof.problem.loops import reduced_loop
    from ptproof.transforms import split

    problem = example("vanishing")
    loop = reduced_loop(problem.field.expression, problem.drift, SEEKERS["pt"].law, problem.states)
    parts = split(loop, [problem.states.filter], parameters.mu)
    layer = parts.boundary_layer([y], t).with_values({sp.Symbol("K", positive=True): 1})
    run = simulate(layer, initial=[2], span=(0, 3))
    assert run["y"][-1] == pytest.approx(2 * math.exp(-3), rel=1e-7)


@pytest.mark.parametrize("engine", ["casadi", "lsoda", "radau", "heyoka"])
def test_an_escape_in_finite_time_is_an_outcome_with_its_time(engine):
    run = simulate(System(t, (x,), (x**3,)), initial=[1], span=(0, 1), engine=engine, samples=50)
    assert run.outcome is Outcome.ESCAPED
    assert run.t[-1] == pytest.approx(0.5, abs=1e-6)


def test_growth_that_is_not_an_escape_goes_through():
    run = simulate(System(t, (x,), (x,)), initial=[1], span=(0, 10))
    assert run.outcome is Outcome.REACHED
    assert run.final_distance == pytest.approx(math.exp(10), rel=1e-6)


def test_a_rate_that_is_not_defined_is_a_failure():
    run = simulate(System(t, (x,), (-sp.sqrt(x),)), initial=[1], span=(0, 5), samples=50)
    assert run.outcome is Outcome.FAILED


def test_too_much_work_is_a_limit():
    problem = example("vanishing")
    hard = replace(problem, tuning=replace(problem.tuning, omega=10**7))
    run = simulate(hard, engine="casadi", time_limit=1.0)
    assert run.outcome is Outcome.STEP_LIMIT
    assert run.limit is Limit.TIME
    assert re.search(r"time limit of 1 s was met at t = .*; a larger time_limit", run.message)
    assert run.seconds < 20


@pytest.mark.parametrize("engine", names())
def test_a_limit_on_steps_is_kept_and_named(engine):
    run = simulate("vanishing", engine=engine, max_steps=100, samples=20)
    assert (run.outcome, run.limit) == (Outcome.STEP_LIMIT, Limit.STEPS)
    assert "step limit of 100 steps was met at t = " in run.message
    assert run.t[-1] < 1


def test_an_unclipped_gain_stops_before_T_and_says_so():
    problem = example("vanishing")
    ideal = replace(problem, tuning=replace(problem.tuning, nu_min=None))
    for frame in ("t", "tau"):
        run = simulate(ideal, frame=frame, nu_end=0.1)
        assert run.outcome is Outcome.STEP_LIMIT
        assert run.limit is Limit.GAIN
        assert "infinite at T" in run.message
        assert run.t[-1] == pytest.approx(0.9, abs=1e-9)


@pytest.mark.parametrize("T", [sp.Rational(1, 1000), 60])
def test_very_short_and_long_times_reach_T(T):
    problem = example("saturated")
    run = simulate(replace(problem, tuning=replace(problem.tuning, T=T)), model="average")
    assert run.outcome is Outcome.REACHED
    assert run.t[-1] == pytest.approx(float(T))


def test_a_high_frequency_goes_to_the_fast_engine():
    problem = example("saturated")
    fast = replace(problem, tuning=replace(problem.tuning, omega=10**5))
    run = simulate(fast, samples=20)
    assert run.settings["engine"] == "heyoka"
    assert run.outcome is Outcome.REACHED


def test_many_turns_do_not_cost_accuracy():
    # The heading turns by 11,000 radians; an error relative to it would be seen in the position.
    problem = example("saturated")
    fast = replace(problem, tuning=replace(problem.tuning, omega=2000))
    ends = [
        simulate(fast, frame=frame, coordinates=coordinates, engine=engine, samples=5).x[:2, -1]
        for frame, coordinates, engine in (
            ("t", "full", "heyoka"),
            ("tau", "reduced", "heyoka"),
            ("tau", "full", "casadi"),
        )
    ]
    assert np.max(np.abs(ends[0] - ends[1])) < 1e-8
    assert np.max(np.abs(ends[0] - ends[2])) < 1e-7


def test_a_second_run_with_other_values_builds_nothing():
    from ptproof.simulation.engines import casadi

    problem = example("nonvanishing")
    simulate(problem, samples=123)
    built = casadi.integrator.cache_info().misses
    other = replace(
        problem, tuning=replace(problem.tuning, k=3, T=1, omega=77), initial=replace(problem.initial, theta=1)
    )
    second = simulate(other, samples=123)
    simulate(problem, samples=123, parameters={"mu": 0.002}, initial={"x1": 0.5})
    assert casadi.integrator.cache_info().misses == built
    assert second.final_distance != simulate(problem, samples=123).final_distance


BAD = {
    "unknown seeker": ({"target": "vanishing", "seeker": "fast"}, "seeker: 'fast'"),
    "unknown engine": ({"target": "vanishing", "engine": "euler"}, "engine: 'euler'"),
    "unknown frame": ({"target": "vanishing", "frame": "s"}, "frame: 's'"),
    "unknown model": ({"target": "vanishing", "model": "mean"}, "model: 'mean'"),
    "unknown example": ({"target": "vanish"}, "not an example"),
    "no problem": ({"target": 3}, "expected a problem"),
    "span for a problem": ({"target": "vanishing", "span": (0, 1)}, "span"),
    "nan parameter": ({"target": "vanishing", "parameters": {"k": float("nan")}}, "k: expected a finite number"),
    "infinite state": ({"target": "vanishing", "initial": {"x1": float("inf")}}, "x1: expected a finite number"),
    "negative": ({"target": "vanishing", "parameters": {"mu": -1}}, "mu: must be positive"),
    "nu_min": ({"target": "vanishing", "parameters": {"nu_min": 2}}, "nu_min: must lie in"),
    "unknown name": ({"target": "vanishing", "parameters": {"kk": 1}}, "'kk' is not one of"),
    "rtol": ({"target": "vanishing", "rtol": 0}, "rtol: expected a number between"),
    "until": ({"target": "vanishing", "until": 0}, "until: must be after"),
    "ensemble": ({"target": "vanishing", "size": 0}, "size: an ensemble has from 1 to"),
    "seed": ({"target": "vanishing", "size": 2, "seed": -1}, "seed: expected"),
    "vary": ({"target": "vanishing", "size": 2, "vary": {"w": (0, 1)}}, "vary: 'w'"),
    "vary upside down": ({"target": "vanishing", "size": 2, "vary": {"k": (2, 1)}}, "vary.k: low must not be above"),
    "vary by text": ({"target": "vanishing", "size": 2, "vary": {"k": "12"}}, r"vary.k: expected \(low, high\) or 2"),
    "heyoka and a kink": ({"target": "saturated", "seeker": "saturated", "engine": "heyoka"}, "kink"),
}  # fmt: skip


@pytest.mark.parametrize("case", BAD)
def test_bad_input_is_named(case):
    arguments, message = BAD[case]
    with pytest.raises(InputError, match=message):
        (ensemble if "size" in arguments else simulate)(**arguments)


def test_a_question_is_a_value_that_options_can_change():
    question = Question("vanishing", model="average", parameters={"k": "9/5"})
    run = simulate(question, settings=Settings(samples=10), rtol="1e-9")
    assert run.settings["rtol"] == 1e-9
    assert np.array_equal(run.x, simulate("vanishing", model="average", samples=10, rtol=1e-9).x)
    assert simulate(question, frame="tau").settings["frame"] == "tau"
    assert ensemble(question, 3, seed=1).settings["model"] == "average"


def test_an_option_that_there_is_none_of_is_named():
    with pytest.raises(TypeError, match="'rtoll' is not an option of a simulation"):
        simulate("vanishing", rtoll=1e-9)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({}, "needs initial="),
        ({"initial": [1], "span": (1, 0)}, "end after it starts"),
        ({"initial": [1, 2], "span": (0, 1)}, "2 numbers for 1 states"),
        ({"initial": [math.nan], "span": (0, 1)}, "finite"),
        ({"initial": [1], "span": (0, math.inf)}, "finite"),
        ({"initial": {"q": 1}, "span": (0, 1)}, "no value for x"),
        ({"initial": [1], "span": (0, 1), "parameters": {"k": 1}}, "k is not one of"),
    ],
)
def test_bad_input_for_a_system_is_named(arguments, message):
    with pytest.raises(InputError, match=message):
        simulate(System(t, (x,), (-x,)), **arguments)


def test_an_undefined_function_is_named():
    with pytest.raises(InputError, match=r"F\(x\) undefined"):
        simulate(System(t, (x,), (sp.Function("F")(x),)), initial=[1], span=(0, 1))


def test_the_package_exports_it():
    assert ptproof.simulate is simulate
    assert ptproof.example("vanishing").name == "vanishing"


def test_a_trajectory_shows_itself(saved):
    run = simulate("vanishing", samples=100)
    picture = run._repr_png_()
    assert shown(picture, saved[0].axes[0], *run.x[:2], BLUE) > 0.9
    assert "reached T" in run._repr_html_()
    assert "reached T" in repr(run)
    assert run["u1"].max() == pytest.approx(math.sqrt(30) / 0.09)
    with pytest.raises(InputError, match="'w' is not part"):
        run["w"]
