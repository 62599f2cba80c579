"""A certificate by the workers of a cluster: what is sent to them can be sent, and what they answer is the same."""

import pickle
from dataclasses import replace

import numpy as np
import pytest
import sympy as sp

from ptproof.balls.ball import precision
from ptproof.certify.loop import certify as module
from ptproof.certify.loop import certify_loop, scene, setup
from ptproof.problem import example, gradient_drift


class Elsewhere:
    """A client whose workers share nothing with us: each is sent bytes and answers with bytes."""

    def __init__(self):
        self.tasks = 0

    def map(self, function, tasks, pure):
        sent = [pickle.dumps((function, task)) for task in tasks]
        self.tasks += len(sent)
        with precision(53):  # a worker's own
            return [pickle.dumps(call(item)) for call, item in map(pickle.loads, sent)]

    def gather(self, futures):
        return [pickle.loads(item) for item in futures]


def drifting():
    problem = example("saturated")
    matrix = [[sp.Rational(-1, 10), sp.S.Zero], [sp.S.Zero, sp.S.Zero]]
    tuning = replace(problem.tuning, omega=sp.Integer(3000), mu=sp.Rational(1, 100000))
    drift = gradient_drift(matrix, problem.field.expression, problem.variables)
    return replace(problem, tuning=tuning, drift=drift)


OPTIONS = {"tolerance": 9.0, "shapes": ("distance",)}


@pytest.fixture
def pieces(monkeypatch):
    """Few of them, as each is a task."""
    monkeypatch.setattr(setup, "_PIECES", 2)


@pytest.fixture(scope="module")
def alone():
    """What one worker finds."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(setup, "_PIECES", 2)
        return certify_loop(drifting(), **OPTIONS, workers=1)


@pytest.mark.usefixtures("pieces")
def test_a_cluster_proves_the_same(alone):
    client = Elsewhere()
    there = certify_loop(drifting(), **OPTIONS, client=client)
    assert client.tasks == 3
    assert alone.distances == there.distances
    assert alone.detail == there.detail


def test_a_worker_that_fails_is_not_taken_for_a_proof(monkeypatch):
    monkeypatch.setattr(setup, "_PIECES", 3)
    monkeypatch.setattr(scene.Task, "bounds", lambda self: np.full(self.stage.levels.bands, np.inf))
    found = certify_loop(drifting(), client=Elsewhere(), tolerance=8.0, shapes=("distance",))
    assert found.final is None


def test_a_worker_takes_the_precision_of_the_proof(monkeypatch):
    from flint import ctx

    seen = []
    monkeypatch.setattr(scene.Task, "bounds", lambda self: seen.append(ctx.prec))
    with precision(53):
        module._elsewhere(scene.Task(None, None, None))
    assert seen == [128]


@pytest.mark.usefixtures("pieces")
@pytest.mark.parametrize("workers", [2, 3])
def test_threads_change_nothing(alone, workers):
    assert certify_loop(drifting(), **OPTIONS, workers=workers).distances == alone.distances
