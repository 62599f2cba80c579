"""Powers, frequencies, order and signs of functions from TOML, and what ``ptproof average`` says of them."""

import json
from pathlib import Path
from typing import Any

import pytest
import sympy as sp

from ptproof.averaging import PoweredProblem, read_dither_system, study
from ptproof.proof.verdict import Verdict
from tests.averaging.test_command import TEXT as PLAIN
from tests.averaging.test_command import run
from tests.averaging.test_reading import named_when_changed

pytestmark = pytest.mark.usefixtures("in_this_process")
TEXT = '''
[system]
state      = ["x"]
parameters = ["p", "q"]
functions  = { F = ["x"], G = ["x"] }
order      = 2
drift      = ["-x"]
period     = "2*pi"
[[system.dither]]
field  = ["F(x)"]
signal = "cos(theta)"
power  = "p"
[[system.dither]]
field  = ["G(x)"]
signal = "cos(theta)"
power  = "2 - 2*p"
frequency = "2"
[expected]
average = ["""-x + (Derivative(F(x),x)*(F(x)*Derivative(G(x),x) - G(x)*Derivative(F(x),x))
               - F(x)*(F(x)*Derivative(G(x),x,x) - G(x)*Derivative(F(x),x,x)))/8"""]
'''
NEWTON = """
[system]
state      = ["z1", "z2", "d", "nu"]
parameters = ["alpha", "H", "h", "omega_0", "omega_d", "p"]
order      = 2
drift      = ["omega_0*z2", "-omega_0*z1", "omega_d*d", "h*(5 - H*(z1^2 + z2^2)/2 - nu)"]
period     = "2*pi"
[[system.dither]]
field  = ["0", "d*(5 - H*(z1^2 + z2^2)/2 - nu)", "0", "0"]
signal = "sin(theta)"
power  = "1 - p"
[[system.dither]]
field  = ["0", "alpha", "0", "0"]
signal = "cos(theta)"
power  = "p"
[[system.dither]]
field  = ["0", "0", "8*omega_d/alpha^2*d^2*(nu - 5 + H*(z1^2 + z2^2)/2)", "0"]
signal = "cos(theta)"
frequency = "2"
power  = "2 - 2*p"
[expected]
average = ["omega_0*z2", "-omega_0*z1 - alpha*H/2*d*z2", "omega_d*d*(1 - H*d)", "h*(5 - H*(z1^2 + z2^2)/2 - nu)"]
"""
SIGNED = """
[system]
state     = ["x"]
functions = { J = { of = ["x"], sign = "positive" } }
drift     = ["0"]
period    = "2*pi"
[[system.dither]]
field  = ["FIRST"]
signal = "cos(theta)"
[[system.dither]]
field  = ["SECOND"]
signal = "sin(theta)"
"""


def test_powers_frequencies_and_order_are_read() -> None:
    problem = read_dither_system(TEXT)
    assert isinstance(problem, PoweredProblem)
    p = sp.Symbol("p", positive=True)
    assert problem.system.powers == (p, 2 - 2 * p)
    assert [str(dither) for dither in problem.system.plain.dithers] == ["cos(theta)", "cos(2*theta)"]
    assert problem.order == 2


def test_frequencies_alone_change_the_dithers() -> None:
    problem = read_dither_system(PLAIN.replace('"sin(theta)"', '"sin(theta)"\nfrequency = "3/2"'))
    assert not isinstance(problem, PoweredProblem)
    assert str(problem.system.dithers[1]) == "sin(3*theta/2)"
    assert problem.system.period == 4 * sp.pi


def test_order_two_with_plain_powers_gives_the_first_order() -> None:
    found = study(read_dither_system(PLAIN.replace("[system]", "[system]\norder = 2")))
    assert found.expected is not None
    assert found.expected.verdict is Verdict.PROVED
    assert not found.notes


