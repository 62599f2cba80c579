"""Section 6, 6.1 and 6.2 for κ = 1: the asymptotic seeker, its gain condition, and the bound in the original time."""

from __future__ import annotations

import sympy as sp

from ptproof.averaging import average, split_dithers
from ptproof.proof import (
    Evidence,
    ForAll,
    Goal,
    claim,
    comparison,
    eq,
    every,
    exp_monotone,
    ge,
    gt,
    le,
    limits,
    lt,
    reals,
    specialise,
)
from ptproof.transforms.reduction import split
from ptproof.transforms.states import change_variable, solve_state

from . import chain
from .notation import (
    IN_TIME,
    R0,
    E_norm,
    F,
    F_source,
    G,
    T,
    V,
    a1,
    a2,
    c,
    f,
    f_norm,
    k,
    kappa,
    mu,
    nu,
    omega,
    p,
    t,
    t0,
    tau,
    theta,
    z,
)  # fmt: skip
from .section5b_0_trajectory import EXAMPLE, solves
from .section5b_0_trajectory import start as first_time
from .section5b_1_lyapunov import between, gradient_between, gradient_bounds
from .section5b_2_gradient_drift import case_two, distance_at, distance_bound_tau

SECTION = "6.1 Discussion: the asymptotic seeker and κ = 1"

ONE = sp.S.One
C1, C2 = c(1, ONE), c(2, ONE)
printed_asymptotic = sp.Matrix([
    f[0] + sp.sqrt(omega) * sp.cos(theta),
    f[1] + sp.sqrt(omega) * sp.sin(theta),
    omega - k / mu * (F - z),
    (F - z) / mu,
])  # fmt: skip


@claim(
    "6/gain-limit", "The growing gain tends to 1 as T tends to infinity",
    eq(sp.Limit(1 / nu(t - t0) ** 2, T, sp.oo, "-"), 1), labels=["eq:exponential_seeker"],
)  # fmt: skip
def gain_limit(goal: Goal) -> Evidence:
    """At every fixed time t."""
    return limits(goal)


@claim(
    "6/asymptotic-seeker-is-the-limit", "The prescribed-time seeker becomes the asymptotic one as T tends to infinity",
    every(*(eq(sp.Limit(entry, T, sp.oo, "-"), printed)
            for entry, printed in zip(chain.closed_loop_t.rhs, printed_asymptotic, strict=True))),
    labels=["eq:exponential_seeker"], uses=[gain_limit],
)  # fmt: skip
def asymptotic_limit(goal: Goal) -> Evidence:
    """Every right-hand side of the closed loop in t, at fixed t and states."""
    return limits(goal)


@claim(
    "6/asymptotic-seeker", "The unicycle under the feedback with the constant gain 1 is that limit, too",
    every(*(eq(sp.Limit(entry, T, sp.oo, "-"), constant)
            for entry, constant in zip(chain.closed_loop_t.rhs, chain.asymptotic.rhs, strict=True))),
    labels=["eq:exponential_seeker"], uses=[gain_limit, asymptotic_limit],
)  # fmt: skip
def asymptotic_seeker(goal: Goal) -> Evidence:
    """So what is simulated and averaged as the asymptotic seeker is the printed one."""
    return limits(goal)


_reduced = solve_state(change_variable(chain.asymptotic, theta, p, theta + k * z, p - k * z), p, omega * t)
asymptotic_average = average(split_dithers(split(_reduced, [z], mu).reduced_model(), omega))


averaged_t_printed = [f[i] + k / (2 * nu(t - t0) ** 2) * chain.gradient_F[i] for i in (0, 1)]


@claim(
    "6.2/averaged-asymptotic", "The average of the asymptotic seeker is the limit of the printed average for T → ∞",
    every(*(eq(sp.Limit(entry, T, sp.oo, "-"), constant)
            for entry, constant in zip(averaged_t_printed, asymptotic_average.rhs, strict=True))),
    place="Section 6.2", uses=[asymptotic_seeker],
)  # fmt: skip
def averaged_asymptotic(goal: Goal) -> Evidence:
    """The same pipeline without a change of time, against eq:LBA_reduced_model_t at every fixed time. The drift keeps
    its full size for all times."""
    return limits(goal)


V_dot = sp.Symbol("V_dot", real=True)
between_1 = tuple(relation.map(lambda e: e.subs(kappa, 1)) for relation in (*between, *gradient_between))
gradient_norm = sp.sqrt(sum(entry**2 for entry in chain.gradient_F))
drift_norm = sp.sqrt(f[0] ** 2 + f[1] ** 2)


@claim(
    "6.2/asymptotic-derivative", "dV/dt for the asymptotic seeker on the average",
    le(asymptotic_average.derivative_along(-(F - F_source)), f_norm * G - k / 2 * G**2),
    given=[eq(f_norm, drift_norm), eq(G, gradient_norm)], place="Section 6.2", uses=[averaged_asymptotic],
)  # fmt: skip
def asymptotic_derivative(goal: Goal) -> Evidence:
    """As in Step 4, but nothing damps the drift."""
    return reals(goal)


