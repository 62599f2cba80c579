"""Beyond the paper: initial values that reach the source (b), the prescribed time that saves any start (c), and a
bounded drift. All of it is about the average.
"""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Assumption,
    Evidence,
    Exists,
    Fact,
    ForAll,
    Goal,
    claim,
    comparison,
    eq,
    exact,
    exists_by,
    ge,
    gt,
    instances,
    le,
    lt,
    power_nonnegative,
    power_positive,
    reals,
    specialise,
)

from .notation import E_norm, F, G, T, b1, b2, c, d, k, kappa, position, q, t0, tau, x1, x2
from .section5a_1_reduction import f_tau, stretch
from .section5b_0_trajectory import (
    EXAMPLE,
    F_1,
    F_2,
    X1,
    X2,
    V_along,
    V_rate,
    assumption_2,
    at,
    derivative,
    gradient_bounds,
    here,
    later,
    s,
    solves,
    start,
    v_nonnegative,
)
from .section5b_0_with_drift import gradient_drift_given, instant
from .section5b_1_lyapunov import n, sigma
from .section6b_1_comparison import W
from .section6b_2_finite import A as drift_letter
from .section6b_2_finite import B as feed_letter
from .section6b_2_finite import duration, finite_small_start, positive_small_start, smallest_attained
from .section6b_3_only import f_now, g, rate_by_norm, rho
from .section9_1_gain import Z, alpha, beta, half, image, integrated_rate

SECTION = "Beyond the paper"

# --- (b) The critical initial value -----------------------------------------------------------------------------------

C1, C2 = sp.symbols("c1 c2", positive=True)
ratio, ratio_0 = C2 / C1 * sp.sqrt(2 * E_norm / k), sp.sqrt(2 * E_norm / k)


@claim(
    "beyond/printed-threshold", "The smallest critical V₀ over all τ*, with ρ = (c₂/c₁)√(2‖E‖/k)",
    eq((C2 * sp.sqrt(E_norm) - C1 * sp.sqrt(k / 2)) ** 2, k * C1**2 / 2 * (ratio - 1) ** 2),
    uses=[finite_small_start, smallest_attained],
)  # fmt: skip
def printed_threshold(goal: Goal) -> Evidence:
    """The claims used show that the bound is finite for all τ if σV₀^σT(c₂√‖E‖ − c₁√(k/2))² < 1, and escapes at
    τ* = t₀ + T(ρ − 1) if this is 1 and ρ > 1. So V₀ = [σT(k c₁²/2)(ρ − 1)²]^(−1/σ) is the smallest critical value."""
    return exact(goal)


# ‖E‖ is a number with ‖Eg‖ ≤ ‖E‖‖g‖ for all g, as the spectral norm is.
norm_bounds = ForAll(g, le(image[0] ** 2 + image[1] ** 2, E_norm**2 * (g[0] ** 2 + g[1] ** 2)))
drifting: tuple[Assumption, ...] = (*solves(tau), *later, *gradient_drift_given, norm_bounds)
square = F_1**2 + F_2**2
at_most = E_norm / (1 + (tau - start) / T) ** 2 - half  # at least ‖E‖/(1 + (τ − t₀)/T)² − k/2


@claim(
    "beyond/rate-along", "dV/dτ along an averaged trajectory with gradient drift, by the norm of E",
    le(V_rate, at((E_norm / stretch**2 - half) * square, tau)), given=drifting, uses=[derivative, rate_by_norm],
    example=EXAMPLE,
)  # fmt: skip
def rate_along(goal: Goal) -> Evidence:
    """At most (‖E‖/(1 + (τ − t₀)/T)² − k/2)‖∇F‖²: the difference is estimated as a whole, not term by term as in the
    paper."""
    slope, drift = [at(entry, tau) for entry in (F_1, F_2)], [at(entry, tau) for entry in f_tau]
    values = {**dict(zip(g, slope, strict=True)), **dict(zip(f_now, drift, strict=True)), rho: 1 / stretch**2}
    given = instances(goal, instant(tau), tuple(slope))
    return reals(goal, *specialise(goal, derivative, {}), *specialise(goal, rate_by_norm, values), *given)


def by_v(goal: Goal) -> list[Fact]:
    """The gradient between powers of V on the trajectory, where V is not negative."""
    positive = [*specialise(goal, v_nonnegative, here), power_nonnegative(V_along, q())]
    return [*specialise(goal, rate_along, {}), *specialise(goal, gradient_bounds, here), *positive]


@claim(
    "beyond/growth-by-c2", "While the drift may win, V of the average grows at most by the upper constant",
    le(V_rate, at_most * c(2) ** 2 * V_along ** (2 * q())), given=[*drifting, *assumption_2, ge(at_most, 0)],
    uses=[rate_along, gradient_bounds, v_nonnegative], example={**EXAMPLE, E_norm: 10},
)  # fmt: skip
def growth_by_c2(goal: Goal) -> Evidence:
    """Along every averaged trajectory, from every initial time τ₀ ≥ t₀."""
    return reals(goal, *by_v(goal))


