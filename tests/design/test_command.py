"""``ptproof design``: the JSON contract, a problem file's numbers to paste, the map, and bad input."""

import importlib
import json

import numpy as np
import pytest
from click.testing import CliRunner

from ptproof.commands.design import design
from ptproof.design import feasible_map
from ptproof.errors import InputError
from tests.design.test_search import PLAIN, R, average, made_up, searching

charting = importlib.import_module("ptproof.design.chart")


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    for module in (searching, charting):
        monkeypatch.setattr(module, "certify_loop", made_up)
        monkeypatch.setattr(module, "tight_bound", average)


def run(*arguments):
    result = CliRunner().invoke(design, arguments, standalone_mode=False)
    if result.exception is not None:
        raise result.exception
    return result


def test_json():
    result = run("saturated", "--seeker", "pt", "--residual", "0.5", "--json")
    data = json.loads(result.stdout)
    assert (result.return_value, data["verdict"]) == (0, "proved")
    assert set(data["numbers"]) == {"k", "T", "omega", "mu", "nu_min"}
    assert data["final"] == data["certificate"]["final"] <= 0.5
    assert data["u1_peak"] < data["u2_peak"]
    assert data["trials"][-1]["why"] == ""


def test_people_get_a_table_to_paste():
    text = run("saturated", "--seeker", "pt", "--residual", "0.5").stdout
    assert '[seeker]\nk = "1.4"\nT = "1"\nomega = "' in text
    assert "the vehicle itself is certified" in text


def test_none_found_is_status_one_and_says_why():
    result = run("saturated", "--seeker", "pt", "--residual", "0.5", "--u1-max", "1", "--json")
    data = json.loads(result.stdout)
    assert (result.return_value, data["verdict"], data["numbers"], data["final"]) == (1, "undecided", None, None)
    assert "limits of the inputs" in data["detail"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("saturated", "--seeker", "pt", "--residual", "0"), "residual"),
        (("saturated", "--seeker", "pt", "--residual", "x"), "--residual"),
        (("saturated", "--seeker", "pt", "--residual", "1", "--free", "speed"), "'speed' is not one of"),
        (("saturated", "--seeker", "pt", "--residual", "1", "--u1-max", "-1"), "u1_max"),
        (("nowhere.toml", "--residual", "1"), "nowhere.toml"),
        (("saturated", "--residual", "1"), "meant for saturated"),
        (("saturated", "--seeker", "pt", "--residual", "1", "--over", "k", "--plot", "x.png"), "--over"),
    ],
)
def test_bad_input_is_one_sentence(arguments, message):
    with pytest.raises(InputError, match=message):
        run(*arguments)


def test_the_map_says_what_holds_where(tmp_path):
    found = searching.design(PLAIN, R(1, 2))
    figure, classes = feasible_map(found, ("omega", "k"), size=5, limits=searching.Limits(u1_max=R(100, 9) * 12))
    assert classes.shape == (5, 5)
    columns = classes[2]
    assert columns[0] == 1
    assert columns[-1] == 3
    assert columns[3] == 0
    low = feasible_map(found, ("omega", "k"), size=2)[1]
    assert low[0, 0] in (1, 2)
    assert {text.get_text() for text in figure.legends[0].get_texts()} == set(charting.WORDS)
    drawn = figure.axes[0].collections[0].get_array()
    assert np.array_equal(np.asarray(drawn).reshape(classes.shape), classes)


def test_the_map_is_written(tmp_path):
    assert (
        run("saturated", "--seeker", "pt", "--residual", "0.5", "--plot", str(tmp_path / "map.png")).return_value == 0
    )
    assert (tmp_path / "map.png").stat().st_size > 5000
