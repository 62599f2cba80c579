"""The comparison lemma for scalar differential inequalities v' ≤ φ(τ, v).

If v' ≤ φ(τ, v) on [τ₀, τ₁), u' = φ(τ, u), v(τ₀) ≤ u(τ₀), and φ is continuous in τ and locally Lipschitz in its
second argument, then v ≤ u on [τ₀, τ₁) (Khalil, Nonlinear Systems, Lemma 3.4). What is checked here is every
hypothesis of it: that u solves the equation (exact algebra), starts at v(τ₀), stays where φ is Lipschitz, and
is defined up to the time in question; the rest of the bound is a real inequality.
"""

from __future__ import annotations

import time
from collections.abc import Sequence

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.algebra import NotAlgebraic, is_zero
from ptproof.proof.claim import Goal
from ptproof.proof.reals import follows
from ptproof.proof.refute import or_refute
from ptproof.proof.statement import ForAll, Implication, ge, gt, relations_of
from ptproof.proof.verdict import Evidence, Verdict

ENGINE = "comparison lemma"


def comparison(
    goal: Goal, solution: sp.Expr, *, denominators: Sequence[sp.Expr] = (), lemmas: Sequence[Implication] = ()
) -> Evidence:
    """Show ``v(τ) ≤ bound`` from the goal's assumption ``Derivative(v(s), s) ≤ φ(s, v(s))`` for all s.

    Parameters
    ----------
    goal
        Its statement is v(τ) ≤ bound(τ); among its assumptions are the differential inequality as a
        :class:`ForAll` over one time s whose domain is s ≥ τ₀ (and s ≤ τ, or s < an end, if it says so).
    solution
        u as an expression in the same time as the assumption and in v(τ₀).
    denominators
        Expressions in s whose positivity on the whole of [τ₀, τ] makes u defined there; each is shown positive
        from the domain and the goal's assumptions.
    """
    start = time.perf_counter()
    try:
        detail = _check(goal, solution, denominators, lemmas)
    except _Failed as failure:
        tried = Evidence(ENGINE, Verdict.UNDECIDED, str(failure), time.perf_counter() - start)
        return or_refute(goal, tried)
    return Evidence(ENGINE, Verdict.PROVED, detail, time.perf_counter() - start)


class _Failed(Exception):
    """A hypothesis of the lemma that could not be shown."""


def _check(goal: Goal, solution: sp.Expr, denominators: Sequence[sp.Expr], lemmas: Sequence[Implication]) -> str:
    (statement,) = relations_of(goal.statement)
    if statement.sign != "<=" or not isinstance(statement.left, AppliedUndef):
        raise _Failed(f"not of the form v(time) <= bound: {statement}")
    at = statement.left
    inequality, s, v = _differential_inequality(goal, at)
    rate = inequality.relation.right
    start = _initial_time(inequality, s)
    value = sp.Dummy("v", nonnegative=True)
    phi = rate.subs(v, value)
    if phi.has(AppliedUndef):
        raise _Failed("the rate depends on the function otherwise than through its value")
    if not _lipschitz(phi, value):
        raise _Failed(f"the rate {rate} is not recognised as locally Lipschitz in {v}")
    if not _nonnegative(goal, v):
        raise _Failed(f"nothing says that {v} is not negative")
    initial = v.subs(s, start)
    first = sp.Dummy("v0", positive=True)
    u = solution.subs(initial, first)
    try:
        if not is_zero(sp.diff(u, s) - phi.subs(value, u)):
            raise _Failed(f"{solution} does not solve the equation with rate {rate}")
        if not is_zero(u.subs(s, start) - first):
            raise _Failed(f"{solution} does not start at {initial}")
    except NotAlgebraic as error:
        raise _Failed(str(error)) from None
    inside = [*(part for part in inequality.domain), *goal.relations]
    for denominator in denominators:
        shown, why = follows(gt(denominator.subs(initial, first), 0), [item.map(lambda e: e.subs(initial, first))
                             for item in inside], list(lemmas))  # fmt: skip
        if not shown:
            raise _Failed(f"{denominator} > 0 is not shown on the whole interval: {why}")
    _covers(solution, denominators, s)
    end = at.args[0]
    bound = statement.right.subs(initial, first)
    reached = u.subs(s, end)
    try:
        equal = is_zero(bound - reached)
    except NotAlgebraic:
        equal = False
    if not equal:
        known = [item.map(lambda e: e.subs(initial, first)) for item in goal.relations if not item.left.has(at.func)]
        shown, why = follows(ge(bound, reached), known, list(lemmas))
        if not shown:
            raise _Failed(f"the solution of the equation is not shown to stay below the bound: {why}")
    return f"u = {solution} solves the equation, starts at {initial}, and is defined on the whole interval"


def _differential_inequality(goal: Goal, at: AppliedUndef) -> tuple[ForAll, sp.Symbol, AppliedUndef]:
    for item in goal.assumptions:
        if isinstance(item, ForAll) and len(item.variables) == 1 and item.relation.sign == "<=":
            (s,) = item.variables
            v = at.func(s)
            if item.relation.left == sp.Derivative(v, s):
                return item, s, v
    raise _Failed(f"no assumption of the form Derivative({at.func}(s), s) <= rate")


def _initial_time(inequality: ForAll, s: sp.Symbol) -> sp.Expr:
    for part in inequality.domain:
        if part.sign == ">=" and part.left == s:
            return part.right
    raise _Failed(f"the domain of {inequality} does not begin with {s} >= a time")


def _lipschitz(phi: sp.Expr, value: sp.Symbol) -> bool:
    """A combination of powers of the value with exponents 0 or ≥ 1 is locally Lipschitz on [0, ∞)."""
    for term in sp.Add.make_args(sp.expand(phi)):
        independent, dependent = term.as_independent(value, as_Add=False)
        if independent.has(value):
            return False
        if dependent == 1:
            continue
        base, exponent = dependent.as_base_exp()
        if base != value or exponent.has(value) or not (exponent - 1).is_nonnegative:
            return False
    return True


def _nonnegative(goal: Goal, v: AppliedUndef) -> bool:
    if v.is_nonnegative or v.is_positive:
        return True
    return any(isinstance(item, ForAll) and item.relation == ge(v, 0) for item in goal.assumptions)


def _covers(solution: sp.Expr, denominators: Sequence[sp.Expr], s: sp.Symbol) -> None:
    """Every factor of the solution with a power that may be singular must be one that was shown positive."""
    positive = [sp.factor(sp.together(item)) for item in denominators]
    for node in sp.preorder_traversal(solution):
        if not (isinstance(node, sp.Pow) and node.base.has(s)):
            continue
        if node.exp.is_integer and node.exp.is_nonnegative:
            continue
        base = sp.factor(sp.together(node.base))
        numerator, denominator = sp.fraction(base)
        for factor in (*sp.Mul.make_args(numerator), *sp.Mul.make_args(denominator)):
            factor = factor.as_base_exp()[0]
            if not factor.has(s) or any(_multiple(factor, item) for item in positive):
                continue
            raise _Failed(f"{factor} may vanish, and nothing shows that it is positive")


def _multiple(factor: sp.Expr, shown: sp.Expr) -> bool:
    """Whether ``factor`` divides a shown expression as one of its factors, up to a positive or negative number."""
    numerator, denominator = sp.fraction(shown)
    factors = [item.as_base_exp()[0] for item in (*sp.Mul.make_args(numerator), *sp.Mul.make_args(denominator))]
    return any(sp.expand(factor - item) == 0 or sp.expand(factor + item) == 0 for item in factors)
