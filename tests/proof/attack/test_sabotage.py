"""An engine that says "proved" to everything is contradicted by the attacker."""

from __future__ import annotations

import importlib

import pytest
import sympy as sp

from ptproof.proof import Goal, Verdict, claim, eq, exact, ge, gt, le, lt
from ptproof.proof.attack import attack
from ptproof.proof.deciding import run_one
from ptproof.proof.statement import Assumption, ForAll, Relation, Statement

t, s, x, y = sp.symbols("t s x y", real=True)
a, b, k = sp.symbols("a b k", positive=True)
n = sp.Symbol("n", integer=True)
u = sp.Symbol("u", negative=True)
F = sp.Function("F", real=True)
V = sp.Function("V", positive=True)
N = sp.Function("N", negative=True)
M = sp.Function("M", integer=True)
DECAY = ForAll((s,), le(sp.Derivative(V(s), s), -k * V(s)), (ge(s, 0), le(s, t)))
FALSE: dict[str, tuple[Statement, list[Assumption]]] = {
    "wrong rate": (le(V(t), V(0) * sp.exp(-2 * k * t)), [DECAY, ge(t, 0)]),
    "wrong direction": (ge(V(t), V(0)), [DECAY, gt(t, 0)]),
    "assumption missing": (le(V(t), V(0) * sp.exp(-k * t)), [DECAY]),
    "capture in a derivative": (eq(sp.Derivative(x * F(x), x), F(x)), []),
    "capture in an integral": (eq(sp.Integral(x * s, (s, 0, 1)), x**2 / 2), []),
    "kind of a function": (gt(N(x) ** 3, 0), []),
    "an integer function that is constant": (gt(M(x), 0), []),
    "a negative symbol": (eq(sp.Abs(u), u), []),
    "a difference quotient": (eq((x**2 - y**2) / (x - y), x - y), []),
    "an integer exponent": (eq((-1) ** n, 1), []),
    "a root of complex values": (ge(sp.sqrt(-1 - x**2) * x, 0), []),
    "only at one corner": (lt(sp.Max(x, y), x + y), [ge(x, 0), ge(y, 0)]),
    "the turning point": (gt(sp.Abs(x - a) + sp.Abs(x - b), a - b), []),
    "where two bounds meet": (lt(x, a), [ge(x, a), le(x, a)]),
    "between two bounds": (le(x * y, a**2), [ge(x, a), le(x, b), le(a, b), eq(y, x)]),
    "a function of a function": (eq(F(F(x)), F(x) ** 2), []),
    "mixed derivatives": (eq(sp.Derivative(F(x, y), x, y), sp.Derivative(F(x, y), x, x)), []),
    "a sum": (eq(sp.Sum(s, (s, 1, 4)), 11), []),
}


@pytest.mark.parametrize("name", FALSE)
def test_what_a_broken_engine_might_prove_is_hit(name: str) -> None:
    statement, assumptions = FALSE[name]
    assert attack(Goal(name, statement, tuple(assumptions))).hit is not None


EQUALITIES = {name: item for name, item in FALSE.items() if isinstance(item[0], Relation) and item[0].sign == "="}


@pytest.mark.parametrize("name", EQUALITIES)
def test_a_sabotaged_engine_proves_nothing_false(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Exact algebra that takes every difference for 0: what is false is not proved all the same."""
    module = importlib.import_module("ptproof.proof.engines.exact")
    monkeypatch.setattr(module, "is_zero", lambda expression: True)
    statement, assumptions = EQUALITIES[name]
    evidence = run_one(claim(name, name, statement, given=assumptions, where_defined=True)(exact))
    assert evidence.verdict is Verdict.UNDECIDED
    assert "shows what is false" in evidence.detail
