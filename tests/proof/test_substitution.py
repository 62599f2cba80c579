"""Substitution: nothing is caught, kinds are checked, and what the values need goes along."""

from __future__ import annotations

from typing import Any

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.content import digest
from ptproof.proof.declarations import admissible, declared
from ptproof.proof.definedness import obligations
from ptproof.proof.statement import ForAll, eq, ge
from ptproof.proof.substitution import NotOfKind, Substitution, replaced

x, y, c = sp.symbols("x y c", real=True)
a = sp.Symbol("a", positive=True)
F, G = sp.Function("F", real=True), sp.Function("G", real=True)


@pytest.mark.parametrize(("values", "expression", "value"), [
    ({c: x}, sp.Derivative(c * x, x), x),
    ({c: x}, sp.Derivative(c * x**2, (x, 2)), 2 * x),
    ({x: 2}, sp.Derivative(x**2, x), 4),
    ({x: c, c: x}, sp.Derivative(c * x**2, x), 2 * x * c),
    ({c: x}, sp.Integral(c * x, (x, 0, c)), x**3 / 2),
    ({x: 5}, sp.Integral(x, (x, 0, x)), sp.Rational(25, 2)),
    ({c: x}, sp.Sum(c * x, (x, 1, 3)), 6 * x),
    ({c: x}, sp.Subs(c * x, x, 3), 3 * x),
    ({F(x): x**2}, sp.Derivative(F(x) * x, x), 3 * x**2),
    ({F(x): c * x}, sp.Derivative(F(c), c), c),
    ({F(x): y * x}, sp.Integral(F(y), (y, 0, 1)), y / 2),
    ({c: 1, F(x): x + 1}, F(c) + c, 3),
    ({c: x, x: c}, c - 2 * x, x - 2 * c),
    ({G(x, y): y}, sp.Derivative(G(x, F(x)), F(x)), 1),
    ({G(x, y): x * y**3}, sp.Derivative(G(x, F(x)), (F(x), 2)), 6 * x * F(x)),
    ({G(x, y): x * y**2, F(x): c * x}, sp.diff(G(x, F(x)), x), 3 * c**2 * x**2),
    ({G(x, y): x * y**2, F(x): c * x, x: 2}, sp.Derivative(G(x, F(x)), F(x)), 8 * c),
])  # fmt: skip
def test_nothing_is_caught(values: Any, expression: sp.Expr, value: Any) -> None:
    assert sp.simplify(Substitution(values).into(expression).doit() - value) == 0


@pytest.mark.parametrize("derivative", [
    sp.Derivative(F(x) * sp.Derivative(F(x), x), F(x)),  # does the derivative vary with F(x)?
    sp.Derivative(G(x, F(x)), x, F(x)),
    sp.Derivative(sp.Function("H")(x) ** 2, sp.Function("H")(x)),  # not known to be real
])  # fmt: skip
def test_a_derivative_by_a_function_without_one_meaning_is_refused(derivative: sp.Expr) -> None:
    with pytest.raises(InputError, match="values cannot be put into"):
        Substitution({x: 1}).into(derivative)


def test_the_same_question_has_the_same_answer() -> None:
    node = sp.Derivative(F(c, x), x)
    assert Substitution({c: x}).into(node) == Substitution({c: x}).into(node)


@pytest.mark.parametrize(("letter", "value"), [
    (a, x), (a, 0), (a, -1), (a, sp.I), (x, sp.I), (x, sp.oo), (sp.Symbol("n", integer=True), sp.Rational(1, 2)),
    (sp.Symbol("n", even=True), 3), (F(x), sp.sqrt(x)), (F(x), 1 / x), (F(x), sp.I * x),
    (sp.Function("p", positive=True)(x), x), (sp.Function("p", positive=True)(a), a),
    (sp.Function("q", real=True, zero=False)(x), x),
])  # fmt: skip
def test_a_value_is_of_the_kind_of_its_letter(letter: Any, value: Any) -> None:
    with pytest.raises(NotOfKind):
        Substitution({letter: value})


def test_what_the_values_need_goes_along() -> None:
    (need,) = Substitution({x: 1 / y}).domain
    assert str(need) == "y != 0"
    assert not Substitution({x: 1 / a}).domain


def test_a_quantifier_catches_nothing() -> None:
    assumed = ForAll((x,), ge(F(x), c))
    with pytest.raises(InputError, match="caught"):
        Substitution({c: x}).quantified(assumed)
    assert Substitution({c: y}).quantified(assumed) == ForAll((x,), ge(F(x), y))


def test_equal_values_are_exchanged_outside_of_derivatives() -> None:
    assert replaced(F(x) + sp.Derivative(F(x), x), {F(x): y}) == y + sp.Derivative(F(x), x)
    assert replaced(sp.Derivative(c * x, x), {c: x}).doit() == x


def test_functions_of_one_name_and_other_kinds_are_different() -> None:
    other = sp.Function("F", positive=True)
    assert Substitution({F(x): x}).into(other(y)) == other(y)
    assert digest(F(x)) != digest(other(x))
    assert declared(other(x))["positive"]
    assert not admissible(other(x), x)


@pytest.mark.parametrize(("expression", "needs"), [
    (1 / x, ["x != 0"]), (sp.sqrt(x), ["x >= 0"]), (1 / sp.sqrt(x), ["x > 0"]), (sp.log(x), ["x > 0"]),
    (x**y, ["x > 0"]), (a**y, []), (x ** sp.Symbol("n", integer=True), ["x != 0"]), (x**3, []),
    (sp.tan(x), ["cos(x) != 0"]), (sp.asin(x), ["x**2 <= 1"]), (sp.atan2(x, y), ["x**2 + y**2 > 0"]),
    (sp.Mod(x, y), ["y != 0"]), (sp.exp(1 / x), ["x != 0"]), (F(1 / x), ["x != 0"]), (sp.Abs(x), []),
    (sp.Max(x, 1 / y), ["y != 0"]), (sp.Derivative(sp.Abs(x), x), ["x != 0"]),
    (sp.Derivative(sp.Max(x, y), x), ["x - y != 0"]), (sp.Derivative(F(x), x), []),
    (sp.Piecewise((1 / x, x > 0), (1, True)), ["x != 0 where x > 0"]),
    (sp.Piecewise((1 / x, x < 1), (1, True)), ["x != 0 where x < 1"]),
    (sp.Piecewise((1, x < 0), (2, x > 0)), ["1 < 0 where x >= 0 and x <= 0"]),
    (sp.Symbol("w"), ["w is not declared real"]), (sp.I + x, ["I is no real number"]),
    (sp.gamma(x), ["it is not known where gamma is defined and real"]),
])  # fmt: skip
def test_what_an_expression_needs(expression: sp.Expr, needs: list[str]) -> None:
    assert [str(need) for need in obligations(expression) if not need.settled] == needs


def test_an_integral_needs_its_integrand_on_the_whole_range() -> None:
    (need,) = (need for need in obligations(sp.Integral(1 / x, (x, 0, a))) if not need.settled)
    assert len(need.given) == 2
    assert not [need for need in obligations(sp.Integral(1 / (1 + x**2), (x, 0, a))) if not need.settled]
    pieces = sp.Piecewise((0, sp.Eq(x, 0)), (1 / x, True))
    assert [need for need in obligations(sp.Integral(pieces, (x, 0, 1))) if not need.settled]


def test_statements_of_the_same_content_have_the_same_digest() -> None:
    assert digest(eq(x, y)) == digest(eq(x, y)) != digest(ge(x, y))
    assert digest(eq(x, sp.Symbol("y"))) != digest(eq(x, y))
