"""A wanted residual: what is proved of the average, and what the vehicle, which circles around it, can reach."""

import json

import pytest
import sympy as sp
from click.testing import CliRunner

from ptproof.commands.gains import gains
from ptproof.gains.residual import Residual

R = sp.Rational
DATA = ["--kappa", "1", "--a1", "1/2", "--a2", "1/2", "--b1", "1", "--b2", "1", "--k", "8", "--T", "1",
        "--nu-min", "0.3", "--x0-norm", "1"]  # fmt: skip


def run(*arguments):
    result = CliRunner().invoke(gains, [*DATA, *arguments], standalone_mode=False)
    if result.exception is not None:
        raise result.exception
    return result


def test_what_the_average_reaches_the_vehicle_need_not():
    result = run("--omega", "100", "--residual", "0.01")
    assert result.return_value == 1
    assert "proved of the average. Of the vehicle it is not." in result.stdout
    assert "1/√ω = 0.1 is more than the residual, which needs ω ≥ 10000" in result.stdout


@pytest.mark.parametrize(("omega", "status"), [("10000", 0), ("9999", 1)])
def test_the_status_turns_at_the_frequency_that_is_named(omega, status):
    assert run("--omega", omega, "--residual", "0.01").return_value == status


def test_without_a_frequency_the_one_that_is_needed_is_said():
    result = run("--residual", "0.01")
    assert result.return_value == 0
    assert "within the residual for ω ≥ 10000" in result.stdout


def test_json_keeps_the_average_and_the_vehicle_apart():
    content = json.loads(run("--omega", "100", "--residual", "0.01", "--json").stdout)
    found = content["residual"]
    assert found["average"] == {"bound": pytest.approx(content["clip"]["residual_bound"]["value"]), "guaranteed": True}
    assert found["vehicle"] == {
        "guaranteed": False, "hover_radius": pytest.approx(0.1), "reachable": False, "omega_needed": 10000.0,
    }  # fmt: skip
    assert content["vehicle"]["hover_radius"]["exact"] == "1/10"
    assert json.loads(run("--json").stdout)["residual"] is None


def test_no_bound_is_no_guarantee():
    asked = Residual(R(1), ())
    assert not asked.is_met
    assert "not even for the average" in asked.sentences[0]


def test_bounds_are_compared_exactly():
    bound = sp.exp(-2)
    near = R(sp.Float(bound.evalf(40), 30))
    below, above = near - R(1, 10**28), near + R(1, 10**28)
    assert float(below) == float(above) == float(bound)
    assert [Residual(wanted, (bound,)).average_meets_it for wanted in (below, above)] == [False, True]
    assert Residual(bound, (bound,)).average_meets_it
