"""What must never be proved: statements that hold only if something is taken for real, inside a domain or two-sided."""

import pytest
import sympy as sp

from ptproof.proof.claim import Goal
from ptproof.proof.engines.exact import exact
from ptproof.proof.engines.existence import defeats_every_choice
from ptproof.proof.engines.limits import limits
from ptproof.proof.engines.reals import reals
from ptproof.proof.lemmas import power_monotone
from ptproof.proof.settling import settle
from ptproof.proof.statement import Exists, Relation, eq, ge, gt, le
from ptproof.proof.verdict import Verdict

x, y, p = sp.symbols("x y p", real=True)
a = sp.Symbol("a", positive=True)
half = sp.Rational(1, 2)


@pytest.mark.parametrize("exponent", [half, half / 2, sp.Rational(1, 3)])
def test_lemma_that_mentions_a_root_says_nothing_of_the_sign(exponent):
    found = settle(Goal("a", ge(x, 0)), lambda goal: reals(goal, power_monotone(x, y, exponent)))
    assert found.verdict is Verdict.REFUTED


def test_power_with_even_coefficient_is_not_a_square_of_a_real_number():
    # x = −1, p = 1/2: x^(2p) = −1.
    assert settle(Goal("a", ge(x ** (2 * p), 0)), reals).verdict is Verdict.REFUTED


@pytest.mark.parametrize("statement", [
    ge(sp.sqrt(x), 0), ge(2 * sp.sqrt(x - 1) + 1, 0), ge(sp.log(x) ** 2, 0), gt(sp.sin(sp.sqrt(x)) + 2, 0),
    ge(sp.asin(x) ** 2, 0), ge(sp.acosh(x) ** 2, 0),
])  # fmt: skip
def test_statement_has_to_be_defined(statement):
    assert reals(Goal("a", statement)).verdict is not Verdict.PROVED


@pytest.mark.parametrize(("statement", "assumption"), [
    (ge(sp.sqrt(x), 0), ge(x, 0)), (ge(sp.sqrt(x - 1), 0), ge(x, 2)), (ge(sp.log(x) ** 2, 0), gt(x, 0)),
    (le(sp.sqrt(1 - x**2), 1), le(x**2, 1)),
])  # fmt: skip
def test_statement_that_is_defined_by_its_assumption_is_proved(statement, assumption):
    assert reals(Goal("a", statement, (assumption,))).verdict is Verdict.PROVED


@pytest.mark.parametrize("value", [sp.oo, -sp.oo])
def test_two_sided_limit_is_not_decided_from_one_side(value):
    assert limits(Goal("a", eq(sp.Limit(1 / x, x, 0, "+-"), value))).verdict is Verdict.UNDECIDED


def test_counterexample_family_stays_in_the_domain():
    bounded = Exists((a,), (le(x, a),), over=(x,))
    assert defeats_every_choice(Goal("a", bounded), {x: a + 1}).verdict is Verdict.REFUTED
    assert defeats_every_choice(Goal("a", bounded, (le(x, 1),)), {x: a + 1}).verdict is Verdict.UNDECIDED


def test_counterexample_family_works_for_every_choice():
    bounded = Exists((a,), (le(x, a),), over=(x,))
    assert defeats_every_choice(Goal("a", bounded, (le(a, 1),)), {x: 2}).verdict is Verdict.UNDECIDED


def test_reciprocal_of_what_has_no_rule_is_undecided():
    pole = sp.Limit(1 / sp.Max(half, 1 - x) ** 2, x, 1, "-")
    assert limits(Goal("a", eq(pole, 4))).verdict is Verdict.UNDECIDED
    assert limits(Goal("a", eq(sp.Limit(1 / (1 - sp.cos(x)), x, 0, "+"), sp.oo))).verdict is Verdict.UNDECIDED
    assert limits(Goal("a", eq(sp.Limit(1 / (1 + sp.cos(x)), x, 0, "+"), half))).verdict is Verdict.PROVED


@pytest.mark.parametrize("assumptions", [(gt(x, 1), le(x, 0)), (le(a, 0),), (gt(sp.sin(x), 1),)])
def test_contradicting_assumptions_prove_nothing(assumptions):
    found = settle(Goal("a", ge(x, y), assumptions), reals)
    assert found.verdict is Verdict.UNDECIDED
    assert "contradict" in found.detail


def test_symbol_that_may_be_complex_is_not_taken_for_real():
    s = sp.Symbol("s")
    assert reals(Goal("a", Relation(s**2 + 1, "!=", sp.S.Zero))).verdict is not Verdict.PROVED


def test_assumed_value_of_a_function_is_not_differentiated():
    F = sp.Function("F", real=True)(x)
    found = settle(Goal("a", eq(sp.Derivative(F, x), 2 * x), (eq(F, x**2),)), exact)
    assert found.verdict is Verdict.REFUTED