@claim(
    "beyond/decay-by-c1", "While the gain wins, V of the average decays at least by the lower constant",
    le(V_rate, at_most * c(1) ** 2 * V_along ** (2 * q())), given=[*drifting, *assumption_2, le(at_most, 0)],
    uses=[rate_along, gradient_bounds, v_nonnegative], example=EXAMPLE,
)  # fmt: skip
def decay_by_c1(goal: Goal) -> Evidence:
    """From τ − τ₀ = T(ρ₀ − 1) on, ρ₀ = √(2‖E‖/k), and always if k ≥ 2‖E‖."""
    return reals(goal, *by_v(goal))


stretched = 1 + duration / T


@claim(
    "beyond/turning-point", "From τ − τ₀ = T(ρ₀ − 1) on the gain wins",
    le(E_norm / stretched**2 - half, 0), given=[ge(stretched**2 * k, 2 * E_norm)],
)  # fmt: skip
def turning_point(goal: Goal) -> Evidence:
    """(1 + (τ − τ₀)/T)² ≥ ρ₀² = 2‖E‖/k."""
    return reals(goal)


@claim(
    "beyond/turning-point-before", "Before it the drift may win", gt(E_norm / stretched**2 - half, 0),
    given=[lt(stretched**2 * k, 2 * E_norm)],
)  # fmt: skip
def turning_point_before(goal: Goal) -> Evidence:
    """The converse: with the drift −‖E‖∇F it does win until then."""
    return reals(goal)


@claim(
    "beyond/no-growth", "From the turning point on V of the average never grows again",
    le(V_along, V_along.subs(tau, start)), given=[*drifting, ge(stretch.subs(tau, start) ** 2 * k, 2 * E_norm)],
    uses=[rate_along, integrated_rate], example=EXAMPLE,
)  # fmt: skip
def no_growth(goal: Goal) -> Evidence:
    """Along every averaged trajectory that starts, or is looked at, from an instant τ₀ with (1 + (τ₀ − t₀)/T)²k ≥
    2‖E‖."""

    def along(there: Goal, time: sp.Expr) -> list[Fact]:
        return specialise(there, rate_along, {tau: time})

    values = {Z(s): V_along.subs(tau, s), alpha: 0, beta: 0, t0: start}
    return reals(goal, *specialise(goal, integrated_rate, values, along=along))


V = sp.Function("V", real=True)
order = n + 1
base = 1 - sigma * V(start) ** sigma * c(2, order) ** 2 * (
    E_norm * T * (s - start) / (T + s - start) - half * (s - start)
)
until = (ge(s, start), le(s, tau))


@claim(
    "beyond/growth-bound", "What the growth by c₂ gives for κ = n + 1 ≥ 2",
    le(V(tau), V(start) * base.subs(s, tau) ** (-1 / sigma)),
    given=[
        ge(tau, start), ForAll((s,), gt(base, 0), until), ForAll((s,), ge(V(s), 0)), ge(V(start), 0),
        ForAll((s,), le(sp.Derivative(V(s), s), at_most.subs(tau, s) * c(2, order) ** 2 * V(s) ** (1 + sigma)), until),
    ],
)  # fmt: skip
def growth_bound(goal: Goal) -> Evidence:
    """A comparison equation of Bernoulli's type, as long as the bracket is positive."""
    root = power_nonnegative(V(start), sigma)
    at_end = instances(goal, tau)
    return comparison(goal, V(start) * base ** (-1 / sigma), denominators=[base], lemmas=[root, *at_end])


V_start = V_along.subs(tau, start)
roots = {drift_letter: c(2, order) * sp.sqrt(E_norm), feed_letter: c(2, order) * sp.sqrt(half)}
small = lt(sigma * V_start**sigma * (T * (roots[drift_letter] - roots[feed_letter]) ** 2), 1)
for_order = [ForAll(item.variables, item.relation.map(lambda side: side.subs(kappa, order))) for item in assumption_2]


