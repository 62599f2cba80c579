"""What a file states of averages of higher orders: proved, refuted with both sides, or one sentence."""

import json
from pathlib import Path

import pytest

from ptproof.averaging import read_dither_system
from ptproof.averaging.orders import average_to_order
from tests.averaging.test_command import refused_with, run

pytestmark = pytest.mark.usefixtures("in_this_process")
THREE = """
[system]
state      = ["x"]
functions  = { F = ["x"] }
drift      = ["0"]
period     = "2*pi"
[[system.dither]]
field  = ["1"]
signal = "cos(theta)"
[[system.dither]]
field  = ["F(x)"]
signal = "sin(theta)"
[[system.dither]]
field  = ["x**2"]
signal = "cos(2*theta)"
[expected]
"""


def stated(**orders: str) -> str:
    return (
        THREE + "[expected.orders]\n" + "\n".join(f'{key.lstrip("_")} = ["{value}"]' for key, value in orders.items())
    )


@pytest.fixture(scope="module")
def derived() -> str:
    """A_2 as it is found."""
    found = average_to_order(read_dither_system(THREE.replace("[expected]", "")), 2)
    return str(found.averages[1][0])


def test_an_order_that_is_right_is_proved(tmp_path: Path, capsys: pytest.CaptureFixture[str], derived: str) -> None:
    status, out, err = run(tmp_path, capsys, stated(_2=derived), "--json")
    expected = json.loads(out)["expected"]
    assert (status, err, expected["verdict"]) == (0, "", "proved")
    assert [entry["order"] for entry in expected["orders"]] == [2]


@pytest.mark.parametrize("change", ["2*({})", "-({})", "({}) + x/1000", "0*({})"])
def test_an_order_that_is_wrong_shows_both_sides(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], derived: str, change: str
) -> None:
    status, out, _ = run(tmp_path, capsys, stated(_2=change.format(derived)))
    shown = " ".join(out.split())
    assert status == 1
    assert "the expected average of order 2: refuted; dx/dtau is derived as" in shown
    assert " and expected as " in shown
    assert "derived " in shown.split("; at ")[1]


def test_the_worst_of_what_is_stated_is_the_verdict(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = stated(_2="x").replace("[expected]", '[expected]\naverage = ["Derivative(F(x), x)/2"]')
    status, out, _ = run(tmp_path, capsys, text, "--json")
    expected = json.loads(out)["expected"]
    assert (status, expected["verdict"]) == (1, "refuted")
    assert [entry["verdict"] for entry in expected["orders"]] == ["proved", "refuted"]


def test_the_highest_order_stated_is_derived(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _, out, _ = run(tmp_path, capsys, stated(_3="0"), "--order", "1", "--json")
    assert [entry["order"] for entry in json.loads(out)["orders"]] == [1, 2, 3]


def test_nothing_is_claimed_of_what_has_no_average(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(tmp_path, capsys, stated(_2="0").replace('"cos(theta)"', '"1 + cos(theta)"'), "--json")
    assert (status, json.loads(out)["expected"]["verdict"]) == (1, "undecided")


WRONG = {
    "order 1": (stated(_1="0"), "expected.orders: 1 is not an order from 2 to 12"),
    "order 0": (stated(_0="0"), "expected.orders: 0 is not an order from 2 to 12"),
    "order 13": (stated(_13="0"), "expected.orders: 13 is not an order from 2 to 12"),
    "a word": (stated(second="0"), "expected.orders: second is not an order from 2 to 12"),
    "02": (stated(_02="0"), "expected.orders: 02 is not an order from 2 to 12"),
    "nothing": (THREE, "expected: states nothing"),
    "two entries": (THREE + '[expected.orders]\n2 = ["0", "0"]', "expected.orders.2: 2 entries for 1 states"),
    "text": (THREE + '[expected.orders]\n2 = "0"', "expected.orders.2: expected a list"),
    "no table": (THREE + "orders = [1]", "expected.orders: expected a table"),
    "a name": (stated(_2="y"), "expected.orders.2[1]: unknown name 'y'"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_cannot_be_stated_is_one_sentence(tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str) -> None:
    refused_with(tmp_path, capsys, *WRONG[name])