coefficient = C2**2 * E_norm - k * C1**2 / 2


@claim(
    "6.2/asymptotic-inequality", "The linear inequality for the average of the asymptotic seeker",
    le(V_dot, coefficient * V),
    given=[le(V_dot, f_norm * G - k / 2 * G**2), le(f_norm, E_norm * G), *between_1],
    place="Section 6.2", uses=[asymptotic_derivative, gradient_bounds],
)  # fmt: skip
def asymptotic_inequality(goal: Goal) -> Evidence:
    """For κ = 1 and f = E∇F."""
    return reals(goal, *specialise(goal, gradient_bounds, {kappa: ONE}))


condition = gt(k, 2 * (C2 / C1) ** 2 * E_norm)


@claim(
    "6.2/gain-condition-suffices", "The gain condition makes the bound of dV/dt negative on the average",
    lt(coefficient * V, 0), given=[condition], labels=["eq:convergence_cond"], uses=[asymptotic_inequality],
)  # fmt: skip
def gain_condition(goal: Goal) -> Evidence:
    """Away from the source, where V > 0."""
    return reals(goal)


@claim(
    "6.2/gain-condition-is-needed-for-this", "The bound of dV/dt is negative under no weaker condition", condition,
    given=[lt(coefficient * V, 0)], labels=["eq:convergence_cond"], uses=[asymptotic_inequality],
)  # fmt: skip
def gain_condition_converse(goal: Goal) -> Evidence:
    """So the printed condition says exactly that the bound of dV/dt is negative. It does not say that a smaller gain
    fails: the bound of dV/dt need not be attained."""
    return reals(goal)


@claim(
    "6.2/gain-threshold-positive", "The gain's threshold is positive when there is a drift",
    gt(2 * (C2 / C1) ** 2 * E_norm, 0), given=[gt(E_norm, 0)], place="Section 6.2",
)  # fmt: skip
def gain_threshold(goal: Goal) -> Evidence:
    """It is 0 only for E = 0, where every positive gain will do."""
    return reals(goal)


s = sp.Symbol("s", real=True)
V_t = sp.Function("V", nonnegative=True)


@claim(
    "6.2/asymptotic-decay", "V of the averaged asymptotic seeker stays below an exponential",
    le(V_t(t), V_t(t0) * sp.exp(coefficient * (t - t0))),
    given=[ge(t, t0), ForAll((s,), le(sp.Derivative(V_t(s), s), coefficient * V_t(s)), (ge(s, t0),))],
    place="Section 6.2", uses=[asymptotic_inequality, gain_condition],
)  # fmt: skip
def asymptotic_decay(goal: Goal) -> Evidence:
    """The bound holds for every gain; under the condition its rate is negative and V tends to 0 as t tends to
    infinity, on the average."""
    return comparison(goal, V_t(t0) * sp.exp(coefficient * (s - t0)))


# --- eq:x_bar_upper_bound in the original time ------------------------------------------------------------------------

end = chain.clock.to_tau
printed_in_t = sp.sqrt(a1 / a2) * R0 * sp.exp(C2**2 / 2 * E_norm * T) * sp.exp(-k * C1**2 / 4 * (t - t0) / nu(t - t0))


@claim(
    "6.2/distance-bound-in-t", "The distance bound in the original time, for every averaged solution",
    le(distance_at(end), printed_in_t.subs(R0, distance_at(t0))),
    given=[ge(t, t0), lt(t, t0 + T), *solves(end, t0), *case_two],
    labels=["eq:x_bar_upper_bound_in_t"], uses=[distance_bound_tau], example=EXAMPLE | {t: sp.Rational(1, 2)},
)  # fmt: skip
def distance_bound_in_t(goal: Goal) -> Evidence:
    """The bound in τ with τ − t₀ replaced by (t − t₀)/ν; x̄(t) is X at the dilated time of t."""
    return reals(goal, *specialise(goal, distance_bound_tau, {tau: end, first_time: t0}))


@claim(
    "6.2/distance-bound-in-t-limit", "The bound tends to 0 as t tends to t₀ + T",
    eq(sp.Limit(printed_in_t, t, t0 + T, "-"), 0), labels=["eq:x_bar_upper_bound_in_t"], uses=[distance_bound_in_t],
)  # fmt: skip
def distance_limit_in_t(goal: Goal) -> Evidence:
    """For every gain and every drift matrix."""
    return limits(goal)


@claim(
    "6.2/drift-slows", "The drift enlarges the bound by a factor that does not depend on time",
    every(le(printed_in_t.subs(E_norm, 0), printed_in_t),
          eq(printed_in_t, printed_in_t.subs(E_norm, 0) * sp.exp(C2**2 / 2 * E_norm * T))),
    given=IN_TIME, place="Section 6.2", uses=[distance_bound_in_t],
)  # fmt: skip
def drift_slows(goal: Goal) -> Evidence:
    """So it delays the convergence that the bound guarantees, and leaves the limit as it is."""
    return reals(goal, exp_monotone(sp.S.Zero, C2**2 / 2 * E_norm * T))