@claim(
    "beyond/larger-threshold", "Below the larger threshold V of the average has a finite bound while the drift may win",
    le(V_along, V_start * base.subs(V(start), V_start).subs(s, tau) ** (-1 / sigma)),
    given=[*drifting, *for_order, gt(E_norm, 0), gt(V_start, 0), small,
           ForAll((s,), ge(at_most.subs(tau, s), 0), until)],
    uses=[growth_by_c2, v_nonnegative, positive_small_start, growth_bound],
    example={**EXAMPLE, E_norm: 1, n: 1, F: -((x1**2 + x2**2) ** 2), b1: 4, b2: 4, X1(s): 1 - 2 * s, tau: 0},
)  # fmt: skip
def larger_threshold(goal: Goal) -> Evidence:
    """For κ = n + 1 ≥ 2, from every start with V₀ < [σT(k c₂²/2)(ρ₀ − 1)²]^(−1/σ). From the turning point on V never
    grows again, so the trajectory exists for all times, and V tends to 0 by the bound for a gain that wins."""
    begins = power_positive(V_start, sigma)

    def along(there: Goal, time: sp.Expr) -> list[Fact]:
        values = {kappa: order, position[0]: X1(time), position[1]: X2(time)}
        said = specialise(there, v_nonnegative, values)
        if le(time, tau) in there.assumptions:
            passed = {**roots, duration: time - start, W: V_start**sigma}
            said += specialise(there, growth_by_c2, {kappa: order, tau: time})
            said += specialise(there, positive_small_start, passed, [begins])
        return said

    values = {V(s): V_along.subs(tau, s)}
    end = specialise(goal, positive_small_start, {**roots, duration: tau - start, W: V_start**sigma}, [begins])
    return reals(goal, *specialise(goal, growth_bound, values, [begins], along=along), *end, begins)


@claim(
    "beyond/larger-threshold-form", "The larger threshold with ρ₀ = √(2‖E‖/k)",
    eq((C2 * sp.sqrt(E_norm) - C2 * sp.sqrt(half)) ** 2, k * C2**2 / 2 * (ratio_0 - 1) ** 2), uses=[larger_threshold],
)  # fmt: skip
def larger_threshold_form(goal: Goal) -> Evidence:
    """In the form of the printed one."""
    return exact(goal)


root = sp.Symbol("rho_0", positive=True)


@claim(
    "beyond/larger-threshold-is-larger", "It is never smaller than the printed one",
    le(C2**2 * (root - 1) ** 2, C1**2 * (C2 / C1 * root - 1) ** 2), given=[ge(root, 1), le(C1, C2)],
    uses=[printed_threshold, larger_threshold_form],
)  # fmt: skip
def larger_is_larger(goal: Goal) -> Evidence:
    """c₁(ρ − 1) = c₂ρ₀ − c₁ ≥ c₂(ρ₀ − 1), as c₁ ≤ c₂; with equality only for c₁ = c₂. For ρ₀ ≤ 1 there is no critical
    value at all, though the printed one may exist."""
    return reals(goal)


# --- (c) The prescribed time ------------------------------------------------------------------------------------------

small_start = lt(sigma * W * (T * (C2 * sp.sqrt(E_norm) - C2 * sp.sqrt(half)) ** 2), 1)


@claim(
    "beyond/time-threshold", "For a short T the start is below the larger threshold, although k < 2‖E‖", small_start,
    given=[gt(2 * E_norm, k), eq(root**2 * k, 2 * E_norm), lt(T, 1 / (sigma * W * (k * C2**2 / 2 * (root - 1) ** 2)))],
    uses=[larger_threshold_form],
)  # fmt: skip
def time_threshold(goal: Goal) -> Evidence:
    """T < V₀^(−σ)/(σ(k c₂²/2)(ρ₀ − 1)²) for the given V₀ and ‖E‖, where W is V₀^σ; the printed chain gives the same
    with c₁ and ρ. What the larger threshold guarantees on the average then holds."""
    return reals(goal)


@claim(
    "beyond/some-time-works", "For every V₀, E and k there is a T for which the start is below the larger threshold",
    Exists((T,), (small_start,)),
)  # fmt: skip
def some_time_works(goal: Goal) -> Evidence:
    """The condition is T times a number that does not depend on T."""
    rest = sigma * W * (C2 * sp.sqrt(E_norm) - C2 * sp.sqrt(half)) ** 2
    return exists_by(goal, {T: 1 / (1 + rest)})


# --- A bounded drift --------------------------------------------------------------------------------------------------

gain = sp.Symbol("K", positive=True)
power = sp.Symbol("R_r", positive=True)  # the distance to the power r = 2κ − 1


@claim(
    "beyond/ultimate-distance", "Under a bounded drift V decreases wherever the distance^r exceeds 2d/(kKb₁)",
    lt(G * (d - gain * half * G), 0), given=[ge(G, b1 * power), gt(power, 2 * d / (k * gain * b1))],
)  # fmt: skip
def ultimate_distance(goal: Goal) -> Evidence:
    """On the average; K is the constant gain after the clip. So V ends at or below a₁(2d/(kKb₁))^(2κ/r), and the
    distance at or below (a₁/a₂)^(1/2κ)(2d/(kKb₁))^(1/r), which is never more than the printed γ(h₂d/K)."""
    return reals(goal)
