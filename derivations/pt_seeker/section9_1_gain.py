"""Beyond the paper: the gain that suffices for a drift E∇F, for every κ (a), and whether it is necessary (d).

All of it is about the average of the asymptotic seeker.
"""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    Exists,
    ForAll,
    Goal,
    claim,
    comparison,
    eq,
    every,
    exact,
    exists_by,
    ge,
    gt,
    le,
    lt,
    reals,
    refute,
    specialise,
)
from ptproof.system import gradient, jacobian

from .notation import E11, E12, E21, E22, E, E_norm, F, F_source, T, f, k, position, t, t0, tau
from .section3_problem import g1, g2, spectral_norm, spectral_norm_squared
from .section6a_asymptotic import asymptotic_average, averaged_asymptotic
from .section6b_3_only import f_now, g, rate_by_norm, rho

SECTION = "Beyond the paper"

slope = gradient(F, position)
half = k / 2
drifted = asymptotic_average.with_values(dict(zip(f, E * slope, strict=True)))  # with f = E∇F
rate = drifted.derivative_along(-(F - F_source))  # dV/dt
matrix = E + half * sp.eye(2)
square = slope[0] ** 2 + slope[1] ** 2
moving = gt(square, 0)  # where the gradient is not zero

# --- (a) The gain that suffices ---------------------------------------------------------------------------------------


@claim(
    "beyond/matrix-rate", "dV/dt along the averaged asymptotic seeker is a quadratic form in the gradient",
    eq(rate, -(slope.T * matrix * slope)[0]), uses=[averaged_asymptotic],
)  # fmt: skip
def matrix_rate(goal: Goal) -> Evidence:
    """For f = E∇F, exactly: −∇Fᵀ(E + k/2)∇F. Only the symmetric part of E counts."""
    return exact(goal)


off = (E12 + E21) / 2
determinant = (E11 + half) * (E22 + half) - off**2  # of (k/2)I + (E + Eᵀ)/2
definite = (gt(E11 + half, 0), gt(determinant, 0))
slowest = determinant / matrix.trace()  # at most the smaller eigenvalue


@claim(
    "beyond/definite-rate", "If (k/2)I + (E + Eᵀ)/2 is positive definite, V falls at least at a multiple of ‖∇F‖²",
    le(rate, -slowest * square), given=definite, uses=[matrix_rate],
)  # fmt: skip
def definite_rate(goal: Goal) -> Evidence:
    """On the average, for every κ. The multiple is determinant over trace, which is at most the smaller eigenvalue."""
    return reals(goal)


@claim(
    "beyond/definite-suffices", "Then V of the averaged asymptotic seeker falls wherever ∇F ≠ 0",
    every(lt(rate, 0), gt(slowest, 0)), given=[*definite, moving], uses=[definite_rate],
)  # fmt: skip
def definite_suffices(goal: Goal) -> Evidence:
    """Under Assumption 2 the gradient vanishes at the source only."""
    return reals(goal)


norm = eq(E_norm**2, spectral_norm_squared)
image = E * sp.Matrix([g1, g2])


@claim(
    "beyond/drift-by-norm", "‖Eg‖² ≤ ‖E‖²‖g‖² for the spectral norm",
    le(image[0] ** 2 + image[1] ** 2, E_norm**2 * (g1**2 + g2**2)), given=[norm], uses=[spectral_norm],
)  # fmt: skip
def drift_by_norm(goal: Goal) -> Evidence:
    """So a drift f = E∇F has ‖f‖ ≤ ‖E‖‖∇F‖."""
    return reals(goal)


@claim(
    "beyond/norm-suffices", "If ‖f‖ ≤ ‖E‖‖∇F‖ and k > 2‖E‖, V of the averaged asymptotic seeker falls, for every κ",
    every(le(asymptotic_average.derivative_along(-(F - F_source)), -(half - E_norm) * square), gt(half - E_norm, 0)),
    given=[gt(k, 2 * E_norm), le(f[0] ** 2 + f[1] ** 2, E_norm**2 * square)], uses=[averaged_asymptotic, rate_by_norm],
)  # fmt: skip
def norm_suffices(goal: Goal) -> Evidence:
    """So with only the norm of E known k > 2‖E‖ suffices: the constants c₁, c₂ of the field don't enter, while the
    printed condition asks for (c₂/c₁)² times as much."""
    now = {g[0]: slope[0], g[1]: slope[1], f_now[0]: f[0], f_now[1]: f[1], rho: 1}
    return reals(goal, *specialise(goal, rate_by_norm, now))


# --- (d) Necessity ----------------------------------------------------------------------------------------------------

repulsive = {E11: -E_norm, E12: 0, E21: 0, E22: -E_norm}  # E = −‖E‖I
s = sp.Symbol("s", real=True)
X = tuple(sp.Function(name, real=True) for name in ("X1", "X2"))
Z = sp.Function("Z", real=True)
alpha, beta = sp.symbols("alpha beta", real=True)
elapsed = tau - t0


def along(expression: sp.Expr, time: sp.Expr) -> sp.Expr:
    """The expression on a trajectory X of the average."""
    return expression.subs({position[0]: X[0](time), position[1]: X[1](time), t: time}, simultaneous=True)


