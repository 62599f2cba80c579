"""Beyond the paper: the gain that suffices for a drift E∇F, for every κ (a), and whether it is necessary (d)."""

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
    reals,
    refute,
)
from ptproof.system import System, gradient

from .notation import E11, E12, E21, E22, E, E_norm, F, F_source, G, k, position, t
from .section5b_1_lyapunov import gradient_bounds
from .section6a_asymptotic import averaged_asymptotic

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
