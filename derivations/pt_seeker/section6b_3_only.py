"""Section 6.2: which gain a guarantee needs, for the asymptotic seeker and for κ ≥ 2. The text says "only" twice."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, ForAll, Goal, claim, ge, gt, instances, le, lt, reals, refute

from .notation import E_norm, a1, a2, b1, b2, k
from .section6a_asymptotic import condition
from .section6b_1_comparison import C1, C2

SECTION = "6.2 Discussion: which gain is needed"

# The gradient and the drift at one instant, and the factor 1/(1 + (τ − t₀)/T)² of the drift, between 0 and 1.
g = sp.symbols("g1 g2", real=True)
f_now = sp.symbols("f1_x f2_x", real=True)
rho = sp.Symbol("rho", positive=True)
square, drift_square = g[0] ** 2 + g[1] ** 2, f_now[0] ** 2 + f_now[1] ** 2
dominated = le(drift_square, E_norm**2 * square)  # ‖f‖ ≤ ‖E‖‖∇F‖, which is all that the norm of E says


def rate(factor: sp.Expr) -> sp.Expr:
    """dV/dτ on the average as in eq:Lyapunov_derivative, with the drift's factor as a letter."""
    return -factor * (g[0] * f_now[0] + g[1] * f_now[1]) - k / 2 * square


@claim(
    "6.2/rate-by-norm",
    "The rate of V is at most −(k/2 − ρ‖E‖)‖∇F‖² on the average",
    le(rate(rho), -(k / 2 - rho * E_norm) * square),
    given=[dominated], place="Section 6.2",
)  # fmt: skip
def rate_by_norm(goal: Goal) -> Evidence:
    """The drift and the gradient are compared as a whole: neither c₁ nor c₂ enters. Here ρ is the factor of the
    drift."""
    return reals(goal)


# --- Line 693: the asymptotic seeker ----------------------------------------------------------------------------------

always_falls = ForAll((*g, *f_now), lt(rate(sp.S.One), 0), (gt(square, 0), dominated))


@claim(
    "6.2/convergence-only-printed",
    "V is guaranteed to fall for the average of the asymptotic seeker only under the printed condition",
    condition, given=[always_falls], labels=["eq:convergence_cond"], expected="refuted",
    grade="error",
    wrong="The condition is enough and not needed: V of the average falls for every drift of that norm as soon as "
          "k > 2‖E‖, a threshold that is smaller by the factor (c₁/c₂)².",
    survives="Yes: the theorem is not concerned, and the smaller threshold is not known to the vehicle either.",
)  # fmt: skip
def convergence_only_printed(goal: Goal) -> Evidence:
    """The witness has the constants of F = −x₁² − 2x₂², a drift of norm 1 and the gain 3: V falls for every gradient
    and every drift that the norm allows, and the printed condition asks for k > 16."""
    return refute(goal, {a1: 2, a2: 1, b1: 2, b2: 4, E_norm: 1, k: 3})


@claim(
    "6.2/convergence-only", "V is guaranteed to fall for that average only if k > 2‖E‖",
    gt(k, 2 * E_norm), given=[always_falls], labels=["eq:convergence_cond"], corrects=convergence_only_printed,
)  # fmt: skip
def convergence_only(goal: Goal) -> Evidence:
    """The drift may point straight down the gradient, f = −‖E‖∇F."""
    return reals(goal, *instances(goal, (1, 0, -E_norm, 0)))


@claim(
    "6.2/convergence-if", "If k > 2‖E‖, V of the average falls wherever the gradient is not zero",
    lt(rate(sp.S.One), 0), given=[gt(k, 2 * E_norm), gt(square, 0), dominated], labels=["eq:convergence_cond"],
    uses=[rate_by_norm],
)  # fmt: skip
def convergence_if(goal: Goal) -> Evidence:
    """So k > 2‖E‖ is the exact condition over all drifts of that norm, and for every κ."""
    return reals(goal)


# --- Line 708: the prescribed-time seeker for κ ≥ 2 -------------------------------------------------------------------

never_grows = ForAll((*g, *f_now, rho), le(rate(rho), 0), (dominated, le(rho, 1)))


@claim(
    "6.2/provable-only-printed",
    "For κ ≥ 2 the average of the prescribed-time seeker keeps V from growing only under the printed condition",
    gt(k, 2 * C2**2 / C1**2 * E_norm), given=[never_grows, le(C1, C2)], place="Section 6.2", expected="refuted",
    grade="error",
    wrong="The condition is enough and not needed: for every κ the average converges as soon as k ≥ 2‖E‖, whatever c₁ "
          "and c₂ are.",
    survives="Yes: the theorem speaks of κ = 1; it even extends to every κ ≥ 2 for k ≥ 2‖E‖.",
)  # fmt: skip
def provable_only_printed(goal: Goal) -> Evidence:
    """With c₂ = 2c₁ and a drift of norm 1 the gain 2 keeps V from growing at all times, and the text asks for k > 8."""
    return refute(goal, {C1: 1, C2: 2, E_norm: 1, k: 2})


@claim(
    "6.2/provable-only", "It keeps V from growing only if k ≥ 2‖E‖",
    ge(k, 2 * E_norm), given=[never_grows], place="Section 6.2", corrects=provable_only_printed,
)  # fmt: skip
def provable_only(goal: Goal) -> Evidence:
    """At the start the drift has its full size. That the trajectory does escape where the gain is smaller is shown
    for one field and one drift of every norm, in the part beyond the paper."""
    return reals(goal, *instances(goal, (1, 0, -E_norm, 0, 1)))


@claim(
    "6.2/provable-if", "If k ≥ 2‖E‖, V of the average never grows",
    le(rate(rho), 0), given=[ge(k, 2 * E_norm), dominated, le(rho, 1)], place="Section 6.2",
    uses=[rate_by_norm],
)  # fmt: skip
def provable_if(goal: Goal) -> Evidence:
    """Equality is enough: the drift is at its strongest at the start only."""
    return reals(goal)
