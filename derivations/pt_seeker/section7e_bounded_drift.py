"""Section 7.2: what the averaged systems of the two seekers do in the example with a bounded drift."""

from __future__ import annotations

from typing import Any

import sympy as sp

from ptproof.proof import (
    Evidence,
    ForAll,
    Goal,
    claim,
    comparison,
    cosine_parabola,
    eq,
    exact,
    ge,
    gt,
    instances,
    le,
    limits,
    lt,
    reals,
    sine_line,
    specialise,
)  # fmt: skip

from .chain import averaged_tau
from .notation import F, T, f, k, t, t0, tau, x1, x2
from .section6a_asymptotic import asymptotic_average, averaged_asymptotic
from .section7b_nonvanishing import drift, field, gradient_lower, slope, slope_along_axis, square

SECTION = "7.2 Simulation: the averages of both seekers"

# The field and the drift of the example, and any k, T and t₀; the example has k = 1, T = 2 and t₀ = 0.
values: dict[Any, Any] = {F: field, f[0]: drift.rate[0], f[1]: drift.rate[1]}
prescribed = averaged_tau.with_values(values)
asymptotic = asymptotic_average.with_values(values)
s = sp.Symbol("s", real=True)


# --- The PT Seeker ----------------------------------------------------------------------------------------------------


@claim(
    "7.2/pull", "The gradient pulls towards the source at least as strongly as for −‖x‖²/2, everywhere",
    le(x1 * slope[0] + x2 * slope[1], -square), place="Section 7.2",
    labels=["eq:nonvanish_drift_field_simulation"], uses=[slope_along_axis],
)  # fmt: skip
def pull(goal: Goal) -> Evidence:
    """Entry by entry; it is stronger than ‖∇F‖ ≥ ‖x‖, and no upper bound of the field is needed for what follows."""
    signs = ({x1: x1}, {x1: -x1}, {x1: x2}, {x1: -x2})
    return reals(goal, *(fact for values in signs for fact in specialise(goal, slope_along_axis, values)))


passed = tau - t0
size, damping, turn_1, turn_2, pulled = sp.symbols("B D C_1 C_2 P", real=True)


def pull_and_drift(beat: sp.Expr, rate_back: sp.Expr) -> sp.Expr:
    """The rate of ‖x‖² for a drift B cos(x), in a time that dilates it to BD cos(x)."""
    return k * (x1 * slope[0] + x2 * slope[1]) + 2 * beat * rate_back * (x1 * sp.cos(x1) + x2 * sp.cos(x2))


@claim(
    "7.2/pt-average-rate", "The rate of the squared distance of the averaged PT Seeker",
    eq(
        prescribed.derivative_along(square),
        pull_and_drift(1 + sp.sin(3 * (t0 + T * passed / (T + passed))), T**2 / (T + passed) ** 2),
    ),
    given=[ge(tau, t0)], place="Section 7.2",
)  # fmt: skip
def pt_rate(goal: Goal) -> Evidence:
    """For every k, T and t₀. The drift's beat is B = 1 + sin 3t at the t that belongs to τ, and D = dt/dτ."""
    return exact(goal)


@claim(
    "7.2/pt-average-falls", "It is negative up to a term that vanishes with time",
    le(k * pulled + 2 * size * damping * (x1 * turn_1 + x2 * turn_2), -k * square / 2 + 4 * size**2 * damping**2 / k),
    given=[
        le(pulled, -square), ge(size, 0), ge(damping, 0),
        *(relation for turn in (turn_1, turn_2) for relation in (le(turn, 1), ge(turn, -1))),
    ],
    place="Section 7.2", uses=[pull, pt_rate],
)  # fmt: skip
def pt_falls(goal: Goal) -> Evidence:
    """With P for x·∇F and C₁, C₂ for the cosines: the pull gives −k‖x‖², and half of it pays for the drift. What is
    left is 4B²D²/k, in the example at most 16D², as the beat B is at most 2."""
    return reals(goal)


W = sp.Function("W", nonnegative=True)
bound_of_beat = sp.Symbol("B", positive=True)
residual = 8 * bound_of_beat**2 * T / (k * (k * T - 1))  # 64 in the example


def pt_bound(start: sp.Expr, time: sp.Expr, amount: sp.Expr = residual) -> sp.Expr:
    """The bound of ‖x̄‖²."""
    return start * sp.exp(-k / 2 * (time - t0)) + amount / sp.sqrt(1 + (time - t0) / T)


