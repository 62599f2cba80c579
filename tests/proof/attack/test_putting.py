"""Concrete functions put in for undefined ones: also where a derivative is taken by one of them."""

from __future__ import annotations

import itertools

import pytest
import sympy as sp

from ptproof.proof import Goal, eq, ge, le
from ptproof.proof.attack import attack
from ptproof.proof.attack.concrete import Concrete
from ptproof.proof.attack.putting import concretely
from ptproof.proof.statement import ForAll

s, t, u, p, q = sp.symbols("s t u p q", real=True)
X, Y, F = (sp.Function(name, real=True) for name in "XYF")
FIELD = Concrete((p, q), p**3 * q + q**2)
STILL = Concrete((p,), sp.S.Zero)
LINE = Concrete((p,), 2 * p + 3)
SLOPE = Concrete((p,), sp.Derivative(Y(p), p) + p)
TAKEN = {
    "by a function that rests": (sp.Derivative(F(X(s), Y(s)), X(s)), {F: FIELD, X: STILL, Y: LINE}, 0),
    "by one that moves": (sp.Derivative(F(X(s), Y(s)), Y(s)), {F: FIELD, X: STILL, Y: LINE}, 2 * (2 * s + 3)),
    "by both": (sp.Derivative(F(X(s), Y(s)), X(s), Y(s)), {F: FIELD, X: LINE, Y: LINE}, 3 * (2 * s + 3) ** 2),
    "twice": (sp.Derivative(F(X(s), 1), (X(s), 2)), {F: FIELD, X: LINE}, 6 * (2 * s + 3)),
    "of an expression": (sp.Derivative(s * X(s) ** 2, X(s)), {X: LINE}, 2 * s * (2 * s + 3)),
    "of what stays unknown": (
        sp.Derivative(F(X(s), s), X(s)), {X: STILL}, sp.Subs(sp.Derivative(F(u, s), u), u, 0),
    ),
    "in a body, at a number": (X(0) + X(t), {X: SLOPE, Y: LINE}, 4 + t),
    "in a body, at a function": (X(Y(t)), {X: SLOPE, Y: LINE}, 2 + 2 * t + 3),
}  # fmt: skip


@pytest.mark.parametrize("name", TAKEN)
def test_a_derivative_is_taken_before_what_moves_gets_its_value(name: str) -> None:
    expression, functions, expected = TAKEN[name]
    for order in itertools.permutations(functions.items()):
        found = concretely(expression, dict(order))
        assert sp.expand(found - expected) == 0 or found.dummy_eq(expected)


def test_a_system_in_which_a_state_rests_by_which_a_slope_is_taken_is_attacked() -> None:
    """X rests where Y moves alone, and the field has a slope by both."""
    bounded = ForAll((p, q), le(sp.Derivative(F(p, q), p) ** 2, p**2), ())
    moves = [
        ForAll((s,), eq(sp.Derivative(state(s), s), sp.Derivative(F(X(s), Y(s)), state(s))), (ge(s, 0), le(s, t)))
        for state in (X, Y)
    ]
    starts = (ge(t, 0), eq(X(0), 0), eq(Y(0), 0))
    assert attack(Goal("rests", ge(X(t), X(0) - 1), (bounded, *moves, *starts))).hit is None
