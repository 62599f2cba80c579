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
    "Derivative(F(x), (x, 2))": sp.diff(F(x), x, x),
    "Derivative(F(x), (x, 2), x)": sp.diff(F(x), x, 3),
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
    "0**-1": "not finite",
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
    # What fuzzing found: each of these was a traceback, a wrong value, minutes of work, or what nothing could print.
    "sqrt(-1)": "not a finite real",
    "sqrt(-1)*sqrt(-1)": "not a finite real",
    "0*acos(2)": "not a finite real",
    "(-8)**(1/3)": "not a finite real",
    "Max(sqrt(-1), 1)": "not a finite real",
    "sqrt(-1) < 1": "not a finite real",
    "1/log(0)": "not finite",
    "sin(log(0))": "not finite",
    "exp(-1/0)": "division by zero",
    "log(x, 0)": "logarithm",
    "log(x, 1)": "logarithm",
    "sqrt(x, 0)": "wrong number",
    "Mod(x, 0)": "division by zero",
    "x % 0": "division by zero",
    "Mod(7, sin(1)**2 + cos(1)**2 - 1)": "division by zero",
    "-(x < 1)": "stands where a number",
    "(x < 1) < 1": "stands where a number",
    "sin(x < 1)": "stands where a number",
    "x < 1 and 2": "stands where a condition",
    "Piecewise((1, x))": "stands where a condition",
    "Piecewise((x < 1, True))": "stands where a number",
    "Derivative(x < 1, x)": "stands where a number",
    "Derivative(sign(x), x)": "jumps",
    "Derivative(F(x), (x, 9))": "more than 8 derivatives",
    "Derivative(F(x), (x, 0))": "pairs such as",
    "Derivative(F(x), (x, 1.5))": "pairs such as",
    "Derivative(F(x), (x, True))": "pairs such as",
    "Derivative(F(x), (2, x))": "pairs such as",
    "Derivative((F(x), 2), x)": "is not arithmetic",
    "Derivative(F(x), ())": "is not arithmetic",
    "Derivative(floor(x), x)": "jumps",
    "Derivative(" * 9 + "exp(x**2)" + ", x)" * 9: "more than 8 derivatives",
    "Max(" + ", ".join(f"x**{i}" for i in range(2, 30)) + ")": "more than 12",
    "exp(exp(exp(9)))": "exponent over",
    "2**exp(exp(9))": "exponent over",
    "(10**4000)*(10**4000)": "too large",
    "-0x" + "f" * 9000: "too large",
    "(1 + 10**-300)**9999": "too large",
    "9" * 5000: "cannot read",
    "sin(" * 150 + "x" + ")" * 150: "nested",
    "(" * 300 + "x" + ")" * 300: "cannot read|nested",
    "x + " * 3000 + "x": "longer than",
}


@pytest.mark.parametrize("text", REFUSED, ids=lambda text: text[:30])
def test_refused_with_the_place_and_a_reason(text: str) -> None:
    with pytest.raises(InputError, match=REFUSED[text]) as caught:
        parse(text, NAMES, where="field.expression")
    assert str(caught.value).startswith("field.expression: ")
    assert len(str(caught.value)) < 400


@pytest.mark.parametrize("value", [10**5000, ["0"] * 600, [10**5000]], ids=["integer", "list", "list of an integer"])
def test_an_error_quotes_little_of_what_was_given(value: object) -> None:
    with pytest.raises(InputError) as caught:
        parse(value)  # type: ignore[arg-type]
    assert len(str(caught.value)) < 200


def test_a_text_of_which_python_would_warn_is_refused_without_a_warning() -> None:
    with pytest.raises(InputError, match="not arithmetic"):
        parse("1if 1 else 2")


def test_a_float_is_its_decimal_text() -> None:
    assert parse(0.1) == sp.Rational(1, 10)


@pytest.mark.parametrize("value", [True, None, [1], float("nan"), float("inf")])
def test_not_a_number_or_text(value: object) -> None:
    with pytest.raises(InputError):
        parse(value)  # type: ignore[arg-type]
