"""Beyond the paper: initial values that reach the source (b), the prescribed time that saves any start (c), the clipped
gain (e), and a bounded drift.
"""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    Exists,
    Goal,
    claim,
    eq,
    exact,
    exists_by,
    ge,
    gt,
    le,
    lt,
    power_positive,
    reals,
    specialise,
)

from .notation import E, E_norm, G, T, V, b1, c, d, k, q
from .section5b_1_lyapunov import gradient_bounds, sigma
from .section6a_asymptotic import averaged_asymptotic
from .section6b_1_comparison import W
from .section6b_2_critical import A as drift_letter
from .section6b_2_critical import B as feed_letter
from .section6b_2_critical import duration, finite_small_start, positive_small_start, smallest_attained
from .section9_1_gain import drifted, half, norm_suffices, slope

SECTION = "Beyond the paper"

V_dot, form = sp.symbols("V_dot g_E_g", real=True)
nu_min = sp.Symbol("nu_min", positive=True)

# --- (b) The critical initial value -----------------------------------------------------------------------------------

C1, C2 = sp.symbols("c1 c2", positive=True)
rho, rho0 = C2 / C1 * sp.sqrt(2 * E_norm / k), sp.sqrt(2 * E_norm / k)


@claim(
    "beyond/printed-threshold", "The smallest critical V₀ over all τ*, with ρ = (c₂/c₁)√(2‖E‖/k)",
    eq((C2 * sp.sqrt(E_norm) - C1 * sp.sqrt(k / 2)) ** 2, k * C1**2 / 2 * (rho - 1) ** 2),
    uses=[finite_small_start, smallest_attained],
)  # fmt: skip
def printed_threshold(goal: Goal) -> Evidence:
    """The claims used show that the bound is finite for all τ if σV₀^σT(c₂√‖E‖ − c₁√(k/2))² < 1, and escapes at
    τ* = t₀ + T(ρ − 1) if this is 1 and ρ > 1. So V₀ = [σT(k c₁²/2)(ρ − 1)²]^(−1/σ) is the smallest critical value."""
    return exact(goal)


factor = sp.Symbol("factor", real=True)  # ‖E‖/(1 + (τ − t₀)/T)² − k/2


@claim(
    "beyond/growth-by-c2", "While the drift wins, V grows at most by the upper constant",
    le(V_dot, factor * c(2) ** 2 * V ** (2 * q())),
    given=[le(V_dot, factor * G**2), ge(factor, 0), le(G, c(2) * V ** q())], uses=[gradient_bounds],
)  # fmt: skip
def growth_by_c2(goal: Goal) -> Evidence:
    """dV/dτ ≤ (‖E‖ν² − k/2)‖∇F‖²: the difference is estimated as a whole, not term by term as in the paper."""
    return reals(goal, power_positive(V, q()))


@claim(
    "beyond/decay-by-c1", "While the gain wins, V decays at least by the lower constant",
    le(V_dot, factor * c(1) ** 2 * V ** (2 * q())),
    given=[le(V_dot, factor * G**2), le(factor, 0), le(c(1) * V ** q(), G)], uses=[gradient_bounds],
)  # fmt: skip
def decay_by_c1(goal: Goal) -> Evidence:
    """From τ − t₀ = T(ρ₀ − 1) on, ρ₀ = √(2‖E‖/k), and always if k ≥ 2‖E‖."""
    return reals(goal, power_positive(V, q()))


stretched = 1 + duration / T


@claim(
    "beyond/turning-point", "The drift wins until τ − t₀ = T(ρ₀ − 1), and not later",
    le(E_norm / stretched**2 - half, 0), given=[ge(stretched**2 * k, 2 * E_norm)],
)  # fmt: skip
def turning_point(goal: Goal) -> Evidence:
    """(1 + (τ − t₀)/T)² ≥ ρ₀²."""
    return reals(goal)


small_start = lt(sigma * W * (T * (C2 * sp.sqrt(E_norm) - C2 * sp.sqrt(half)) ** 2), 1)


