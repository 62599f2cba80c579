"""Section 5, Theorem 2, Step 4: gradient drift."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    Goal,
    Prose,
    cited,
    claim,
    comparison,
    eq,
    every,
    exp_monotone,
    ge,
    gt,
    integrals,
    le,
    limits,
    reals,
    specialise,
)

from .notation import (
    R0,
    V0,
    E_norm,
    G,
    R,
    T,
    V,
    a1,
    a2,
    c,
    f_norm,
    k,
    kappa,
    t0,
    tau,
    x1,
)  # fmt: skip
from .section3_problem import spectral_norm
from .section5a_1_reduction import stretch
from .section5b_1_lyapunov import (
    ONE,
    V_dot,
    V_t,
    after,
    between,
    derivative_given,
    gradient_between,
    gradient_bounds,
    on_interval,
    s,
    v_bounds,
    v_differential_inequality,
)

SECTION = "5.2 Theorem, Steps 4 to 6: stability"

# --- Case ii: gradient drift, κ = 1 -------------------------------------------------------------------------

B1, B2 = c(1, ONE), c(2, ONE)
between_1 = tuple(relation.map(lambda e: e.subs(kappa, 1)) for relation in (*between, *gradient_between))
case_two = le(V_dot, B2**2 * E_norm * V / stretch**2 - k * B1**2 / 2 * V)


@claim(
    "5/step4-gradient-drift", "With gradient drift and κ = 1 the inequality is linear in V", case_two,
    given=[after, derivative_given, le(f_norm, E_norm * G), *between_1],
    labels=["eq:lyapunov_derivative_inequality_kappa_1"],
    uses=[spectral_norm, v_differential_inequality, gradient_bounds],
)  # fmt: skip
def gradient_drift(goal: Goal) -> Evidence:
    """2q₁ = 1, and ‖E∇F‖ ≤ ‖E‖‖∇F‖ is bounded by c₂‖E‖ times the root of V."""
    return reals(
        goal,
        *specialise(goal, v_differential_inequality, {kappa: ONE}),
        *specialise(goal, gradient_bounds, {kappa: ONE}),
    )


drift_rate = B2**2 * E_norm
decay_rate = k * B1**2 / 2
elapsed = tau - t0


@claim(
    "5/step4-integral-of-the-drift", "The drift's factor has the integral ‖l₁‖₁ = c₂²‖E‖T",
    eq(sp.Integral(drift_rate / (1 + x1 / T) ** 2, (x1, 0, sp.oo)), drift_rate * T), place="Step 4, case ii",
)  # fmt: skip
def drift_integral(goal: Goal) -> Evidence:
    """In the variable τ − t₀; this is why the growth by the drift is bounded however strong the drift is."""
    return integrals(goal)


lag = sp.Symbol("tau_hat", nonnegative=True)  # τ − t₀


@claim(
    "5/step4-lemma-hypotheses", "What the cited comparison lemma asks of its data",
    every(ge(drift_rate / (1 + lag / T) ** 2, 0), gt(decay_rate, 0)), place="Step 4, case ii",
)  # fmt: skip
def lemma_hypotheses(goal: Goal) -> Evidence:
    """c = k c₁²/2 > 0, l₁ ≥ 0 and l₂ = 0; that l₁ is integrable is the claim before. The bound itself is proved below
    without the lemma."""
    return reals(goal)


exponent = drift_rate * (s - t0) / (1 + (s - t0) / T) - decay_rate * (s - t0)


@claim(
    "5/step4-exponential-bound", "V decreases exponentially in τ up to a factor",
    le(V_t(tau), V_t(t0) * sp.exp(drift_rate * T) * sp.exp(-decay_rate * elapsed)),
    given=[on_interval(drift_rate / (1 + (s - t0) / T) ** 2 * V_t(s) - decay_rate * V_t(s), V_t(s)), after],
    labels=["eq:Lyapunov_inequality_upper_bound"], uses=[gradient_drift, drift_integral],
)  # fmt: skip
def exponential_bound(goal: Goal) -> Evidence:
    """The linear comparison equation is solved and its solution checked; the integral of the drift's factor up to τ is
    then replaced by its limit."""
    bounded = exp_monotone(exponent.subs(s, tau), drift_rate * T - decay_rate * elapsed)
    return comparison(goal, V_t(t0) * sp.exp(exponent), denominators=[1 + (s - t0) / T], lemmas=[bounded])


growth, decay = sp.exp(drift_rate * T), sp.exp(-decay_rate * elapsed)
distance_bound = (  # as printed
    sp.sqrt(a1 / a2) * R0 * sp.exp(c(2, ONE) ** 2 / 2 * E_norm * T) * sp.exp(-k * c(1, ONE) ** 2 / 4 * (tau - t0))
)


@claim(
    "5/step4-distance-bound", "The distance decreases exponentially in τ up to a factor", le(R, distance_bound),
    given=[le(a2 * R**2, V), le(V0, a1 * R0**2), le(V, V0 * growth * decay)],
    labels=["eq:x_bar_upper_bound"], uses=[exponential_bound, v_bounds],
)  # fmt: skip
def distance_bound_tau(goal: Goal) -> Evidence:
    """V is bounded by the squared distance from below at τ and from above at t₀; then the root is taken,
    which halves both exponents: half of c₂²‖E‖T, and a quarter of k c₁²."""
    return reals(goal)


@claim(
    "5/step4-distance-limit", "The bound tends to 0", eq(sp.Limit(distance_bound, tau, sp.oo, "-"), 0),
    place="Step 4, case ii", uses=[distance_bound_tau],
)  # fmt: skip
def distance_limit(goal: Goal) -> Evidence:
    """However large the drift is."""
    return limits(goal)


start = sp.Symbol("tau_0", real=True)


@claim(
    "5/step4-uniform", "The bound is uniform in the time at which the averaged system is started",
    le(
        drift_rate * ((tau - t0) / (1 + (tau - t0) / T) - (start - t0) / (1 + (start - t0) / T)),
        drift_rate * T,
    ),
    given=[ge(start, t0), ge(tau, start)], place="Step 4, case ii", uses=[exponential_bound],
)  # fmt: skip
def uniform(goal: Goal) -> Evidence:
    """The averaged system depends on τ, so uniformity needs a word: from any later start the drift contributes at most
    the same factor."""
    return reals(goal)


guas = claim(
    "5/step4-guas", "With gradient drift and κ = 1 the source is globally uniformly asymptotically stable",
    Prose("x* is globally uniformly asymptotically stable for the averaged system in τ, by the class-KL bound"),
    expected="cited", place="Step 4, case ii", uses=[distance_bound_tau, distance_limit, uniform],
)(cited("Khalil, Nonlinear Systems, Lemma 4.5: a class-KL bound that is uniform in the initial time"))  # fmt: skip
