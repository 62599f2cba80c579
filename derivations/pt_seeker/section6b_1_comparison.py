"""Section 6.2 for κ ≥ 2: the bound by the comparison principle, and its denominator.

κ = n + 1 with n = 1, 2, … (n as in Step 4), so that σ = 2q − 1 = n/(n + 1) is known to be positive.
"""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Assumption,
    Evidence,
    Fact,
    ForAll,
    Goal,
    claim,
    comparison,
    eq,
    every,
    exact,
    ge,
    gt,
    instances,
    le,
    limits,
    power_nonnegative,
    reals,
    specialise,
)

from .notation import IN_TAU, V0, E, E_norm, T, c, f, k, kappa, q, t0, tau, x1, x2
from .section5b_0_trajectory import (
    EXAMPLE,
    X1,
    X2,
    V_along,
    V_rate,
    assumption_2,
    at,
    drift_norm,
    gradient_bounds,
    here,
    later,
    s,
    solves,
    start,
    v_differential_inequality,
    v_nonnegative,
)
from .section5b_0_with_drift import drift_norm_below, gradient_drift_given, norm_of_E
from .section5b_1_lyapunov import EXAMPLE_QUARTIC, along_X, at_order, n, sigma, sigma_form
from .section5b_1_lyapunov import W as value

SECTION = "6.2 Discussion: vanishing drift and κ ≥ 2"

order = n + 1
q_printed = q(order)
# The constants c₁ and c₂ of κ as letters, as the paper prints them here: the claims hold for all positive values.
C1, C2 = sp.symbols("c_kappa1 c_kappa2", positive=True)
constants = [eq(C1, c(1, order)), eq(C2, c(2, order))]  # what they stand for under Assumption 2
drift, feed = C2**2 * E_norm, k * C1**2 / 2
after = ge(tau, t0)

# A solution that moves, for κ = 2: F = −‖x‖⁴ and E = −I, so that X' = (4/(1 + s)² − 4)X³ on the ray through (1, 0).
MOVING = EXAMPLE_QUARTIC | {
    n: 1, k: 2, C1: 4, C2: 4, E_norm: 1, V0: 1, **dict.fromkeys(E, 0), E[0, 0]: -1, E[1, 1]: -1,
    X1(s): (1 + 8 * s**2 / (1 + s)) ** sp.Rational(-1, 2),
    f[0]: 4 * (x1**2 + x2**2) * x1, f[1]: 4 * (x1**2 + x2**2) * x2,
}  # fmt: skip


@claim(
    "6.2/drift-by-v", "The drift along a solution is bounded by a power of V",
    le(at(drift_norm, tau), c(2) * E_norm * V_along ** q()),
    given=[after, *assumption_2, *gradient_drift_given, norm_of_E],
    place="Section 6.2", uses=[drift_norm_below, gradient_bounds, v_nonnegative], example=EXAMPLE,
)  # fmt: skip
def drift_by_v(goal: Goal) -> Evidence:
    """‖E∇F‖ ≤ ‖E‖‖∇F‖, and the gradient's upper bound at the position of the instant."""
    return reals(
        goal, *specialise(goal, drift_norm_below, {start: tau}), *specialise(goal, gradient_bounds, here),
        *specialise(goal, v_nonnegative, here), power_nonnegative(V_along, q()),
    )  # fmt: skip


# --- The comparison principle -----------------------------------------------------------------------------------------


def rate_at(time: sp.Expr) -> sp.Expr:
    """The factor of V^(2q)."""
    return drift / (1 + (time - t0) / T) ** 2 - feed


elapsed = tau - t0
work = drift * T * elapsed / (T + elapsed) - feed * elapsed  # the integral of the factor


