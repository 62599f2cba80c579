"""The answer as text, data, constants and picture."""

import json

import pytest
import sympy as sp

from ptproof.certify import Domain, Range, certify_field
from ptproof.errors import InputError
from ptproof.problem.field import Field

x, y = sp.symbols("x1 x2", real=True)
R = sp.Rational


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
    assert "b2 = sup ‖∇F(x)‖ / ‖x − x*‖" in str(refuted)


def test_refuted_field_has_constants_up_to_the_largest_radius(refuted):
    bounds = refuted.smaller.field_bounds()
    radius = refuted.largest_radius
    assert bounds.a2 <= (1 - sp.cos(radius)) / radius**2 <= bounds.a2 * R(1001, 1000)
    assert bounds.b1 <= sp.sin(radius) / radius <= bounds.b1 * R(1001, 1000)
    assert bounds.a1 >= R(1, 2)
    assert bounds.b2 >= 1
    assert refuted.to_json()["witness"]["constants"]["b1"]["lower"] == refuted.smaller.b1.lower


def test_a_field_as_text_and_as_a_value_is_the_same(proved):
    text = certify_field("cos(x1) - x2^2", ["x1", "x2"], ["0", 0], "1", radius="1")
    assert certify_field(proved.field, radius=1) == text == proved


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((Field((x,), -(x**2), (0,), 1), (x,), (0,), 1), "leave them out"),
        (("-x1^2 - z", ["x1"], [0], 1), "unknown name 'z'"),
        (("-x1^2", ["x1"], [0]), "kappa"),
        ((-0.5 * x**2, [x], [0], 1), "must be exact"),
    ],
)
def test_what_is_no_field_is_refused(arguments, message):
    with pytest.raises(InputError, match=message):
        certify_field(*arguments)


def test_radii_have_decimals_beside_them_for_people():
    third, root, whole = (Domain(outer=radius) for radius in (R(3139, 1000), sp.sqrt(2), sp.Integer(2)))
    assert third.readable == "the ball ‖x − x*‖ ≤ 3139/1000 (3.139)"
    assert root.readable == "the ball ‖x − x*‖ ≤ sqrt(2) (about 1.41421)"
    assert whole.readable == str(whole)


def test_data_are_plain_json(proved, refuted):
    assert json.loads(json.dumps(proved.to_json()))["a1"]["lower"] == proved.a1.lower
    assert json.loads(json.dumps(refuted.to_json()))["witness"]["largest_radius"] == str(refuted.largest_radius)


def test_notebook_forms(proved):
    assert "<table>" in proved._repr_html_()
    assert proved._repr_latex_().startswith("$")


def test_picture_shows_both_quotients_inside_their_bands(proved, tmp_path):
    figure = proved.plot(str(tmp_path / "band.png"))
    left, right = figure.axes
    for axis, low, high in ((left, proved.a2, proved.a1), (right, proved.b1, proved.b2)):
        lines = [line.get_ydata() for line in axis.lines if len(line.get_xdata()) > 2]
        assert len(lines) == 48
        assert all(low.lower * (1 - 1e-9) <= y.min() and y.max() <= high.upper * (1 + 1e-9) for y in lines)
        assert {patch.get_y() for patch in axis.patches} == {low.lower, high.lower}
    assert (tmp_path / "band.png").read_bytes().startswith(b"\x89PNG")


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
