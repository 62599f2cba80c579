"""Signs and zeros are certain or not told at all."""

import pytest
import sympy as sp

from ptproof.proof.signs import holds, sign_of, vanishes
from ptproof.proof.statement import Relation

x = sp.Symbol("x", real=True)
p = sp.Symbol("p", positive=True)
ROOT = sp.CRootOf(x**5 - x - 1, 0)
NEAR_PI = sp.Rational(sp.pi.evalf(60))


@pytest.mark.parametrize(
    ("expression", "sign"),
    [
        (0, 0),
        (sp.Rational(-1, 10**400), -1),
        (sp.pi - NEAR_PI, 1 if sp.pi.evalf(90) > NEAR_PI else -1),
        (sp.sqrt(5 + 2 * sp.sqrt(6)) - sp.sqrt(2) - sp.sqrt(3), None),
        ((sp.sqrt(2) + 1) * (sp.sqrt(3) - 1) - sp.sqrt(6) - sp.sqrt(3) + sp.sqrt(2) + 1, 0),
        ((sp.sqrt(2) + 1) * (sp.sqrt(3) - 1) - sp.sqrt(6) - sp.sqrt(3) + sp.sqrt(2), -1),
        (ROOT, 1),
        (ROOT - sp.Rational(ROOT.eval_rational(dx=sp.Rational(1, 10**30))) - sp.Rational(1, 10**29), -1),
        (p + 1, 1),
        (-p, -1),
        (p - p * (sp.sin(x) ** 2 + sp.cos(x) ** 2), 0),
        (sp.Function("h", positive=True)(0), 1),
    ],
)
def test_sign(expression, sign):
    assert sign_of(expression) == sign


@pytest.mark.parametrize(
    "expression", [x, p - 1, sp.I, sp.zoo, sp.nan, sp.log(-1), sp.Float("0.5"), sp.CRootOf(x**5 - x - 1, 1)]
)
def test_what_is_not_decided_has_no_sign(expression):
    assert sign_of(expression) is None


def test_a_quotient_by_what_vanishes_is_not_zero():
    nothing = sp.sin(x) ** 2 + sp.cos(x) ** 2 - 1
    assert vanishes(nothing)
    assert not vanishes(nothing / nothing)
    assert not vanishes((sp.expand((x + 1) ** 2) - (x + 1) ** 2) / nothing)


@pytest.mark.parametrize(
    ("sign", "truth"), [("=", False), ("!=", True), ("<", True), ("<=", True), (">", False), (">=", False)]
)
def test_a_relation_between_numbers(sign, truth):
    assert holds(Relation(3, sign, sp.pi)) is truth


def test_a_cubic_root_is_not_zero():
    assert not vanishes(sp.cbrt(3))


def test_a_relation_with_a_symbol_is_not_certain():
    assert not holds(Relation(p, ">", 0))


def test_a_value_beside_zero_ends_the_question() -> None:
    """Of letters that are declared to be more than real, or of a sign, no value is taken."""
    n, m = sp.Symbol("n", even=True), sp.Symbol("m", negative=True)
    g = sp.Function("g", negative=True)(x)
    zero = [(-1) ** n - 1, sp.sqrt(m**2) + m, abs(g) + g, sp.Derivative(x**2, x) - 2 * x]
    assert [vanishes(entry) for entry in zero] == [True] * 4
    assert [vanishes(entry) for entry in (sp.sqrt(m**2) - m, sp.Function("h", real=True)(x) - x)] == [False] * 2


def test_values_of_a_function_at_arguments_that_are_equal_are_equal() -> None:
    f, w = sp.Function("f", real=True), sp.Symbol("w", positive=True)
    assert vanishes(f(1 / (1 + 1 / w)) - f(w / (w + 1)))
    assert vanishes(w * f(sp.exp(w) * sp.exp(2 * w)) - f(sp.exp(3 * w)) * w)
    assert not vanishes(f(w) - f(w + 1))
