"""What is remembered part by part is what SymPy makes of the whole."""

import random

import pytest
import sympy as sp

from ptproof.proof.factors import factored
from ptproof.proof.prepared import prepare
from ptproof.proof.rewriting import carried_out, everywhere

x, y, k = sp.symbols("x y k", positive=True)
r = sp.Symbol("r", real=True)
f = sp.Function("f", real=True)
LEAVES = [x, y, r, k, f(x), sp.sqrt(x), sp.sin(r), sp.exp(r), x ** (1 / k), sp.Integer(2), sp.Rational(-3, 2)]


def some_expression(numbers: random.Random, depth: int) -> sp.Expr:
    if depth == 0:
        return numbers.choice(LEAVES)
    left, right = (some_expression(numbers, depth - 1) for _ in range(2))
    return numbers.choice([left + right, left * right, left - right, left**2 + right, left / (1 + right**2)])


@pytest.mark.parametrize("seed", range(40))
def test_factors_are_those_of_sympy(seed):
    numbers = random.Random(seed)
    expression = some_expression(numbers, numbers.choice([2, 3]))
    assert factored(expression) == sp.factor(sp.together(expression))


@pytest.mark.parametrize(
    "expression", [2 * x + 2 * y, -2 * x - 2 * y, (1 - x) / (2 - 2 * y), x**2 - r**2, sp.sqrt(2) * x + 2, x + sp.pi]
)
def test_signs_and_numbers_of_factors_are_those_of_sympy(expression):
    assert factored(expression) == sp.factor(sp.together(expression))


@pytest.mark.parametrize("seed", range(20))
def test_derivatives_are_carried_out_as_by_sympy(seed):
    inside = some_expression(random.Random(seed), 2)
    expression = 1 + x * sp.Derivative(inside * r, r) + sp.Integral(inside, (r, 0, 1))
    expression += sp.Max(1, sp.Subs(sp.Derivative(inside, r), r, y)) + sp.Piecewise(
        (sp.Derivative(inside, r), x < r), (r, True)
    )
    expression += f(sp.Derivative(r**2, r)) + sp.Subs(f(r) * sp.Derivative(r**3, r), r, x + 1)
    assert carried_out(expression) == expression.doit(integrals=False)
    assert carried_out(expression) == carried_out(expression)


def test_what_is_written_unevaluated_is_evaluated():
    assert carried_out(sp.Add(x, x, evaluate=False)) == 2 * x


def test_only_the_kind_that_is_named_is_changed():
    halved = everywhere(sp.sin, lambda node: node / 2)
    assert halved(sp.sin(x) + sp.cos(sp.sin(y))) == sp.sin(x) / 2 + sp.cos(sp.sin(y) / 2)
    assert halved(sp.sin(sp.sin(x))) == sp.sin(sp.sin(x) / 2) / 2
    assert halved(x) is x


def test_equal_arguments_of_a_function_become_one():
    assert prepare(f(x * (x + 1)) - f(x**2 + x)) == 0
    assert prepare(f(x * (x + 1)) - f(x**2 - x)) != 0
