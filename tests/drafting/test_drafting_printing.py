"""Expressions as Python source: what is printed has the value of what it was printed from."""

import pytest
import sympy as sp

from ptproof.drafting.printing import laid_out, python

x, y, k = sp.symbols("x y k", real=True)
F = sp.Function("F", real=True)
THIRD = sp.Rational(1, 3)
EXPRESSIONS = [
    x ** sp.Rational(3, 2) / 2, sp.sqrt(x) * sp.sin(k * x) / 3 - sp.pi, 1 / sp.sqrt(x) / 2, THIRD**x, 3**THIRD,
    x ** -sp.Rational(3, 2), sp.sqrt(THIRD), -x / (y + k), (x + 1) ** -2 / 2, THIRD * (x + y), THIRD, -THIRD, 2**-x,
    sp.E * sp.exp(-x) * sp.Abs(x), sp.Max(x, y, THIRD), sp.Min(x, 0), sp.log(x), sp.atan(x), sp.oo, -sp.oo, 1 / sp.pi,
    F(x, y).diff(x), sp.Derivative(F(x, y), x, y), sp.Integral(F(x, y), (x, 0, y)), sp.Limit(1 / x, x, sp.oo),
    sp.Limit(k, x, 0, dir="+"), sp.Subs(F(x, y).diff(x), x, k), sp.Piecewise((x / 3, x > THIRD), (1, True)),
    sp.exp(x / 2) ** 2 + sp.tanh(x) - sp.cosh(y) * sp.sign(k), sum(k**n / (n + 1) * sp.cos(n * x) for n in range(40)),
]  # fmt: skip


@pytest.mark.parametrize("expression", EXPRESSIONS, ids=str)
def test_it_is_read_back_as_it_was(expression):
    names = {"sp": sp, "x": x, "y": y, "k": k, "F": F, "one": lambda *sides: sides[0]}
    assert eval(python(expression), names) == expression
    text = laid_out("one", (expression, 0))
    assert eval(text, names) == expression
    assert max(map(len, text.splitlines())) <= 120


def test_plain_quotients_would_be_floats():
    assert eval(str(THIRD)) != THIRD
