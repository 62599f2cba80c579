"""Limits by the limit theorems, and the forms that have none."""

from __future__ import annotations

import pytest
import sympy as sp

from ptproof.proof.claim import Goal
from ptproof.proof.engines.limits import limit_of, limits
from ptproof.proof.settling import settle
from ptproof.proof.statement import eq
from ptproof.proof.verdict import Verdict

s, x = sp.symbols("s x", real=True)
T, k, p = sp.symbols("T k p", positive=True)
c = sp.Symbol("c", real=True)

CASES = [
    (s / (1 - s / T), s, T, "-", sp.oo),
    (s / (1 - s / T), s, T, "+", -sp.oo),
    (s / (1 + s / T), s, sp.oo, "-", T),
    (sp.exp(-k * s / (1 - s / T)), s, T, "-", 0),
    ((1 + s) ** (-1 / k), s, sp.oo, "-", 0),
    (1 / (1 - s / T) ** 2, s, T, "-", sp.oo),
    ((2 * s**2 + s) / (3 * s**2 - 1), s, sp.oo, "-", sp.Rational(2, 3)),
    (sp.cos(s / (1 + s)), s, sp.oo, "-", sp.cos(1)),
    (1 / sp.sqrt(1 - s), s, 1, "-", sp.oo),
    # A square that is not negative anywhere is positive near the point.
    ((s**2 / (1 - s / T)) ** (-1 / k), s, T, "-", 0),
]


@pytest.mark.parametrize(("expression", "variable", "point", "side", "value"), CASES)
def test_limit(expression: sp.Expr, variable: sp.Symbol, point: sp.Expr, side: str, value: sp.Expr) -> None:
    assert limit_of(expression, variable, sp.sympify(point), side) == value


NONE = [
    (sp.cos(s), s, sp.oo),
    (c * s, s, sp.oo),
    (s - s**2 * sp.exp(-s), s, sp.oo),
    (sp.Function("f")(s), s, sp.oo),
    # Squares that may be 0 all the way, or fall to 0; and what is negative near the point.
    (((c * s) ** 2 / (s / T - 1)) ** (-1 / k), s, T),
    (((s - c) ** 2 / (s / T - 1)) ** (-1 / k), s, T),
    ((-(s**2) / (s / T - 1)) ** (-1 / k), s, T),
]


@pytest.mark.parametrize(("expression", "variable", "point"), NONE)
def test_no_rule_no_answer(expression: sp.Expr, variable: sp.Symbol, point: sp.Expr) -> None:
    assert limit_of(expression, variable, point) is None


def test_wrong_value_is_refuted() -> None:
    goal = Goal("t", eq(sp.Limit(s / (1 + s / T), s, sp.oo, "-"), 2 * T))
    assert settle(goal, limits).verdict is Verdict.REFUTED


def test_sympy_is_wrong_about_a_positive_time() -> None:
    # Why times are declared real, and why limits are not asked of SymPy.
    t = sp.Symbol("t", positive=True)
    assert sp.limit((1 - t) ** sp.Rational(-1, 2), t, 1, "-") == -sp.oo