@claim(
    "7.2/pt-average-converges", "The averaged PT Seeker comes to the source from everywhere if kT > 1: a bound of ‖x̄‖²",
    le(W(tau), pt_bound(W(t0), tau)),
    given=[
        ge(tau, t0), gt(k * T, 1),
        ForAll((s,), le(sp.Derivative(W(s), s), -k * W(s) / 2 + 4 * bound_of_beat**2 / (k * (1 + (s - t0) / T) ** 4)),
               (ge(s, t0), le(s, tau))),
    ],
    place="Section 7.2", uses=[pt_falls, gradient_lower],
)  # fmt: skip
def pt_converges(goal: Goal) -> Evidence:
    """W is ‖x̄‖² along the trajectory, and D² is 1/(1 + (τ − t₀)/T)⁴. Although Assumption 2 holds on discs only, the
    conclusion of the Proposition holds for this example, where kT = 2, on the whole plane. For kT ≤ 1 the root in
    the bound would have to be a slower power."""
    return comparison(goal, pt_bound(W(t0), s), denominators=[1 + (s - t0) / T])


@claim(
    "7.2/pt-average-limit", "That bound tends to 0",
    eq(sp.Limit(pt_bound(square, tau, size), tau, sp.oo, "-"), 0), place="Section 7.2",
    uses=[pt_converges],
)  # fmt: skip
def pt_limit(goal: Goal) -> Evidence:
    """From every start; B stands for the number of the claim before."""
    return limits(goal)


# --- The asymptotic seeker --------------------------------------------------------------------------------------------

half = sp.Rational(1, 2)


@claim(
    "7.2/asymptotic-average-rate", "Near the source the drift pushes the averaged asymptotic seeker to the right",
    ge(asymptotic.rhs[0], sp.Rational(7, 8) * (1 + sp.sin(3 * t)) - 3 * k / 8),
    given=[le(x1, half), ge(x1, -half)], place="Section 7.2", uses=[averaged_asymptotic],
)  # fmt: skip
def asymptotic_rate(goal: Goal) -> Evidence:
    """For |x₁| ≤ 1/2 the cosine is at least 7/8, and half of the slope at most 3/8, whatever k is."""
    return reals(goal, cosine_parabola(x1), sine_line(x1), sine_line(-x1))


first = sp.Symbol("t_1", real=True)
X = sp.Function("X_1", real=True)
push = ForAll(
    (s,), le(sp.Derivative(X(s), s), 3 * k / 8 - sp.Rational(7, 8) * (1 + sp.sin(3 * s))),
    (ge(s, first), le(s, t)),
)  # fmt: skip


def pushed(time: sp.Expr) -> sp.Expr:
    """What the push moves from t₁ to a time."""
    return (7 - 3 * k) / 8 * (time - first) - sp.Rational(7, 24) * (sp.cos(3 * time) - sp.cos(3 * first))


@claim(
    "7.2/pushed", "What is pushed to the left like this moves at least that far", le(X(t), X(first) - pushed(t)),
    given=[ge(t, first), push], place="Section 7.2", uses=[asymptotic_rate],
)  # fmt: skip
def pushed_away(goal: Goal) -> Evidence:
    """The comparison lemma."""
    return comparison(goal, X(first) - pushed(s))


stays = [ForAll((s,), relation, (ge(s, first), le(s, t))) for relation in (le(X(s), half), ge(X(s), -half))]
right = ForAll(
    (s,), ge(sp.Derivative(X(s), s), sp.Rational(7, 8) * (1 + sp.sin(3 * s)) - 3 * k / 8),
    (ge(s, first), le(s, t)),
)  # fmt: skip


@claim(
    "7.2/asymptotic-average-never-settles",
    "For k < 7/3 the average of the asymptotic seeker is never near the source for long",
    le((7 - 3 * k) * (t - first), sp.Rational(38, 3)),
    given=[ge(t, first), lt(k, sp.Rational(7, 3)), *stays, right], place="Section 7.2", uses=[pushed_away],
)  # fmt: skip
def never_settles(goal: Goal) -> Evidence:
    """While |x̄₁| ≤ 1/2 the push of the claims before acts, and within 38/(3(7 − 3k)) seconds it carries x̄₁ from −1/2
    beyond 1/2. With k = 1 these are 19/6 seconds: the source is not approached, as the drift is not dominated."""
    return reals(goal, *specialise(goal, pushed_away, {X(s): -X(s)}), *instances(goal, t, first))
