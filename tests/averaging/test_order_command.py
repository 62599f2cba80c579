"""``ptproof average --order`` and ``mu_omega``: the JSON contract, and one sentence for what is wrong."""

import json
from pathlib import Path
from typing import Any

import pytest

from tests.averaging.test_command import TEXT, refused_with, run

pytestmark = pytest.mark.usefixtures("in_this_process")
FAST = """
[system.fast]
state = ["z"]
rate = ["F(x1,x2) - z"]
"""
FINITE = TEXT.split("[expected]")[0].replace("k*F(x1,x2)", "k*z").replace("drift ", 'mu_omega = "m"\ndrift ') + FAST
TURNED = [
    "k*(-m*Derivative(F(x1, x2), x2) + Derivative(F(x1, x2), x1))/(2*(m**2 + 1))",
    "k*(m*Derivative(F(x1, x2), x1) + Derivative(F(x1, x2), x2))/(2*(m**2 + 1))",
]


def test_the_json_contract_of_orders(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(tmp_path, capsys, TEXT, "--order", "2", "--json")
    data = json.loads(out)
    assert (status, err) == (0, "")
    assert set(data) == {"average", "v", "assumptions", "expected", "orders", "remainder"}
    assert [entry["order"] for entry in data["orders"]] == [1, 2]
    assert [set(entry) for entry in data["orders"]] == [{"order", "average", "correctors", "verdict"}] * 2
    assert data["orders"][0]["average"] == data["average"]
    assert data["orders"][1]["average"] == ["0", "0"]
    assert {entry["verdict"] for entry in data["orders"]} == {"proved"}
    assert data["remainder"]["power"] == "-2/2"
    assert len(data["remainder"]["leading"]) == len(data["remainder"]["corrector"]) == 2


def test_a_finite_filter_changes_the_average(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(tmp_path, capsys, FINITE, "--json")
    data = json.loads(out)
    assert status == 0
    assert data["average"] == TURNED
    assert data["remainder"]["fast"]["z_gap"] == "sqrt(omega)*(z - F(x1, x2))"


@pytest.mark.parametrize(
    ("claimed", "verdict"), [(TURNED, "proved"), (["k/2*Derivative(F(x1,x2), x1)", "0"], "refuted")]
)
def test_the_claim_is_about_the_finite_filter(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], claimed: list[str], verdict: str
) -> None:
    text = FINITE.replace('parameters = ["k"]', 'parameters = ["k", "m"]')
    status, out, _ = run(tmp_path, capsys, f"{text}\n[expected]\naverage = {json.dumps(claimed)}\n", "--json")
    assert json.loads(out)["expected"]["verdict"] == verdict
    assert status == (0 if verdict == "proved" else 1)


def test_people_see_the_orders(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(tmp_path, capsys, TEXT, "--order", "2")
    assert status == 0
    assert "order 2: dX/dtau has omega^(-1/2)" in out
    assert "put back into the system: proved" in out


@pytest.mark.parametrize("order", ["0", "-1", "13", "1000000000000000000000"])
def test_an_order_that_is_none_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str], order: str) -> None:
    status, out, err = run(tmp_path, capsys, TEXT, "--order", order)
    assert (status, out) == (2, "")
    assert f"--order: expected a whole number from 1 to 12, got {order}" in err


WRONG = {
    "no fast state": (FINITE.replace(FAST, ""), "system.mu_omega: there are no fast states"),
    "zero": (FINITE.replace('"m"', "0"), "system.mu_omega: 0 is not shown to be positive"),
    "negative": (FINITE.replace('"m"', '"-1/2"'), "system.mu_omega: -1/2 is not shown to be positive"),
    "unknown sign": (FINITE.replace('"m"', '"k - 1"'), "system.mu_omega: k - 1 is not shown to be positive"),
    "a state": (FINITE.replace('"m"', '"x1"'), "system.mu_omega"),
    "of time": (FINITE.replace('"m"', '"1 + tau"'), "system.mu_omega"),
    "the frequency": (FINITE.replace('"m"', '"omega"'), "system.mu_omega"),
    "taken": (FINITE.replace('"m"', '"mu"'), "system.mu_omega: 'mu' has a meaning of its own"),
    "a function": (FINITE.replace('"m"', '"sin"'), "system.mu_omega"),
    "infinite": (FINITE.replace('"m"', "inf"), "system.mu_omega: inf is not a finite number"),
    "a list": (FINITE.replace('"m"', "[1]"), "system.mu_omega"),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_rate_is_one_sentence(tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str) -> None:
    refused_with(tmp_path, capsys, *WRONG[name])


NO = {
    "nonlinear": ("F(x1,x2) - z - z**3", "system.fast.rate[1]"),
    "coefficient": ("(1 + x1**2)*(F(x1,x2) - z)", "system.fast.rate[1]"),
    "unstable": ("F(x1,x2) + z", "system.fast.rate: the matrix [[1]]"),
    "neutral": ("F(x1,x2)", "system.fast.rate: the matrix [[0]]"),
}


@pytest.mark.parametrize("name", NO)
def test_a_filter_that_is_not_covered_has_no_average(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str
) -> None:
    rate, place = NO[name]
    status, out, err = run(tmp_path, capsys, FINITE.replace('F(x1,x2) - z"]', f'{rate}"]'), "--order", "1", "--json")
    assert status == 1
    assert json.loads(out)["average"] is None
    assert place in err
    assert "Traceback" not in err


CIRCLE = """
[system.fast]
state = ["z", "w"]
rate  = ["w", "F(x1,x2) - z - w"]
"""


def test_jumps_and_filters_that_swing_are_refused_with_the_reason(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = FINITE.replace(FAST, CIRCLE).replace('"cos(theta)"', '"sign(cos(theta))"')
    status, _, err = run(tmp_path, capsys, text, "--json")
    assert status == 1
    assert "drive each other in a circle" in err


def _shape(value: Any) -> Any:
    """The keys of nested JSON; of a list those of its first entry."""
    if isinstance(value, list):
        return [_shape(value[0])] if value else []
    if not isinstance(value, dict):
        return ""
    return {("?" if key in OPEN else key): _shape(entry) for key, entry in value.items()}


OPEN = ("2,1", "A", "z_gap", "psi")


def test_the_contract_that_is_written_down_is_the_one_that_is_kept(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    written = Path(__file__).parents[2].joinpath("CONTRIBUTING.md").read_text("utf-8")
    block = written.split("`ptproof average FILE --json`")[1].split("```json")[1].split("```")[0]
    promised = json.loads(block)
    claims = f"""
[expected]
average = {json.dumps(TURNED)}
[expected.orders]
2 = ["0", "1"]
"""
    status, out, _ = run(tmp_path, capsys, FINITE.replace('["k"]', '["k", "m"]') + claims, "--json")
    data = json.loads(out)
    assert status == 1
    for found in (data, promised):
        found["assumptions"] = {"A": found["assumptions"]["A"]}
        for claim in (found["expected"], *found["expected"]["orders"]):
            claim["witness"] = None
    assert _shape(data) == _shape(promised)
