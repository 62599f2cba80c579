"""Any text becomes an exact expression over the allowed names, or one sentence; never anything else."""

from __future__ import annotations

import re
import warnings
from fractions import Fraction
from typing import Any

import hypothesis.strategies as st
import pytest
import sympy as sp
from hypothesis import given
from sympy.core.function import AppliedUndef

from ptproof.errors import InputError
from ptproof.reading.expressions import CONSTANTS, FUNCTIONS, parse
from tests.fuzz import trees
from tests.fuzz.sizes import fuzz, within

X, Y = sp.symbols("x y", real=True)
FIELD = sp.Function("F", real=True)
NAMES: dict[str, Any] = {"x": X, "y": Y, "F": FIELD}
_HEADS = (
    sp.Add, sp.Mul, sp.Pow, sp.Rational, sp.Symbol, sp.NumberSymbol, sp.Derivative, sp.Piecewise, sp.Heaviside,
    AppliedUndef,
    sp.Tuple, sp.logic.boolalg.Boolean, sp.functions.elementary.piecewise.ExprCondPair, sp.Subs,
    sp.sin, sp.cos, sp.tan, sp.cot, sp.asin, sp.acos, sp.atan, sp.sinh, sp.cosh, sp.tanh, sp.exp, sp.log, sp.Abs,
    sp.sign,
    sp.Max, sp.Min, sp.atan2, sp.floor, sp.ceiling, sp.Mod, sp.frac,
)  # fmt: skip
SECONDS = 10.0
_WORDS = [*FUNCTIONS, *CONSTANTS, *NAMES, "Piecewise", "Derivative", "True", "False", "and", "or", "not", "if", "else"]
_SIGNS = [
    "+", "-", "*", "/", "**", "^", "%", "//", "(", ")", ",", "<", "<=", ">", ">=", "==", "!=", "[", "]", ".", ":",
    "=",
    " ", "\n", "\t", "\r", "\f", "\0", "\\", "#", "'", '"', "@", "~", "&", "|", "{", "}", ";", "`", "$", "?", "!",
    "_",
]  # fmt: skip
_ODD = [
    "__import__", "os", ".system", "__class__", "lambda", "eval", "exec", "open", "globals", "nan", "inf", "oo",
    "zoo",
    "ｘ", "𝑥", "х", "π", "²", "−", "∞", "٣", "½", "\u202e", "\ufeff", "é", "e\u0301", "0x1F", "0b1", "0o7",
    "1_000", "1__0",
    "1j", "007", "1e999", "1e-399", "9" * 400, "1.5.2", ".5", "5.", "1e5", "1E+5", "0x1p3", "10**400", "9**9**9",
    "1if",
]  # fmt: skip
tokens = st.one_of(
    st.sampled_from(_WORDS), st.sampled_from(_SIGNS), st.sampled_from(_ODD), st.integers(0, 12).map(str),
    st.decimals(-100, 100, places=2).map(str),
)  # fmt: skip
soups = st.lists(tokens, max_size=14).map("".join)


