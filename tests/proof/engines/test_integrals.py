"""Definite integrals by checked antiderivatives, and SymPy's wrong ones that are not used."""

from __future__ import annotations

import pytest
import sympy as sp

from ptproof.proof.claim import Goal
from ptproof.proof.engines.evaluation import definite
from ptproof.proof.engines.integrals import integrals
from ptproof.proof.relation import RelationSign
from ptproof.proof.settling import settle
from ptproof.proof.statement import Relation, eq
from ptproof.proof.verdict import Verdict

s, theta = sp.symbols("s theta", real=True)
T, a = sp.symbols("T a", positive=True)


def test_rational_integral_to_infinity() -> None:
    goal = Goal("t", eq(sp.Integral(a / (1 + s / T) ** 2, (s, 0, sp.oo)), a * T))
    assert integrals(goal).verdict is Verdict.PROVED


def test_wrong_value_is_refuted() -> None:
    goal = Goal("t", eq(sp.Integral(a / (1 + s / T) ** 2, (s, 0, sp.oo)), 2 * a * T))
    assert settle(goal, integrals).verdict is Verdict.REFUTED


def test_iterated_integral() -> None:
    inner = sp.Integral(sp.cos(s), (s, 0, theta))
    goal = Goal("t", eq(sp.Integral(sp.sin(theta) * inner, (theta, 0, 2 * sp.pi)) / (2 * sp.pi), sp.Rational(1, 2)))
    assert integrals(goal).verdict is Verdict.PROVED


WAVES = sp.Integral(sp.cos(2 * a * s) * sp.sin(a * theta), (s, 0, theta), (theta, 0, 2 * sp.pi / a))
PARTS = sp.Integral(theta**2 * sp.cos(a * theta) * sp.cos(2 * a * theta), (theta, 0, 2 * sp.pi / a))


@pytest.mark.parametrize(("integral", "value"), [(WAVES, 0), (PARTS, 20 * sp.pi / (9 * a**3))], ids=["waves", "parts"])
def test_products_of_waves(integral: sp.Expr, value: sp.Expr) -> None:
    """∫₀^{2π} u² (cos u + cos 3u)/2 du = 2π (1 + 1/9), since ∫₀^{2π} u² cos nu du = 4π/n²."""
    assert integrals(Goal("t", eq(integral, value))).verdict is Verdict.PROVED
    assert integrals(Goal("t", eq(integral, value + 1 / a**3))).verdict is not Verdict.PROVED


def test_a_wave_whose_rate_may_be_zero_is_not_divided_by_it() -> None:
    rate = sp.Symbol("b", real=True)
    goal = Goal("t", eq(sp.Integral(sp.cos(rate * s) * sp.cos(rate * s + 1), (s, 0, 1)), 0))
    assert integrals(goal).verdict is Verdict.UNDECIDED


@pytest.mark.parametrize(
    ("integrand", "upper", "wrong"),
    [
        (sp.Abs(sp.sin(s) * sp.cos(s)), 2 * sp.pi, 1),  # the truth is 2
        (sp.Abs(sp.sin(s)), 7 * sp.pi, 2),  # the truth is 14
        (1 / (2 + sp.cos(s)), 2 * sp.pi, 0),  # the truth is 2π/√3
    ],
)
def test_what_sympy_gets_wrong_is_not_proved(integrand: sp.Expr, upper: sp.Expr, wrong: int) -> None:
    goal = Goal("t", eq(sp.Integral(integrand, (s, 0, upper)), wrong))
    assert integrals(goal).verdict is not Verdict.PROVED


def test_pole_inside_is_refused() -> None:
    assert definite(sp.Integral(1 / (s - 1) ** 2, (s, 0, 2))) is None


def test_a_logarithm_serves_where_its_argument_is_positive() -> None:
    assert definite(sp.Integral(1 / (1 + s), (s, 0, T))) == sp.log(1 + T)
    assert definite(sp.Integral(1 / (1 + s), (s, 0, sp.oo))) is sp.oo
    assert definite(sp.Integral(1 / (1 + s), (s, -2, 0))) is None


@pytest.mark.parametrize("sign", ["!=", "<", ">"])
def test_what_is_no_equality_is_refuted_by_the_value(sign: RelationSign) -> None:
    """At a point that the engine suspects, without a search."""
    goal = Goal("t", Relation(WAVES, sign, sp.S.Zero))
    assert settle(goal, integrals, seconds=0).verdict is Verdict.REFUTED


@pytest.mark.parametrize("sign", ["<=", ">="])
def test_what_is_no_equality_is_not_refuted_where_it_holds(sign: RelationSign) -> None:
    assert settle(Goal("t", Relation(WAVES, sign, sp.S.Zero)), integrals, seconds=0).verdict is Verdict.UNDECIDED


def test_another_value_is_refuted_without_a_search() -> None:
    goal = Goal("t", eq(PARTS, 21 * sp.pi / (9 * a**3)))
    assert settle(goal, integrals, seconds=0).verdict is Verdict.REFUTED