def test_the_json_of_the_second_order(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(tmp_path, capsys, NEWTON, "--json")
    data: dict[str, Any] = json.loads(out)
    assert (status, err) == (0, "")
    assert data["expected"] == {"verdict": "proved", "witness": None}
    assert data["powers"] == ["1 - p", "p", "2 - 2*p"]
    assert data["gamma"]["2,3,2"] == {
        "value": "1/8", "exponent": "0", "limit": "1/8", "condition": "it does not depend on omega"
    }  # fmt: skip
    assert data["gamma"]["1,3,1"]["condition"] == "2 - 4*p < 0"
    assert data["v"]["2,1"] == "-1/2"
    verdicts = {letter: entry["verdict"] for letter, entry in data["assumptions"].items()}
    assert verdicts.pop("2.3") == "refuted"  # for p up to 5/8
    assert set(verdicts.values()) == {"proved"}


def test_what_the_theorem_asks_holds_for_larger_powers() -> None:
    found = study(read_dither_system(NEWTON.replace("order ", 'conditions = ["5/8 < p < 1"]\norder ')))
    assert found.ledger.verdict is Verdict.PROVED
    at = study(read_dither_system(NEWTON.replace("order ", 'conditions = ["5/8 <= p", "p < 1"]\norder ')))
    assert at.ledger.with_verdict(Verdict.REFUTED) == ("2.3",)
    assert "p = 5/8" in at.notes[0]


@pytest.mark.parametrize(
    ("old", "new"), [("omega_d*d*(1 - H*d)", "omega_d*d*(1 - 3*H*d)"), ("- alpha*H/2*d*z2", "+ alpha*H/2*d*z2")]
)
def test_a_wrong_average_is_refuted(old: str, new: str) -> None:
    found = study(read_dither_system(NEWTON.replace(old, new)))
    assert found.expected is not None
    assert found.expected.verdict is Verdict.REFUTED
    assert found.expected.witness is not None


def test_unknown_fields(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(tmp_path, capsys, TEXT)
    assert status == 0
    assert "the expected average: proved" in out
    assert "gamma_1,2,1 = 1/8: tends to 1/8" in out
    assert "the limit holds without it: 2.3" in out


def test_no_limit_no_average(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(tmp_path, capsys, TEXT.replace('"2 - 2*p"', '"q"'), "--json")
    data = json.loads(out)
    assert status == 1
    assert data["average"] is None
    assert data["assumptions"]["limit"]["verdict"] == "refuted"
    assert "grows without bound" in err


@pytest.mark.parametrize(
    ("signal", "verdicts"),
    [
        ("cos(theta) + 1", ("proved", "refuted")),
        ("theta", ("undecided", "refuted")),
        ("cos(theta/2)", ("undecided", "refuted")),
        ("tan(theta)", ("undecided", "undecided")),
    ],
)
def test_dithers_that_are_none(signal: str, verdicts: tuple[str, str]) -> None:
    found = study(read_dither_system(TEXT.replace('signal = "cos(theta)"', f'signal = "{signal}"', 1)))
    assert found.system is None
    assert tuple(str(found.ledger.entries[letter].verdict) for letter in ("1.2", "1.3")) == verdicts


def test_one_dither_alone_leaves_the_drift() -> None:
    first = TEXT.split("[[system.dither]]")
    found = study(read_dither_system("[[system.dither]]".join(first[:2])))
    assert found.system is not None
    assert [str(entry) for entry in found.system.rhs] == ["-x"]


def test_orders_in_the_root_are_for_plain_powers(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(tmp_path, capsys, TEXT, "--order", "2", "--json")
    assert (status, out) == (2, "")
    assert "powers of omega" in err


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('power  = "p"', 'power  = "3/2"', "system.dither: the power of dither 1 is 3/2, not between 0 and 1"),
        ('power  = "p"', 'power  = "0"', "not between 0 and 1"),
        ('power  = "p"', 'power  = "p^2"', "system.dither[1].power: p**2 is not linear"),
        ('power  = "p"', 'power  = "x"', "system.dither[1].power: unknown name 'x'"),
        ('power  = "p"', 'power  = "nan"', "system.dither[1].power: nan is not a finite number"),
        ('power  = "p"', 'powr  = "p"', "'powr' (did you mean 'power'?)"),
        ('"2"', '"0"', "system.dither[2].frequency: expected a positive rational number"),
        ('"2"', '"sqrt(2)"', "system.dither[2].frequency: expected a positive rational number"),
        ('"2"', '"q"', "system.dither[2].frequency: unknown name 'q'"),
        ("order      = 2", "order      = 3", "system.order: expected 1 or 2, got 3"),
        ("order      = 2", "order      = true", "system.order: expected 1 or 2, got True"),
        ("order      = 2", 'order = 2\nconditions = ["p"]', "system.conditions[1]: expected a relation such as"),
        ("order      = 2", 'order = 2\nconditions = ["p*q < 1"]', "system.conditions[1]: p*q is not linear"),
        ("order      = 2", 'order = 2\nconditions = ["p < 2"]', "which the conditions allow; add p < 1"),
        ("order      = 2", 'order = 2\nconditions = ["q < 1"]', "is not about parameters of the powers"),
        ("order      = 2", 'order = 2\nconditions = ["p > 1"]', "the power of dither 1 is p, not between 0 and 1"),
        ("[expected]", '[system.fast]\nstate = ["z"]\nrate = ["F(x) - z"]\n[expected]', "system.fast: fast states are"),
        ("{ F = [", '{ F = { sign = "positive" }, K = [', "system.functions.F.of is missing"),
        ("[expected]", '[region]\np = ["1/2", "1"]\n[expected]', "region.p: a region is of states"),
        ('F = ["x"]', 'F = { of = ["x"], sign = "plus" }', "system.functions.F.sign: 'plus' is not one of positive"),
        ('F = ["x"]', 'F = { of = ["x"], sgn = "positive" }', "'sgn' (did you mean 'sign'?)"),
        ('F = ["x"]', 'F = { of = ["y"], sign = "positive" }', "system.functions.F: 'y' is not a state"),
        ('F = ["x"]', 'F = { of = "x", sign = "positive" }', "system.functions.F.of: expected a list"),
        ('F = ["x"]', 'F = { of = ["x"], sign = ["positive"] }', "system.functions.F.sign: ['positive'] is not one of"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_named(old: str, new: str, message: str) -> None:
    named_when_changed(TEXT, old, new, message)


SMOOTH = [
    ("sqrt(J(x))*sin(log(J(x)))", "sqrt(J(x))*cos(log(J(x)))", "positive", "-Derivative(J(x), x)/2"),
    ("1/(1 + J(x))", "1", "nonnegative", "Derivative(J(x), x)/(2*(J(x) + 1)**2)"),
    ("sqrt(-J(x))", "sqrt(-J(x))*J(x)", "negative", "-J(x)*Derivative(J(x), x)/2"),
    ("sqrt(1 - J(x))", "1", "nonpositive", "Derivative(J(x), x)/(4*sqrt(1 - J(x)))"),
    ("1/J(x)", "1", "nonzero", "Derivative(J(x), x)/(2*J(x)**2)"),
]


@pytest.mark.parametrize(("first", "second", "sign", "average"), SMOOTH, ids=[entry[0] for entry in SMOOTH])
def test_signs_make_fields_smooth(first: str, second: str, sign: str, average: str) -> None:
    text = SIGNED.replace("FIRST", first).replace("SECOND", second).replace("positive", sign)
    found = study(read_dither_system(text + f'[expected]\naverage = ["{average}"]'))
    assert found.ledger.entries["A"].verdict is Verdict.PROVED
    assert found.expected is not None
    assert found.expected.verdict is Verdict.PROVED


@pytest.mark.parametrize("declared", ['["x"]', '{ of = ["x"] }', '{ of = ["x"], sign = "nonzero" }'])
def test_without_the_sign_they_are_not(declared: str) -> None:
    text = SIGNED.replace('{ of = ["x"], sign = "positive" }', declared)
    text = text.replace("FIRST", "sin(log(J(x)))/sqrt(J(x))").replace("SECOND", "cos(log(J(x)))/sqrt(J(x))")
    found = study(read_dither_system(text))
    assert found.ledger.entries["A"].verdict is not Verdict.PROVED
    assert found.refusals or found.caveats
    if "nonzero" not in declared:
        assert found.system is None
        assert found.refusals[0].startswith("A: field 1, entry 1: not C^2")


def test_the_wrong_half_of_a_signed_average_is_refuted() -> None:
    text = SIGNED.replace("FIRST", "sqrt(J(x))*sin(log(J(x)))").replace("SECOND", "sqrt(J(x))*cos(log(J(x)))")
    found = study(read_dither_system(text + '[expected]\naverage = ["-Derivative(J(x), x)"]'))
    assert found.expected is not None
    assert found.expected.verdict is Verdict.REFUTED
