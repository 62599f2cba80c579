"""``ptproof bounds``: text in, a table or JSON out, and the exit status."""

import json
import math

import numpy as np
import pytest
from click.testing import CliRunner

from ptproof.commands.bounds import bounds
from ptproof.errors import InputError
from ptproof.reading.tables import split_list
from tests.pictures import shown

KEYS = {"verdict", "domain", "a1", "a2", "b1", "b2", "witness"}


def run(*arguments):
    result = CliRunner().invoke(bounds, list(arguments), standalone_mode=False)
    if result.exception is not None:
        raise result.exception
    return result


def test_proved_field_as_json():
    result = run("-(x1-1)**2 - 2*(x2+1/2)**2", "--vars", "x1,x2", "--source", "1,-1/2", "--kappa", "1", "--json")
    data = json.loads(result.stdout)
    assert result.return_value == 0
    assert set(data) == KEYS
    assert (data["verdict"], data["witness"]) == ("proved", None)
    assert data["a1"]["lower"] <= 2 <= data["a1"]["upper"] <= 2.002
    assert 0.999 <= data["a2"]["lower"] <= 1 <= data["a2"]["upper"]


def test_refuted_field_as_json():
    result = run("--kappa", "1", "--json", "--radius", "4", "--vars", "h", "cos(h)")
    data = json.loads(result.stdout)
    assert result.return_value == 1
    assert set(data) == KEYS
    assert data["verdict"] == "refuted"
    assert data["a1"] == {"lower": None, "upper": None}
    assert {"values", "left", "right", "largest_radius"} <= set(data["witness"])


@pytest.mark.usefixtures("in_this_process")
def test_expression_with_minus_and_letters_of_options_is_an_expression():
    result = run("-cosh(h)", "--vars", "h", "--kappa", "1", "--annulus", "1/2,1")
    assert result.return_value == 0
    assert "proved on the annulus" in result.stdout
    assert "constants that certainly hold" in result.stdout


@pytest.mark.usefixtures("in_this_process")
def test_undecided_goes_to_standard_error_with_what_was_tried():
    result = run("-abs(x)**3", "--vars", "x", "--kappa", "1", "--radius", "1", "--json")
    assert result.return_value == 1
    assert json.loads(result.stdout)["verdict"] == "undecided"
    assert "kink" in result.stderr


@pytest.mark.usefixtures("in_this_process")
def test_picture_shows_the_band_and_the_quotients_between(tmp_path, saved):
    path = tmp_path / "picture.png"
    run("-x**2 - 3*y**2", "--vars", "x,y", "--kappa", "1", "--radius", "1", "--plot", str(path))
    left, right = saved[0].axes
    radii = np.linspace(0.2, 0.9, 30)
    for axes, highest, lowest in ((left, 3, 1), (right, 6, 2)):
        assert axes.get_xlim()[0] < 0.1 < 0.9 < axes.get_xlim()[1]
        for value, colour, beside in ((highest, "tab:red", 0.94), (lowest, "tab:blue", 1.06)):
            assert shown(path, axes, radii, value, colour) > 0.9
            assert shown(path, axes, radii, beside * value, colour) < 0.2
    # At 30 degrees the first quotient is 3/4 + 3/4, the second the square root of 3 + 9.
    assert shown(path, left, radii, 1.5, "0.6") > 0.9
    assert shown(path, right, radii, math.sqrt(12), "0.6") > 0.9


@pytest.mark.usefixtures("in_this_process")
@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["-x**2 - z", "--vars", "x", "--kappa", "1"], "unknown name 'z'"),
        (["-x**2", "--vars", "x", "--kappa", "0"], "kappa"),
        (["-x**2", "--vars", "x", "--kappa", "1/2"], "kappa"),
        (["-x**2", "--vars", "x,sin", "--kappa", "1"], "'sin' has a meaning"),
        (["-x**2", "--vars", "x", "--kappa", "1", "--source", "0,0"], "2 coordinates"),
        (["-x**2", "--vars", "x", "--kappa", "1", "--annulus", "1"], "two radii"),
        (["-x**2", "--vars", "x", "--kappa", "1", "--radius", "-1"], "larger than 0"),
        (["-x**2", "--vars", "x", "--kappa", "1", "--timeout", "nan"], "time limit"),
    ],
)
def test_bad_input_is_refused(arguments, message):
    with pytest.raises(InputError, match=message):
        run(*arguments)


@pytest.mark.parametrize(
    ("text", "entries"),
    [("1,2", ["1", "2"]), ("atan2(1,2), 3", ["atan2(1,2)", "3"]), ("sqrt(2)", ["sqrt(2)"]), ("", [""])],
)
def test_lists_are_split_at_outer_commas(text, entries):
    assert split_list(text) == entries
