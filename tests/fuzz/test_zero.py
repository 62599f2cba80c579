"""Exact algebra, signs and powers: what is said to be 0, or to have a sign, is held against values at exact points."""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from typing import Any

import hypothesis.strategies as st
import sympy as sp
from hypothesis import event, given

from ptproof.proof.algebra import NotAlgebraic, is_zero
from ptproof.proof.powers import split_powers
from ptproof.proof.signs import sign_of, vanishes
from tests.fuzz import oracle, trees
from tests.fuzz.oracle import MP
from tests.fuzz.sizes import fuzz, or_nothing

SECONDS = 1.0
FUNCTIONS = {"F": lambda a: MP.sin(a) - a / 3, "G": lambda a: MP.exp(-(a**2)) + MP.mpf(1) / 7}

# Rules that hold for some kinds of a and b and fail for others: a difference of two sides that look alike.
RULES: tuple[Callable[[Any, Any, Any, Any], Any], ...] = (
    lambda a, b, r, s: (a**r) ** s - a ** (r * s),
    lambda a, b, r, s: (a * b) ** r - a**r * b**r,
    lambda a, b, r, s: (a / b) ** r - a**r / b**r,
    lambda a, b, r, s: a**r * a**s - a ** (r + s),
    lambda a, b, r, s: sp.exp(a) ** r - sp.exp(r * a),
    lambda a, b, r, s: sp.sqrt(a**2) - a,
    lambda a, b, r, s: sp.sqrt(a**2) - sp.Abs(a),
    lambda a, b, r, s: sp.Abs(a * b) - sp.Abs(a) * sp.Abs(b),
    lambda a, b, r, s: sp.Abs(a) ** 2 - a**2,
    lambda a, b, r, s: sp.Abs(a) ** r - (a**2) ** (r / 2),
    lambda a, b, r, s: sp.log(a * b) - sp.log(a) - sp.log(b),
    lambda a, b, r, s: sp.exp(sp.log(a)) - a,
    lambda a, b, r, s: sp.log(sp.exp(a)) - a,
    lambda a, b, r, s: sp.sqrt(a**2 + 2 * a * b + b**2) - a - b,
    lambda a, b, r, s: (sp.sqrt(a) + sp.sqrt(b)) ** 2 - a - b - 2 * sp.sqrt(a * b),
    lambda a, b, r, s: 1 / (sp.sqrt(a) - b) - (sp.sqrt(a) + b) / (a - b**2),
    lambda a, b, r, s: sp.sin(a + b) - sp.sin(a) * sp.cos(b) - sp.cos(a) * sp.sin(b),
    lambda a, b, r, s: sp.cos(2 * a) - 2 * sp.cos(a) ** 2 + 1,
    lambda a, b, r, s: sp.tan(a) - sp.sin(a) / sp.cos(a),
    lambda a, b, r, s: sp.tan(a) ** 2 + 1 - 1 / sp.cos(a) ** 2,
    lambda a, b, r, s: sp.tanh(a) - sp.sinh(a) / sp.cosh(a),
    lambda a, b, r, s: sp.sin(sp.asin(a)) - a,
    lambda a, b, r, s: sp.asin(sp.sin(a)) - a,
    lambda a, b, r, s: sp.Max(a, b) - (a + b + sp.Abs(a - b)) / 2,
    lambda a, b, r, s: sp.Max(a, b) + sp.Min(a, b) - a - b,
    lambda a, b, r, s: sp.sign(a) * sp.Abs(a) - a,
    lambda a, b, r, s: sp.Piecewise((a, a > 0), (-a, True)) - sp.Abs(a),
    lambda a, b, r, s: trees.F(a + b) - trees.F(b + a),
    lambda a, b, r, s: trees.F((a**2 - b**2) / (a - b)) - trees.F(a + b) if a != b else sp.S.Zero,
    lambda a, b, r, s: sp.diff(sp.sqrt(a), trees.x) - sp.diff(a, trees.x) / (2 * sp.sqrt(a)),
    lambda a, b, r, s: sp.diff(a * b, trees.p) - sp.diff(a, trees.p) * b - a * sp.diff(b, trees.p),
    lambda a, b, r, s: sp.factor(a + b) - a - b,
    lambda a, b, r, s: sp.expand(a * b) - a * b,
    lambda a, b, r, s: sp.powsimp(a**r * b**r, force=True) - a**r * b**r,
    lambda a, b, r, s: sp.powdenest((a**r) ** s, force=True) - (a**r) ** s,
    lambda a, b, r, s: sp.cancel(sp.together(1 / a + 1 / b)) - 1 / a - 1 / b if a != 0 and b != 0 else sp.S.Zero,
)
small = trees.expressions(
    undefined=(trees.F, trees.G), functions=(sp.sin, sp.exp, sp.log, sp.sqrt, sp.Abs, sp.cos), leaves=3
)
exponents = st.one_of(
    trees.exponents, st.sampled_from([trees.m, 1 / trees.m, trees.p, trees.x, trees.m / (trees.m + 1)])
)


