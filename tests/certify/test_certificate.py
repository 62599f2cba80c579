"""The answer as text, data, constants and picture."""

import json

import pytest
import sympy as sp

from ptproof.certify import Range, certify_field
from ptproof.errors import InputError

x, y = sp.symbols("x1 x2", real=True)


@pytest.fixture(scope="module")
def proved():
    return certify_field(sp.cos(x) - y**2, (x, y), (0, 0), 1, radius=1)


@pytest.fixture(scope="module")
def refuted():
    return certify_field(sp.cos(x), (x,), (0,), 1, radius=4)


def test_exact_constants_hold_outside_of_the_enclosures(proved):
    bounds = proved.field_bounds()
    assert bounds.a1 >= proved.a1.upper
    assert bounds.a2 <= proved.a2.lower
    assert bounds.b1 <= proved.b1.lower
    assert bounds.b2 >= proved.b2.upper
    assert all(isinstance(value, sp.Rational) for value in (bounds.a1, bounds.a2, bounds.b1, bounds.b2))


def test_refuted_field_has_no_constants(refuted):
    with pytest.raises(InputError, match="refuted"):
        refuted.field_bounds()


def test_text_names_verdict_and_witness(proved, refuted):
    assert "proved on the ball ‖x − x*‖ ≤ 1" in str(proved)
    assert "a2 = inf (F(x*) − F(x)) / ‖x − x*‖^2" in str(proved)
    assert "x1 = 3.14159" in str(refuted) or "x1 = -3.14159" in str(refuted)
    assert "Positive constants are certified on the ball" in str(refuted)


def test_data_are_plain_json(proved, refuted):
    assert json.loads(json.dumps(proved.to_json()))["a1"]["lower"] == proved.a1.lower
    assert json.loads(json.dumps(refuted.to_json()))["witness"]["largest_radius"] == str(refuted.largest_radius)


def test_notebook_forms(proved):
    assert "<table>" in proved._repr_html_()
    assert proved._repr_latex_().startswith("$")


def test_picture_shows_both_quotients(proved, tmp_path):
    figure = proved.plot(str(tmp_path / "band.png"))
    assert len(figure.axes) == 2
    assert (tmp_path / "band.png").exists()


@pytest.mark.parametrize(
    ("ends", "text"),
    [
        (Range(), "not known"),
        (Range(0.5, 2 / 3), "[0.5, 0.6666667]"),
        (Range(1 / 3, 0.375), "[0.3333333, 0.375]"),
        (Range(2 / 3, None), "[0.6666666, …]"),
    ],
)
def test_ends_are_rounded_outwards(ends, text):
    assert str(ends) == text
