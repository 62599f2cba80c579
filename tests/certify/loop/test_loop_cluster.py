"""A certificate by the workers of a cluster: what is sent to them can be sent, and what they answer is the same."""

import pickle
from dataclasses import replace
from functools import cache

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


@pytest.fixture(autouse=True)
def few_pieces(monkeypatch):
    monkeypatch.setattr(setup, "_PIECES", 3)


def proved(**how):
    return certify_loop(drifting(), tolerance=8.0, shapes=("distance",), **how)


@cache
def alone():
    return proved(workers=1)


def test_a_cluster_proves_the_same():
    client = Elsewhere()
    here, there = alone(), proved(client=client)
    assert client.tasks == 4
    assert here.final is not None
    assert here.distances == there.distances
    assert here.detail == there.detail


def test_a_worker_that_fails_is_not_taken_for_a_proof(monkeypatch):
    monkeypatch.setattr(scene.Task, "bounds", lambda self: np.full(self.stage.levels.bands, np.inf))
    assert proved(client=Elsewhere()).final is None


def test_a_worker_takes_the_precision_of_the_proof(monkeypatch):
    from flint import ctx

    seen = []
    monkeypatch.setattr(scene.Task, "bounds", lambda self: seen.append(ctx.prec))
    with precision(53):
        module._elsewhere(scene.Task(None, None, None))
    assert seen == [128]


def test_threads_change_nothing():
    assert proved(workers=3).distances == alone().distances