@st.composite
def differences(draw: Any) -> Any:
    """Sums of products with such differences in them, some of which are 0."""
    total = sp.S.Zero
    for _ in range(draw(st.integers(1, 2))):
        rule = draw(st.sampled_from(RULES))
        a, b, r, s = draw(small), draw(small), draw(exponents), draw(exponents)
        made = or_nothing(SECONDS, _made, rule, a, b, r, s)
        if made is not None:
            total += draw(st.sampled_from([sp.S.One, sp.Integer(-2), trees.x, trees.q])) * made
    return total


def _made(*parts: Any) -> Any:
    rule, *arguments = parts
    try:
        made = rule(*arguments)
    except (ZeroDivisionError, TypeError, ValueError, sp.PolynomialError):
        return None  # SymPy can't even build it
    return made if trees.is_plain(made) else None


def check_zero(expression: Any, point: Any) -> None:
    with contextlib.suppress(oracle.NoValue):
        assert not oracle.is_not_zero(expression, point, FUNCTIONS), f"{expression} is said to be 0 at {point}"


def said_to_be_zero(decide: Callable[[Any], Any], expression: Any) -> bool:
    try:
        return bool(or_nothing(SECONDS, decide, expression))
    except NotAlgebraic:
        return False


@given(differences() | trees.expressions(undefined=(trees.F,), kinks=True, symbolic=True), trees.seeds)
@fuzz(10)
def test_what_has_the_normal_form_0_is_0(expression: Any, seed: int) -> None:
    for decide in (is_zero, vanishes):
        if said_to_be_zero(decide, expression):
            event("answered")
            for point in trees.points(expression.free_symbols, 6, seed):
                check_zero(expression, point)


@given(trees.expressions(symbolic=True, powers=exponents, leaves=8), trees.seeds)
@fuzz(15)
def test_split_powers_have_the_same_value(expression: Any, seed: int) -> None:
    split = or_nothing(SECONDS, split_powers, expression)
    if split is not None:
        for point in trees.points(expression.free_symbols, 4, seed):
            check_zero(sp.Add(split, sp.Mul(-1, expression, evaluate=False), evaluate=False), point)


numbers_ = trees.expressions([sp.Integer(2), sp.pi, sp.sqrt(2), sp.Rational(-1, 3)], kinks=True, leaves=8)


@given(numbers_ | trees.expressions(undefined=(trees.G, trees.F), kinks=True, symbolic=True), trees.seeds)
@fuzz(20)
def test_a_sign_is_the_sign_of_every_value(expression: Any, seed: int) -> None:
    found = or_nothing(SECONDS, sign_of, expression)
    if found is None:
        return
    event("answered")
    assert found in (-1, 0, 1)
    for point in trees.points(expression.free_symbols, 6 if expression.free_symbols else 1, seed):
        try:
            value, error = oracle.certain(expression, point, FUNCTIONS)
        except oracle.NoValue:
            continue
        assert abs(value) <= error if found == 0 else value * found >= -error, f"{expression} at {point}"
