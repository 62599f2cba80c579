"""Section 2.2: the stability of the scalar example, in both times, for every solution."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    ForAll,
    Goal,
    Relation,
    claim,
    comparison,
    eq,
    every,
    exp_monotone,
    ge,
    le,
    lt,
    reals,
    specialise,
)  # fmt: skip

from .notation import T, k, nu, t, t0, tau
from .section2_change_of_time import contracted_example, example, example_limit, pt_solution

SECTION = "2 Preliminaries: the scalar example is stable in both times"

s = sp.Symbol("s", real=True)
first = sp.Symbol("t_1", real=True)  # any start
first_tau = sp.Symbol("tau_1", real=True)
X = sp.Function("X", real=True)
in_time = [ge(first, t0), ge(t, first), lt(t, t0 + T)]


def gone(time: sp.Expr) -> sp.Expr:
    """(t − t₀)/ν, the dilated time that has passed."""
    return (time - t0) / nu(time - t0)


def on(start: sp.Expr, end: sp.Expr, relation: Relation) -> ForAll:
    """The relation at all times from start to end."""
    return ForAll((s,), relation, (ge(s, start), le(s, end)))


# --- In dilated time --------------------------------------------------------------------------------------------------


@claim(
    "2.2/example-above", "In dilated time what falls at least at the rate kx stays below the solution",
    le(X(tau), X(first_tau) * sp.exp(-k * (tau - first_tau))),
    given=[ge(tau, first_tau), on(first_tau, tau, le(sp.Derivative(X(s), s), -k * X(s)))], place="Section 2.2",
    uses=[example],
)  # fmt: skip
def example_above(goal: Goal) -> Evidence:
    """The comparison lemma."""
    return comparison(goal, X(first_tau) * sp.exp(-k * (s - first_tau)))


@claim(
    "2.2/example-guas", "The linear example is globally uniformly asymptotically stable, exponentially",
    eq(sp.Abs(X(tau)), sp.Abs(X(first_tau)) * sp.exp(-k * (tau - first_tau))),
    given=[ge(tau, first_tau), on(first_tau, tau, eq(sp.Derivative(X(s), s), -k * X(s)))],
    labels=["eq:example", "eq:example_solution"], uses=[example_above],
)  # fmt: skip
def example_guas(goal: Goal) -> Evidence:
    """Every solution, from every start at every time: |x(τ)| = β(|x(τ₁)|, τ − τ₁) with β(r, σ) = r e^(−kσ)."""
    both = (X(s), -X(s))
    return reals(goal, *(fact for value in both for fact in specialise(goal, example_above, {X(s): value})))


# --- In the original time ---------------------------------------------------------------------------------------------


@claim(
    "2.2/pt-example-above", "In the original time what falls at least at the rate kx/ν² stays below the solution",
    le(X(t), X(first) * sp.exp(-k * (gone(t) - gone(first)))),
    given=[*in_time, on(first, t, le(sp.Derivative(X(s), s), -k * X(s) / nu(s - t0) ** 2))], place="Section 2.2",
    uses=[contracted_example],
)  # fmt: skip
def pt_example_above(goal: Goal) -> Evidence:
    """The comparison lemma, as long as ν is positive."""
    return comparison(goal, X(first) * sp.exp(-k * (gone(s) - gone(first))), denominators=[nu(s - t0)])


@claim(
    "2.2/pt-example-every-solution", "Every solution in the original time, from every start at every time",
    eq(X(t), X(first) * sp.exp(-k * (gone(t) - gone(first)))),
    given=[*in_time, on(first, t, eq(sp.Derivative(X(s), s), -k * X(s) / nu(s - t0) ** 2))],
    labels=["eq:pt_example", "eq:pt_example_solution"], uses=[pt_example_above, pt_solution],
)  # fmt: skip
def pt_example_every_solution(goal: Goal) -> Evidence:
    """The printed solution is the only one; it is the case t₁ = t₀."""
    both = (X(s), -X(s))
    return reals(goal, *(fact for value in both for fact in specialise(goal, pt_example_above, {X(s): value})))


@claim(
    "2.2/pt-example-uniform", "The exponent from a later start: at least what remains of the time, dilated",
    every(
        eq(gone(t) - gone(first), (t - first) / (nu(t - t0) * nu(first - t0))),
        ge(gone(t) - gone(first), (t - first) / nu(t - t0)),
    ),
    given=in_time, place="Section 2.2",
)  # fmt: skip
def pt_example_uniform(goal: Goal) -> Evidence:
    """From t₁ on the horizon is what is left of T, and the contraction is faster than from t₀."""
    return reals(goal)


@claim(
    "2.2/pt-example-fxt-guas", "The example is FxT-GUAS in the original time",
    le(sp.Abs(X(t)), sp.Abs(X(first)) * sp.exp(-k * (t - first) / nu(t - t0))),
    given=[*in_time, on(first, t, eq(sp.Derivative(X(s), s), -k * X(s) / nu(s - t0) ** 2))],
    labels=["eq:pt_example"], place="Section 2.2", uses=[pt_example_every_solution, pt_example_uniform],
)  # fmt: skip
def pt_example_fxt_guas(goal: Goal) -> Evidence:
    """A bound of the class that the definition asks for, β(r, σ) = r e^(−kσ), with (t − t₁)/ν, which tends to infinity
    as t tends to t₀ + T, in the place of time. It holds from every start at every time."""
    return reals(
        goal, *specialise(goal, pt_example_every_solution, {}),
        exp_monotone(-k * (gone(t) - gone(first)), -k * (t - first) / nu(t - t0)),
    )  # fmt: skip


size, larger, wait, longer = sp.symbols("r r_1 sigma sigma_1", nonnegative=True)


@claim(
    "2.2/example-class-kl", "r e^(−kσ) is of class KL",
    every(
        eq(sp.Subs(size * sp.exp(-k * wait), size, 0), 0),
        lt(size * sp.exp(-k * wait), larger * sp.exp(-k * wait)),
        le(size * sp.exp(-k * longer), size * sp.exp(-k * wait)),
    ),
    given=[lt(size, larger), le(wait, longer)], place="Section 2.2", uses=[example_limit],
)  # fmt: skip
def class_kl(goal: Goal) -> Evidence:
    """0 at 0, increasing with r, not increasing with σ, and tending to 0 with σ, by the limit of the solution."""
    return reals(goal, exp_monotone(-k * longer, -k * wait))
