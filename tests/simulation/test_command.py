"""``ptproof simulate``: the JSON contract, exit status, one sentence for bad input."""

import json
import subprocess
import sys
from dataclasses import dataclass, replace

import pytest

from ptproof.certify.loop.certificate import LoopCertificate
from ptproof.commands.cli import main
from ptproof.problem.seekers import seekers_of
from ptproof.proof.verdict import Verdict
from ptproof.simulation import simulate
from ptproof.simulation.drawing import BLUE
from tests.pictures import lines_shown, shown


@dataclass(frozen=True)
class Done:
    exit_code: int
    stdout: str
    stderr: str


@pytest.fixture
def call(capsys):
    def run(*arguments):
        with pytest.raises(SystemExit) as ended:
            main(["simulate", *arguments])
        shown = capsys.readouterr()
        return Done(int(ended.value.code or 0), shown.out, shown.err)

    return run


def test_one_trajectory_as_json(call):
    result = call("vanishing", "--json")
    assert result.exit_code == 0
    data = json.loads(result.stdout)
    assert data["example"] == "vanishing"
    assert (data["seeker"], data["frame"], data["engine"], data["outcome"]) == ("pt", "t", "casadi", "reached T")
    assert set(data["final"]) == {"t", "x", "theta", "z", "field", "distance"}
    assert data["final"]["distance"] == pytest.approx(0.178750991, abs=1e-7)
    assert data["seconds"] > 0


def test_an_ensemble_as_json_repeats_from_its_seed(call):
    results = [json.loads(call("vanishing", "--ensemble", "20", "--seed", "4", "--json").stdout) for _ in range(2)]
    assert results[0]["N"] == 20
    assert results[0]["outcomes"] == {"reached T": 20}
    assert results[0]["distance"] == results[1]["distance"]
    assert set(results[0]["distance"]) == {"median", "q95", "max"}


def test_members_may_differ_in_what_one_says(call):
    data = json.loads(call("vanishing", "--ensemble", "6", "--vary", "k=1:9/5", "--vary", "x1=-1:1", "--json").stdout)
    assert data["outcomes"] == {"reached T": 6}
    assert call("vanishing", "--ensemble", "6", "--vary", "k=1").exit_code == 2
    assert call("vanishing", "--ensemble", "6", "--vary", "q=1:2").exit_code == 2
    assert "low must not be above high" in call("vanishing", "--ensemble", "6", "--vary", "k=2:1").stderr
    assert call("vanishing", "--vary", "k=1:2").exit_code == 2


def test_the_example_named_saturated_runs_the_saturated_seeker(call):
    assert json.loads(call("saturated", "--json").stdout)["seeker"] == "saturated"


ESCAPES = """
[field]
variables = ["x1", "x2"]
expression = "-(x1**2 + x2**2)**2/4"
source = [0, 0]
kappa = 2
[drift]
kind = "gradient"
E = [[-10, 0], [0, -10]]
[seeker]
k = 1
omega = 30
mu = "0.001"
T = 1
[initial]
x = [2, 2]
"""


def test_a_run_that_escapes_has_status_one(call, tmp_path):
    (tmp_path / "p.toml").write_text(ESCAPES)
    result = call(str(tmp_path / "p.toml"), "--seeker", "asymptotic", "--model", "average", "--json")
    assert result.exit_code == 1
    assert json.loads(result.stdout)["outcome"] == "escaped"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("nope",), "not an example"),
        (("nowhere.toml",), "cannot be read"),
        (("vanishing", "--seeker", "saturated"), "[saturation]"),
        (("vanishing", "--rtol", "nan"), "rtol"),
        (("vanishing", "--plot", "x.gif"), "--plot"),
        (("vanishing", "--until", "inf"), "until"),
        (("vanishing", "--seeker", "best"), "best"),
        (("vanishing", "--engine", "euler"), "casadi"),
        (("vanishing", "--cluster", "tcp://127.0.0.1:1"), "--ensemble"),
    ],
)
def test_bad_input_is_one_sentence_and_status_two(call, arguments, message):
    result = call(*arguments)
    assert result.exit_code == 2
    assert message in result.stderr
    assert result.stdout == ""
    assert "Traceback" not in result.stderr


def test_an_error_names_the_file_that_asks_for_it(call, tmp_path):
    (tmp_path / "p.toml").write_text(ESCAPES.replace('mu = "0.001"', 'mu = "0.001"\nnu_min = "1/2"'))
    message = call(str(tmp_path / "p.toml"), "--until", "0").stderr
    assert f"{tmp_path / 'p.toml'}: until: must be after the start" in message


def test_a_limit_says_which_it_was_and_how_to_move_it(call, tmp_path):
    (tmp_path / "p.toml").write_text(ESCAPES.replace("omega = 30", "omega = 100000000").replace("-10", "0"))
    done = call(str(tmp_path / "p.toml"), "--time-limit", "0.1", "--engine", "casadi", "--json")
    data = json.loads(done.stdout)
    assert (done.exit_code, data["outcome"], data["limit"]) == (1, "step limit", "time_limit")
    assert "time limit of 0.1 s was met at t = " in data["message"]


