"""What an undecided certificate says: boxes on which the proof fails, and what would help."""

from dataclasses import replace

import numpy as np
import pytest
import sympy as sp

from ptproof.balls.ball import precision
from ptproof.certify.loop import certify_loop
from ptproof.certify.loop.boxes import Boxes
from ptproof.certify.loop.cover import rates, tried
from ptproof.certify.loop.failing import Advice, promising
from ptproof.certify.loop.scene import NoCertificate, Scene, tasks
from ptproof.certify.loop.setup import drift_factor
from ptproof.problem import example, gradient_drift
from ptproof.proof.verdict import Verdict

RADIUS = 2 * sp.sqrt(2)


def tuned(drift=None, **numbers):
    problem = example("saturated")
    given = {key: sp.Rational(value) for key, value in numbers.items()}
    made = replace(problem, tuning=replace(problem.tuning, **given))
    if drift is None:
        return made
    matrix = [[drift, sp.S.Zero], [sp.S.Zero, sp.S.Zero]]
    return replace(made, drift=gradient_drift(matrix, made.field.expression, made.variables))


def test_levels_that_are_not_closed_are_shown_where_they_are_open():
    found = certify_loop(tuned(omega=3, mu="1/100"), shapes=("distance",), explain=True, workers=1)
    assert found.verdict is Verdict.UNDECIDED
    assert 1 <= len(found.failing) <= 3
    for box in found.failing:
        assert box.rate is None
        assert max(map(abs, sum(box.position, ()))) > found.start_radius
        assert box.level[0] < 1.5 * 13.4  # what W is at most at the start, and half as much again
    assert 3 < found.help.omega <= 48  # at 48 it is proved: see below
    assert found.help.mu * found.help.omega == pytest.approx(3 / 100)


def test_what_would_help_does():
    assert certify_loop(tuned(omega=48, mu="1/1600"), tolerance=0.5, shapes=("distance",), workers=1).final < 1


def test_a_drift_that_wins_fails_where_it_points_outward():
    problem = tuned(sp.Integer(-3), omega=300, mu="1/10000")
    with precision(128), pytest.raises(NoCertificate) as caught:
        tasks(Scene.of(problem, RADIUS, sp.S.Zero, "distance"), 0.1)
    from ptproof.certify.loop.failing import failing

    with precision(128):
        boxes = failing(problem, "distance", caught.value.place)
    assert boxes
    for box in boxes:
        (left, right), (low, high) = box.position
        assert min(abs(left), abs(right)) > max(abs(low), abs(high))  # along the first axis, which the drift blows on
        assert box.rate >= 0
        assert box.rate >= box.middle
        assert 0 < box.drift_factor[0] <= box.drift_factor[1] <= 1
        assert box.time[0] < box.time[1]
        assert "dW/dtau is at most" in str(box)


def test_no_more_is_said_of_a_box_than_of_all():
    with precision(128):
        scene = Scene.of(tuned(omega=300, mu="1/10000"), RADIUS, sp.S.Zero, "distance")
        task = tasks(scene, 9.0)[0]
        bound = rates(
            task.model, scene.stage.levels, scene.stage.filter_bands, scene.stage.half, task.part.interval, (0, 0),
            task.expected(), np.inf,
        )  # fmt: skip
        band = scene.stage.levels.bands // 2
        found = tried(
            task.model, Boxes.square(scene.stage.half), scene.stage.levels, scene.stage.filter_bands,
            task.part.interval, band,
        )  # fmt: skip
    assert max(item.rate for item in found) == pytest.approx(bound[band], rel=1e-9)


def test_the_drift_factor_is_the_gain_turned_over():
    with precision(128):
        model = Scene.of(tuned(sp.Rational(-1, 10), omega=300, mu="1/10000"), RADIUS, sp.S.Zero, "distance").work[0][0]
    assert drift_factor(model.jets, 0.0, 0.5) == pytest.approx((0.25, 1.0))


def test_a_slow_filter_is_not_promising():
    assert not promising(tuned(omega=30, mu=1), RADIUS, sp.S.Zero, "distance")


def test_where_nothing_helps_that_is_said():
    assert "the drift may win" in str(Advice(None, None, None))
    assert str(Advice(48.0, 1 / 1600, None)).endswith("omega = 48 with mu = 0.000625")