def grown(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    """Texts that are mostly well formed, whose parts are of the wrong kind now and then."""
    binary = st.sampled_from(["+", "-", "*", "/", "**", "^", "%", " < ", " <= ", ">", " and ", " or ", ",", "=="])
    calls = st.sampled_from([*FUNCTIONS, "F", "Derivative", "Piecewise", "unknown"])
    return st.one_of(
        st.builds("({}){}({})".format, inner, binary, inner),
        st.builds("{}{}{}".format, inner, binary, inner),
        st.builds("-{}".format, inner),
        st.builds("{}({})".format, calls, inner),
        st.builds("{}({}, {})".format, calls, inner, inner),
        st.builds("Piecewise(({}, {} < {}), ({}, True))".format, inner, inner, inner, inner),
        st.builds("Piecewise(({}, {}), ({}, True))".format, inner, inner, inner),
        st.builds("Derivative({}, x)".format, inner),
    )


leaves = st.one_of(
    st.sampled_from(["x", "y", "pi", "E", "F(x)", "0", "1", "2", "3", "-1", "1/2", "0.1", "10", "True", "sqrt(-1)"]),
    st.sampled_from(
        ["9999", "10001", "1e300", "1e-300", "10**300", "F", "0.0", "(1/7)", "100000", "Derivative(F(x), x)"]
    ),
)
texts = st.one_of(st.text(max_size=30), soups, st.recursive(leaves, grown, max_leaves=8))


def read(text: Any) -> sp.Expr | None:
    """The expression, or None where the text is refused in one sentence."""
    with within(SECONDS), warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            return parse(text, NAMES, where="HERE")
        except InputError as error:
            refused = error
    assert type(refused) is InputError
    assert str(refused).startswith("HERE: ")
    assert len(str(refused)) < 1000
    return None


def is_allowed(expression: sp.Expr) -> bool:
    for node in sp.preorder_traversal(expression):
        if isinstance(node, sp.Symbol) and node not in (X, Y) and not isinstance(node, sp.Dummy):
            return False
        if isinstance(node, AppliedUndef) and node.func != FIELD:
            return False
        if not isinstance(node, _HEADS) or isinstance(node, sp.Float):
            return False
    return True


@given(texts)
@fuzz(100)
def test_an_expression_over_the_allowed_names_or_one_sentence(text: str) -> None:
    found = read(text)
    if found is not None:
        assert isinstance(found, sp.Expr)
        assert is_allowed(found), sp.srepr(found)
        assert not found.has(sp.oo, -sp.oo, sp.zoo, sp.nan)


@given(st.recursive(leaves, grown, max_leaves=20), st.sampled_from([str, repr]))
@fuzz(30)
def test_what_was_read_can_be_printed_and_read_again(text: str, shown: Any) -> None:
    found = read(text)
    if found is None or found.has(sp.I):
        return
    try:
        with within(SECONDS):
            printed = shown(found)
    except ValueError:  # Python's own limit for the digits of an integer
        pytest.fail(f"what was read cannot be printed: {text[:80]!r}")
    again = read(printed)
    assert again is None or again == found or sp.simplify(again - found) == 0


@given(trees.expressions((X, Y), undefined=(FIELD,), kinks=True, leaves=8))
@fuzz(20)
def test_a_printed_expression_is_read_as_itself(expression: sp.Expr) -> None:
    if expression.has(sp.Heaviside, sp.DiracDelta, sp.cot, sp.AccumBounds, sp.Derivative):
        return
    found = read(str(expression))
    if found is None:
        return
    point = {X: sp.Rational(7, 5), Y: sp.Rational(-3, 11)}
    difference = sp.simplify((found - expression).subs(point).replace(FIELD, sp.atan))
    assert found == expression or abs(sp.N(difference, 30)) < 1e-20


@given(
    st.from_regex(
        re.compile(r"-?([0-9]{1,9}(_[0-9]{1,3})?\.[0-9]{0,9}|\.[0-9]{1,9})([eE][+-]?[0-9]{1,2})?", re.ASCII),
        fullmatch=True,
    )
)
@fuzz(30)
def test_a_decimal_is_its_exact_value(literal: str) -> None:
    found = read(literal)
    exact = Fraction(literal.replace("_", ""))
    assert found == sp.Rational(exact.numerator, exact.denominator)


@given(
    st.sampled_from(["(", "-", "sin(", "x**", "x+", "F(", "Abs(", "((", "+-", "not ", "[", "1<", "Max(x,"]),
    st.integers(1, 3000),
)
@fuzz(20)
def test_deep_nesting_is_read_or_refused(opening: str, depth: int) -> None:
    closing = ")" * opening.count("(") + "]" * opening.count("[")
    found = read(opening * depth + "x" + closing * depth)
    assert found is None or is_allowed(found)


@given(st.floats() | st.integers() | st.booleans() | st.none() | st.binary(max_size=4) | st.complex_numbers())
@fuzz(30)
def test_what_is_no_text_is_its_decimal_value_or_refused(given_value: Any) -> None:
    found = read(given_value)
    if found is not None:
        assert not isinstance(given_value, bool)
        exact = Fraction(str(given_value))
        assert found == sp.Rational(exact.numerator, exact.denominator)
