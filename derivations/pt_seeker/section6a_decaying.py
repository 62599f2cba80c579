"""Section 6: a signal that decays to zero away from the source, for which Assumption 2 holds only locally.

F = 1/(1 + ‖x‖²), without drift, on the average in dilated time.
"""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    ForAll,
    Goal,
    claim,
    comparison,
    eq,
    every,
    exact,
    exp_monotone,
    ge,
    le,
    lt,
    power_monotone,
    reals,
    specialise,
)  # fmt: skip

from . import chain
from .notation import F, a2, f, k, kappa, t0, tau, x1, x2

SECTION = "6.1 Discussion: a signal that decays to zero"

s = sp.Symbol("s", real=True)
square = x1**2 + x2**2
signal = 1 / (1 + square)
average = chain.averaged_tau.with_values({F: signal, f[0]: sp.S.Zero, f[1]: sp.S.Zero})
X1, X2 = (sp.Function(name, real=True) for name in ("X_1", "X_2"))
W = sp.Function("W", real=True)
Z = sp.Function("Z", nonnegative=True)
after = ge(tau, t0)


def weight(of: sp.Expr) -> sp.Expr:
    """w e^(2w + w²/2), whose derivative has the factor (1 + w)²."""
    return of * sp.exp(2 * of + of**2 / 2)


def distance_squared(time: sp.Expr) -> sp.Expr:
    """‖x̄‖² along a trajectory."""
    return X1(time) ** 2 + X2(time) ** 2


moves = [
    ForAll((s,), eq(sp.Derivative(state(s), s), rate.subs({x1: X1(s), x2: X2(s)})), (ge(s, t0), le(s, tau)))
    for state, rate in zip((X1, X2), average.rhs, strict=True)
]


remote = {x1: 1 + 1 / a2, x2: sp.S.Zero}


@claim(
    "6/decaying-bounded-lyapunov", "Its V = F(x*) − F stays below 1, and no power of the distance stays below V",
    every(
        lt(1 - signal, 1),
        lt((1 - signal).subs(remote), a2 * square.subs(remote) ** kappa),
    ),
    place="Section 6",
)  # fmt: skip
def bounded_lyapunov(goal: Goal) -> Evidence:
    """So V is not radially unbounded, and Assumption 2 fails on the plane for every κ and a₂: at the distance
    1 + 1/a₂."""
    there = square.subs(remote)
    return reals(goal, power_monotone(sp.S.One, there, kappa - 1))


@claim(
    "6/decaying-linear", "A function of the distance that falls exponentially",
    eq(average.derivative_along(weight(square)), -2 * k * weight(square)), place="Section 6"
)  # fmt: skip
def decaying_linear(goal: Goal) -> Evidence:
    """w e^(2w + w²/2) with w = ‖x̄‖² is another Lyapunov function, and a radially unbounded one."""
    return exact(goal)


@claim(
    "6/exponential-decay", "What falls at least at the rate 2k", le(Z(tau), Z(t0) * sp.exp(-2 * k * (tau - t0))),
    given=[after, ForAll((s,), le(sp.Derivative(Z(s), s), -2 * k * Z(s)), (ge(s, t0), le(s, tau)))],
    place="Section 6",
)  # fmt: skip
def exponential_decay(goal: Goal) -> Evidence:
    """The comparison lemma."""
    return comparison(goal, Z(t0) * sp.exp(-2 * k * (s - t0)))


@claim(
    "6/decaying-guas", "All the same the source is globally uniformly asymptotically stable on the average",
    le(distance_squared(tau), weight(distance_squared(t0)) * sp.exp(-2 * k * (tau - t0))),
    given=[after, *moves], place="Section 6", uses=[decaying_linear, exponential_decay],
)  # fmt: skip
def decaying_guas(goal: Goal) -> Evidence:
    """From every start, by a class-KL bound. So Theorem 1 does apply to this signal: that the Lyapunov function of the
    proof is bounded, which the text gives as the reason for what follows, does not make the stability local."""
    return reals(
        goal, *specialise(goal, exponential_decay, {Z(s): weight(distance_squared(s))}),
        exp_monotone(sp.S.Zero, 2 * distance_squared(tau) + distance_squared(tau) ** 2 / 2),
    )  # fmt: skip


@claim(
    "6/slow-fall", "What falls at most at the rate 4k", le(W(tau), W(t0) + 4 * k * (tau - t0)),
    given=[after, ForAll((s,), le(sp.Derivative(W(s), s), 4 * k), (ge(s, t0), le(s, tau)))], place="Section 6",
)  # fmt: skip
def slow_fall(goal: Goal) -> Evidence:
    """The comparison lemma."""
    return comparison(goal, W(t0) + 4 * k * (s - t0))


@claim(
    "6/decaying-barely-progresses", "From far away the average barely progresses",
    ge(distance_squared(tau) ** 2, distance_squared(t0) ** 2 - 4 * k * (tau - t0)),
    given=[after, *moves], place="Section 6", uses=[slow_fall],
)  # fmt: skip
def barely(goal: Goal) -> Evidence:
    """The fourth power of the distance falls by at most 4k times the dilated time: from the distance R it takes about
    R³/k to get nearer by 1. A clipped seeker has T(2/ν_min − 1) of it, an asymptotic one the time itself; without a
    clip the average still arrives at t₀ + T."""
    return reals(goal, *specialise(goal, slow_fall, {W(s): -(distance_squared(s) ** 2)}))
