"""Text from outside: exact values, allowed names, and nothing that is evaluated."""

from __future__ import annotations

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.reading.expressions import parse

x, y = sp.symbols("x y", real=True)
F = sp.Function("F", real=True)
NAMES = {"x": x, "y": y, "F": F}

EXACT = {
    "1.8": sp.Rational(9, 5),
    "1e-3": sp.Rational(1, 1000),
    "1_000": sp.Integer(1000),
    "2*pi/3": 2 * sp.pi / 3,
    "-x**2 + cos(2*pi/3*x)/2": -(x**2) + sp.cos(2 * sp.pi * x / 3) / 2,
    "Derivative(F(x), x)": sp.diff(F(x), x),
    "Piecewise((1, x < pi), (-1, True))": sp.Piecewise((1, x < sp.pi), (-1, True)),
    "sqrt(2)": sp.sqrt(2),
    "E": sp.E,
    "+x": x,
    "x^2": x**2,
    "-x^2+1": 1 - x**2,
    "2*x^3^2": 2 * x**9,
    "0.5*x^-1": 1 / (2 * x),
    "(x + y)^2/2": (x + y) ** 2 / 2,
}


@pytest.mark.parametrize("text", EXACT)
def test_exact_value(text: str) -> None:
    assert parse(text, NAMES) == EXACT[text]


REFUSED = {
    "sqrt(x, 0)": "wrong number",
    "__import__('os').system('true')": "not arithmetic",
    "x.__class__": "not arithmetic",
    "(lambda: 1)()": "not arithmetic",
    "[1, 2]": "not arithmetic",
    "x^^2": "cannot read",
    "x*^2": "cannot read",
    "'^'": "not arithmetic",
    "unknown": "unknown name",
    "foo(x)": "unknown function",
    "F": "needs arguments",
    "1/0": "division by zero",
    "0**-1": "not a finite",
    "": "empty",
    "x +": "cannot read",
    "x < 1": "stands where a number",
    "(x < 1) + 1": "stands where a number",
    "9**9**9": "exponent over",
    "(10**5000)**5000": "too large",
    "1e999999999": "out of range",
    "1e-999999999": "out of range",
    "sin(x, x)": "wrong number",
    "nan": "unknown name",
    "inf": "unknown name",
    "x == 1": "only <",
    "'text'": "not arithmetic",
    "(" * 300 + "x" + ")" * 300: "cannot read|nested",
    "x + " * 3000 + "x": "longer than",
}


@pytest.mark.parametrize("text", REFUSED, ids=lambda text: text[:30])
def test_refused_with_the_place_and_a_reason(text: str) -> None:
    with pytest.raises(InputError, match=REFUSED[text]) as caught:
        parse(text, NAMES, where="field.expression")
    assert str(caught.value).startswith("field.expression: ")


def test_a_float_is_its_decimal_text() -> None:
    assert parse(0.1) == sp.Rational(1, 10)


@pytest.mark.parametrize("value", [True, None, [1], float("nan"), float("inf")])
def test_not_a_number_or_text(value: object) -> None:
    with pytest.raises(InputError):
        parse(value)  # type: ignore[arg-type]
