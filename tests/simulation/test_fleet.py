"""Many vehicles with their whole way: the same by every engine, and nobody lost out of sight."""

from dataclasses import replace

import numpy as np
import pytest
import sympy as sp

from ptproof.problem import example
from ptproof.simulation.attack import outside_of
from ptproof.simulation.fleet import fleet, starts
from ptproof.simulation.plan import Engine
from ptproof.simulation.question import Question
from ptproof.simulation.run import prepared, simulate
from ptproof.simulation.settings import Settings
from ptproof.system import System


def tuned(**numbers):
    problem = example("vanishing")
    return replace(problem, tuning=replace(problem.tuning, **{k: sp.sympify(v) for k, v in numbers.items()}))


def test_the_distances_are_as_exact_as_is_said():
    problem, gap = example("vanishing"), 0.05
    many = fleet(problem, 11, radius=2.0, filter_gap=gap, samples=20, workers=2)
    begin = starts(problem, 11, 2.0, gap, 0)
    run = simulate(
        problem, frame="tau", engine="lsoda", rtol=1e-10, samples=20, initial={k: v[9] for k, v in begin.items()}
    )
    distances = np.hypot(run["x1"], run["x2"])
    assert np.allclose(run.t, many.times, atol=1e-12)
    assert many.error < 1e-9
    assert np.abs(distances - many.distances[9]).max() < 1e-7


def test_every_start_is_allowed_and_the_ends_are_met():
    problem = example("vanishing")
    begin = starts(problem, 500, 2.0, 0.1, 3)
    distance = np.hypot(begin["x1"], begin["x2"])
    field = sp.lambdify(problem.variables, problem.field.expression)
    off = begin["z"] - field(begin["x1"], begin["x2"])
    assert distance.max() == pytest.approx(2.0)
    assert (distance <= 2.0 + 1e-12).all()
    assert off.min() == pytest.approx(-0.1)
    assert off.max() == pytest.approx(0.1)


def test_one_by_one_is_the_same_as_in_groups():
    problem = example("vanishing")
    job = prepared(
        Question(problem, "pt", "tau"), Settings(rtol=1e-9, samples=10, engine="heyoka"), None, 10,
        starts(problem, 10, 1.0, 0.0, 0),
    )  # fmt: skip
    together = job.way(1)
    from ptproof.simulation.engines import engine_named

    alone = Engine.paths(engine_named("heyoka"), job.plan, job.batch)
    assert np.array_equal(together.time, alone.time)
    assert np.abs(together.x - alone.x).max() < 1e-8


def test_a_gain_without_a_clip_is_followed_to_a_tenth():
    problem = example("vanishing")
    many = fleet(replace(problem, tuning=replace(problem.tuning, nu_min=None)), 8, radius=1.0, samples=5, workers=1)
    assert many.times[-1] == pytest.approx(0.9)
    assert np.isfinite(many.distances).all()


def test_who_gets_lost_is_outside():
    bound, distances = np.ones(3), np.full((4, 3), 0.5)
    assert outside_of(bound, distances) == 0
    distances[2, 2] = np.nan
    distances[3, 1] = 1.1
    assert outside_of(bound, distances) == 2


@pytest.mark.parametrize("engine", ["heyoka", "lsoda"])
def test_who_escapes_has_no_state_from_there_on(engine):
    t, x = sp.symbols("t x", real=True)
    question = Question(System(t, (x,), (x**2,)), initial=[0], span=(0, 2))
    starts = np.array([-1.0, 1.0, 0.25])
    found = prepared(question, Settings(samples=9, engine=engine), None, 3, {"x": starts}).way(1)
    left = 1 - np.outer(starts, found.time)
    exact = starts[:, None] / np.where(left > 0, left, np.nan)
    reached = np.isfinite(found.x[0])
    assert np.array_equal(reached, np.isfinite(exact))
    assert np.allclose(found.x[0][reached], exact[reached], rtol=1e-6)
