"""Section V.B, Step 3: the Lyapunov function of the subsystem (z̄, d̂)."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, Relation, claim, definition, eq, every, exact, ge, gt, le, reals, refute
from ptproof.system import System

from . import chain
from .notation import J_0, G, I, Lambda_t, P, alpha, b, d_h, omega_0, omega_d, t, z, z1, z2
from .section5b_1_coordinates import shifted

SECTION = "V.B Newton-based source seeking: analysis, Step 3"
STEP_3 = "Section V.B, Step 3"

A = J_0 + Lambda_t
grown = sp.exp(d_h) - 1
square = z1**2 + z2**2
zPz, zGz = (sp.expand((z.T * matrix * z)[0]) for matrix in (P, G))
V = sp.log(1 + zPz) + b / omega_d * (sp.exp(d_h) - d_h - 1)

lyapunov_function = definition(
    "newton/5-lyapunov-function", "V = ln(1 + z̄ᵀPz̄) + (b/ω_d)(e^d̂ − d̂ − 1)",
    eq(sp.Function("V", real=True)(z1, z2, d_h), V), labels=["eq:Lyapunov_func"], prose="For the subsystem (z̄, d̂).",
)  # fmt: skip


@claim(
    "newton/5-lyapunov-equation", "P(J₀ + Λ̃) + (J₀ + Λ̃)ᵀP = −I", eq(P * A + A.T * P, -I), place=STEP_3,
)  # fmt: skip
def lyapunov_equation(goal: Goal) -> Evidence:
    """For the printed P."""
    return exact(goal)


@claim(
    "newton/5-P-positive", "P is positive definite", every(gt(P[0, 0], 0), gt(P.det(), 0)), place=STEP_3,
)  # fmt: skip
def positive_definite(goal: Goal) -> Evidence:
    """By its leading minors."""
    return reals(goal)


@claim("newton/5-G", "G = PΛ̃ + Λ̃ᵀP", eq(P * Lambda_t + Lambda_t.T * P, G), labels=["eq:matrix_G"])
def matrix_G(goal: Goal) -> Evidence:
    """The order of the two sides is that of the display, turned."""
    return exact(goal)


# --- The two numbers of b --------------------------------------------------------------------------------------------

norm_squared = 2 + alpha**2 / (16 * omega_0**2) + 1 / (2 * omega_0) * sp.sqrt(alpha**2 + 16 * omega_0**2)
least = 2 / alpha + alpha / (8 * omega_0**2) - 1 / (2 * omega_0**2) * sp.sqrt(alpha**2 / 16 + omega_0**2)


def extreme(matrix: sp.Matrix, value: sp.Expr) -> Relation:
    """det(matrix − value I) = 0."""
    return eq(sp.expand((matrix - value * sp.eye(2)).det()), 0)


@claim("newton/5-norm-G", "‖G‖² is an eigenvalue of GᵀG", extreme(G.T * G, norm_squared), place=STEP_3)
def norm_of_G(goal: Goal) -> Evidence:
    """The square of the norm is the greater one, by the next claim."""
    return exact(goal)


@claim(
    "newton/5-norm-G-greatest", "‖G‖² is the greater of the two", ge(norm_squared, (G.T * G).trace() / 2), place=STEP_3,
)  # fmt: skip
def norm_greatest(goal: Goal) -> Evidence:
    """It is not less than their mean."""
    return reals(goal)


@claim("newton/5-least-P", "λ_min(P) is an eigenvalue of P", extreme(P, least), place=STEP_3)
def least_of_P(goal: Goal) -> Evidence:
    """It is the smaller one, by the next claim."""
    return exact(goal)


@claim(
    "newton/5-least-P-positive", "λ_min(P) is the smaller eigenvalue, and positive",
    every(le(least, P.trace() / 2), gt(least, 0)), place=STEP_3, uses=[least_of_P],
)  # fmt: skip
def least_positive(goal: Goal) -> Evidence:
    """Not more than their mean; (2/α + α/(8ω₀²))² − (α²/16 + ω₀²)/(4ω₀⁴) = det P > 0."""
    return reals(goal)


# --- Its derivative --------------------------------------------------------------------------------------------------

subsystem = System(t, (z1, z2, d_h), chain.shifted.rhs[:3], name="the subsystem")
V_rate = subsystem.derivative_along(V)
quadratic = (z.T * (P * A + A.T * P) * z)[0]
mixed = (z.T * (P * Lambda_t + Lambda_t.T * P) * z)[0]


@claim(
    "newton/5-V-derivative", "dV/dt along the subsystem",
    eq(quadratic / (1 + zPz) + grown * mixed / (1 + zPz) - b * grown**2, V_rate),
    place=STEP_3, uses=[shifted, positive_definite],
)  # fmt: skip
def derivative(goal: Goal) -> Evidence:
    """z̄ᵀPz̄ is not negative, so that the logarithm and the quotients are defined."""
    return exact(goal)


@claim(
    "newton/5-V-derivative-by-G", "dV/dt with −I and G put in",
    every(
        eq((-square + grown * zGz) / (1 + zPz) - b * grown**2, V_rate),
        eq((-square + grown * zGz - b * grown**2 * (1 + zPz)) / (1 + zPz), V_rate),
    ),
    labels=["eq:Vdot_temp"], uses=[derivative, lyapunov_equation, matrix_G],
)  # fmt: skip
def derivative_by_G(goal: Goal) -> Evidence:
    """Both lines."""
    return exact(goal)


@claim(
    "newton/5-quadratic-form-printed", "z̄ᵀPz̄ ≤ λ_min(P)‖z̄‖²", le(zPz, least * square), place=STEP_3,
    expected="refuted", grade="misprint", wrong="The least eigenvalue bounds z̄ᵀPz̄ from below, not from above.",
    survives="Yes: what is used after it is the bound from below.",
)  # fmt: skip
def quadratic_form_printed(goal: Goal) -> Evidence:
    """At z̄ = (1, 0)."""
    return refute(goal, {alpha: 1, omega_0: 1, z1: 1, z2: 0})


@claim(
    "newton/5-quadratic-form", "z̄ᵀPz̄ ≥ λ_min(P)‖z̄‖²", ge(zPz, least * square), place=STEP_3,
    uses=[least_of_P, least_positive], corrects=quadratic_form_printed,
)  # fmt: skip
def quadratic_form(goal: Goal) -> Evidence:
    """P − λ_min(P) I has the determinant 0 and a trace that is not negative."""
    return reals(goal)
