"""``ptproof certify``: the JSON contract, sentences, the picture, the status, and bad input."""

import json
from dataclasses import replace

import pytest
from click.testing import CliRunner

import ptproof.certify as door
from ptproof.commands.certify import certify
from ptproof.errors import InputError
from tests.certify.loop.test_loop_certificate import found

KEYS = {"verdict", "omega", "mu", "start_radius", "times", "distances", "final", "hover", "detail", "seconds"}
NAME = ("saturated", "--seeker", "pt")


def run(*arguments):
    result = CliRunner().invoke(certify, arguments, standalone_mode=False)
    if result.exception is not None:
        raise result.exception
    return result


@pytest.fixture
def known(monkeypatch):
    """The certificate of another test, so that it need not be found again; gives what was asked for."""
    asked = []

    def give(problem, radius, **options):
        asked.append((problem, radius, options))
        return found()

    monkeypatch.setattr(door, "certify_loop", give)
    return asked


def test_json(known):
    result = run(*NAME, "--json")
    data = json.loads(result.stdout)
    assert result.return_value == 0
    assert set(data) >= KEYS
    assert data["verdict"] == "proved"
    assert data["times"][0] == 0
    assert data["final"] == data["distances"][-1] <= 0.7


def test_the_options_are_the_numbers_that_are_certified(known):
    run(
        *NAME,
        "--radius",
        "1/2",
        "--filter-gap",
        "0.1",
        "--omega",
        "40",
        "--mu",
        "1/1000",
        "--T",
        "2",
        "--nu-min",
        "0.4",
    )
    problem, radius, options = known[0]
    tuning = problem.tuning
    assert (str(radius), str(options["filter_gap"])) == ("1/2", "1/10")
    assert tuple(map(str, (tuning.omega, tuning.mu, tuning.T, tuning.nu_min))) == ("40", "1/1000", "2", "2/5")


def test_people_get_the_answer_and_what_it_is_about(known, tmp_path):
    result = run(*NAME, "--plot", str(tmp_path / "bound.png"))
    assert "the vehicle in closed loop, omega = 30" in result.stdout
    assert "every start within 2.82843, every heading" in result.stdout
    assert "proved: within 0." in result.stdout
    assert (tmp_path / "bound.png").stat().st_size > 10_000


def test_a_vehicle_outside_is_said_and_is_status_one(monkeypatch, tmp_path, capsys):
    false = replace(found(), distances=tuple(0.5 * value for value in found().distances))
    monkeypatch.setattr(door, "certify_loop", lambda *_, **__: false)
    result = run(*NAME, "--plot", str(tmp_path / "bound.png"))
    assert result.return_value == 1
    assert "outside the bound: please report this" in result.output


def test_undecided_is_status_one_and_says_what_would_help():
    result = run(*NAME, "--omega", "2", "--mu", "1/2", "--tolerance", "1", "--json")
    data = json.loads(result.stdout)
    assert (result.return_value, data["verdict"], data["final"]) == (1, "undecided", None)
    assert "would help" in data["detail"] or "not above" in data["detail"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("saturated",), "meant for saturated"),
        (("vanishing", "--seeker", "asymptotic"), "asymptotic"),
        ((*NAME, "--radius", "-1"), "radius"),
        ((*NAME, "--radius", "q"), "--radius"),
        ((*NAME, "--filter-gap", "-1"), "filter_gap"),
        ((*NAME, "--omega", "0"), "omega"),
        ((*NAME, "--nu-min", "2"), "nu_min"),
        ((*NAME, "--plot", "x.gif"), "--plot"),
        (("nowhere.toml",), "nowhere.toml"),
    ],
)
def test_bad_input_is_one_sentence(arguments, message):
    with pytest.raises(InputError, match=message):
        run(*arguments)
