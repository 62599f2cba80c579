"""The attacker hits false statements of many kinds, and no true one."""

from __future__ import annotations

import pytest
import sympy as sp

from ptproof.proof import Goal, eq, ge, gt, le, lt
from ptproof.proof.attack import attack, points_of
from ptproof.proof.statement import Assumption, ForAll, Relation, Statement, every

x, y, z = sp.symbols("x y z", real=True)
p, q = sp.symbols("p q", positive=True)
n = sp.Symbol("n", integer=True, positive=True)
F = sp.Function("F", real=True)(x)
G = sp.Function("G", positive=True)(x)
s, t = sp.symbols("s t", real=True)
H, K = sp.Function("H", real=True), sp.Function("K", real=True)

FALSE: dict[str, tuple[Statement, list[Assumption]]] = {
    "coefficient": (eq((x + y) ** 2, x**2 + 3 * x * y + y**2), []),
    "sign": (eq(sp.cos(x + y), sp.cos(x) * sp.cos(y) + sp.sin(x) * sp.sin(y)), []),
    "exponent": (eq(p**2 * p**q, p ** (q + 3)), []),
    "assumption missing": (ge(x**2, x), []),
    "division by zero at one place": (eq(x * (1 / x + 1), 1 + x), []),
    "division by zero by an assumption": (eq((1 / (x - y) + 1) * (x - y), 0), [eq(x, y)]),
    "false where two symbols are equal": (gt(p / q + q / p, 2), []),
    "false for negative values": (eq(sp.sqrt(x**2), x), []),
    "false at a kink": (gt(sp.Abs(x - y), 0), []),
    "false for large values": (le(p, 10**5), []),
    "false for tiny values": (ge(p, sp.Rational(1, 10**8)), []),
    "false for fractions": (ge(p**2, p), []),
    "false for 1": (gt(n, 1), []),
    "strict at the end of a range": (lt(x, 3), [le(x, 3)]),
    "a root of a negative number": (ge(sp.sqrt(x), 0), []),
    "the logarithm of a negative number": (le(sp.log(x), x), []),
    "the imaginary unit": (ge(sp.exp(2 * sp.I * x), 0), []),
    "derivative": (eq(sp.Derivative(F**2, x), F * sp.Derivative(F, x)), []),
    "chain rule": (eq(sp.diff(H(x, K(x)), x), sp.Derivative(H(x, K(x)), K(x)) * sp.Derivative(K(x), x)), []),
    "a derivative by a function": (eq(sp.Derivative(x * K(x) ** 2, K(x)), x * K(x)), []),
    "another function than the one that moves": (eq(sp.Derivative(H(x, K(x)), K(x)), sp.Derivative(K(x), x)), []),
    "a function that vanishes": (gt(F**2, 0), []),
    "a rate that vanishes": (gt(sp.Derivative(G, x) ** 2, 0), []),
    "integral": (eq(sp.Integral(s, (s, 0, p)), p**2), []),
    "limit": (eq(sp.Limit((1 + x / t) ** t, t, sp.oo), sp.exp(x) + 1), []),
    "a finite limit said to be infinite": (eq(sp.Limit(t / (1 + t), t, sp.oo), sp.oo), []),
    "an infinite limit said to be finite": (eq(sp.Limit(1 / t, t, 0, "+"), 3), []),
    "one of several parts": (every(eq(x, x), ge(x, x), eq(x, y)), []),
    "a row of a column": (eq(sp.Matrix([x, y]), sp.Matrix([x, 2 * y])), []),
    "a linear assumption that has to be solved": (eq(x, 3 * y), [eq(2 * x + 3 * y, 5)]),
    "a quadratic assumption that has to be solved": (gt(x, 0), [eq(x**2, 2)]),
}
TRUE: dict[str, tuple[Statement, list[Assumption]]] = {
    "square": (eq((x + y) ** 2, x**2 + 2 * x * y + y**2), []),
    "angles": (eq(sp.cos(x + y), sp.cos(x) * sp.cos(y) - sp.sin(x) * sp.sin(y)), []),
    "powers": (eq(p**2 * p**q, p ** (q + 2)), []),
    "a square above 1": (ge(x**2, x), [ge(x, 1)]),
    "quotients": (ge(p / q + q / p, 2), []),
    "root of a square": (eq(sp.sqrt(x**2), sp.Abs(x)), []),
    "derivative": (eq(sp.Derivative(F**2, x), 2 * F * sp.Derivative(F, x)), []),
    "chain rule": (eq(sp.Derivative(sp.sin(K(x)) ** 2, x), sp.diff(sp.sin(K(x)) ** 2, K(x)) * sp.diff(K(x), x)), []),
    "chain rule, both arguments": (
        eq(
            sp.Derivative(H(x, K(x)), x),
            sp.Subs(sp.Derivative(H(s, K(x)), s), s, x) + sp.Derivative(H(x, K(x)), K(x)) * sp.Derivative(K(x), x),
        ),
        [],
    ),
    "a derivative by a function": (eq(sp.Derivative(x * K(x) ** 2, (K(x), 2)), 2 * x), []),
    "a tiny exponential": (gt(1 + sp.exp(-p), 1), []),
    "a product of tiny exponentials": (gt(sp.exp(-p * q), 0), []),
    "the root of a sum that cancels": (eq(sp.sqrt((sp.sqrt(p) + 1) ** 2 - p - 2 * sp.sqrt(p) - 1), 0), []),
    "integral": (eq(sp.Integral(s, (s, 0, p)), p**2 / 2), []),
    "limit": (eq(sp.Limit((1 + x / t) ** t, t, sp.oo), sp.exp(x)), []),
    "infinite limit": (eq(sp.Limit(1 / t, t, 0, "+"), sp.oo), []),
    "the root of a quadratic equation": (gt(x**3, 2), [eq(x**2, 2), gt(x, 0)]),
}


