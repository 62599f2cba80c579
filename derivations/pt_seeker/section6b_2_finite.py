"""Section 6.2 for κ ≥ 2: when the bound stays finite, and the smallest critical initial value."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    Goal,
    claim,
    eq,
    exact,
    ge,
    gt,
    le,
    lt,
    reals,
    specialise,
)

from .notation import E_norm, T, k, t0
from .section5b_1_lyapunov import sigma
from .section6b_1_comparison import (
    C1,
    C2,
    W,
    after,
    denominator,
    denominator_form,
    elapsed,
)
from .section6b_2_critical import (
    admitted,
    critical_positive,
    critical_power,
    tau_star,
)

SECTION = "6.2 Discussion: vanishing drift and κ ≥ 2"

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


smallest = 1 / (sigma * T * (drift_root - feed_root) ** 2)


@claim(
    "6.2/smallest-critical-value", "No critical value is smaller than the threshold for small starts",
    ge(critical_power, smallest), given=admitted, labels=["critical-V_0"], uses=[critical_positive],
)  # fmt: skip
def smallest_critical_value(goal: Goal) -> Evidence:
    """V(x₀)^σ of eq. (critical-V₀) is at least 1/(σT(c₂√‖E‖ − c₁√(k/2))²), for every τ* that the condition allows."""
    return reals(goal)


@claim(
    "6.2/smallest-critical-value-attained", "The threshold for small starts is the critical value of one τ*",
    eq(critical_power.subs(tau_star, t0 + T * (drift_root / feed_root - 1)), smallest),
    given=[gt(E_norm, k * C1**2 / (2 * C2**2))], labels=["critical-V_0"], uses=[smallest_critical_value],
)  # fmt: skip
def smallest_attained(goal: Goal) -> Evidence:
    """At 1 + (τ* − t₀)/T = (c₂/c₁)√(2‖E‖/k), where the two roots are one. So below the threshold the bound is finite
    for all τ, and at the threshold it escapes."""
    return exact(goal)
