"""Section 6.2 for κ ≥ 2: the critical initial value, and when the bound stays finite."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    Exists,
    Fact,
    Goal,
    Relation,
    claim,
    eq,
    every,
    exact,
    exists_by,
    ge,
    gt,
    le,
    lt,
    power_of_root,
    reals,
    refute,
    specialise,
)

from .notation import V0, E, E_norm, T, f, k, t0, tau, x1, x2
from .section5b_0_trajectory import X1, V_along, s
from .section5b_1_lyapunov import sigma_form
from .section6b_1_comparison import (
    C1,
    C2,
    MOVING,
    W,
    after,
    denominator,
    denominator_from,
    gammas,
    positive,
    q_printed,
    remark,
    remark_inequality,
    trajectory,
)

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


# The other root of the denominator, and the square of the turning point's 1 + (τ − t₀)/T.
turning = 2 * C2**2 * E_norm / (k * C1**2)
tau_other = t0 + T * (turning / ratio - 1)
admitted = (gt(tau_star, t0), gt(E_norm, threshold))


@claim(
    "6.2/critical-time-range", "The printed condition bounds τ* from above",
    lt(tau_star, t0 + T * (turning - 1)), given=[gt(tau_star, t0), gt(E_norm, threshold)],
    labels=["critical-V_0"],
)  # fmt: skip
def critical_range(goal: Goal) -> Evidence:
    """The text asks for any τ* > t₀ and then for a drift that is large enough for it. For a given drift this is a
    range: t₀ < τ* < t₀ + T(2c₂²‖E‖/(k c₁²) − 1), which is empty if ‖E‖ ≤ k c₁²/(2c₂²)."""
    return reals(goal)


@claim(
    "6.2/critical-time-range-is-enough", "A τ* within that range satisfies the printed condition",
    gt(E_norm, threshold), given=[gt(tau_star, t0), lt(tau_star, t0 + T * (turning - 1))], labels=["critical-V_0"],
)  # fmt: skip
def critical_range_converse(goal: Goal) -> Evidence:
    """The same inequality, solved for the drift."""
    return reals(goal)


@claim(
    "6.2/critical-roots", "At the critical value the denominator has the roots τ* and τ′",
    eq(denominator(critical_power), gammas(critical_power)[2] * (tau - tau_star) * (tau - tau_other)),
    given=admitted, labels=["critical-V_0"], uses=[critical_positive],
)  # fmt: skip
def critical_roots(goal: Goal) -> Evidence:
    """With (1 + (τ* − t₀)/T)(1 + (τ′ − t₀)/T) = 2c₂²‖E‖/(k c₁²): the two roots lie on both sides of the instant at
    which the drift's term and the feedback's are equal."""
    return exact(goal)


early = le(ratio**2, turning)


@claim(
    "6.2/critical-first-root", "If τ* is early the bound is finite until τ*, and the other root is not earlier",
    every(gt(denominator(critical_power), 0), ge(tau_other, tau_star)),
    given=[*admitted, early, after, lt(tau, tau_star)], labels=["critical-V_0"],
    uses=[critical_positive, critical_roots],
)  # fmt: skip
def first_root(goal: Goal) -> Evidence:
    """Early: (1 + (τ* − t₀)/T)² ≤ 2c₂²‖E‖/(k c₁²), while the drift's term is the larger one. Then τ* is the instant at
    which the bound escapes."""
    return reals(goal)


@claim(
    "6.2/critical-second-root", "If τ* is late the bound has escaped before, at the other root",
    every(gt(tau_other, t0), lt(tau_other, tau_star), eq(denominator(critical_power, tau_other), 0)),
    given=[*admitted, gt(ratio**2, turning)], labels=["critical-V_0"], uses=[critical_positive, critical_roots],
)  # fmt: skip
def second_root(goal: Goal) -> Evidence:
    """Then the denominator is zero at τ* as the text says, but for the second time: between the roots it is negative,
    and the printed right-hand side is no bound there."""
    return reals(goal, *specialise(goal, critical_roots, {tau: tau_other}))


@claim(
    "6.2/critical-before-second-root", "Until the other root the denominator is positive, and then negative up to τ*",
    every(gt((tau_other - tau) * denominator(critical_power), 0)),
    given=[*admitted, gt(ratio**2, turning), after, lt(tau, tau_star), Relation(tau, "!=", tau_other)],
    labels=["critical-V_0"], uses=[critical_positive, critical_roots],
)  # fmt: skip
def between_roots(goal: Goal) -> Evidence:
    """Its sign is that of τ′ − τ."""
    return reals(goal)


@claim(
    "6.2/critical-before-both-roots", "Before both roots the denominator is positive",
    gt(denominator(W), 0), given=[eq(W, critical_power), *admitted, after, lt(tau, tau_star), lt(tau, tau_other)],
    labels=["critical-V_0"], uses=[critical_positive, critical_roots],
)  # fmt: skip
def before_both(goal: Goal) -> Evidence:
    """A parabola that opens upwards, left of its roots; W is V(x₀)^σ."""
    return reals(goal)


# V(x₀)^σ is the critical value of eq. (critical-V₀), solved for the drift.
drift_of_start = ratio / (sigma_printed * (tau_star - t0) * V0**sigma_printed) + k * C1**2 / 2 * ratio
critical_start = eq(E_norm, drift_of_start / C2**2)
# A drift across the ray on which the vehicle moves: F = −‖x‖⁴ and E = diag(0, −‖E‖), so that X' = −2kX³ on the ray.
across = MOVING | {
    k: 1, E[0, 0]: 0, E_norm: sp.Rational(5, 4), E[1, 1]: sp.Rational(-5, 4), tau_star: 1, tau: sp.Rational(1, 8),
    X1(s): 1 / sp.sqrt(1 + 4 * s), f[0]: 0, f[1]: 5 * (x1**2 + x2**2) * x2,
}  # fmt: skip


@claim(
    "6.2/bound-violated", "Before τ*, a critical start violates the bound along every solution",
    gt(V_along, remark(V0)),
    given=[
        gt(tau, t0), lt(tau, tau_star), *trajectory, eq(V0, V_along.subs(tau, t0)), *admitted, critical_start,
        positive(denominator_from(V0)),
    ],
    labels=["eq:remark_inequality"], expected="refuted", uses=[critical_value], grade="wording",
    wrong="An upper bound whose right-hand side becomes infinite is said to be violated; it holds until then, and says "
    "nothing afterwards.",
    survives="Yes: that no finite bound is left is what the remark needs, and for k < 2‖E‖ some averages do escape.",
)  # fmt: skip
def bound_violated(goal: Goal) -> Evidence:
    """Where the right-hand side escapes, the inequality is not violated: it is void. The witness is a trajectory for
    κ = 2 that moves across the drift, from a start that is critical for τ* = 1."""
    return refute(goal, across)


@claim(
    "6.2/bound-holds-until-it-escapes",
    "From a critical start the bound holds along every solution until the first root",
    le(V_along, remark(V0)),
    given=[lt(tau, tau_star), lt(tau, tau_other), *trajectory, *admitted, critical_start],
    labels=["eq:remark_inequality"], corrects=bound_violated,
    uses=[remark_inequality, before_both], example=across,
)  # fmt: skip
def bound_until_escape(goal: Goal) -> Evidence:
    """Between the start and the first root the denominator is positive. From the first root on nothing is said: the
    bound is infinite at the root, and what is printed is not a bound behind it."""

    def along(there: Goal, point: sp.Expr) -> list[Fact]:
        return specialise(there, before_both, {W: V0**sigma_printed, tau: point})

    return reals(goal, *specialise(goal, remark_inequality, {}, along=along))


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
