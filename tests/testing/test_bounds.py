"""assert_field_bounds and assert_gain_condition."""

from dataclasses import replace

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.gains import GainData
from ptproof.problem import example
from ptproof.problem.field import Field, FieldBounds
from ptproof.testing import assert_field_bounds, assert_gain_condition

x1, x2 = sp.symbols("x1 x2", real=True)
half = sp.Rational(1, 2)
PLANE = {"variables": (x1, x2), "source": (0, 0)}
bowl = -(x1**2 + x2**2) / 2
EXACT = {"a1": half, "a2": half, "b1": sp.Integer(1), "b2": sp.Integer(1)}


def test_positive_constants_exist():
    assert_field_bounds(bowl, **PLANE)


def test_text_is_parsed():
    assert_field_bounds("5/2 + cos(2*pi/3*x1)/2 - (x1**2 + x2**2)/2", b1="1/10", b2=4, **PLANE)


def test_the_best_constants_themselves_hold():
    assert_field_bounds(bowl, **EXACT, **PLANE)


@pytest.mark.parametrize(
    ("name", "factor"),
    [("a1", "0.99"), ("a2", "1.01"), ("b1", "1.01"), ("b2", "0.99")],
)
def test_a_constant_a_little_to_the_wrong_side_is_refuted(name, factor):
    wrong = {**EXACT, name: EXACT[name] * sp.Rational(factor)}
    with pytest.raises(AssertionError, match=rf"(?s)does not hold: refuted.*{name}: .*has to be at"):
        assert_field_bounds(bowl, **wrong, **PLANE)


def test_a_field_without_such_bounds_fails_with_the_witness():
    with pytest.raises(AssertionError, match=r"(?s)no such bounds: refuted.*witness:"):
        assert_field_bounds(-(x1**4 + x2**2) / 2, **PLANE)


def test_a_domain_can_be_given():
    hill = 1 / (1 + x1**2 + x2**2)
    assert_field_bounds(hill, radius=half, **PLANE)
    with pytest.raises(AssertionError, match="refuted"):
        assert_field_bounds(hill, **PLANE)


def test_a_constant_within_the_enclosure_of_the_best_one_is_undecided():
    """The best b1 is 0.52354…, which no engine tells from this number in time, nor the coarse enclosure."""
    wavy = "5/2 + cos(2*pi/3*x1)/2 - (x1**2 + x2**2)/2"
    with pytest.raises(AssertionError, match=r"(?s)could not be decided: undecided.*b1: .*smaller rtol"):
        assert_field_bounds(wavy, b1="0.5233", rtol=0.1, seconds=1, **PLANE)


def test_out_of_time_is_undecided():
    with pytest.raises(AssertionError, match="could not be decided: undecided"):
        assert_field_bounds("cos(x1)*cos(x2) + cos(x1*x2) - x1**2", radius=half, seconds=0.001, **PLANE)


@pytest.mark.parametrize(
    ("changes", "error", "words"),
    [
        ({"a1": -1}, InputError, "a1: expected a positive number"),
        ({"a1": 0.5}, InputError, "not exact"),
        ({"radius": 0.5}, InputError, "radius"),
        ({"source": (0,)}, InputError, "source"),
        ({"kappa": 0}, InputError, "kappa"),
        ({"variables": ["x1", "x2"]}, TypeError, "variables"),
    ],
)
def test_bad_use_is_refused(changes, error, words):
    with pytest.raises(error, match=words):
        assert_field_bounds(bowl, **{**PLANE, **changes})


data = GainData(FieldBounds(1, 2, 1, 1, 2), k=3, T=1, drift_norm=1, nu_min=half, V0=1)


@pytest.mark.parametrize(
    "condition",
    [
        "k > asymptotic.k_min",
        "asymptotic.k_min <= 2",
        "prescribed_time.overshoot < 10.45",
        "prescribed_time.overshoot > 10.44",
        "2*asymptotic.k_min + 1 >= 5",
        "V0 < critical.V0_threshold",
        "a2 < a1",
    ],
)
def test_a_condition_that_holds(condition):
    assert_gain_condition(data, condition)


@pytest.mark.parametrize(
    "condition",
    [
        "k > asymptotic.k_min_printed",
        "asymptotic.k_min < 2",
        "k <= asymptotic.k_min",
        "prescribed_time.overshoot < 10.44",
        "2*asymptotic.k_min > 4",
        "critical.V0_threshold <= 10**9",
    ],
)
def test_a_condition_that_does_not_hold_fails_with_both_sides(condition):
    with pytest.raises(AssertionError, match=r"does not hold: refuted"):
        assert_gain_condition(data, condition)