@pytest.mark.parametrize("suffix", ["png", "svg"])
def test_plots_are_the_same_bytes_each_time(call, tmp_path, suffix, saved):
    files = [tmp_path / f"{i}.{suffix}" for i in range(2)]
    for file in files:
        assert call("vanishing", "--plot", str(file)).exit_code == 0
    assert files[0].read_bytes() == files[1].read_bytes()
    if suffix == "png":
        figure, run = saved[0], simulate("vanishing")
        assert shown(files[0], figure.axes[0], *run.x[:2], BLUE) > 0.9
        assert shown(files[0], figure.axes[1], run.t, run["field"], BLUE) > 0.9
        assert {name: share for name, share in lines_shown(files[0], figure).items() if share < 0.25} == {}


def test_people_are_told_of_an_escape_and_of_a_limit(call, tmp_path):
    (tmp_path / "p.toml").write_text(ESCAPES)
    done = call(str(tmp_path / "p.toml"), "--seeker", "asymptotic", "--model", "average")
    assert (done.exit_code, done.stderr) == (1, "")
    assert "escaped at t = " in done.stdout
    (tmp_path / "p.toml").write_text(ESCAPES.replace("-10", "0"))
    assert "stopped by nu_end at t = " in call(str(tmp_path / "p.toml"), "--model", "average").stdout


def test_people_get_sentences(call):
    text = call("vanishing").stdout
    assert "reached T at t = 1" in text
    assert "distance from the source 0.17875" in text


OTHER_PEAK = """
[field]
variables = ["x1", "x2"]
expression = "{field}"
source = [0, 0]
kappa = 1
[drift]
kind = "none"
[seeker]
k = 1
omega = 100
mu = "0.001"
T = 2
nu_min = "0.2"
[initial]
x = [3, 0]
"""


@pytest.mark.parametrize(
    ("field", "status", "words"),
    [
        ("-x1**2 - x2**2", 0, "reached T"),
        ("-x1**2 - x2**2 + x1", 2, "field.source: (0, 0) is no maximum of the field, whose gradient there is (1, 0)"),
        ("x1**2 - x1**4 - x2**2", 2, "which rises from there in a direction of (x1)"),
        ("-x1**2 + x1**4 - x1**6/15 - x2**2", 1, "above the 0 at the stated source"),
    ],
)
@pytest.mark.parametrize("more", [[], ["--ensemble", "3"]])
def test_a_source_that_is_not_the_maximum_is_not_a_success(call, field, status, words, more, tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(OTHER_PEAK.format(field=field))
    result = call(str(path), *more)
    assert result.exit_code == status
    assert words in result.stdout + result.stderr
    assert status != 2 or "mine.toml" in result.stderr


def test_a_file_with_a_saturation_table_gets_the_saturated_seeker(call, tmp_path):
    path = tmp_path / "mine.toml"
    table = '[saturation]\nepsilon = "0.01"\nlevel = 4\ngain = 3\n'
    path.write_text(OTHER_PEAK.format(field="-x1**2 - x2**2") + table)
    assert "mine.toml, saturated seeker" in call(str(path)).stdout


def test_a_seeker_that_is_none_is_refused_with_all_that_there_are(call):
    refused = call("vanishing", "--seeker", "nobody")
    assert refused.exit_code == 2
    assert all(repr(name) in refused.stderr for name in seekers_of("simulate"))


def test_the_help_does_without_sympy():
    code = (
        "import sys, click\n"
        "from ptproof.commands.simulate import simulate\n"
        "print(simulate.get_help(click.Context(simulate)), 'sympy' in sys.modules)"
    )
    shown = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert shown.rstrip().endswith("False")


def test_the_average_stands_beside_the_vehicle_and_is_not_taken_for_it(call):
    text = call("vanishing").stdout
    assert "vehicle: field 2.95007, distance from the source 0.17875" in text
    assert "its average (not the vehicle): distance from the source 0.0331" in text
    data = json.loads(call("vanishing", "--json").stdout)
    assert data["average"]["distance"] == pytest.approx(simulate("vanishing", model="average").final_distance)
    assert json.loads(call("saturated", "--json").stdout)["average"] is None
    assert "no average stands beside it" in call("saturated").stdout


@pytest.mark.parametrize(
    ("until", "outcome", "sentence"),
    [("0.5", "reached the time asked for", "before the prescribed time t0 + T = 1"), ("1", "reached T", ""),
     ("1.5", "reached T", "past the prescribed time 1")],
)  # fmt: skip
def test_another_end_than_the_prescribed_time_is_told(call, until, outcome, sentence):
    done = call("vanishing", "--until", until, "--json")
    data = json.loads(done.stdout)
    assert (done.exit_code, data["outcome"]) == (0, outcome)
    assert sentence in data["message"]
    assert bool(data["message"]) == bool(sentence)


def test_a_gain_that_is_infinite_at_the_prescribed_time_is_not_followed_past_it(call, tmp_path):
    (tmp_path / "p.toml").write_text(ESCAPES.replace("-10", "0"))
    data = json.loads(call(str(tmp_path / "p.toml"), "--model", "average", "--until", "2", "--json").stdout)
    assert (data["outcome"], data["limit"]) == ("step limit", "nu_end")


def test_a_moving_source_noise_sampling_files_and_c(call, tmp_path):
    files = [str(tmp_path / name) for name in ("run.csv", "law.c", "run.png")]
    done = call(
        "vanishing", "--motion", "t/2", "sin(3*t)", "--noise", "0.01", "--sample-time", "1e-4", "--until", "0.2",
        "--save", files[0], "--c-code", files[1], "--plot", files[2], "--json",
    )  # fmt: skip
    data = json.loads(done.stdout)
    assert (done.exit_code, data["engine"]) == (0, "sampled")
    assert data["source"] == pytest.approx([0.1, 0.5646424734])
    assert all((tmp_path / name).stat().st_size > 1000 for name in ("run.csv", "law.c", "run.png"))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--motion", "t", "y"), "motion[1]"),
        (("--noise", "-1"), "noise"),
        (("--sample-time", "x"), "sample_time"),
        (("--save", "run.txt"), ".csv or .npz"),
        (("--c-code", "no/such/folder/law.c"), "--c-code"),
    ],
)
def test_what_the_vehicle_meets_is_refused_by_a_sentence(call, arguments, message):
    result = call("vanishing", "--until", "0.01", *arguments)
    assert (result.exit_code, result.stdout) == (2, "")
    assert message in result.stderr


