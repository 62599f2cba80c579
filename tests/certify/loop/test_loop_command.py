"""``ptproof certify``: the JSON contract, sentences, the picture, the status, and bad input."""

import json
import re
from dataclasses import replace

import pytest
from click.testing import CliRunner

import ptproof.certify as door
from ptproof.certify.loop.failing import Advice, Failing
from ptproof.commands.certify import certify
from ptproof.errors import InputError
from ptproof.proof.verdict import Verdict
from tests.certify.loop.test_loop_certificate import found

KEYS = {
    "verdict", "omega", "mu", "start_radius", "times", "distances", "final", "hover", "detail", "seconds", "failing",
    "help",
}  # fmt: skip
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
    assert "every start within 2.82842, every heading" in result.stdout  # 2.82843 is more than 2 sqrt(2)
    data = json.loads(run(*NAME, "--json").stdout)
    said = re.findall(r"within ([0-9.]+) of the source|at most ([0-9.]+)", result.stdout)
    written = [float(first or second) for first, second in said]
    assert len(written) == 11
    assert written[0] >= data["final"]
    assert written[1] >= data["hover"]
    assert written[2] >= data["distances"][0]
    assert written[-1] >= data["final"]
    assert (tmp_path / "bound.png").stat().st_size > 10_000


def test_a_vehicle_outside_is_said_and_is_status_one(monkeypatch, tmp_path, capsys):
    false = replace(found(), distances=tuple(0.5 * value for value in found().distances))
    monkeypatch.setattr(door, "certify_loop", lambda *_, **__: false)
    result = run(*NAME, "--plot", str(tmp_path / "bound.png"))
    assert result.return_value == 1
    assert "outside the bound: please report this" in result.output


def test_an_attack_is_shown_and_is_repeated_by_its_seed(known):
    found = [json.loads(run(*NAME, "--attack", "50", "--seed", seed, "--json").stdout)["attack"] for seed in "001"]
    assert found[0] == found[1] != found[2]
    assert found[0]["outside"] == 0
    assert 0.5 < found[0]["tightest"] <= 1
    assert found[0]["until"] == pytest.approx(1)
    assert "attacked: 50 simulated vehicles" in run(*NAME, "--attack", "50").stdout


def test_an_attack_that_hits_is_said_and_is_status_one(monkeypatch):
    false = replace(found(), distances=tuple(0.5 * value for value in found().distances))
    monkeypatch.setattr(door, "certify_loop", lambda *_, **__: false)
    result = run(*NAME, "--attack", "40", "--json")
    attack = json.loads(result.stdout)["attack"]
    assert result.return_value == 1
    assert attack["outside"] > 20
    assert attack["tightest"] > 1
    assert "outside the bound: please report this" in result.stderr


@pytest.mark.parametrize("json_too", [True, False])
def test_undecided_is_status_one_and_says_where_and_what_would_help(monkeypatch, json_too):
    box = Failing("distance", (0, 1), ((1, 2), (3, 4)), (0, 6.28), (0, 0.1), (0.09, 1), (5, 6), 0.7, -0.1)
    open_ = replace(
        found(), verdict=Verdict.UNDECIDED, times=(), distances=(), hover=None, detail="too slow", failing=(box,),
        help=Advice(48.0, 0.001, None),
    )  # fmt: skip
    asked = {}
    monkeypatch.setattr(door, "certify_loop", lambda *_, **options: asked.update(options) or open_)
    result = run(*NAME, *(["--json"] if json_too else []), "--attack", "5")
    assert asked["explain"]
    assert result.return_value == 1
    if json_too:
        data = json.loads(result.stdout)
        assert (data["verdict"], data["final"], data["help"]["omega"]) == ("undecided", None, 48.0)
        assert data["failing"][0]["position"] == [[1, 2], [3, 4]]
        assert {"heading", "filter", "drift_factor", "level", "rate", "middle", "time"} <= set(data["failing"][0])
    else:
        assert "fails at t in [0, 1], circle's centre in [1, 2], [3, 4]" in result.stdout
        assert "dW/dtau is at most 0.7 (about -0.1 at its middle)" in result.stdout
        assert "omega = 48 with mu = 0.001" in result.stdout


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
