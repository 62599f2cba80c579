"""Beyond the paper: what the averaged system needs when more is known of the drift, and what the printed bounds lose.

(a) the gain that suffices for a drift E∇F, for every κ; (b) the critical initial value, minimised over τ*, and a larger
one; (c) the prescribed time that saves any start; (d) whether the gain condition is necessary; (e) the clipped gain.
"""

from __future__ import annotations

import sympy as sp

from ptproof.problem.drift import gradient_drift
from ptproof.proof import (
    Evidence,
    Exists,
    Goal,
    Prose,
    cited,
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
    refute,
    specialise,
)
from ptproof.system import System, gradient

from .notation import E11, E12, E21, E22, E, E_norm, F, F_source, G, T, V, b1, c, d, k, position, q, t
from .section5b_stability import gradient_bounds, sigma
from .section6a_asymptotic import averaged_asymptotic
from .section6b_critical import A as drift_letter
from .section6b_critical import B as feed_letter
from .section6b_critical import (
    W,
    duration,
    finite_small_start,
    positive_small_start,
    smallest_critical_value,
)

SECTION = "Beyond the paper"

slope = gradient(F, position)
half = k / 2
drifted = System(t, position, tuple(sp.Matrix(gradient_drift(E.tolist(), F, position).rate) + half * slope))
matrix = E + half * sp.eye(2)
g1, g2 = sp.symbols("g1 g2", real=True)
g = sp.Matrix([g1, g2])
quadratic = (g.T * matrix * g)[0]
square = g1**2 + g2**2
V_dot = sp.Symbol("V_dot", real=True)
nu_min = sp.Symbol("nu_min", positive=True)

# --- (a) The gain that suffices ---------------------------------------------------------------------------------------


@claim(
    "beyond/matrix-rate", "dV/dt along the averaged asymptotic seeker is a quadratic form in the gradient",
    eq(drifted.derivative_along(-(F - F_source)), -(slope.T * matrix * slope)[0]), uses=[averaged_asymptotic],
)  # fmt: skip
def matrix_rate(goal: Goal) -> Evidence:
    """For f = E∇F, exactly: −∇Fᵀ(E + k/2)∇F. Only the symmetric part of E counts."""
    return exact(goal)


definite = [gt(E11 + half, 0), gt((E11 + half) * (E22 + half) - ((E12 + E21) / 2) ** 2, 0)]


@claim(
    "beyond/definite-suffices", "If (k/2)I + (E + Eᵀ)/2 is positive definite, V decreases wherever ∇F ≠ 0",
    gt(quadratic, 0), given=[*definite, gt(square, 0)], uses=[matrix_rate],
)  # fmt: skip
def definite_suffices(goal: Goal) -> Evidence:
    """For every κ. Under Assumption 2 the gradient vanishes at the source only, and V grows without limit, so the
    source is globally asymptotically stable for the averaged asymptotic seeker."""
    return reals(goal)


asymptotic_convergence = claim(
    "beyond/asymptotic-convergence", "Then the averaged asymptotic seeker converges from everywhere, for every κ",
    Prose("V is positive definite, radially unbounded and strictly decreasing off the source"),
    uses=[definite_suffices, gradient_bounds], expected="cited",
)(cited("Khalil, Nonlinear Systems, Theorem 4.2"))  # fmt: skip


@claim(
    "beyond/quadratic-form-and-norm", "(g·Eg)² ≤ ‖g‖²‖Eg‖²",
    le((g.T * E * g)[0] ** 2, square * ((E * g)[0] ** 2 + (E * g)[1] ** 2)),
)  # fmt: skip
def form_and_norm(goal: Goal) -> Evidence:
    """The inequality of Cauchy and Schwarz, in the letters of the drift."""
    return reals(goal)


form = sp.Symbol("g_E_g", real=True)


@claim(
    "beyond/norm-suffices", "With only the norm of E known, k > 2‖E‖ suffices, for every κ",
    gt(form + half * G**2, 0), given=[gt(k, 2 * E_norm), le(form**2, (E_norm * G**2) ** 2)],
    uses=[form_and_norm, matrix_rate],
)  # fmt: skip
def norm_suffices(goal: Goal) -> Evidence:
    """|g·Eg| ≤ ‖E‖‖g‖². The constants c₁, c₂ of the field don't enter, while the printed condition asks for (c₂/c₁)²
    times as much."""
    return reals(goal)


