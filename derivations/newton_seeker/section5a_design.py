"""Section V.A: the Newton seeker, its averaged system, and the eigenvalues."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, claim, definition, eq, every, exact, ge, gt, le, lt, reals, refute

from . import chain
from .notation import (
    J_0,
    P_RANGE,
    F_star,
    F_x,
    F_z,
    H,
    J_n,
    Lambda,
    alpha,
    alpha_t,
    c,
    d,
    h,
    lambda_1,
    lambda_2,
    lambda_3,
    lambda_4,
    nu,
    omega,
    omega_0,
    omega_d,
    rate_of,
    rotated,
    t,
    z,
)
from .section4_gradient import ahead, forward, generator, orthogonal, rotation_rate, rotation_undone, second
from .section4_linear import both, characteristic, is_root
from .section8_newton_average import (
    first_coefficients,
    form,
    powers,
    second_coefficients_newton,
    third_dither,
    third_dither_bounded,
    vanishing_powers,
)
from .section8_newton_brackets import bracket_12, bracket_232

SECTION = "V.A Newton-based source seeking: design"


def riccati(field: sp.Expr) -> sp.Expr:
    """The rate of d as printed."""
    return omega_d * d * (1 - d * 8 * omega**2 / alpha_t**2 * (field - nu) * sp.cos(2 * omega * t))


def driven(field: sp.Expr) -> sp.Expr:
    """u₁ of the Newton seeker."""
    return forward(field, c * d)


law = definition(
    "newton/5-law", "The Newton seeker",
    every(
        eq(sp.Symbol("u1", real=True), driven(F_x)), eq(sp.Symbol("u2", real=True), omega_0),
        eq(rate_of("d"), riccati(F_x)), eq(rate_of("nu"), h * (F_x - nu)),
    ),
    labels=["eq:newton_seeker_control_law"], prose="d is the state of a Riccati filter.",
)  # fmt: skip


@claim(
    "newton/5-closed-loop", "The closed loop of the Newton seeker",
    eq(sp.Matrix([*(driven(F_x) * ahead), riccati(F_x), h * (F_x - nu)]), chain.newton.vector),
    labels=["eq:newton_seeker", "eq:newton_seeker_a"],
)  # fmt: skip
def closed_loop(goal: Goal) -> Evidence:
    """With θ = ω₀t, as for the gradient seeker."""
    return exact(goal)


@claim(
    "newton/5-in-z", "The closed loop of the Newton seeker in z",
    eq(sp.Matrix([*(J_0 * z + driven(F_z) * second), riccati(F_z), h * (F_z - nu)]), chain.newton_in_z.vector),
    labels=["eq:newton_seeker_in_z", "eq:ricatti_filter_z"],
    uses=[closed_loop, orthogonal, rotation_undone, rotation_rate, generator],
)  # fmt: skip
def in_z(goal: Goal) -> Evidence:
    """Only the position is turned."""
    return exact(goal)


@claim(
    "newton/5-average", "Proposition 2: the averaged Newton seeker",
    eq(
        sp.Matrix([*((J_0 + Lambda * d) * z), omega_d * d * (1 - H * d), h * (F_z - nu)]),
        chain.newton_averaged.vector,
    ),
    labels=["eq:LBS_newton_seeker", "prop:average_newton_seeker"],
    uses=[in_z, form, powers, third_dither, third_dither_bounded],
)  # fmt: skip
def average_newton(goal: Goal) -> Evidence:
    """The end of the pipeline. It holds for all p between 1/2 and 1 by the averaging of the system itself, which does
    not rest on Assumption 2."""
    return exact(goal)


_rest = chain.newton_averaged.vector - sp.Matrix(chain.newton_dithered.plain.drift)


@claim(
    "newton/5-average-by-hand", "γ₁₂[f₁, f₂] + γ₂₃₂[[f₂, f₃], f₂] is what the average adds to f₀",
    eq(
        -sp.Rational(1, 2) * sp.Matrix([0, d * alpha * H * z[1], 0, 0])
        + sp.Rational(1, 8) * sp.Matrix([0, 0, -8 * omega_d * H * d**2, 0]),
        _rest,
    ),
    given=P_RANGE, place="Appendix, Proposition 2",
    uses=[first_coefficients, second_coefficients_newton, vanishing_powers, bracket_12, bracket_232],
)  # fmt: skip
def average_by_hand(goal: Goal) -> Evidence:
    """The two printed brackets whose coefficients do not tend to 0."""
    return exact(goal)


# --- Linearisation ---------------------------------------------------------------------------------------------------

equilibrium = {rotated[0]: 0, rotated[1]: 0, d: 1 / H, nu: F_star}
deviation = sp.Matrix([*rotated, d, nu])


@claim(
    "newton/5-equilibrium", "z̄ = 0, d̄ = 1/H, ν̄ = F* is an equilibrium of the averaged system",
    eq(sp.Matrix([0, 0, 0, 0]), chain.newton_averaged.vector.subs(equilibrium)), place="Section V.A",
)  # fmt: skip
def is_equilibrium(goal: Goal) -> Evidence:
    """The Riccati filter rests at 0 and at 1/H."""
    return exact(goal)


@claim(
    "newton/5-linearisation", "The linear system with the matrix J_n",
    eq(J_n * deviation, chain.newton_averaged.linearization(equilibrium) * deviation),
    labels=["eq:newton_seeker_lin"], uses=[is_equilibrium],
)  # fmt: skip
def linearisation(goal: Goal) -> Evidence:
    """It is the averaged Newton seeker that is linearised; the text refers to the averaged gradient seeker. The state
    of the linear system is the deviation from the equilibrium."""
    return exact(goal)


decay = alpha / 2
discriminant = decay**2 - (2 * omega_0) ** 2


@claim(
    "newton/5-eigenvalues-printed", "λ₁, λ₂ = −α/2 ± √((α/2)² − (2ω₀)²)/2 are eigenvalues of J_n",
    every(*(eq(characteristic(J_n, value), 0) for value in (lambda_1, lambda_2))),
    given=[ge(discriminant, 0), *both(-decay, discriminant)], labels=["eq:ev_zbar_newton"],
    uses=[linearisation], expected="refuted", grade="error",
    wrong="The eigenvalues begin with −α/2 where it is −α/4.",
    survives="Yes for what is concluded, that they do not depend on H; where the root is imaginary, the rate is half "
    "of what is printed.",
)  # fmt: skip
def eigenvalues_printed(goal: Goal) -> Evidence:
    """As for the gradient seeker: the trace of that block is −α/2."""
    values = {lambda_1: sp.sqrt(3) - 4, lambda_2: -sp.sqrt(3) - 4}
    return refute(goal, {alpha: 8, omega_0: 1, omega_d: 5, h: 7, **values})


@claim(
    "newton/5-eigenvalues", "λ₁, λ₂ = −α/4 ± √((α/2)² − (2ω₀)²)/2, where they are real",
    every(*(eq(characteristic(J_n, value), 0) for value in (lambda_1, lambda_2))),
    given=[ge(discriminant, 0), *both(-decay / 2, discriminant)], labels=["eq:ev_zbar_newton"], uses=[linearisation],
    corrects=eigenvalues_printed,
)  # fmt: skip
def eigenvalues(goal: Goal) -> Evidence:
    """The roots of λ² + (α/2) λ + ω₀²."""
    return exact(goal)


@claim(
    "newton/5-eigenvalues-complex", "λ₁, λ₂ have the real part −α/4 where they are not real",
    every(*is_root(J_n, -decay / 2, sp.sqrt(-discriminant) / 2)), given=[le(discriminant, 0)],
    labels=["eq:ev_zbar_newton"], uses=[linearisation],
)  # fmt: skip
def eigenvalues_complex(goal: Goal) -> Evidence:
    """det(J_n − λI) by real and imaginary part."""
    return exact(goal)


@claim(
    "newton/5-other-eigenvalues", "λ₃ = −ω_d and λ₄ = −h",
    every(eq(characteristic(J_n, lambda_3), 0), eq(characteristic(J_n, lambda_4), 0)),
    given=[eq(lambda_3, -omega_d), eq(lambda_4, -h)], place="Section V.A", uses=[linearisation],
)  # fmt: skip
def other_eigenvalues(goal: Goal) -> Evidence:
    """Both filters are alone in the linear part."""
    return exact(goal)


@claim(
    "newton/5-stable", "All eigenvalues have negative real parts",
    every(lt(-decay / 2 + sp.sqrt(discriminant) / 2, 0), gt(h, 0), gt(omega_d, 0)), given=[ge(discriminant, 0)],
    place="Section V.A", uses=[eigenvalues],
)  # fmt: skip
def stable(goal: Goal) -> Evidence:
    """The real ones; the others have the real part −α/4."""
    return reals(goal)
