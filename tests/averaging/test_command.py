"""``ptproof average``: the JSON contract, exit status, and what people see."""

import json
from pathlib import Path
from typing import Any

import pytest

from ptproof.commands.cli import main

TEXT = """
[system]
state      = ["x1", "x2"]
parameters = ["k"]
functions  = { F = ["x1", "x2"] }
drift      = ["0", "0"]
period     = "2*pi"
[[system.dither]]
field  = ["cos(k*F(x1,x2))", "-sin(k*F(x1,x2))"]
signal = "cos(theta)"
[[system.dither]]
field  = ["sin(k*F(x1,x2))", "cos(k*F(x1,x2))"]
signal = "sin(theta)"
[expected]
average = ["k/2*Derivative(F(x1,x2), x1)", "k/2*Derivative(F(x1,x2), x2)"]
"""


def run(tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, *options: str) -> tuple[int, str, str]:
    path = tmp_path / "seeker.toml"
    path.write_text(text)
    with pytest.raises(SystemExit) as end:
        main(["average", str(path), *options])
    out = capsys.readouterr()
    return int(end.value.code or 0), out.out, out.err


def refused_with(tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, sentence: str) -> None:
    """That the command refuses the file by one sentence, and prints nothing else."""
    status, out, err = run(tmp_path, capsys, text, "--json")
    assert (status, out) == (2, "")
    assert f"seeker.toml: {sentence}" in err
    assert len(err.strip().splitlines()) == 1


def test_the_json_contract(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(tmp_path, capsys, TEXT, "--json")
    data: dict[str, Any] = json.loads(out)
    assert status == 0
    assert err == ""
    assert set(data) == {"average", "v", "assumptions", "expected"}
    assert data["average"] == ["k*Derivative(F(x1, x2), x1)/2", "k*Derivative(F(x1, x2), x2)/2"]
    assert data["v"] == {"2,1": "1/2"}
    assert set("ABCDEF") <= set(data["assumptions"])
    assert all(entry["verdict"] == "proved" and entry["detail"] for entry in data["assumptions"].values())
    assert data["expected"] == {"verdict": "proved", "witness": None}


@pytest.mark.usefixtures("in_this_process")
def test_without_a_claim_nothing_is_expected(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(tmp_path, capsys, TEXT.split("[expected]")[0], "--json")
    assert status == 0
    assert json.loads(out)["expected"] is None


@pytest.mark.usefixtures("in_this_process")
def test_a_missing_half_is_refuted_with_a_witness(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(tmp_path, capsys, TEXT.replace("k/2*", "k*"), "--json")
    expected = json.loads(out)["expected"]
    assert status == 1
    assert expected["verdict"] == "refuted"
    assert set(expected["witness"]) == {"values", "left", "right"}
    assert "F(x1, x2)" in expected["witness"]["values"]


@pytest.mark.usefixtures("in_this_process")
def test_a_refused_system_has_no_average(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(tmp_path, capsys, TEXT.replace('"sin(theta)"', '"1 + sin(theta)"'), "--json")
    data = json.loads(out)
    assert status == 1
    assert data["average"] is None
    assert data["assumptions"]["D"]["verdict"] == "refuted"
    assert data["expected"]["verdict"] == "undecided"
    assert "dither 2" in err
    assert "mean" in err


def test_bad_input_ends_with_status_two(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(tmp_path, capsys, TEXT.replace("period ", "perod "), "--json")
    assert status == 2
    assert out == ""
    assert "did you mean 'period'" in err
    assert "Traceback" not in err


def test_the_time_limit_is_kept_and_claims_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    endless = TEXT.replace('"cos(k*F(x1,x2))", "-sin(k*F(x1,x2))"', '"(x1 + x2 + k)**900*x2", "(x1 - x2 - k)**900*x1"')
    status, out, err = run(tmp_path, capsys, endless, "--json", "--timeout", "0.7")
    data = json.loads(out)
    assert status == 1
    assert data == {"average": None, "v": {}, "assumptions": {}, "expected": None}
    assert "no answer within" in err


def test_a_time_limit_must_be_positive(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(tmp_path, capsys, TEXT, "--timeout", "0")[0] == 2


@pytest.mark.usefixtures("in_this_process")
def test_people_see_the_average_and_the_assumptions(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(tmp_path, capsys, TEXT)
    assert status == 0
    assert "dx1/dtau = k*Derivative(F(x1, x2), x1)/2" in out
    assert "grad F" in out
    assert "the expected average: proved" in out


@pytest.mark.usefixtures("in_this_process")
def test_people_see_the_witness(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _, out, _ = run(tmp_path, capsys, TEXT.replace("k/2*", "k*"))
    assert "the expected average: refuted" in out
    assert "derived" in out
