"""assert_identity and assert_inequality: pass when proved, fail with what a person needs, refuse bad use."""

from fractions import Fraction

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.testing import assert_identity, assert_inequality, eq, ge, gt, le, lt

x, y = sp.symbols("x y", real=True)
k = sp.Symbol("k", positive=True)
F = sp.Function("F", real=True)(x)
PERIOD = (x, 0, 2 * sp.pi)

TRUE = [
    (sp.cos(2 * x), 1 - 2 * sp.sin(x) ** 2, ()),
    ([x, sp.sin(x) ** 2], (x, 1 - sp.cos(x) ** 2), ()),
    (sp.Matrix([k * F.diff(x)]), [sp.diff(k * F, x)], ()),
    (x**2, 4, [eq(x, -2)]),
    (sp.Max(x, y), (x + y + sp.Abs(x - y)) / 2, ()),
    (sp.Integral(sp.sin(x) ** 2, PERIOD), sp.pi, ()),
    (sp.pi, sp.Integral(sp.sin(x) ** 2, PERIOD), ()),
    (sp.Limit(x / (x + 1), x, sp.oo, "-"), 1, ()),
    (x * Fraction(1, 2), x / 2, ()),
]
FALSE = [
    (sp.cos(2 * x), 1 - sp.sin(x) ** 2, ()),
    ([x, sp.sin(x) ** 2], (x, 1 + sp.cos(x) ** 2), ()),
    (k * F.diff(x) / 2, k * F.diff(x), ()),
    (x**2, 5, [eq(x, -2)]),
    (sp.Max(x, y), (x + y - sp.Abs(x - y)) / 2, ()),
    (sp.Integral(sp.sin(x) ** 2, PERIOD), 2 * sp.pi, ()),
    (2 * sp.pi, sp.Integral(sp.sin(x) ** 2, PERIOD), ()),
    (sp.Limit(x / (x + 1), x, sp.oo, "-"), 2, ()),
]


@pytest.mark.parametrize(("left", "right", "given"), TRUE)
def test_a_true_identity_passes(left, right, given):
    assert assert_identity(left, right, given=given) is None


@pytest.mark.parametrize(("left", "right", "given"), FALSE)
def test_a_false_identity_fails_with_a_witness(left, right, given):
    with pytest.raises(AssertionError, match=r"(?s)not equal: refuted.*difference:.*witness:"):
        assert_identity(left, right, given=given)


def test_the_message_shows_both_sides_and_the_difference_in_simplest_form():
    with pytest.raises(AssertionError) as failed:
        assert_identity(sp.cos(2 * x), 1 - sp.sin(x) ** 2)
    text = str(failed.value)
    assert "left:       cos(2*x)" in text
    assert "right:      1 - sin(x)**2" in text
    assert "difference: -sin(x)**2  (left - right)" in text


@pytest.mark.parametrize("swapped", [False, True])
def test_the_witness_names_the_sides_as_they_were_given(swapped):
    sides = (sp.Integral(x, (x, 0, 2)), sp.Integer(3))
    left, right = reversed(sides) if swapped else sides
    with pytest.raises(AssertionError, match="left 3, right 2" if swapped else "left 2, right 3"):
        assert_identity(left, right)


def test_undecided_is_a_failure_that_says_so():
    with pytest.raises(AssertionError, match=r"(?s)undecided.*simplification, which proves nothing.*tried:"):
        assert_identity(sp.gamma(x + 1), x * sp.gamma(x))


def test_out_of_time_is_undecided(monkeypatch):
    def slow(goal):
        while True:
            pass

    monkeypatch.setattr("ptproof.proof.engines.exact.exact", slow)
    with pytest.raises(AssertionError, match=r"(?s)undecided.*no answer in 0.2 s"):
        assert_identity(x, x, seconds=0.2)


TRUE_INEQUALITIES = [
    (ge(x**2 + y**2, 2 * x * y), ()),
    (ge(x, 0), [ge(x, 1)]),
    (sp.Le(sp.sin(x), 2, evaluate=False), ()),
    (le(sp.cos(x), 1), [ge(x, 0), le(x, 1)]),
    (lt(sp.exp(-x) * sp.sin(x), sp.Rational(1, 2)), [ge(x, 0), le(x, 1)]),
    (gt(k, 0), ()),
]
FALSE_INEQUALITIES = [
    (ge(x**2 + y**2, 3 * x * y), ()),
    (ge(x, 0), [ge(x, -1)]),
    (x**2 >= 1, ()),
    (lt(sp.exp(-x) * sp.sin(x), sp.Rational(3, 10)), [ge(x, 0), le(x, 1)]),
    (gt(k, 1), ()),
]


@pytest.mark.parametrize(("relation", "given"), TRUE_INEQUALITIES)
def test_a_true_inequality_passes(relation, given):
    assert_inequality(relation, given=given)


@pytest.mark.parametrize(("relation", "given"), FALSE_INEQUALITIES)
def test_a_false_inequality_fails_with_a_witness(relation, given):
    with pytest.raises(AssertionError, match=r"(?s)does not hold: refuted.*witness:"):
        assert_inequality(relation, given=given)


def test_one_assumption_need_not_be_a_list():
    assert_inequality(ge(x, 0), given=ge(x, 1))


@pytest.mark.parametrize("relation", [x**2 >= 0, sp.true, True, False])
def test_a_relation_that_was_evaluated_before_is_refused(relation):
    with pytest.raises(InputError, match=r"evaluated to (True|False) before it could be checked"):
        assert_inequality(relation)


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda: assert_identity(0.5, x), InputError, "left: 0.5 is not exact"),
        (lambda: assert_identity(x, sp.Float(0.5) * x), InputError, "right: contains the floating-point number 0.5"),
        (lambda: assert_identity([x, y], [x]), InputError, "shapes"),
        (lambda: assert_identity(sp.nan, x), InputError, "nan"),
        (lambda: assert_identity("y +", x), InputError, "left: cannot read"),
        (lambda: assert_identity(None, x), TypeError, "left: expected an expression, got NoneType"),
        (lambda: assert_identity(x, x, seconds=-1), InputError, "seconds"),
        (lambda: assert_identity(x, x, seconds=float("inf")), InputError, "seconds"),
        (lambda: assert_identity(x, x, given="x > 0"), TypeError, "given"),
        (lambda: assert_identity(x, x, given=[3]), TypeError, r"given\[0\]"),
        (lambda: assert_inequality(3), TypeError, "statement: expected a relation"),
    ],
)
def test_bad_use_is_refused_with_the_place(call, error, words):
    with pytest.raises(error, match=words):
        call()
