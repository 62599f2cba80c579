"""The commands' own work on files and options that are nearly right: an answer, or one sentence that says where."""

from __future__ import annotations

import contextlib
import io
import json
import math
import tempfile
from pathlib import Path
from typing import Any

import hypothesis.strategies as st
from hypothesis import given

from ptproof.averaging import study
from ptproof.averaging.reading import read_dither_system
from ptproof.commands.bounds import _certify
from ptproof.commands.cli import main
from ptproof.errors import InputError
from ptproof.problem.reading import read
from tests.fuzz import toml
from tests.fuzz.sizes import fuzz, or_nothing, within

SECONDS = 8.0
DITHERED = """
[system]
state = ["x1", "x2"]
parameters = ["k"]
functions = { F = ["x1", "x2"] }
drift = ["0", "-x2"]
period = "2*pi"
dither = [
  { field = ["cos(k*F(x1,x2))", "0"], signal = "cos(theta)" },
  { field = ["sin(k*F(x1,x2))", "1"], signal = "sin(theta)" },
]
start = "0"
name = "seeker"
[system.fast]
state = ["z"]
rate = ["F(x1,x2) - z"]
[region]
x1 = ["-1", "1"]
[expected]
average = ["k/2*Derivative(F(x1,x2), x1)", "0"]
"""
SEEKING = """
[field]
variables = ["x1", "x2"]
expression = "5/2 + cos(2*pi/3*x1)/2 - (x1**2 + x2**2)/2"
source = ["0", "0"]
kappa = 1
[drift]
kind = "gradient"
E = [["-1", "0"], ["0", "-1"]]
[seeker]
k = "1.8"
omega = "30"
mu = "0.01"
T = "1"
t0 = "0"
nu_min = "0.3"
clock = "paper"
[saturation]
epsilon = "0.0004"
level = "4"
gain = "11.11"
[initial]
x = ["-2", "-2"]
theta = "0"
z = "0"
"""


def refused(error: InputError, places: Any) -> None:
    """One sentence, which begins with the file and does not drown in what it quotes."""
    message = str(error)
    assert type(error) is InputError
    assert message.startswith("FILE"), message
    assert "\n" not in message.strip() or "not TOML" in message, message
    assert len(message) < 1500, message
    if len(places) == 1 and places[0] and "not TOML" not in message:
        names = [str(key) for key in places[0] if isinstance(key, str)]
        assert any(name and name in message for name in names), f"{message} names none of {names}"


@given(toml.changed(SEEKING))
@fuzz(30)
def test_a_problem_file_is_read_or_refused(changed: Any) -> None:
    text, places = changed
    try:
        with within(SECONDS):
            read(text, "FILE", "name")
    except InputError as error:
        refused(error, places)


@given(toml.changed(DITHERED))
@fuzz(30)
def test_a_dither_file_is_read_or_refused(changed: Any) -> None:
    text, places = changed
    try:
        with within(SECONDS):
            read_dither_system(text, "FILE", "name")
    except InputError as error:
        refused(error, places)


@given(toml.changed(DITHERED))
@fuzz(8)
def test_a_dither_system_that_is_read_is_studied(changed: Any) -> None:
    try:
        problem = read_dither_system(changed[0], "FILE", "name")
    except InputError:
        return
    try:
        found = or_nothing(SECONDS, study, problem)
    except InputError:
        return
    if found is not None:
        json.dumps(found.to_json(), allow_nan=False)
        found.latex()


def call(*arguments: str) -> tuple[int, str, str]:
    """Status and output of a command in this process."""
    out, err = io.StringIO(), io.StringIO()
    status = 0
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            main(list(arguments))
        except SystemExit as end:
            status = int(end.code or 0)
    return status, out.getvalue(), err.getvalue()


def check(status: int, out: str, err: str, what: str) -> None:
    assert status in (0, 1, 2), what
    if status == 2:
        assert out == "", what
        assert err.strip(), what
        assert len(err) < 3000, err
    else:
        json.loads(out, parse_constant=_no_constant)


def _no_constant(name: str) -> float:
    raise AssertionError(f"{name} is not JSON")


@given(toml.changed(SEEKING.split("[saturation]")[0] + '[initial]\nx = ["-1/2", "-1/2"]\n'))
@fuzz(4)
def test_a_problem_file_is_simulated_or_refused(changed: Any) -> None:
    _with_file("simulate", changed[0], "--time-limit", "0.5")


@given(toml.changed(SEEKING.split("[saturation]")[0] + '[initial]\nx = ["-1/2", "-1/2"]\n'))
@fuzz(2)
def test_a_problem_file_has_gains_or_is_refused(changed: Any) -> None:
    given_constants = ("--a1", "2", "--a2", "1/2", "--b1", "1", "--b2", "4")
    _with_file("gains", changed[0], *given_constants)


