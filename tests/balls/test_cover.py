"""Inequalities on boxes: proved by a cover, refuted at an exact point, or undecided and said so."""

import pytest
import sympy as sp

from ptproof.balls.ball import enclose
from ptproof.balls.cover import holds_on_box
from ptproof.errors import InputError

x, y = sp.symbols("x y", real=True)
R = sp.Rational
unit = {x: (-1, 1), y: (-1, 1)}

# Each row is true by hand; its corrupted twin, with the constant on the wrong side, must be refuted.
TRUE_AND_CORRUPTED = [
    # The maximum of (1 + x) exp(-x²) is at x = (√3 − 1)/2: 1.1948...
    ((1 + x) * sp.exp(-(x**2)), "<", R(1195, 1000), R(1194, 1000), {x: (-3, 3)}),
    # sinc has its minimum −0.2172336... at 4.4934...
    (sp.sin(x) / x, ">", -R(217234, 10**6), -R(217233, 10**6), {x: (R(1, 10), 30)}),
    # The Motzkin polynomial is at least 0, touched at |x| = |y| = 1.
    (x**2 * y**4 + x**4 * y**2 + 1 - 3 * x**2 * y**2, ">", -R(1, 100), R(1, 100), {x: (-2, 2), y: (-2, 2)}),
    (x**2 + y**2 - 2 * x * y, ">=", -R(1, 1000), R(1, 1000), unit),
    (sp.cos(x) * sp.cos(y), "<=", 1, R(999, 1000), {x: (R(1, 100), 3), y: (0, 3)}),
    (sp.Abs(x) + sp.Max(x, y), ">=", -R(1, 1000), R(1, 1000), unit),
    (sp.sqrt(2 - x**2 - y**2) * x, "<", R(1001, 1000), R(999, 1000), {x: (0, 1), y: (-R(1, 2), R(1, 2))}),
]


@pytest.mark.parametrize(("expression", "relation", "bound", "corrupted", "box"), TRUE_AND_CORRUPTED)
def test_true_bound_is_proved(expression, relation, bound, corrupted, box):
    result = holds_on_box(expression - bound, relation, box)
    assert result.holds is True, result.detail


@pytest.mark.parametrize(("expression", "relation", "bound", "corrupted", "box"), TRUE_AND_CORRUPTED)
def test_corrupted_bound_is_refuted_at_a_point_of_the_box(expression, relation, bound, corrupted, box):
    result = holds_on_box(expression - corrupted, relation, box)
    assert result.holds is False
    assert all(sp.Le(low, result.point[key]) and sp.Le(result.point[key], high) for key, (low, high) in box.items())
    value = enclose(expression - corrupted, result.point)
    assert value < 0 if relation[0] == ">" else value > 0


def test_equality_at_a_corner_refutes_a_strict_inequality():
    result = holds_on_box(x - 1, "<", {x: (0, 1)})
    assert (result.holds, result.point) == (False, {x: 1})


def test_irrational_end_is_part_of_the_box():
    result = holds_on_box(x - 2 * sp.pi / 3 + R(1, 10**12), "<", {x: (0, 2 * sp.pi / 3)})
    assert (result.holds, result.point) == (False, {x: 2 * sp.pi / 3})


def test_touching_sides_are_undecided():
    result = holds_on_box(x**2 - 2 * x * y + y**2, ">=", unit, max_boxes=500)
    assert result.holds is None
    assert "500 boxes" in result.detail


def test_singularity_inside_the_box_is_undecided():
    assert holds_on_box(1 / x**2, ">", {x: (-1, 1)}, max_boxes=300).holds is None


def test_jump_is_not_taken_for_a_slope():
    step = sp.Piecewise((x, x < R(1, 3)), (x - 5, True))
    assert holds_on_box(step + 4, ">", {x: (0, 1)}).holds is False
    assert holds_on_box(step + R(47, 10), ">", {x: (0, 1)}).holds is True


def test_no_symbols_at_all():
    assert holds_on_box(sp.pi - 3, ">", {}).holds is True
    assert holds_on_box(3 - sp.pi, ">", {}).holds is False


@pytest.mark.parametrize(
    ("relation", "box", "message"),
    [
        ("==", {x: (0, 1)}, "relation"),
        ("<", {}, "no range is given for x"),
        ("<", {x: (1, 0)}, "empty"),
        ("<", {x: (0.0, 1)}, "exact"),
        ("<", {x: (0, sp.oo)}, "exact"),
    ],
)
def test_bad_input_is_refused(relation, box, message):
    with pytest.raises(InputError, match=message):
        holds_on_box(x, relation, box)
