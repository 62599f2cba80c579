"""The attacker's numbers know their error: what differs by less is never told apart."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy as sp

from ptproof.balls.ball import precision
from ptproof.proof.attack import Place
from ptproof.proof.attack.magnitudes import spread
from ptproof.proof.attack.numbers import Ball, NotReal, Undefined, Unsure, exact

x, y = sp.symbols("x y", real=True)
VALUES: dict[str, sp.Expr] = {
    "root": sp.sqrt(2 + sp.sqrt(x)),
    "exponential": sp.exp(-x) + sp.exp(sp.sin(x)),
    "logarithm": sp.log(1 + x**2) ** 3,
    "tangent": sp.tan(x) / sp.atan(x),
    "hyperbolic": sp.tanh(x) * sp.cosh(x) - sp.asinh(x),
    "power": x**sp.pi - sp.pi**x,
    "arc sine": sp.asin(1 / (2 + x)) + sp.acos(x / 9),
    "cancellation": (sp.sqrt(x + sp.Rational(1, 10**12)) - sp.sqrt(x)) * 10**12,
    "derivative": sp.Derivative(sp.exp(sp.sin(x) / x) * x ** sp.Rational(5, 2), (x, 3)),
    "integral": sp.Integral(sp.exp(-(x**2)), (x, 0, 2)),
    "large power": (1 + x / 10**9) ** (10**9),
    "modulus": sp.Mod(x, sp.Rational(2, 3)) + sp.floor(-x),
}


@pytest.mark.parametrize("name", VALUES)
def test_the_error_covers_the_difference_to_more_digits(name: str) -> None:
    few, many = (Place({x: Fraction(7, 3)}, digits=digits) for digits in (30, 90))
    rough, fine = few.value(VALUES[name]), many.value(VALUES[name])
    numbers = many.calculus.numbers
    apart = numbers.ball(numbers.sub(rough, fine))
    assert apart.contains(0)
    assert spread(apart) < -20


@pytest.mark.parametrize("name", sorted({*VALUES} - {"large power"}))  # which SymPy would write out
def test_another_library_comes_to_the_same_value(name: str) -> None:
    """SymPy evaluates by mpmath, in which no line is shared with python-flint."""
    value = Place({x: Fraction(7, 3)}).calculus.numbers.ball(Place({x: Fraction(7, 3)}).value(VALUES[name]))
    other = VALUES[name].subs(x, sp.Rational(7, 3)).doit().evalf(40)
    with precision(200):
        assert abs(value - Ball(str(other))) < Ball(f"1e-{10 if name == 'integral' else 25}")


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        (x**2 / 3, Fraction(16, 3)),
        (sp.sqrt(x), Fraction(2)),
        (sp.exp(x - 4), Fraction(1)),
        (sp.Abs(1 - x), Fraction(3)),
    ],
)
def test_what_is_rational_stays_exact(expression: sp.Expr, value: Fraction) -> None:
    assert Place({x: Fraction(4)}).value(expression) == exact(value)


@pytest.mark.parametrize(
    ("expression", "error"),
    [
        (1 / x, Undefined),
        (sp.log(x), Undefined),
        (sp.sqrt(x - 1), NotReal),
        (sp.Pow(x - 2, sp.Rational(1, 3)), NotReal),
        (sp.Derivative(sp.Abs(x), x), Unsure),
        (sp.exp(sp.exp(sp.exp(x + 5))), Unsure),
        (sp.Pow(x, -x - 1), Undefined),
        (sp.Function("F")(x), Unsure),
    ],
)
def test_what_has_no_value_says_why(expression: sp.Expr, error: type[Exception]) -> None:
    with pytest.raises(error):
        Place({x: Fraction(0)}).value(expression)


def test_a_term_too_small_to_be_seen_is_not_taken_for_nothing() -> None:
    place = Place({x: Fraction(3, 2), y: Fraction(3, 2)})
    with pytest.raises(Unsure):
        place.sign(sp.sqrt(x) + sp.exp(-(10**6) * x) - x ** sp.Rational(3, 2) / y)


def test_a_value_with_a_bound_is_no_number_to_compare_with() -> None:
    assert isinstance(Place({}).value(sp.pi), Ball)
