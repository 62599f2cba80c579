"""Section 6.2 for κ ≥ 2: the critical initial value, and when the bound stays finite."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    Exists,
    Goal,
    Relation,
    claim,
    eq,
    exact,
    exists_by,
    gt,
    le,
    lt,
    power_of_root,
    reals,
    specialise,
)

from .notation import V0, E_norm, T, k, t0
from .section5b_1_lyapunov import sigma, sigma_form
from .section6b_1_comparison import C1, C2, W, after, denominator, denominator_form, elapsed, q_printed

SECTION = "6.2 Discussion: vanishing drift and κ ≥ 2"

# --- The critical initial value ---------------------------------------------------------------------------------------

tau_star = sp.Symbol("tau_star", real=True)
eps = sp.Symbol("epsilon_tau", positive=True)
sigma_printed = 2 * q_printed - 1
ratio = (tau_star - t0) / T + 1
critical_power = ratio / (sigma_printed * (tau_star - t0) * (C2**2 * E_norm - k * C1**2 / 2 * ratio))
threshold = k * C1**2 / (2 * C2**2) * ratio


@claim(
    "6.2/critical-v0-positive", "The critical initial value exists under the printed condition, and only then",
    gt(critical_power, 0), given=[gt(tau_star, t0), gt(E_norm, threshold)], labels=["critical-V_0"], uses=[sigma_form],
)  # fmt: skip
def critical_positive(goal: Goal) -> Evidence:
    """The power V(x₀)^σ has to be positive to have a root."""
    return reals(goal)


@claim(
    "6.2/critical-v0-condition", "Without the printed condition there is no positive critical value",
    gt(E_norm, threshold), given=[gt(tau_star, t0), Relation(E_norm, "!=", threshold), gt(critical_power, 0)],
    labels=["critical-V_0"],
)  # fmt: skip
def critical_condition(goal: Goal) -> Evidence:
    """The converse, wherever the printed fraction is defined."""
    return reals(goal)


@claim(
    "6.2/critical-v0", "At the critical initial value the denominator is zero at τ*",
    eq(denominator(V0**sigma_printed, tau_star), 0),
    given=[gt(tau_star, t0), gt(E_norm, threshold), eq(V0, critical_power ** (1 / sigma_printed))],
    labels=["critical-V_0"], uses=[critical_positive],
)  # fmt: skip
def critical_value(goal: Goal) -> Evidence:
    """The root of the affine function of V(x₀)^σ."""
    return reals(goal, power_of_root(V0, critical_power, sigma_printed))


@claim(
    "6.2/critical-time-near-start", "If ‖E‖ > k c₁²/(2c₂²), critical times lie as close to t₀ as one likes",
    Exists((tau_star,), (gt(tau_star, t0), lt(tau_star, t0 + eps), gt(E_norm, threshold))),
    given=[gt(E_norm, k * C1**2 / (2 * C2**2))], place="Section 6.2", uses=[critical_value],
)  # fmt: skip
def critical_time(goal: Goal) -> Evidence:
    """For every ε > 0 there is a τ* in (t₀, t₀ + ε) that satisfies the condition of the critical value. The closer
    τ* is to t₀, the larger is the initial value that belongs to it."""
    room = T * (2 * C2**2 * E_norm / (k * C1**2) - 1)
    return exists_by(goal, {tau_star: t0 + sp.Min(eps, room) / 2})


# --- When the bound stays finite --------------------------------------------------------------------------------------


@claim(
    "6.2/finite-under-gain-condition", "Under the gain condition the bound stays finite for every initial value",
    gt(denominator(W), 0), given=[after, gt(k, 2 * C2**2 / C1**2 * E_norm)],
    place="Section 6.2", uses=[denominator_form],
)  # fmt: skip
def finite_under_condition(goal: Goal) -> Evidence:
    """Then the integral of the factor is negative, and the denominator only grows."""
    return reals(goal)


@claim(
    "6.2/finite-at-equality", "At equality in the gain condition the bound stays finite, too",
    gt(denominator(W), 0), given=[after, eq(k, 2 * C2**2 / C1**2 * E_norm)],
    place="Section 6.2", uses=[denominator_form],
)  # fmt: skip
def finite_at_equality(goal: Goal) -> Evidence:
    """So for all initial values at once the sharp condition is k ≥ 2c₂²/c₁² ‖E‖."""
    return reals(goal)


A, B = sp.symbols("A B", positive=True)
duration = sp.Symbol("Delta", nonnegative=True)


@claim(
    "6.2/work-of-the-drift", "The integral of the factor never exceeds T(√α − √β)²",
    le(A**2 * T * duration / (T + duration) - B**2 * duration, T * (A - B) ** 2), place="Section 6.2",
)  # fmt: skip
def work_bound(goal: Goal) -> Evidence:
    """α = A² is the drift's constant c₂²‖E‖ and β = B² the feedback's, k c₁²/2. The difference of the sides is a square
    over T + τ − t₀."""
    return reals(goal)


@claim(
    "6.2/positive-for-a-small-start", "The denominator is positive if σV₀^σ times that bound is below 1",
    gt((T + duration) * (1 - sigma * W * (A**2 * T * duration / (T + duration) - B**2 * duration)), 0),
    given=[lt(sigma * W * (T * (A - B) ** 2), 1)], place="Section 6.2", uses=[work_bound],
)  # fmt: skip
def positive_small_start(goal: Goal) -> Evidence:
    """In the letters of the claim before."""
    return reals(goal)


drift_root, feed_root = C2 * sp.sqrt(E_norm), C1 * sp.sqrt(k / 2)


@claim(
    "6.2/finite-for-a-small-start", "For an initial value that is small enough the bound stays finite whatever k is",
    gt(denominator(W), 0), given=[after, gt(E_norm, 0), lt(sigma * W * (T * (drift_root - feed_root) ** 2), 1)],
    place="Section 6.2", uses=[denominator_form, positive_small_start],
)  # fmt: skip
def finite_small_start(goal: Goal) -> Evidence:
    """The gain condition is what all initial values together need. For one given V(x₀) the bound is finite for all τ
    if σV(x₀)^σ T(c₂√‖E‖ − c₁√(k/2))² < 1, that is, if the start is close enough to the source or T is short enough,
    also where k violates the condition."""
    return reals(goal, *specialise(goal, positive_small_start, {A: drift_root, B: feed_root, duration: elapsed}))


worst = T * (A / B - 1)


@claim(
    "6.2/smallest-critical-value", "The threshold for small starts is sharp",
    eq((T + worst) * (1 - (A**2 * T * worst / (T + worst) - B**2 * worst) / (T * (A - B) ** 2)), 0),
    given=[gt(A, B)], place="Section 6.2", uses=[work_bound],
)  # fmt: skip
def smallest_critical_value(goal: Goal) -> Evidence:
    """At σV(x₀)^σ = 1/(T(A − B)²) with A > B the denominator is zero at τ* = t₀ + T(A/B − 1): the smallest initial
    value that is critical for any τ*."""
    return exact(goal)