def _with_file(command: str, text: str, *options: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "file.toml"
        path.write_text(text, "utf-8")
        found = or_nothing(30, call, command, str(path), "--json", *options)
    if found is not None:
        check(*found, f"{command} {options}\n{text}\n{found[2]}")


numbers = st.sampled_from(
    ["1", "2", "1/2", "0.3", "1.8", "0", "-1", "pi", "1e-300", "1e300", "1e308*100", "10**400", "nan", "inf",
    "sqrt(-1)", "x", "", "1/0",
     "exp(900)", "exp(-900)", "9" * 400, "3", "1000", "5/2", "1e-30", "E", "sqrt(2)", "1001", "E**pi"]
)  # fmt: skip
NAMES = ["kappa", "a1", "a2", "b1", "b2", "drift-norm", "drift-bound", "k", "T", "nu-min", "exponent", "V0",
"x0-norm", "tau-star", "t0",
         "omega", "mu", "residual", "radius"]  # fmt: skip
GOOD = {
    "kappa": "2",
    "a1": "3/2",
    "a2": "1/2",
    "b1": "1.4",
    "b2": "3.3",
    "drift-norm": "1.5",
    "k": "1.8",
    "T": "1",
    "V0": "0.5",
}


@given(st.dictionaries(st.sampled_from(NAMES), numbers, max_size=3), st.sampled_from([None, "paper", "power",
"tangent", "papr", "exponential", "logarithmic"]),
       st.lists(st.sampled_from(list(GOOD)), max_size=2))  # fmt: skip
@fuzz(5)
def test_gains_of_numbers_are_an_answer_or_one_sentence(values: Any, clock: str | None, dropped: list[str]) -> None:
    chosen = {name: text for name, text in {**GOOD, **values}.items() if name not in dropped or name in values}
    options = [part for name, text in chosen.items() for part in (f"--{name}", text)]
    options += [] if clock is None else ["--clock", clock]
    found = or_nothing(30, call, "gains", *options, "--json")
    if found is not None:
        check(*found, f"gains {' '.join(options)}\n{found[2]}")


fields = st.sampled_from(
    ["-(x1**2 + x2**2)", "3 - x1^2 - 2*x2^2 + x1*x2/2", "cos(x1) - x2**2", "x1", "0", "5", "1/x1", "log(x1)",
    "-Abs(x1)**3 - x2**2",
     "-x1**2", "-exp(x1**2 + x2**2)", "sqrt(-1)*x1", "-x1**400", "x1 <", "floor(x1)", "-(x1**2+x2**2)*sign(x1)",
     "x3", "-sqrt(x1**2+x2**2)",
     "Max(x1, x2)", "-x1**2*x2**2", "-(x1 - 1)**2 - x2**2", "tan(x1)",
     "Piecewise((-x1**2, x1 < 0), (-x1**2 - x2**2, True))",
     "1e300*x1**2", "-1e300*(x1**2 + x2**2)", "-(x1**2+x2**2)/10**200", "atan2(x2, x1)", "x1**x2", "Mod(x1, 2)",
     "acos(x1) - x2**2",
     "-exp(-1/(x1**2 + x2**2))", "1 - x1**2 - x2**2 + exp(-1000*(x1 - 1)**2)",
     "Derivative(x1**3, x1) - x2**2 - 4*x1**2"]
)  # fmt: skip
lists = st.sampled_from(
    [
        "x1,x2",
        "x1",
        "x1,x1",
        "",
        "x1,,x2",
        "0,0",
        "pi,1",
        "x2,x1",
        "sin,x1",
        "0",
        "1,0",
        "1/2,2",
        "2,1",
        "1,1",
        "nan,0",
        "-1,2",
        "sqrt(-1),0",
        "1,inf",
    ]
)
radii = st.sampled_from(
    [None, "1", "0", "-1", "1/2", "1e-300", "1e300", "pi", "sqrt(2)", "nan", "10**4000", "x1", "sqrt(-1)"]
)


@given(fields, st.one_of(st.just("x1,x2"), lists), st.one_of(st.none(), lists), st.one_of(st.just("1"), numbers),
radii,
       st.one_of(st.none(), st.none(), lists), st.sampled_from([0.3, 1e-3, 0.0, math.nan, -1.0, 5.0]))  # fmt: skip
@fuzz(5)
def test_bounds_of_any_field_are_an_answer_or_one_sentence(
    expression: str, names: str, source: str | None, kappa: str, radius: str | None, annulus: str | None, rtol: float
) -> None:
    try:
        found = or_nothing(SECONDS, _certify, 0.5, expression, names, source, kappa, radius, annulus, rtol)
    except InputError as error:
        refused(InputError(f"FILE{error}"), ())
        return
    if found is not None:
        json.dumps(found.to_json(), allow_nan=False)
        assert str(found)
