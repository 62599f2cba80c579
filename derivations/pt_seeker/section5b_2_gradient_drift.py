"""Section 5, Theorem 2, Step 4: gradient drift."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Assumption,
    Evidence,
    Fact,
    Goal,
    Relation,
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
    lt,
    reals,
    specialise,
)

from .notation import (
    E_norm,
    T,
    a1,
    a2,
    c,
    k,
    kappa,
    t0,
    tau,
    x1,
    x2,
)  # fmt: skip
from .section5a_1_reduction import stretch
from .section5b_0_trajectory import (
    EXAMPLE,
    R_0,
    X1,
    X2,
    V_along,
    V_of_x,
    V_rate,
    assumption_2,
    at,
    distance,
    later,
    s,
    solves,
    start,
    v_bounds,
)
from .section5b_0_trajectory import v_nonnegative as nonnegative
from .section5b_0_with_drift import gradient_drift_given, gradient_drift_inequality, norm_of_E
from .section5b_1_lyapunov import ONE, W, W_nonnegative, along_X, at_order, on_interval

SECTION = "5.2 Theorem, Steps 4 to 6: stability"

# --- Case ii: gradient drift, κ = 1 -------------------------------------------------------------------------

B1, B2 = c(1, ONE), c(2, ONE)
drift_rate = B2**2 * E_norm
decay_rate = k * B1**2 / 2
case_two: list[Assumption] = [*at_order(assumption_2, ONE), *gradient_drift_given, norm_of_E]


@claim(
    "5/step4-gradient-drift", "With gradient drift and κ = 1 the inequality along a solution is linear in V",
    le(V_rate, at(drift_rate * V_of_x / stretch**2 - decay_rate * V_of_x, tau)),
    given=[*solves(tau), *later, *case_two],
    labels=["eq:lyapunov_derivative_inequality_kappa_1"], uses=[gradient_drift_inequality], example=EXAMPLE,
)  # fmt: skip
def gradient_drift(goal: Goal) -> Evidence:
    """2q₁ = 1, and ‖E∇F‖ ≤ ‖E‖‖∇F‖ is bounded by c₂‖E‖ times the root of V."""
    return reals(goal, *specialise(goal, gradient_drift_inequality, {kappa: ONE}))


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


begun = 1 + (start - t0) / T
passed = (s - start) / begun / (1 + (s - t0) / T)  # the original time that passes from τ₀ to s
exponent = drift_rate * passed - decay_rate * (s - start)
growth, decay = sp.exp(drift_rate * T), sp.exp(-decay_rate * (tau - start))


@claim(
    "5/step4-uniform", "From every start the drift contributes at most the same factor",
    every(
        eq(sp.diff(passed, s), 1 / (1 + (s - t0) / T) ** 2), le(drift_rate * passed.subs(s, tau), drift_rate * T),
    ),
    given=[ge(start, t0), ge(tau, start), ge(s, t0)], place="Step 4, case ii",
)  # fmt: skip
def uniform(goal: Goal) -> Evidence:
    """What the drift's factor adds up to from τ₀ to τ is the original time that passes, times c₂²‖E‖: at most T."""
    return reals(goal)


@claim(
    "5/step4-linear-comparison", "What changes as V does with gradient drift decreases exponentially up to a factor",
    le(W(tau), W(start) * growth * decay),
    given=[
        on_interval((drift_rate / (1 + (s - t0) / T) ** 2 - decay_rate) * W(s), W(s)), W_nonnegative,
        ge(start, t0), ge(tau, start),
    ],
    place="Step 4, case ii", uses=[drift_integral, uniform],
)  # fmt: skip
def linear_comparison(goal: Goal) -> Evidence:
    """The linear comparison equation is solved from any initial time τ₀ ≥ t₀ and its solution checked; the integral of
    the drift's factor from τ₀ to τ is then replaced by its integral over all times."""
    bounded = exp_monotone(exponent.subs(s, tau), drift_rate * T - decay_rate * (tau - start))
    return comparison(goal, W(start) * sp.exp(exponent), denominators=[1 + (s - t0) / T], lemmas=[bounded])


def bounded(since: sp.Expr) -> Relation:
    """eq:Lyapunov_inequality_upper_bound as printed, from the initial time ``since``."""
    decay = sp.exp(-k * c(1, ONE) ** 2 / 2 * (tau - since))
    return le(V_along, V_along.subs(tau, since) * sp.exp(c(2, ONE) ** 2 * E_norm * T) * decay)


