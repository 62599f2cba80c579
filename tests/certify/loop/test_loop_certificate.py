"""Certificates for vehicles: held against simulated ones, and refused where there can be none."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import sympy as sp

from ptproof.certify.loop import certify as module
from ptproof.certify.loop import certify_loop
from ptproof.errors import InputError
from ptproof.problem import example
from ptproof.proof.verdict import Verdict
from ptproof.simulation.fleet import fleet


def tuned(name="saturated", **numbers):
    problem = example(name)
    given = {key: sp.Rational(value) for key, value in numbers.items()}
    return replace(problem, tuning=replace(problem.tuning, **given))


@cache
def found(omega=30, gap=0):
    return certify_loop(tuned(omega=omega), filter_gap=sp.Rational(gap), tolerance=0.12, workers=1)


def outside(certificate, problem, size=200):
    many = fleet(problem, size, radius=certificate.start_radius, filter_gap=certificate.filter_gap, samples=120)
    return int((many.distances > certificate.bound(many.times)).any(axis=1).sum())


@pytest.mark.parametrize(("omega", "gap", "final"), [(30, "0", 0.7), (30, "1/20", 0.9), (300, "0", 0.25)])
def test_no_vehicle_is_outside(omega, gap, final):
    certificate = found(omega, gap)
    assert certificate.verdict is Verdict.PROVED
    assert certificate.final < final
    assert outside(certificate, tuned(omega=omega)) == 0


def test_vehicles_that_start_farther_are_outside():
    certificate = replace(found(), start_radius=4.5)
    assert outside(certificate, tuned(omega=30)) > 0


def test_the_bound_between_two_times_is_the_larger():
    certificate = found()
    a, b = certificate.times[3:5]
    inside = certificate.bound(np.array([a, (a + b) / 2, b]))
    assert inside.tolist() == [certificate.distances[3], max(certificate.distances[3:5]), certificate.distances[4]]


def test_json():
    data = found().to_json()
    assert data["verdict"] == "proved"
    assert data["final"] == data["distances"][-1]
    assert data["hover"] <= data["final"]
    assert len(data["times"]) == len(data["distances"])


def test_a_sabotaged_function_proves_nothing(monkeypatch):
    from ptproof.certify.loop import flow as place

    exact = place._exact

    def wrong(part):
        return {key: value * (-20 if key[0] == 2 else 1) for key, value in exact(part).items()}

    monkeypatch.setattr(place, "_exact", wrong)
    certificate = certify_loop(tuned(omega=30), tolerance=1.0, workers=1)
    assert certificate.final is None or certificate.final > found().final


@pytest.mark.parametrize(
    "problem",
    [
        tuned(omega="1/10"),  # a circle larger than everything
        tuned(omega=30, mu=10),  # a filter that is too slow to be of use
        tuned(omega=30, k="1/100000"),  # hardly any feedback, and more is lost than won
        tuned("vanishing", omega=3000, mu="1/99000", k="1/10"),  # a drift that is stronger than the seeker
    ],
)
def test_nothing_is_proved_where_there_is_nothing(problem):
    certificate = certify_loop(problem, tolerance=1.0, workers=1)
    assert certificate.verdict is Verdict.UNDECIDED
    assert certificate.final is None
    assert certificate.detail


@pytest.mark.parametrize("data", [{"radius": sp.Integer(-1)}, {"filter_gap": sp.Integer(-1)}, {"radius": sp.oo}])
def test_bad_input(data):
    with pytest.raises(InputError):
        certify_loop(tuned(), **data)


def test_the_closed_loop_must_be_the_one_that_is_meant(monkeypatch):
    from ptproof.certify.loop import setup
    from ptproof.problem import Problem

    original = Problem.closed_loop

    def other(self, *arguments, **options):
        system = original(self, *arguments, **options)
        return replace(system, rhs=(system.rhs[0] * 2, *system.rhs[1:]))

    monkeypatch.setattr(Problem, "closed_loop", other)
    with pytest.raises(InputError, match="not of the form"):
        setup.check_form(tuned())


@pytest.mark.parametrize(
    ("name", "first"), [("vanishing", "field"), ("nonvanishing", "distance"), ("saturated", "distance")]
)
def test_levels_of_the_field_are_tried_first_where_the_drift_follows_its_slope(monkeypatch, name, first):
    tried = []

    def none(problem, size, gap, shape, *_):
        tried.append(shape)
        raise module.NoCertificate("none")

    monkeypatch.setattr(module, "_curve", none)
    certificate = certify_loop(example(name))
    assert tried[0] == first
    assert sorted(tried) == ["distance", "field"]
    assert certificate.verdict is Verdict.UNDECIDED
    assert certificate.detail.count("none") == 2