@claim(
    "6.2/v-inequality", "The inequality for V along a solution with gradient drift, for κ = n + 1 ≥ 2",
    le(V_rate, rate_at(tau) * V_along ** (1 + sigma)),
    given=[*solves(tau), *later, *at_order(assumption_2, order), *gradient_drift_given, norm_of_E, *constants],
    place="Section 6.2", uses=[drift_by_v, v_differential_inequality, v_nonnegative, sigma_form],
    example=MOVING,
)  # fmt: skip
def v_drift_inequality(goal: Goal) -> Evidence:
    """Both terms carry the same power V^(2q) = V^(1 + σ). For κ ≥ 2 it is more than 1, so the drift may win if V is
    large."""
    said = [*specialise(goal, v_nonnegative, {kappa: order, **here}), power_nonnegative(V_along, q(order))]
    return reals(
        goal, *said, *specialise(goal, v_differential_inequality, {kappa: order}),
        *specialise(goal, drift_by_v, {kappa: order}),
    )  # fmt: skip


def gammas(start: sp.Expr) -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """γ₀, γ₁, γ₂ as printed; ``start`` is V(x₀)^(2q − 1)."""
    factor = (2 * q_printed - 1) * start
    half_feed = k * C1**2 / 2
    gamma_0 = factor * t0 * (C2**2 * E_norm * T + half_feed * (t0 - T)) - t0 + T
    gamma_1 = 1 - factor * (C2**2 * E_norm * T - half_feed * (T - 2 * t0))
    return gamma_0, gamma_1, factor * half_feed


def denominator(start: sp.Expr, time: sp.Expr = tau) -> sp.Expr:
    """The printed denominator γ₂τ² + γ₁τ + γ₀."""
    gamma_0, gamma_1, gamma_2 = gammas(start)
    return gamma_2 * time**2 + gamma_1 * time + gamma_0


def remark(start: sp.Expr, time: sp.Expr = tau) -> sp.Expr:
    """The printed right-hand side of eq:remark_inequality."""
    return start * ((time - t0 + T) / denominator(start ** (2 * q_printed - 1), time)) ** (1 / (2 * q_printed - 1))


W = sp.Symbol("W", positive=True)  # V(x₀)^σ
explicit = (T + elapsed) * (1 - sigma * W * work)


@claim(
    "6.2/denominator", "The printed denominator is (T + τ − t₀)(1 − σV₀^σ times the integral)",
    eq(denominator(W), explicit), given=IN_TAU, labels=["eq:remark_inequality"], uses=[sigma_form],
)  # fmt: skip
def denominator_form(goal: Goal) -> Evidence:
    """γ₀, γ₁ and γ₂ as printed, against what the integration gives; W stands for V(x₀)^σ."""
    return exact(goal)


# Along a solution: what the comparison assumes of V, and the solution itself.


on = (ge(s, t0), le(s, tau))


def positive(found: sp.Expr) -> ForAll:
    """The printed denominator, as a function of s, is positive on [t₀, τ]."""
    return ForAll((s,), gt(found, 0), on)


def denominator_from(value: sp.Expr) -> sp.Expr:
    """The printed denominator at s, where V starts at ``value``."""
    return denominator(value ** (2 * q_printed - 1), s)


falls_or_grows = ForAll((s,), le(sp.Derivative(value(s), s), rate_at(s) * value(s) ** (1 + sigma)), on)
not_negative = ForAll((s,), ge(value(s), 0), on)
starts = le(V_along.subs(tau, t0), V0)  # V may also start at 0, at the source
trajectory: list[Assumption] = [
    *solves(tau, t0),
    after,
    *at_order(assumption_2, order),
    *gradient_drift_given,
    norm_of_E,
    *constants,
    starts,
]


def v_falls(there: Goal, point: sp.Expr) -> list[Fact]:
    """What shows, at an arbitrary instant, that V along X satisfies the inequality, and is not negative."""
    position_then = {kappa: order, x1: X1(point), x2: X2(point)}
    return [
        *specialise(there, v_nonnegative, position_then),
        *specialise(there, v_drift_inequality, {start: t0, tau: point}),
    ]  # fmt: skip


def left(time: sp.Expr) -> sp.Expr:
    """1 − σW₀^σ times the work up to an instant, of what starts at V(x₀): the printed denominator over T + τ − t₀."""
    return 1 - sigma * V0**sigma * work.subs(tau, time)