@claim(
    "5/step4-exponential-bound", "V decreases exponentially along every solution up to a factor, from every start",
    bounded(start), given=[*solves(tau), *later, *case_two],
    labels=["eq:Lyapunov_inequality_upper_bound"], uses=[gradient_drift, linear_comparison, nonnegative],
    example=EXAMPLE,
)  # fmt: skip
def exponential_bound(goal: Goal) -> Evidence:
    """V along the solution is put into the comparison, with V ≥ 0 by Assumption 2. The printed bound is the one from
    τ₀ = t₀."""

    def along(there: Goal, point: sp.Expr) -> list[Fact]:
        return [
            *specialise(there, gradient_drift, {tau: point}),
            *specialise(there, nonnegative, {kappa: ONE, x1: X1(point), x2: X2(point)}),
        ]  # fmt: skip

    return reals(goal, *specialise(goal, linear_comparison, {W(s): along_X}, along=along))


R_start = sp.Symbol("R_start", nonnegative=True)
V_start, V_end = sp.symbols("V_start V_end", nonnegative=True)


def printed_bound(value: sp.Expr, since: sp.Expr) -> sp.Expr:
    """The right-hand side of eq:x_bar_upper_bound as printed, from a distance at the time ``since``."""
    return (
        sp.sqrt(a1 / a2) * value * sp.exp(c(2, ONE) ** 2 / 2 * E_norm * T)
        * sp.exp(-k * c(1, ONE) ** 2 / 4 * (tau - since))
    )  # fmt: skip


@claim(
    "5/step4-distance-by-v", "From the bound of V to a bound of the distance, for κ = 1",
    le(R_0, printed_bound(R_start, start)),
    given=[le(a2 * R_0**2, V_end), le(V_start, a1 * R_start**2), le(V_end, V_start * growth * decay)],
    place="Step 4, case ii",
)  # fmt: skip
def distance_by_v(goal: Goal) -> Evidence:
    """V is bounded by the squared distance from below at τ and from above at the start; then the root is taken, which
    halves both exponents: half of c₂²‖E‖T, and a quarter of k c₁²."""
    return reals(goal)


def distance_at(time: sp.Expr) -> sp.Expr:
    """‖X − x*‖ at an instant."""
    return at(distance, time)


@claim(
    "5/step4-distance-bound", "The distance decreases exponentially along every solution up to a factor",
    le(distance_at(tau), printed_bound(distance_at(start), start)), given=[*solves(tau), *later, *case_two],
    labels=["eq:x_bar_upper_bound"], uses=[exponential_bound, v_bounds, distance_by_v, nonnegative], example=EXAMPLE,
)  # fmt: skip
def distance_bound_tau(goal: Goal) -> Evidence:
    """From every initial time τ₀ ≥ t₀ and every initial position: the bound is uniform in the initial time of the
    averaged system, which depends on τ. The printed one is that from τ₀ = t₀."""
    ends = [(tau, {x1: X1(tau), x2: X2(tau)}), (start, {x1: X1(start), x2: X2(start)})]
    said = [
        fact for _, place in ends for claimed in (v_bounds, nonnegative)
        for fact in specialise(goal, claimed, {kappa: ONE, **place})
    ]  # fmt: skip
    values = {
        R_0: distance_at(tau), R_start: distance_at(start), V_end: V_along, V_start: V_along.subs(tau, start),
    }  # fmt: skip
    return reals(goal, *said, *specialise(goal, exponential_bound, {}), *specialise(goal, distance_by_v, values, said))


r_1, r_2 = sp.symbols("r_1 r_2", positive=True)
any_distance = sp.Symbol("r", real=True)
after_start = sp.Symbol("varsigma", nonnegative=True)


def class_kl(value: sp.Expr) -> sp.Expr:
    """The printed bound as a function of the initial distance and of the time since the start."""
    return printed_bound(value, start).subs(tau, start + after_start)


@claim(
    "5/step4-distance-limit", "The bound tends to 0 with time, and with the initial distance",
    every(
        eq(sp.Limit(printed_bound(R_start, start), tau, sp.oo, "-"), 0),
        eq(sp.Limit(class_kl(any_distance), any_distance, 0, "+"), 0),
    ),
    place="Step 4, case ii", uses=[distance_bound_tau],
)  # fmt: skip
def distance_limit(goal: Goal) -> Evidence:
    """However large the drift is."""
    return limits(goal)


@claim(
    "5/step4-guas",
    "Case ii: the bound is of class KL and the same for all initial times, so the averaged source is GUAS",
    every(
        lt(0, class_kl(r_1)), lt(class_kl(r_1), class_kl(r_2)), lt(sp.diff(class_kl(r_1), after_start), 0),
    ),
    given=[lt(r_1, r_2)], place="Step 4, case ii", uses=[distance_bound_tau, distance_limit],
)  # fmt: skip
def guas(goal: Goal) -> Evidence:
    """It tends to 0 at the source, increases with the distance, and decreases with the time since the start to the
    limit 0; neither τ₀ nor t₀ stands in it. With the bound for every solution from every start that is global uniform
    asymptotic stability, and no theorem on Lyapunov functions is needed."""
    return reals(goal)
