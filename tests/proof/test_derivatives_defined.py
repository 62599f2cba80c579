"""Where a derivative is defined: of angles, of integrals by their ends, by functions, by letters that do not move."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
import sympy as sp

from ptproof.proof import Evidence, Goal, Verdict, claim, eq, exact, ge, gt, integrals, le, lt, reals, specialise
from ptproof.proof.deciding import run_one

x, y, s, u, t = sp.symbols("x y s u t", real=True)
n, q = sp.Symbol("n", integer=True), sp.Symbol("q", rational=True)
F = sp.Function("F", real=True)
D, J = sp.Derivative, sp.Integral
off_origin = gt(x**2 + y**2, 0)


@pytest.fixture(autouse=True)
def short_search(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ptproof.proof.settling.SEARCH_SECONDS", 0.05)


def verdict(statement: Any, proof: Callable[[Goal], Evidence] = exact, *given: Any, **options: Any) -> Verdict:
    return run_one(claim("t", "T", statement, given=given, **options)(proof)).verdict


# Each holds wherever its derivative exists, and somewhere it does not.
NOWHERE_PROVED = [
    (eq(D(sp.atan2(y, x), y), x / (x**2 + y**2)), exact, off_origin),
    (eq(D(sp.atan2(y, x), x), -y / (x**2 + y**2)), exact, off_origin),
    (ge(D(sp.atan2(y, x), y) * x, 0), reals, off_origin),
    (eq(D(sp.atan2(sp.sin(x), sp.cos(x)), x), 1), exact, None),
    (eq(D(sp.atan2(F(x), -1), F(x)), -1 / (1 + F(x) ** 2)), exact, None),
    (eq(D(sp.Abs(F(x)), F(x)), sp.sign(F(x))), exact, None),
    (eq(D(sp.Subs(F(s) * sp.Abs(s), s, t), t), D(F(t), t) * sp.Abs(t) + F(t) * sp.sign(t)), exact, None),
    (eq(D(J(sp.sign(s), (s, -1, x)), x), sp.sign(x)), exact, None),
    (eq(D(J(sp.sign(s), (s, x, 1)), x), -sp.sign(x)), exact, None),
    (eq(D(J(sp.sign(s - y), (s, 0, x)), x), sp.sign(x - y)), exact, None),
    (eq(D(J(sp.floor(s), (s, 0, x)), x), sp.floor(x)), exact, None),
    (eq(D(J(sp.Mod(s, 1), (s, 0, x)), x), sp.Mod(x, 1)), exact, None),
    (eq(D(J(sp.Heaviside(s), (s, -1, x)), x), sp.Heaviside(x)), exact, None),
    (eq(D(J(sp.atan2(s, -1), (s, -1, x)), x), sp.atan2(x, -1)), exact, None),
    (eq(D(J(sp.Piecewise((1, s < 0), (2, True)), (s, -1, x)), x), sp.Piecewise((1, x < 0), (2, True))), exact, None),
    (eq(D(J(sp.sqrt(1 - s), (s, 0, x)), x), sp.sqrt(1 - x)), exact, le(x, 1)),
    (eq(D(J(sp.Abs(s), (s, 0, x)), x, 2), sp.sign(x)), exact, None),
    (eq(sp.Subs(D(J(sp.sign(s), (s, 0, x)), x), x, 0), 0), exact, None),
    (le(D(J(sp.sign(s), (s, 0, x)), x) ** 2, 1), reals, None),
    (eq(D(J(F(s), (s, 0, n)), n), F(n)), exact, None),
    (eq(D(2**n, n), 2**n * sp.log(2)), exact, None),
    (eq(D(n * sp.cos(sp.pi * n) ** 2 + n**2, n), 1 + 2 * n), exact, None),
    (eq(D(q**2, q), 2 * q), exact, None),
    (eq(D(J(sp.exp(-s * x), (s, 0, sp.oo)), x), -1 / x**2), integrals, gt(x, 0)),
]  # fmt: skip


@pytest.mark.parametrize(("statement", "proof", "given"), NOWHERE_PROVED)
def test_no_derivative_is_taken_where_there_is_none(statement: Any, proof: Any, given: Any) -> None:
    assert verdict(statement, proof, *([] if given is None else [given])) is not Verdict.PROVED


@pytest.mark.parametrize(("statement", "given"), [
    (eq(D(sp.atan2(y, x), y), x / (x**2 + y**2)), gt(x, 0)),
    (eq(D(sp.atan2(y, x), x), -y / (x**2 + y**2)), lt(y, -1)),
    (eq(D(sp.Abs(F(x)), F(x)), sp.sign(F(x))), gt(F(x), 0)),
    (eq(D(J(sp.sign(s), (s, -1, x)), x), sp.sign(x)), lt(x, 0)),
    (eq(D(J(sp.Abs(s), (s, 0, x)), x), sp.Abs(x)), None),
    (eq(D(J(sp.Max(s, u), (s, 0, x)), x), sp.Max(x, u)), None),
    (eq(D(J(F(s), (s, 0, x)), x), F(x)), None),
    (eq(D(J(s * sp.sign(y), (s, 0, x)), x), x * sp.sign(y)), None),
    (eq(D(J(sp.sqrt(s), (s, 0, x)), x), sp.sqrt(x)), gt(x, 0)),
])  # fmt: skip
def test_it_is_taken_where_there_is_one(statement: Any, given: Any) -> None:
    assert verdict(statement, exact, *([] if given is None else [given])) is Verdict.PROVED


@pytest.mark.parametrize("value", [sp.sign(x), sp.floor(x), sp.atan2(x, -1), sp.Heaviside(x)])
def test_what_is_shown_of_smooth_functions_is_not_said_of_one_that_jumps(value: sp.Expr) -> None:
    fact = claim("used", "U", eq(D(J(F(s), (s, 0, x)), x), F(x)))(exact)
    proof = lambda goal: reals(goal, *specialise(goal, fact, {F(x): value}))  # noqa: E731
    wrong = eq(D(J(value.subs(x, s), (s, 0, x)), x), value)
    assert verdict(wrong, proof, uses=[fact]) is not Verdict.PROVED