def test_an_enclosure_as_json(call):
    result = call("vanishing", "--enclose", "--until", "0.01", "--time-limit", "600", "--json")
    assert result.exit_code == 0
    enclosure = json.loads(result.stdout)["enclosure"]
    assert enclosure["verdict"] == "proved"
    assert enclosure["width"] <= 1e-6
    assert len(enclosure["times"]) == len(enclosure["lower"]) == len(enclosure["upper"]) == enclosure["steps"] + 1
    assert {"method", "seconds", "states", "switches"} <= enclosure.keys()


def test_an_enclosure_that_is_cut_short_is_undecided(call):
    result = call("vanishing", "--enclose", "--time-limit", "0.1")
    assert result.exit_code == 1
    assert "enclosure undecided: the time limit was met" in result.stdout


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (("--noise", "0.1"), "leave out --noise"), (("--motion", "t", "0"), "leave out --motion"),
        (("--ensemble", "3"), "leave out --ensemble"), (("--enclose-width", "0"), "width: must be positive"),
        (("--enclose-width", "small"), "unknown name 'small'"),
    ],
)  # fmt: skip
def test_an_enclosure_of_bad_input_is_refused(call, options, sentence):
    result = call("vanishing", "--enclose", *options)
    assert result.exit_code == 2
    assert sentence in result.stderr


def test_the_picture_of_a_run_shows_its_enclosure(call, tmp_path):
    files = [tmp_path / "plain.png", tmp_path / "enclosed.png"]
    call("vanishing", "--until", "0.01", "--plot", str(files[0]))
    result = call("vanishing", "--enclose", "--until", "0.01", "--time-limit", "600", "--plot", str(files[1]))
    assert result.exit_code == 0
    assert files[0].read_bytes() != files[1].read_bytes()


def test_the_certificate_stands_beside_the_run_and_says_of_whom_it_is(call, monkeypatch, tmp_path):
    found = LoopCertificate(Verdict.PROVED, 30.0, 0.001, 2.83, 0.0, (0.0, 1.0), (3.5, 0.5), None, "", 0.0)
    monkeypatch.setattr("ptproof.certify.certify_loop", lambda problem: found)
    result = call("vanishing", "--certify", "--plot", str(tmp_path / "run.png"))
    assert result.exit_code == 0
    assert (
        "certified for every vehicle that starts within 2.83, from every heading: distance at most 0.5" in result.stdout
    )
    assert json.loads(call("vanishing", "--certify", "--json").stdout)["certificate"]["final"] == 0.5
    monkeypatch.setattr("ptproof.certify.certify_loop", lambda problem: replace(found, verdict=Verdict.UNDECIDED))
    assert call("vanishing", "--certify").exit_code == 1


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("vanishing", "--ensemble", "3"), "leave out --ensemble"),
        (("vanishing", "--until", "0.5"), "leave out --until"),
        (("vanishing", "--noise", "0.1"), "leave out --noise"),
        (("saturated",), "closed loop of the seeker pt"),
        (("vanishing", "--model", "average"), "closed loop of the seeker pt"),
    ],
)
def test_what_no_certificate_speaks_of_is_refused(call, arguments, message):
    result = call(*arguments, "--certify")
    assert (result.exit_code, result.stdout) == (2, "")
    assert message in result.stderr