def follows_average(*values: tuple[sp.Symbol, sp.Expr]) -> tuple[ForAll, ...]:
    """X is a trajectory of the averaged asymptotic seeker on [t₀, t], with these values of its letters."""
    system = drifted.with_values(dict(values))
    return tuple(
        ForAll((s,), eq(sp.Derivative(X[i](s), s), along(system.rhs[i], s)), (ge(s, t0), le(s, t))) for i in (0, 1)
    )


@claim(
    "beyond/integrated-rate", "A rate that depends on time only, integrated",
    le(Z(tau), Z(t0) + alpha * T * elapsed / (T + elapsed) - beta * elapsed),
    given=[ge(tau, t0),
           ForAll((s,), le(sp.Derivative(Z(s), s), alpha / (1 + (s - t0) / T) ** 2 - beta), (ge(s, t0), le(s, tau)))],
)  # fmt: skip
def integrated_rate(goal: Goal) -> Evidence:
    """The comparison principle, for both signs of both constants."""
    passed = s - t0
    solution = Z(t0) + alpha * T * passed / (T + passed) - beta * passed
    return comparison(goal, solution, denominators=[1 + passed / T, T + passed])


@claim(
    "beyond/norm-condition-is-sharp", "For E = −‖E‖I and k ≤ 2‖E‖ no averaged trajectory ever climbs, in any field",
    le(along(F, t), along(F, t0)), given=[ge(t, t0), le(k, 2 * E_norm), *follows_average(*repulsive.items())],
    uses=[norm_suffices, integrated_rate],
)  # fmt: skip
def norm_sharp(goal: Goal) -> Evidence:
    """dF/dt = (k/2 − ‖E‖)‖∇F‖² ≤ 0 on the trajectory: the vehicle's average ends no higher than it started. So no
    smaller constant than 2 serves every E of that norm."""
    return reals(goal, *specialise(goal, integrated_rate, {Z(s): along(F, s), alpha: 0, beta: 0, tau: t}))


round_field = drifted.with_values({F: -(position[0] ** 2 + position[1] ** 2) / 2})
linear = jacobian(round_field.rhs, position)  # −(E + k/2)
stable = (lt(linear.trace(), 0), gt(linear.det(), 0))  # both eigenvalues have negative real parts


@claim(
    "beyond/norm-condition-necessary", "For F = −‖x‖²/2 the average is asymptotically stable only if k > 2‖E‖",
    gt(k, 2 * E_norm), given=[*stable, norm], expected="refuted",
)  # fmt: skip
def norm_necessary(goal: Goal) -> Evidence:
    """Refuted. The average is dx/dt = −(E + k/2)x; with E = I it converges for every k > 0: a drift towards the source
    needs no gain to beat it."""
    return refute(goal, {E11: 1, E22: 1, E12: 0, E21: 0, E_norm: 1, k: 1})


@claim(
    "beyond/norm-condition-necessary-for-repulsion", "For F = −‖x‖²/2 and E = −‖E‖I it is so only if k > 2‖E‖",
    gt(k, 2 * E_norm), given=[relation.map(lambda side: side.subs(repulsive)) for relation in stable],
    corrects=norm_necessary, uses=[norm_sharp],
)  # fmt: skip
def norm_necessary_repulsion(goal: Goal) -> Evidence:
    """The most repulsive drift of its norm."""
    return reals(goal)


@claim(
    "beyond/definite-necessary-for-one-field",
    "For F = −‖x‖²/2 the average is asymptotically stable only if (k/2)I + (E + Eᵀ)/2 is positive definite",
    gt(determinant, 0), given=stable, expected="refuted",
)  # fmt: skip
def definite_necessary(goal: Goal) -> Evidence:
    """Refuted: with a nilpotent E this average converges for every k > 0."""
    return refute(goal, {E11: 0, E22: 0, E12: 4, E21: 0, k: 1})


eps, deficit = sp.symbols("epsilon_H delta_H", positive=True)
direction = sp.Matrix([g1, g2])
hessian = direction * direction.T + eps * sp.eye(2)
x = sp.Matrix(position)
quadratic_field = drifted.with_values({F: -(x.T * hessian * x)[0] / 2})


@claim(
    "beyond/definite-necessary-for-all-fields",
    "Where it fails strictly, the average leaves the source of some quadratic field",
    Exists((eps,), (gt(jacobian(quadratic_field.rhs, position).trace(), 0), gt(hessian.det(), 0))),
    given=[eq((direction.T * matrix * direction)[0], -deficit)], corrects=definite_necessary,
)  # fmt: skip
def definite_necessary_all(goal: Goal) -> Evidence:
    """If g·(E + k/2)g < 0 for some g, take F = −x·Hx/2 with H = ggᵀ + εI, positive definite. The average is
    dx/dt = −(E + k/2)Hx, whose matrix has a positive trace for small ε, so that an eigenvalue has a positive real part.
    So over all fields definiteness is sharp up to its boundary."""
    return exists_by(goal, {eps: deficit / (1 + matrix.trace() ** 2)})
