"""Section 5, Theorem 2, Step 4: the Lyapunov function, and stability without drift."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    ForAll,
    Goal,
    Prose,
    cited,
    claim,
    comparison,
    definition,
    eq,
    every,
    exact,
    ge,
    le,
    lt,
    power_monotone,
    power_positive,
    reals,
)

from .notation import (
    F,
    F_source,
    G,
    R,
    V,
    a1,
    a2,
    b1,
    b2,
    c,
    f_norm,
    k,
    kappa,
    q,
    t0,
    tau,
    x1,
    x2,
)  # fmt: skip
from .section5a_1_reduction import stretch

SECTION = "5.2 Theorem, Steps 4 to 6: stability"
ONE = sp.S.One

lyapunov_function = definition(
    "5/step4-lyapunov-function", "V = F(x*) − F(x̄)", eq(sp.Function("V")(x1, x2), -(F - F_source)),
    labels=["eq:Lyapunov_function"], prose="How much the field at the averaged vehicle is below its maximum.",
)  # fmt: skip

# From here on one symbol stands for each norm and for V at one instant. R is the distance ‖x̄ − x*‖.
F_value = sp.Symbol("F_x", real=True)


@claim(
    "5/step4-v-bounds-by-letters", "V between even powers of the distance",
    every(le(a2 * R ** (2 * kappa), V), le(V, a1 * R ** (2 * kappa))),
    given=[
        eq(V, -(F_value - F_source)),
        le(F_source - a1 * R ** (2 * kappa), F_value), le(F_value, F_source - a2 * R ** (2 * kappa)),
    ],
    place="Step 4",
)  # fmt: skip
def v_bounds(goal: Goal) -> Evidence:
    """Assumption 2, with F(x̄) moved to the other side."""
    return reals(goal)


between = (le(a2 * R ** (2 * kappa), V), le(V, a1 * R ** (2 * kappa)))
gradient_between = (le(b1 * R ** (2 * kappa - 1), G), le(G, b2 * R ** (2 * kappa - 1)))


@claim(
    "5/step4-gradient-bounds", "‖∇F‖ between powers of V",
    every(le(c(1) * V ** q(), G), le(G, c(2) * V ** q())),
    given=[*between, *gradient_between], labels=["eq:ass4"], uses=[v_bounds],
)  # fmt: skip
def gradient_bounds(goal: Goal) -> Evidence:
    """The distance is eliminated: V/a₁ ≤ ‖x̄ − x*‖^(2κ) ≤ V/a₂, raised to the power q, is a bound for
    ‖x̄ − x*‖^(2κ − 1)."""
    distance = R ** (2 * kappa)
    return reals(goal, power_monotone(V / a1, distance, q()), power_monotone(distance, V / a2, q()))


@claim(
    "5/step4-exponent-range", "1/2 ≤ q_κ < 1", every(le(sp.Rational(1, 2), q()), lt(q(), 1)), place="Step 4",
)  # fmt: skip
def exponent_range(goal: Goal) -> Evidence:
    """For every integer κ ≥ 1; equality at κ = 1."""
    return reals(goal)


V_dot = sp.Symbol("V_dot", real=True)
derivative_given = le(V_dot, f_norm * G / stretch**2 - k / 2 * G**2)
after = ge(tau, t0)


def v_inequality(order: sp.Expr) -> sp.Expr:
    """The right-hand side of eq:lyapunov_derivative_inequality_2 as printed, for a given κ."""
    return c(2, order) / stretch**2 * f_norm * V ** q(order) - k * c(1, order) ** 2 / 2 * V ** (2 * q(order))


@claim(
    "5/step4-v-inequality-by-letters", "A differential inequality for V alone",
    le(V_dot, v_inequality(kappa)), given=[after, derivative_given, *between, *gradient_between],
    place="Step 4", uses=[gradient_bounds],
)  # fmt: skip
def v_differential_inequality(goal: Goal) -> Evidence:
    """The gradient's norm is bounded above where it multiplies the drift, and below where it is squared."""
    return reals(goal, power_positive(V, q()))


# --- Case i: no drift ---------------------------------------------------------------------------------------


@claim(
    "5/step4-driftless", "Without drift V decreases",
    le(V_dot, -k * c(1) ** 2 / 2 * V ** (2 * q())),
    given=[after, derivative_given, eq(f_norm, 0), *between, *gradient_between],
    labels=["eq:lyapunov_derivative_inequality_kappa_2"], uses=[v_differential_inequality],
)  # fmt: skip
def driftless(goal: Goal) -> Evidence:
    """‖f‖ = 0 in the inequality for V."""
    return reals(goal)


@claim(
    "5/step4-driftless-definite", "Without drift the rate of V is negative away from the source",
    lt(-k * c(1) ** 2 / 2 * V ** (2 * q()), 0), place="Step 4, case i", uses=[driftless],
)  # fmt: skip
def driftless_definite(goal: Goal) -> Evidence:
    """k c₁² > 0 and V > 0."""
    return reals(goal)


# Along a trajectory: not negative; positive as long as the source is not reached, where there is nothing to show.
V_t = sp.Function("V", nonnegative=True)
V_away = sp.Function("V", positive=True)
s = sp.Symbol("s", real=True)


def on_interval(rate: sp.Expr, value: sp.Expr) -> ForAll:
    """d(value)/ds ≤ rate on [t₀, τ]."""
    return ForAll((s,), le(sp.Derivative(value, s), rate), (ge(s, t0), le(s, tau)))


# κ = n + 1 with n = 1, 2, …: the exponents below are then known to be positive.
n = sp.Symbol("n", positive=True, integer=True)
driftless_rate = -k * c(1, n + 1) ** 2 / 2
sigma = n / (n + 1)  # 2q − 1


@claim(
    "5/step4-sigma", "2q_κ − 1 = (κ − 1)/κ", eq(2 * q() - 1, (kappa - 1) / kappa), place="Step 4, case i",
)  # fmt: skip
def sigma_form(goal: Goal) -> Evidence:
    """The exponent of the comparison equation beyond 1; it is n/(n + 1) for κ = n + 1."""
    return exact(goal)


@claim(
    "5/step4-driftless-bound", "Without drift V has an explicit class-KL bound for κ = n + 1 ≥ 2",
    le(V_away(tau), V_away(t0) * (1 - sigma * V_away(t0) ** sigma * driftless_rate * (tau - t0)) ** (-1 / sigma)),
    given=[on_interval(driftless_rate * V_away(s) ** (1 + sigma), V_away(s)), after],
    place="Step 4, case i", uses=[driftless, sigma_form],
)  # fmt: skip
def driftless_bound(goal: Goal) -> Evidence:
    """The comparison equation is of Bernoulli's type. It says more than asymptotic stability: the rate at which V
    decreases, uniform in the initial time. κ = 1 is the exponential case of the next part with E = 0."""
    base = 1 - sigma * V_away(t0) ** sigma * driftless_rate * (s - t0)
    return comparison(goal, V_away(t0) * base ** (-1 / sigma), denominators=[base])


lyapunov_theorem = claim(
    "5/step4-lyapunov-theorem", "Without drift the source is globally uniformly asymptotically stable for the average",
    Prose("A radially unbounded V with class-K∞ bounds and a negative definite rate makes x* globally uniformly "
          "asymptotically stable for the averaged system in τ"),
    expected="cited", place="Step 4, case i", uses=[v_bounds, driftless, driftless_definite],
)(cited("Khalil, Nonlinear Systems, Theorem 4.9"))  # fmt: skip
