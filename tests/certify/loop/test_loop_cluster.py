"""A certificate by the workers of a cluster: what is sent to them can be sent, and what they answer is the same."""

import pickle
from dataclasses import replace

import numpy as np
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


def test_a_cluster_proves_the_same(monkeypatch):
    monkeypatch.setattr(setup, "_PIECES", 3)
    client = Elsewhere()
    options = {"tolerance": 8.0, "shapes": ("distance",)}
    here, there = (certify_loop(drifting(), **options, **how) for how in ({"workers": 1}, {"client": client}))
    assert client.tasks == 4
    assert here.distances == there.distances
    assert here.detail == there.detail


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


def test_threads_change_nothing(monkeypatch):
    monkeypatch.setattr(setup, "_PIECES", 2)
    one, *others = (
        certify_loop(drifting(), tolerance=9.0, shapes=("distance",), workers=workers).distances
        for workers in (1, 2, 3)
    )
    assert others == [one, one]