def test_a_problems_own_constants_are_certified():
    problem = example("vanishing")
    assert_gain_condition(problem, "k > clip.k_min_after_clip")
    with pytest.raises(AssertionError, match=r"(?s)refuted.*asymptotic.k_min:"):
        assert_gain_condition(problem, "k > asymptotic.k_min")


def test_a_problem_whose_field_has_no_bounds_is_undecided():
    flat = replace(example("saturated"), field=Field((x1, x2), -(x1**4) / 4 - x2**2, (0, 0), 1))
    with pytest.raises(AssertionError, match=r"(?s)undecided.*not certified: refuted"):
        assert_gain_condition(flat, "k > 0")


def test_the_message_has_the_exact_values():
    with pytest.raises(AssertionError) as failed:
        assert_gain_condition(data, "k > asymptotic.k_min_printed")
    assert "asymptotic.k_min_printed: 16" in str(failed.value)
    assert "-13  (left - right)" in str(failed.value)


def test_what_does_not_apply_is_undecided():
    with pytest.raises(AssertionError, match=r"(?s)undecided.*needs drift_bound"):
        assert_gain_condition(data, "nonvanishing.ultimate_bound < 1")


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        ((data, "k = 3"), InputError, "not one of"),
        ((data, "k > foo.bar"), InputError, "foo.bar is not a quantity"),
        ((data, "omega > 3"), InputError, "unknown name 'omega'"),
        ((data, "1 < k < 3"), InputError, "not one of"),
        ((data, 3), TypeError, "condition: expected text"),
        ((3, "k > 0"), TypeError, "data: expected GainData"),
        ((data, "__import__('os') > 3"), InputError, "condition"),
    ],
)
def test_bad_conditions_are_refused(arguments, error, words):
    with pytest.raises(error, match=words):
        assert_gain_condition(*arguments)


STEP = sp.Piecewise((1, x2 < 1), (2, True))


WIDE = {"a1": 9, "a2": "1/9", "b1": "1/9", "b2": 9}


@pytest.mark.parametrize(
    ("factor", "constants"),
    [
        (STEP, {}),
        (STEP, WIDE),
        (STEP, {"b1": "1/9"}),
        (1 + sp.sign(x1) ** 2, {"b1": "1/9"}),
        (1 + sp.Heaviside(x2 - 1), WIDE),
        (3 + sp.atan(x1) + sp.atan(1 / (x1 - 1)), {}),
        (3 + sp.atan(x1) + sp.atan(1 / (x1 - 1)), {"b1": "1/9"}),
        (1 + sp.floor(x1), WIDE),
    ],
)
def test_a_field_that_jumps_has_no_bounds(factor, constants):
    with pytest.raises(AssertionError, match=r"(?s)undecided|refuted"):
        assert_field_bounds(-(x1**2 + x2**2) * factor, radius=2, rtol=1, seconds=0.3, **constants, **PLANE)


def test_the_sentence_names_the_jump():
    with pytest.raises(AssertionError, match=r"(?s)undecided.*no gradient: Piecewise.*the value jumps at"):
        assert_field_bounds(-(x1**2 + x2**2) * STEP, **PLANE)


def test_a_field_that_jumps_elsewhere_has_bounds_here():
    assert_field_bounds(-(x1**2 + x2**2) * STEP, radius=half, a1="1.001", a2="0.999", b1="1.99", b2="2.01", **PLANE)
    with pytest.raises(AssertionError, match="refuted"):
        assert_field_bounds(-(x1**2 + x2**2) * STEP, radius=half, a1="0.99", **PLANE)


def test_a_condition_for_all_time_needs_a_level_that_lies_where_the_constants_hold():
    """From (1.9, 1.9) the level of V reaches beyond the saddles of cos x₁ + cos x₂, from (1, 1) it does not."""
    hills = replace(example("saturated"), field=Field((x1, x2), sp.cos(x1) + sp.cos(x2), (0, 0), 1))
    near, far = (replace(hills, initial=replace(hills.initial, x=(sp.Rational(r),) * 2)) for r in ("1", "1.9"))
    assert_gain_condition(near, "k > asymptotic.k_min")
    with pytest.raises(AssertionError, match=r"(?s)undecided.*later times are not shown to keep it there"):
        assert_gain_condition(far, "k > asymptotic.k_min")
    assert_gain_condition(far, "k > clip.k_min_after_clip")