@claim(
    "beyond/norm-condition-is-sharp", "No smaller constant serves every E of that norm",
    ge(-(-E_norm + half) * square, 0), given=[le(k, 2 * E_norm)], uses=[norm_suffices],
)  # fmt: skip
def norm_sharp(goal: Goal) -> Evidence:
    """For E = −‖E‖I and k ≤ 2‖E‖ the rate of V is not negative anywhere: V never decreases, whatever the field is."""
    return reals(goal)


# --- (d) Necessity ----------------------------------------------------------------------------------------------------

trace, determinant = matrix.trace(), matrix.det()
gram = E.T * E
spectral_norm = [
    eq(E_norm**4 - gram.trace() * E_norm**2 + gram.det(), 0), ge(2 * E_norm**2, gram.trace()),
]  # fmt: skip


@claim(
    "beyond/norm-condition-necessary", "k > 2‖E‖ is necessary for convergence with that E", gt(k, 2 * E_norm),
    given=[gt(trace, 0), gt(determinant, 0), *spectral_norm], expected="refuted",
)  # fmt: skip
def norm_necessary(goal: Goal) -> Evidence:
    """Refuted. For F = −‖x‖²/2 the average is dx/dt = −(E + k/2)x, which converges exactly if trace and determinant of
    E + k/2 are positive. With E = I it does so for every k > 0: a drift towards the source needs no gain to beat it."""
    return refute(goal, {E11: 1, E22: 1, E12: 0, E21: 0, E_norm: 1, k: 1})


@claim(
    "beyond/norm-condition-necessary-for-repulsion", "For E = −‖E‖I it is necessary", gt(k, 2 * E_norm),
    given=[gt((half - E_norm) * square, 0)], corrects=norm_necessary, uses=[norm_sharp],
)  # fmt: skip
def norm_necessary_repulsion(goal: Goal) -> Evidence:
    """The most repulsive drift of its norm: V decreases somewhere only if k > 2‖E‖."""
    return reals(goal)


@claim(
    "beyond/definite-necessary-for-one-field", "Definiteness is necessary for convergence in every single field",
    gt((E11 + half) * (E22 + half) - ((E12 + E21) / 2) ** 2, 0), given=[gt(trace, 0), gt(determinant, 0)],
    expected="refuted",
)  # fmt: skip
def definite_necessary(goal: Goal) -> Evidence:
    """Refuted: for F = −‖x‖²/2 and a nilpotent E the average converges for every k > 0."""
    return refute(goal, {E11: 0, E22: 0, E12: 4, E21: 0, k: 1})


eps, deficit = sp.symbols("epsilon_H deficit", positive=True)
hessian = g * g.T + eps * sp.eye(2)


@claim(
    "beyond/definite-necessary-for-all-fields", "Where it fails strictly, some quadratic field is repelled",
    Exists((eps,), (lt((matrix * hessian).trace(), 0), gt(hessian.det(), 0))),
    given=[eq(quadratic, -deficit)], corrects=definite_necessary,
)  # fmt: skip
def definite_necessary_all(goal: Goal) -> Evidence:
    """If g·(E + k/2)g < 0 for some g, take F = −x·Hx/2 with H = ggᵀ + εI, positive definite. The average is
    dx/dt = −(E + k/2)Hx, and the trace of (E + k/2)H is negative for small ε, so an eigenvalue has a positive real
    part. So over all fields definiteness is sharp up to its boundary."""
    return exists_by(goal, {eps: deficit / (1 + matrix.trace() ** 2)})


# --- (b) The critical initial value -----------------------------------------------------------------------------------

C1, C2 = sp.symbols("c1 c2", positive=True)
rho, rho0 = C2 / C1 * sp.sqrt(2 * E_norm / k), sp.sqrt(2 * E_norm / k)


@claim(
    "beyond/printed-threshold", "The smallest critical V₀ over all τ*, with ρ = (c₂/c₁)√(2‖E‖/k)",
    eq((C2 * sp.sqrt(E_norm) - C1 * sp.sqrt(k / 2)) ** 2, k * C1**2 / 2 * (rho - 1) ** 2),
    uses=[finite_small_start, smallest_critical_value],
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
