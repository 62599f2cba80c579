"""The smallest ω and the largest start with a guarantee: the search, and what it says."""

import json
import math
from dataclasses import replace

import pytest
import sympy as sp
from click.testing import CliRunner

from ptproof.certify.loop import frontier as module
from ptproof.certify.loop.certificate import LoopCertificate
from ptproof.certify.loop.frontier import OMEGA, START, Frontier, Try, largest_start, smallest_omega
from ptproof.commands.certify import certify
from ptproof.errors import InputError
from ptproof.problem import example
from ptproof.proof.verdict import Verdict


def certificate(problem, radius, proved):
    tuning = problem.tuning
    verdict, curve = (Verdict.PROVED, ((0.0, 1.0), (2.0, 1.0))) if proved else (Verdict.UNDECIDED, ((), ()))
    return LoopCertificate(
        verdict, float(tuning.omega), float(tuning.mu), float(radius or 2), 0.0, *curve, None, "because", 0.1
    )


@pytest.fixture
def boundary(monkeypatch):
    """Bounds are proved for omega ≥ 17.3 and radius ≤ 0.61 alone; what was asked for is kept."""
    asked = []

    def give(problem, radius=None, **options):
        asked.append((problem, radius, options))
        proved = problem.tuning.omega >= sp.Rational("17.3") and (radius is None or radius <= sp.Rational("0.61"))
        return certificate(problem, radius, proved)

    monkeypatch.setattr(module, "certify_loop", give)
    return asked


@pytest.mark.parametrize("first", ["30", "2", "5000"])
def test_the_smallest_omega_is_between_two_neighbours(boundary, first):
    problem = example("vanishing")
    tuning = replace(problem.tuning, omega=sp.Rational(first), mu=sp.Rational("0.03") / sp.Rational(first))
    found = smallest_omega(replace(problem, tuning=tuning))
    assert 17.3 <= float(found.best.value) <= 17.3 * 1.05
    assert float(found.beyond.value) < 17.3
    assert float(found.best.value) / float(found.beyond.value) <= 1.05
    assert {item[0].tuning.mu * item[0].tuning.omega for item in boundary} == {sp.Rational("0.03")}


@pytest.mark.parametrize("first", ["2", "1/100"])
def test_the_largest_start_is_between_two_neighbours(boundary, first):
    found = largest_start(example("vanishing"), first, tolerance=0.7)
    assert 0.61 / 1.05 <= float(found.best.value) <= 0.61 < float(found.beyond.value)
    assert all(options == {"tolerance": 0.7} for _, _, options in boundary)


def test_nothing_is_found_where_nothing_is_proved(monkeypatch):
    monkeypatch.setattr(module, "certify_loop", lambda problem, *_, **__: certificate(problem, 1, proved=False))
    found = smallest_omega(example("vanishing"))
    assert found.best is None
    assert found.to_json()["proved_at"] is None
    assert len(found.tries) == 13


def test_the_farthest_counts_where_verdicts_alternate():
    problem = example("vanishing")
    tries = tuple(
        Try(sp.Integer(value), certificate(problem, 1, proved=proved))
        for value, proved in ((8, True), (4, False), (2, True), (1, False))
    )
    assert (Frontier(OMEGA, tries).best.value, Frontier(OMEGA, tries).beyond.value) == (2, 1)
    assert Frontier(START, tries).best.value == 8
    assert Frontier(START, tries).beyond is None


def run(*arguments):
    result = CliRunner().invoke(certify, arguments, standalone_mode=False)
    if result.exception is not None:
        raise result.exception
    return result


@pytest.mark.parametrize(("option", "value"), [("--smallest-omega", 17.3), ("--largest-start", 0.61)])
def test_json(boundary, option, value):
    result = run("vanishing", option, "--json")
    data = json.loads(result.stdout)
    assert result.return_value == 0
    assert abs(math.log(data["proved_at"] / value)) < math.log(1.05)
    assert data["certificate"]["verdict"] == "proved"
    assert {item["verdict"] for item in data["tries"]} == {"proved", "undecided"}


def test_people_are_told_where_there_is_no_guarantee(boundary):
    result = run("vanishing", "--largest-start", "--radius", "1/2")
    assert "proved at start_radius = 0.595: within 1" in result.stdout
    assert "no guarantee was found at start_radius" in result.stdout
    assert "nothing is said of vehicles there: because" in result.stdout


def test_a_search_that_finds_nothing_is_status_one(monkeypatch):
    monkeypatch.setattr(module, "certify_loop", lambda problem, *_, **__: certificate(problem, 1, proved=False))
    result = run("vanishing", "--smallest-omega")
    assert result.return_value == 1
    assert "no guarantee was found at any of these values" in result.stdout


def test_a_search_has_no_picture(boundary):
    with pytest.raises(InputError, match="--plot"):
        run("vanishing", "--smallest-omega", "--plot", "x.png")
