"""Dither systems from TOML: what is read, and one clear sentence for what is wrong."""

from pathlib import Path

import pytest
import sympy as sp

from ptproof.averaging import load_dither_system, read_dither_system
from ptproof.errors import InputError

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
[system.fast]
state = ["z"]
rate  = ["F(x1,x2) - z"]
[expected]
average = ["k/2*Derivative(F(x1,x2), x1)", "k/2*Derivative(F(x1,x2), x2)"]
"""
x1, x2, z = sp.symbols("x1 x2 z", real=True)
k = sp.Symbol("k", positive=True)
F = sp.Function("F", real=True)(x1, x2)


def test_everything_is_read() -> None:
    problem = read_dither_system(TEXT)
    assert problem.system.state == (x1, x2)
    assert problem.system.fields[0] == (sp.cos(k * F), -sp.sin(k * F))
    assert problem.system.period == 2 * sp.pi
    assert problem.fast is not None
    assert problem.fast.rate == (F - z,)
    assert problem.functions == (F,)
    assert problem.expected == (k * sp.diff(F, x1) / 2, k * sp.diff(F, x2) / 2)
    assert problem.start == 0


def test_numbers_are_exact() -> None:
    text = TEXT.replace('drift      = ["0", "0"]', 'drift = [0.1, "1.8*x1"]')
    assert read_dither_system(text).system.drift == (sp.Rational(1, 10), sp.Rational(9, 5) * x1)


def test_region_and_start_are_read() -> None:
    text = TEXT.replace("[expected]", '[region]\nx1 = ["-1", "pi"]\n[expected]').replace(
        "period ", 'start = "1/2"\nperiod '
    )
    problem = read_dither_system(text)
    assert problem.region == {x1: (-1, sp.pi)}
    assert problem.start == sp.Rational(1, 2)


def test_the_name_is_that_of_the_file(tmp_path: Path) -> None:
    path = tmp_path / "unicycle.toml"
    path.write_text(TEXT)
    assert load_dither_system(path).system.name == "unicycle"


def test_bounded_functions_of_time_are_read() -> None:
    text = TEXT.replace('{ F = ["x1", "x2"] }', '{ F = ["x1", "x2"], d = ["tau"] }\nbounded = ["d"]').replace(
        'drift      = ["0", "0"]', 'drift = ["d(tau)", "0"]'
    )
    problem = read_dither_system(text)
    assert problem.bounded == (problem.system.drift[0],)


def test_mu_is_free_without_fast_states() -> None:
    text = TEXT.replace('["k"]', '["k", "mu"]')
    with pytest.raises(InputError, match="small parameter"):
        read_dither_system(text)
    before, after = text.split("[system.fast]")
    assert read_dither_system(before + "[expected]" + after.split("[expected]")[1]).fast is None


def named_when_changed(text: str, old: str, new: str, message: str) -> None:
    """That the text with ``new`` in place of ``old`` is refused by one line that has the message."""
    assert old in text
    with pytest.raises(InputError) as caught:
        read_dither_system(text.replace(old, new, 1), "seeker.toml")
    assert str(caught.value).startswith("seeker.toml: ")
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


WRONG = [
    ("[system]", "[sytem]", "unknown table: 'sytem' (did you mean 'system'?)"),
    ("period ", "periode ", "'periode' (did you mean 'period'?)"),
    ('signal = "cos', 'signl = "cos', "'signl' (did you mean 'signal'?)"),
    ("rate ", "rates ", "'rates' (did you mean 'rate'?)"),
    ("average =", "averge =", "'averge' (did you mean 'average'?)"),
    ('drift      = ["0", "0"]', 'drift = ["0"]', "system.drift: 1 entries for 2 states"),
    ('drift      = ["0", "0"]', 'drift = "0"', "system.drift: expected a list"),
    ('drift      = ["0", "0"]', 'drift = ["nan", "0"]', "system.drift[1]: nan is not a finite number"),
    ('drift      = ["0", "0"]', 'drift = [true, "0"]', "system.drift[1]: expected a number"),
    ('drift      = ["0", "0"]', 'drift = [inf, "0"]', "system.drift[1]"),
    ('drift      = ["0", "0"]', 'drift = ["1/0", "0"]', "system.drift[1]: a division by zero"),
    ('drift      = ["0", "0"]', 'drift = ["F(x1)", "0"]', "system.drift[1]: wrong number of arguments for 'F'"),
    ('drift      = ["0", "0"]', 'drift = ["x1.real", "0"]', "is not arithmetic"),
    ('drift      = ["0", "0"]', 'drift = ["__import__(\'os\')", "0"]', "system.drift[1]"),
    ('drift      = ["0", "0"]', "", "system.drift is missing"),
    ('"cos(theta)"', '"cos(thet)"', "system.dither[1].signal: unknown name 'thet'"),
    ('"cos(theta)"', '"x1*cos(theta)"', "system.dither[1].signal: a signal depends on theta, tau and parameters only"),
    ('"cos(k*F(x1,x2))", "-sin', '"cos(theta)", "-sin', "system.dither[1].field: a field does not depend on theta"),
    ('["x1", "x2"]\nparameters', '["x1", "x1"]\nparameters', "'x1' is declared twice"),
    ('["x1", "x2"]\nparameters', '["tau", "x2"]\nparameters', "'tau' has a meaning of its own"),
    ('["x1", "x2"]\nparameters', '["x 1", "x2"]\nparameters', "'x 1' is not a name"),
    ('["x1", "x2"]\nparameters', "[]\nparameters", "system.state: expected at least one name"),
    ('["k"]', '["x1"]', "'x1' is declared twice"),
    ('{ F = ["x1", "x2"] }', '{ F = ["x1", "x3"] }', "system.functions.F: 'x3' is not a state"),
    ('{ F = ["x1", "x2"] }', "{ F = [] }", "a function needs at least one argument"),
    ('"2*pi"', '"-2*pi"', "system.period: -2*pi is not positive"),
    ('"2*pi"', '"0"', "system.period: 0 is not positive"),
    ('["z"]', '["x1"]', "system.fast.state: 'x1' is declared twice"),
    ("[expected]", '[region]\nx1 = ["1", "0"]\n[expected]', "region.x1: the interval [1, 0] is empty"),
    ("[expected]", '[region]\nx3 = ["0", "1"]\n[expected]', "unknown state in [region]: 'x3'"),
    ("parameters", 'bounded = ["G"]\nparameters', "system.bounded: 'G' is not declared in system.functions"),
    ("[system]", "[system", "not TOML"),
]


@pytest.mark.parametrize(("old", "new", "message"), WRONG, ids=[message for _, _, message in WRONG])
def test_what_is_wrong_is_named(old: str, new: str, message: str) -> None:
    named_when_changed(TEXT, old, new, message)


@pytest.mark.parametrize("content", [b"\xff\xfe", b""])
def test_files_that_are_no_dither_system(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "bad.toml"
    path.write_bytes(content)
    with pytest.raises(InputError, match=r"bad\.toml"):
        load_dither_system(path)


def test_a_missing_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"none\.toml: cannot be read"):
        load_dither_system(tmp_path / "none.toml")


def test_a_folder(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot be read"):
        load_dither_system(tmp_path)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('["x1", "x2"]\nparameters', '[3, "x2"]\nparameters'),
        ('parameters = ["k"]', "parameters = [3]"),
        ('F = ["x1", "x2"]', "F = [[1]]"),
        ('drift      = ["0", "0"]', 'drift = ["0", "0"]\nbounded = [[1]]'),
    ],
)
def test_a_name_that_is_no_text_is_refused(old: str, new: str) -> None:
    assert old in TEXT
    with pytest.raises(InputError, match=r"^text: system\."):
        read_dither_system(TEXT.replace(old, new))
