"""Problems from TOML: exact values, and one clear sentence for everything that is wrong."""

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.problem import EXAMPLES, example, load

GOOD = """
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
mu = "0.001"
T = "1"
[initial]
x = ["-2", "-2"]
"""


@pytest.fixture
def write(tmp_path):
    def put(text):
        path = tmp_path / "my.toml"
        path.write_text(text)
        return path

    return put


def test_decimal_text_and_decimal_numbers_are_the_same_exact_value(write):
    text = load(write(GOOD))
    number = load(write(GOOD.replace('"1.8"', "1.8")))
    assert text.tuning.k == number.tuning.k == sp.Rational(9, 5)


def test_what_is_left_out_has_its_default(write):
    problem = load(write(GOOD))
    assert (problem.tuning.t0, problem.tuning.nu_min, problem.initial.theta) == (0, None, 0)
    assert problem.saturation is None


def test_the_filter_starts_at_the_measured_field(write):
    problem = load(write(GOOD))
    x1, x2 = problem.variables
    assert problem.measured == problem.field.value({x1: -2, x2: -2})
    assert load(write(GOOD + 'z = "1/3"\n')).measured == sp.Rational(1, 3)


@pytest.mark.parametrize("name", EXAMPLES)
def test_the_examples_ship_with_the_package(name):
    assert example(name).name == name


def test_the_examples_have_the_parameters_of_section_7():
    vanishing, nonvanishing, saturated = map(example, EXAMPLES)
    R = sp.Rational
    assert (vanishing.tuning.k, vanishing.tuning.omega, vanishing.tuning.T) == (R(9, 5), 30, 1)
    assert (nonvanishing.tuning.k, nonvanishing.tuning.omega, nonvanishing.tuning.T) == (1, 50, 2)
    assert (saturated.tuning.k, saturated.saturation.epsilon, saturated.saturation.gain) == (
        R(7, 5),
        R(1, 2500),
        R(1111, 100),
    )
    assert {p.tuning.mu for p in (vanishing, nonvanishing, saturated)} == {R(1, 1000)}
    assert {p.tuning.nu_min for p in (vanishing, nonvanishing, saturated)} == {R(3, 10)}
    assert [p.peak for p in (vanishing, nonvanishing, saturated)] == [3, 2, 0]


def test_a_field_of_three_variables_is_a_problem_without_a_unicycle(write):
    text = GOOD.replace('["x1", "x2"]', '["x", "y", "z"]').replace(
        '"5/2 + cos(2*pi/3*x1)/2 - (x1**2 + x2**2)/2"', '"-x**2 - y**2 - z**2"'
    )
    text = text.replace('source = ["0", "0"]', 'source = ["0", "0", "0"]').replace('x = ["-2", "-2"]', "x = [1, 1, 1]")
    text = text.replace('E = [["-1", "0"], ["0", "-1"]]', "E = [[0, 0, 0], [0, 0, 0], [0, 0, 0]]")
    problem = load(write(text))
    assert len(problem.variables) == 3
    with pytest.raises(InputError, match="plane"):
        problem.closed_loop()


WRONG = {
    "unknown key": (("mu =", "mue ="), r"my\.toml: unknown key in \[seeker\]: 'mue' \(did you mean 'mu'\?\)"),
    "case of a key": (("T =", "t ="), r"unknown key in \[seeker\]: 't' \(did you mean"),
    "unknown table": (("[initial]", "[inital]"), r"did you mean 'initial'"),
    "missing table": ((GOOD[GOOD.index("[drift]") : GOOD.index("[seeker]")], ""), r"\[drift\] is missing"),
    "missing key": (('k = "1.8"\n', ""), r"seeker\.k is missing"),
    "nan": (('"1.8"', "nan"), r"seeker\.k: nan is not a finite number"),
    "infinity": (('T = "1"', "T = inf"), r"seeker\.T: inf is not a finite number"),
    "infinity as text": (('x = ["-2"', 'x = ["-inf"'), r"initial\.x\[0\]: -inf is not a finite number"),
    "huge": (('"1.8"', '"1e400"'), r"seeker\.k: .* too large"),
    "zero gain": (('"1.8"', '"0"'), r"seeker\.k: must be positive"),
    "negative time": (('T = "1"', 'T = "-1"'), r"seeker\.T: must be positive"),
    "not a number": (('"1.8"', '"k"'), r"seeker\.k: unknown name 'k'"),
    "imaginary": (('"1.8"', '"sqrt(-1)"'), r"seeker\.k: .* not a finite real number"),
    "clip above 1": (('T = "1"', 'T = "1"\nnu_min = "1.5"'), r"seeker\.nu_min: must lie in \(0, 1\]"),
    "clip at 0": (('T = "1"', 'T = "1"\nnu_min = 0'), r"seeker\.nu_min: must be positive"),
    "kappa": (("kappa = 1", "kappa = 0"), r"field\.kappa: must be a positive integer"),
    "kappa half": (("kappa = 1", 'kappa = "3/2"'), r"field\.kappa: must be a positive integer"),
    "length of source": (('source = ["0", "0"]', 'source = ["0"]'), r"field\.source: 1 entries for 2 coordinates"),
    "length of x": (('x = ["-2", "-2"]', 'x = ["-2"]'), r"initial\.x: 1 entries for 2 coordinates"),
    "x no list": (('x = ["-2", "-2"]', 'x = "-2"'), r"initial\.x: expected a list"),
    "E not square": (('["0", "-1"]]', '["0"]]'), r"drift\.E\[1\]: 1 entries for 2"),
    "unknown kind": (('"gradient"', '"gradiant"'), r"drift\.kind: .*did you mean 'gradient'"),
    "E for bounded": (('"gradient"', '"bounded"'), r"drift\.f is missing"),
    "variable twice": (('["x1", "x2"]', '["x1", "x1"]'), r"field\.variables: 'x1' is declared twice"),
    "variable named t": (('["x1", "x2"]', '["t", "x2"]'), r"'t' has a meaning of its own"),
    "unknown name in field": (("x1**2", "y**2"), r"field\.expression: unknown name 'y'"),
    "code in field": (("x1**2", "__import__('os')"), r"field\.expression: "),
    "singular at the source": (("5/2 +", "log(x1**2) +"), r"field\.expression at field\.source: .* no finite"),
    "no TOML": (("[seeker]", "[seeker"), r"my\.toml: not TOML"),
}  # fmt: skip


@pytest.mark.parametrize("case", WRONG)
def test_what_is_wrong_is_named(write, case):
    (old, new), message = WRONG[case]
    assert old in GOOD
    with pytest.raises(InputError, match=message):
        load(write(GOOD.replace(old, new)))


def test_a_file_that_is_not_there_is_named(tmp_path):
    with pytest.raises(InputError, match=r"nowhere\.toml: cannot be read"):
        load(tmp_path / "nowhere.toml")
    with pytest.raises(InputError, match="cannot be read"):
        load(tmp_path)


def test_bytes_that_are_no_text_are_named(tmp_path):
    (tmp_path / "b.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match="UTF-8"):
        load(tmp_path / "b.toml")


def test_an_unknown_example_gets_a_hint():
    with pytest.raises(InputError, match="did you mean 'vanishing'"):
        example("vanshing")