@pytest.mark.parametrize("name", FALSE)
def test_hits_what_is_false(name: str) -> None:
    statement, assumptions = FALSE[name]
    assert attack(Goal(name, statement, tuple(assumptions))).hit is not None


@pytest.mark.parametrize("name", TRUE)
def test_hits_nothing_that_is_true(name: str) -> None:
    statement, assumptions = TRUE[name]
    done = attack(Goal(name, statement, tuple(assumptions)))
    assert done.hit is None
    assert done.points


def test_a_seed_gives_the_same_points() -> None:
    goal = Goal("points", ge(x, y), (ge(x, y + 1), le(x * y, 3)))
    first, second = ([*points_of(goal, seed=5, points=8)] for _ in range(2))
    assert first == second
    assert first != [*points_of(goal, seed=6, points=8)]


@pytest.mark.parametrize("seed", range(3))
def test_an_assumption_that_fails_between_the_places_of_a_grid_is_no_assumption_that_holds(seed: int) -> None:
    """With a large rate a function that vanishes at the start breaks its inequality on a short stretch only."""
    V, rate = sp.Function("V", nonnegative=True), sp.Symbol("rate", positive=True)
    grows = ForAll((s,), le(sp.Derivative(V(s), s), rate * V(s)), (ge(s, 0), le(s, t)))
    goal = Goal("growth", le(V(t), V(0) * sp.exp(rate * t)), (grows, ge(t, 0), ge(rate, 1000)))
    assert attack(goal, seed=seed).hit is None


@pytest.mark.parametrize("rate", ["a gain with a corner", "a saturation"])
def test_an_equation_without_a_plain_solution_is_met_at_rest(rate: str) -> None:
    """Constant functions: without them nothing would satisfy the assumption, and no claim about it could be proved."""
    X, Y = (sp.Function(name, real=True) for name in "XY")
    rates = {"a gain with a corner": -X(s) / sp.Max(1, s) ** 2, "a saturation": sp.Min(p, sp.Max(-p, Y(s) - X(s)))}
    moves = ForAll((s,), Relation(sp.Derivative(X(s), s), "=", rates[rate]), (ge(s, 0), le(s, t)))
    for sign, found in (("=", True), ("<", False)):
        goal = Goal("rest", le(X(t), X(0)), (moves, ge(t, 0), Relation(X(0), sign, X(t)), Relation(X(t), sign, X(0))))
        assert (next(points_of(goal, points=1), None) is not None) is found