@claim(
    "beyond/larger-threshold", "Below the larger threshold the bound is finite for all τ",
    gt((T + duration) * (1 - sigma * W * C2**2 * (E_norm * T * duration / (T + duration) - half * duration)), 0),
    given=[gt(E_norm, 0), small_start], uses=[growth_by_c2, decay_by_c1, turning_point, positive_small_start],
)  # fmt: skip
def larger_threshold(goal: Goal) -> Evidence:
    """W is V₀^σ. Up to the turning point the comparison with c₂ for both terms has this denominator, positive if
    V₀ < [σT(k c₂²/2)(ρ₀ − 1)²]^(−1/σ); after it V only decreases."""
    roots = {drift_letter: C2 * sp.sqrt(E_norm), feed_letter: C2 * sp.sqrt(half)}
    return reals(goal, *specialise(goal, positive_small_start, roots))


@claim(
    "beyond/larger-threshold-form", "The larger threshold with ρ₀ = √(2‖E‖/k)",
    eq((C2 * sp.sqrt(E_norm) - C2 * sp.sqrt(half)) ** 2, k * C2**2 / 2 * (rho0 - 1) ** 2), uses=[larger_threshold],
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


@claim(
    "beyond/time-threshold", "Below a certain T the guarantee holds although k violates the condition", small_start,
    given=[gt(E_norm, 0), gt(2 * E_norm, k), lt(T, 1 / (sigma * W * (k * C2**2 / 2 * (root - 1) ** 2))),
           eq(root**2 * k, 2 * E_norm)],
    uses=[larger_threshold, larger_threshold_form],
)  # fmt: skip
def time_threshold(goal: Goal) -> Evidence:
    """T < V₀^(−σ)/(σ(k c₂²/2)(ρ₀ − 1)²) for the given V₀ and ‖E‖; the printed chain gives the same with c₁ and ρ."""
    return reals(goal)


@claim(
    "beyond/some-time-works", "For every V₀, E and k there is such a T", Exists((T,), (small_start,)),
    uses=[larger_threshold],
)  # fmt: skip
def some_time_works(goal: Goal) -> Evidence:
    """The condition is T times a number that does not depend on T."""
    rest = sigma * W * (C2 * sp.sqrt(E_norm) - C2 * sp.sqrt(half)) ** 2
    return exists_by(goal, {T: 1 / (1 + rest)})


# --- (e) The clipped gain ---------------------------------------------------------------------------------------------


@claim(
    "beyond/clipped-average", "After the clip the average is that of the asymptotic seeker with k/ν_min²",
    eq(sp.Matrix(drifted.rhs).subs(k, k / nu_min**2), E * slope + 1 / nu_min**2 * half * slope),
    uses=[averaged_asymptotic],
)  # fmt: skip
def clipped_average(goal: Goal) -> Evidence:
    """The gain 1/ν_min² multiplies (k/2)∇F and not the drift."""
    return exact(goal)


@claim(
    "beyond/clipped-condition", "With the gain clipped at ν_min, k > 2ν_min²‖E‖ suffices after the clip",
    gt(form + k / nu_min**2 / 2 * G**2, 0), given=[gt(k, 2 * nu_min**2 * E_norm), le(form**2, (E_norm * G**2) ** 2)],
    uses=[clipped_average, norm_suffices],
)  # fmt: skip
def clipped_condition(goal: Goal) -> Evidence:
    """The condition of the asymptotic seeker, with k/ν_min² for k; likewise for definiteness of
    (k/(2ν_min²))I + (E + Eᵀ)/2."""
    return reals(goal)


# --- A bounded drift --------------------------------------------------------------------------------------------------

gain = sp.Symbol("K", positive=True)
power = sp.Symbol("R_r", positive=True)  # the distance to the power r = 2κ − 1


@claim(
    "beyond/ultimate-distance", "Under a bounded drift V decreases wherever the distance^r exceeds 2d/(kKb₁)",
    lt(G * (d - gain * half * G), 0), given=[ge(G, b1 * power), gt(power, 2 * d / (k * gain * b1))],
)  # fmt: skip
def ultimate_distance(goal: Goal) -> Evidence:
    """K is the constant gain after the clip. So V ends at or below a₁(2d/(kKb₁))^(2κ/r), and the distance at or below
    (a₁/a₂)^(1/2κ)(2d/(kKb₁))^(1/r), which is never more than the printed γ(h₂d/K)."""
    return reals(goal)
