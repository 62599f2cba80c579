"""Section 6.2 for κ ≥ 2: the bound by the comparison principle, and its denominator.

κ = n + 1 with n = 1, 2, … (n as in Step 4), so that σ = 2q − 1 = n/(n + 1) is known to be positive.
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
    ge,
    gt,
    le,
    limits,
    power_monotone,
    power_positive,
    reals,
    specialise,
)

from .notation import IN_TAU, V0, E_norm, G, T, V, c, f_norm, k, kappa, q, t0, tau
from .section5a_1_reduction import stretch
from .section5b_1_lyapunov import V_away, gradient_bounds, n, sigma, sigma_form, v_differential_inequality, v_inequality

SECTION = "6.2 Discussion: vanishing drift and κ ≥ 2"

order = n + 1
q_printed = q(order)
# The constants c₁ and c₂ of κ as letters, as the paper prints them here: the claims hold for all positive values.
C1, C2 = sp.symbols("c_kappa1 c_kappa2", positive=True)
drift, feed = C2**2 * E_norm, k * C1**2 / 2
V_dot = sp.Symbol("V_dot", real=True)
s = sp.Symbol("s", real=True)
after = ge(tau, t0)


@claim(
    "6.2/drift-by-v", "The drift is bounded by a power of V", le(f_norm, c(2) * E_norm * V ** q()),
    given=[le(f_norm, E_norm * G), le(c(1) * V ** q(), G), le(G, c(2) * V ** q())],
    place="Section 6.2", uses=[gradient_bounds],
)  # fmt: skip
def drift_by_v(goal: Goal) -> Evidence:
    """‖E∇F‖ ≤ ‖E‖‖∇F‖, and the gradient's upper bound."""
    return reals(goal)


@claim(
    "6.2/v-inequality", "The inequality for V under gradient drift, any κ",
    le(V_dot, (c(2) ** 2 * E_norm / stretch**2 - k * c(1) ** 2 / 2) * V ** (2 * q())),
    given=[after, le(V_dot, v_inequality(kappa)), le(f_norm, c(2) * E_norm * V ** q())],
    place="Section 6.2", uses=[drift_by_v, v_differential_inequality],
)  # fmt: skip
def v_drift_inequality(goal: Goal) -> Evidence:
    """Both terms carry the same power V^(2q). For κ ≥ 2 it is more than 1, so the drift may win if V is large."""
    return reals(goal, power_positive(V, q()))


# --- The comparison principle -----------------------------------------------------------------------------------------


def rate_at(time: sp.Expr) -> sp.Expr:
    """The factor of V^(2q)."""
    return drift / (1 + (time - t0) / T) ** 2 - feed


Y = sp.Function("Y", real=True)
elapsed = tau - t0
work = drift * T * elapsed / (T + elapsed) - feed * elapsed  # the integral of the factor
bernoulli = ForAll((s,), le(sp.Derivative(V_away(s), s), rate_at(s) * V_away(s) ** (2 * q_printed)),
                   (ge(s, t0), le(s, tau)))  # fmt: skip


@claim(
    "6.2/bernoulli", "−V^(−σ) satisfies an inequality without V",
    le(sp.Derivative(-(V_away(s) ** -sigma), s), sigma * rate_at(s)),
    given=[le(sp.Derivative(V_away(s), s), rate_at(s) * V_away(s) ** (2 * q_printed)), ge(s, t0)],
    place="Section 6.2", uses=[v_drift_inequality, sigma_form],
)  # fmt: skip
def bernoulli_substitution(goal: Goal) -> Evidence:
    """Bernoulli's substitution: the derivative brings the factor σV^(−σ−1), and σ + 1 = 2q."""
    return reals(goal)


@claim(
    "6.2/bernoulli-integrated", "The inequality without V, integrated",
    le(Y(tau), Y(t0) + sigma * work),
    given=[after, ForAll((s,), le(sp.Derivative(Y(s), s), sigma * rate_at(s)), (ge(s, t0), le(s, tau)))],
    place="Section 6.2", uses=[bernoulli_substitution],
)  # fmt: skip
def bernoulli_integrated(goal: Goal) -> Evidence:
    """The comparison principle, with a rate that depends on time only."""
    solution = Y(t0) + sigma * work.subs(tau, s)
    return comparison(goal, solution, denominators=[1 + (s - t0) / T, T + s - t0])


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


@claim(
    "6.2/remark-inequality", "The bound for κ ≥ 2, as long as its denominator is positive",
    le(V_away(tau), remark(V_away(t0))),
    given=[after, bernoulli, gt(denominator(V_away(t0) ** (2 * q_printed - 1)), 0)],
    labels=["eq:remark_inequality"], uses=[bernoulli_integrated, denominator_form],
)  # fmt: skip
def remark_inequality(goal: Goal) -> Evidence:
    """The printed bound, with the domain that it needs: V exists up to τ and the denominator is positive at τ. Where
    it is zero or negative the right-hand side says nothing."""
    first, last = V_away(t0) ** sigma, V_away(tau) ** sigma
    bound = first * (elapsed + T) / denominator(V_away(t0) ** (2 * q_printed - 1))
    return reals(
        goal, *specialise(goal, bernoulli_integrated, {Y(s): -(V_away(s) ** -sigma)}),
        power_monotone(last, bound, 1 / sigma),
    )  # fmt: skip


@claim(
    "6.2/bound-attained", "The bound solves the comparison equation",
    eq(sp.Derivative(-denominator(W) / (W * (T + elapsed)), tau), sigma * rate_at(tau)),
    given=IN_TAU, place="Section 6.2", uses=[remark_inequality],
)  # fmt: skip
def bound_attained(goal: Goal) -> Evidence:
    """V to the power −σ is the denominator over V(x₀)^σ(T + τ − t₀) where V equals the bound, and that satisfies the
    integrated inequality with equality: the inequality for V alone allows no better bound."""
    return exact(goal)


numerator, small = sp.symbols("numerator small", positive=True)


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