@claim(
    "6.2/bernoulli-comparison", "What grows or falls as V does stays below the solution of the comparison equation",
    le(value(tau), V0 * left(tau) ** (-1 / sigma)),
    given=[after, le(value(t0), V0), falls_or_grows, not_negative, positive(left(s))],
    place="Section 6.2", uses=[sigma_form],
)  # fmt: skip
def bernoulli_comparison(goal: Goal) -> Evidence:
    """The comparison principle. The equation is of Bernoulli's type, and W may be 0."""
    return comparison(goal, V0 * left(s) ** (-1 / sigma), denominators=[left(s)])


base, top, below = sp.symbols("B N D", positive=True)


@claim(
    "6.2/remark-power", "The power of the comparison equation's solution, as it is printed",
    eq(base ** (-1 / sigma), (top / below) ** (1 / (2 * q_printed - 1))), given=[eq(base, below / top)],
    place="Section 6.2", uses=[sigma_form],
)  # fmt: skip
def remark_power(goal: Goal) -> Evidence:
    """1/σ and the printed 1/(2q − 1) are one exponent."""
    return exact(goal)


@claim(
    "6.2/remark-by-letters", "The printed bound, by letters",
    le(value(tau), remark(V0)),
    given=[after, le(value(t0), V0), falls_or_grows, not_negative, positive(denominator_from(V0))],
    place="Section 6.2", uses=[bernoulli_comparison, denominator_form, remark_power],
)  # fmt: skip
def remark_by_letters(goal: Goal) -> Evidence:
    """The solution as it is printed: its base is the quotient of T + τ − t₀ and the printed denominator."""

    def along(there: Goal, point: sp.Expr) -> list[Fact]:
        return instances(there, point)

    facts = instances(goal, tau)
    values = {base: left(tau), top: elapsed + T, below: denominator_from(V0).subs(s, tau)}
    return reals(
        goal, *facts, *specialise(goal, bernoulli_comparison, {}, facts, along=along),
        *specialise(goal, remark_power, values, facts),
    )  # fmt: skip


@claim(
    "6.2/remark-inequality", "The bound for κ ≥ 2 along every solution, as long as its denominator is positive",
    le(V_along, remark(V0)),
    given=[*trajectory, positive(denominator_from(V0))],
    labels=["eq:remark_inequality"], uses=[remark_by_letters, v_drift_inequality, v_nonnegative], example=MOVING,
)  # fmt: skip
def remark_inequality(goal: Goal) -> Evidence:
    """The printed bound, with the domain that it needs: the denominator is positive up to τ. Where it has been zero or
    negative the right-hand side says nothing."""
    return reals(goal, *instances(goal, tau), *specialise(goal, remark_by_letters, {value(s): along_X}, along=v_falls))


@claim(
    "6.2/bound-attained", "The bound solves the comparison equation",
    eq(sp.Derivative(-denominator(W) / (W * (T + elapsed)), tau), sigma * rate_at(tau)),
    given=IN_TAU, place="Section 6.2", uses=[remark_inequality],
)  # fmt: skip
def bound_attained(goal: Goal) -> Evidence:
    """V to the power −σ is the denominator over V(x₀)^σ(T + τ − t₀) where V equals the bound, and that satisfies the
    integrated inequality with equality: the inequality for V alone allows no better bound."""
    return exact(goal)


numerator, small = sp.symbols("N s_0", positive=True)


@claim(
    "6.2/bound-escapes", "Where the denominator falls to zero the bound grows to infinity",
    eq(sp.Limit(V0 * (numerator / small) ** (1 / (2 * q_printed - 1)), small, 0, "+"), sp.oo),
    place="Section 6.2", uses=[bound_attained],
)  # fmt: skip
def bound_escapes(goal: Goal) -> Evidence:
    """The numerator T + τ − t₀ stays positive."""
    return limits(goal)


@claim(
    "6.2/denominator-shape", "The denominator: quadratic in τ, affine in V₀^σ, and T at the start",
    every(
        eq(sp.Derivative(denominator(W), (tau, 3)), 0), gt(gammas(W)[2], 0),
        eq(sp.Derivative(denominator(W), (W, 2)), 0), eq(denominator(W, t0), T),
    ),
    place="Section 6.2", uses=[denominator_form],
)  # fmt: skip
def denominator_shape(goal: Goal) -> Evidence:
    """A parabola that opens upwards and starts at T > 0, so the bound is finite at first."""
    return reals(goal)
