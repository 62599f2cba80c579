"""Witnesses: only exact values that satisfy everything assumed, at which the sides are certainly apart."""

from __future__ import annotations

import pytest
import sympy as sp

from ptproof.proof.claim import Goal
from ptproof.proof.engines.exact import exact
from ptproof.proof.engines.witnesses import check_witness, refute
from ptproof.proof.settling import settle
from ptproof.proof.statement import ForAll, Relation, eq, ge, gt, le
from ptproof.proof.verdict import Verdict

x, y, s = sp.symbols("x y s", real=True)
a = sp.Symbol("a", positive=True)
n = sp.Symbol("n", positive=True, integer=True)
F = sp.Function("F", real=True)(x)
W = sp.Function("W", nonnegative=True)


def test_witness_is_accepted() -> None:
    evidence = refute(Goal("t", le(x**2, x)), {x: 2})
    assert evidence.verdict is Verdict.REFUTED
    assert evidence.witness is not None
    assert evidence.witness.to_json() == {"values": {"x": "2"}, "left": "4", "right": "2"}


def test_witness_where_the_claim_holds_is_not_accepted() -> None:
    assert refute(Goal("t", le(x**2, x)), {x: sp.Rational(1, 2)}).verdict is Verdict.UNDECIDED


def test_witness_must_satisfy_the_assumptions() -> None:
    assert check_witness(Goal("t", le(x, 1), (le(x, 1),)), {x: 2})[0] is None


def test_witness_must_be_what_the_symbol_stands_for() -> None:
    assert check_witness(Goal("t", gt(a, 0)), {a: -1})[0] is None
    assert check_witness(Goal("t", ge(n, 1)), {n: sp.Rational(1, 2)})[0] is None


def test_witness_for_a_function_keeps_its_declared_sign() -> None:
    goal = Goal("t", ge(W(s), 0))
    assert check_witness(goal, {W(s): s, s: -1})[0] is None


def test_quantified_assumption_is_checked_for_all_values() -> None:
    goal = Goal("t", le(W(x), 1), (ForAll((s,), le(W(s), 1), (ge(s, 0),)), ge(x, 0)))
    # 1 + s² satisfies the assumption at s = 0 only; the value given for s must not stand for the bound one.
    assert check_witness(goal, {W(s): 1 + s**2, s: 0, x: 3})[0] is None


def test_undefined_function_becomes_a_concrete_one() -> None:
    evidence = settle(Goal("t", eq(sp.diff(F**2, x), F * sp.diff(F, x))), exact)
    assert evidence.verdict is Verdict.REFUTED
    assert evidence.witness is not None
    assert "F(x)" in evidence.witness.values


def test_true_statement_is_never_refuted() -> None:
    assert exact(Goal("t", eq(sp.diff(F**2, x), 2 * F * sp.diff(F, x)))).verdict is Verdict.PROVED


def test_strict_inequality_is_refuted_by_equality() -> None:
    assert refute(Goal("t", gt(x, 1)), {x: 1}).verdict is Verdict.REFUTED


def test_values_that_are_too_close_are_told_apart_or_not_at_all() -> None:
    tiny = sp.Rational(1, 10**60)
    assert refute(Goal("t", eq(sp.sin(x) ** 2 + sp.cos(x) ** 2, 1 + y)), {x: 1, y: tiny}).verdict is Verdict.REFUTED
    assert refute(Goal("t", eq(sp.sin(x) ** 2 + sp.cos(x) ** 2, 1 + y)), {x: 1, y: 0}).verdict is Verdict.UNDECIDED


X = sp.Function("X", real=True)
MOVES = eq(sp.Derivative(X(s), s), sp.cos(X(s)))


@pytest.mark.parametrize(
    ("path", "domain", "end", "accepted"),
    [
        (s, (ge(s, 0), le(s, x)), 0, True),
        (s, (ge(s, 0), le(s, x)), 1, False),  # on the rest of the interval it does not move like this
        (2 * s, (ge(s, 0), le(s, x)), 0, False),  # the derivative is another one
        (sp.Abs(s), (ge(s, 0), le(s, x)), 0, False),  # there is no derivative
        (s, (ge(s, 0),), 0, False),
        (s, (ge(s, 0), ge(s, x)), 0, False),
    ],
)
def test_assumption_on_a_single_instant_is_checked_there(
    path: sp.Expr, domain: tuple[Relation, ...], end: int, accepted: bool
) -> None:
    goal = Goal("t", le(X(x), -1), (ForAll((s,), MOVES, domain),))
    assert (check_witness(goal, {X(s): path, x: end})[0] is not None) is accepted
