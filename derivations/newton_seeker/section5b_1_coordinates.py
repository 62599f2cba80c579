"""Section V.B, Steps 1 and 2: ln d, the averaged system, and the shift to the origin."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, claim, definition, eq, every, exact, gt, refute

from . import chain
from .notation import (
    J_0,
    F_star,
    F_z,
    H,
    Lambda,
    Lambda_t,
    alpha_t,
    c,
    d_h,
    d_plus,
    d_t,
    h,
    letter,
    nu,
    omega,
    omega_0,
    omega_d,
    r,
    t,
    z,
    z1,
    z2,
)  # fmt: skip
from .section4_gradient import forward, second
from .section5a_design import in_z

SECTION = "V.B Newton-based source seeking: analysis, Steps 1 and 2"
STEP_1, STEP_2 = "Section V.B, Step 1", "Section V.B, Step 2"

logarithm = definition(
    "newton/5-logarithm", "d̃ = ln d, for d > 0", every(eq(d_t, sp.log(d_plus)), gt(d_plus, 0)),
    labels=["eq-d-to-dtilde"], prose="It leaves out the unstable point d = 0 of the Riccati filter.",
)  # fmt: skip
in_logarithm_printed = sp.Matrix(
    [
        *(J_0 * z + forward(F_z, c * sp.exp(d_t)) * second),
        omega_d * (1 - sp.exp(d_t) * 8 * omega**2 / alpha_t**2 * (F_z - nu) * sp.cos(2 * omega * t)),
        h * (F_z - nu),
    ]
)


@claim(
    "newton/5-in-logarithm", "The closed loop in z and d̃", eq(in_logarithm_printed, chain.logarithmic.vector),
    labels=["eq:newton_seeker_in_z_and_d"], uses=[in_z],
)  # fmt: skip
def in_logarithm(goal: Goal) -> Evidence:
    """The rate of ln d is that of d over d, where d is positive."""
    return exact(goal)


@claim(
    "newton/5-average-in-logarithm", "The averaged system in d̃",
    eq(
        sp.Matrix([*((J_0 + Lambda * sp.exp(d_t)) * z), omega_d * (1 - H * sp.exp(d_t)), h * (F_z - nu)]),
        chain.logarithmic_averaged.vector,
    ),
    labels=["eq:LBS_newton_seeker_exp"], uses=[in_logarithm],
)  # fmt: skip
def average_in_logarithm(goal: Goal) -> Evidence:
    """Averaged anew, for all p between 1/2 and 1."""
    return exact(goal)


@claim(
    "newton/5-change-and-average", "It is the averaged Newton seeker with d = e^d̃",
    every(
        eq(chain.newton_averaged.rhs[2].subs(sp.Symbol("d", real=True), sp.exp(d_t)) / sp.exp(d_t),
           chain.logarithmic_averaged.rhs[2]),
        eq(chain.newton_averaged.rhs[1].subs(sp.Symbol("d", real=True), sp.exp(d_t)),
           chain.logarithmic_averaged.rhs[1]),
    ),
    place=STEP_2, uses=[average_in_logarithm],
)  # fmt: skip
def change_and_average(goal: Goal) -> Evidence:
    """Averages of the same motion in two coordinates."""
    return exact(goal)


@claim(
    "newton/5-lambda", "Λ̃ = H⁻¹Λ", eq(Lambda_t, Lambda / H), place=STEP_2,
)  # fmt: skip
def lambda_tilde(goal: Goal) -> Evidence:
    """It does not depend on H."""
    return exact(goal)


d_tb = letter("d_tb", r"\bar{\tilde{d}}", "1", "d̃, averaged, beside d̃ itself")
nu_b = letter("nu_b", r"\bar{\nu}", "[F]", "ν, averaged, beside ν itself")
shift = definition(
    "newton/5-shift", "d̂ is d̃, averaged, less ln(1/H), and r is ν̄ − F(z̄)",
    every(eq(d_h, d_tb - sp.log(1 / H)), eq(r, nu_b - F_z)), labels=[],
    prose="Printed with F(z), as here; z̄ is meant, as in newton/4-field-of-average.",
)  # fmt: skip


@claim(
    "newton/5-shifted", "The averaged system at the origin",
    eq(
        sp.Matrix([
            *((J_0 + Lambda_t) * z + (sp.exp(d_h) - 1) * Lambda_t * z),
            -omega_d * (sp.exp(d_h) - 1),
            -h * r + H * (z.T * (J_0 + Lambda_t * sp.exp(d_h)) * z)[0],
        ]),
        chain.shifted.vector,
    ),
    labels=["eq:LBS_newton_seeker_exp_origin", "eq:sub_r", "eq:sub_z", "eq:sub_d"],
    uses=[average_in_logarithm, lambda_tilde],
)  # fmt: skip
def shifted(goal: Goal) -> Evidence:
    """By change of variables from the averaged system; its rows in the order of z̄, d̂, r."""
    return exact(goal)


@claim(
    "newton/5-origin", "The origin is an equilibrium of it",
    eq(sp.Matrix([0, 0, 0, 0]), chain.shifted.vector.subs({z1: 0, z2: 0, d_h: 0, r: 0})), place=STEP_2, uses=[shifted],
)  # fmt: skip
def origin(goal: Goal) -> Evidence:
    """All rates are zero there."""
    return exact(goal)


_at = {z1: 0, z2: 0, d_t: sp.log(1 / H), nu: F_star}


@claim(
    "newton/5-equilibrium-printed", "z = 0, d̃ = ln(1/H), ν = F* is an equilibrium of the closed loop in z and d̃",
    eq(sp.Matrix([0, 0, 0, 0]), chain.logarithmic.vector.subs(_at)), place="Section V.B, Step 4",
    expected="refuted", grade="wording",
    wrong="The point is called an equilibrium of the closed loop in z and d̃, which does not rest there.",
    survives="Yes: it is an equilibrium of the averaged system, and sGPUAS is a property of a point.",
)  # fmt: skip
def equilibrium_printed(goal: Goal) -> Evidence:
    """There dz₂/dt = α̃ cos ωt and dd̃/dt = ω_d."""
    return refute(goal, {t: 0, omega: 1, omega_0: 1, omega_d: 1, alpha_t: 1, H: 1, F_star: 0, c: 1, h: 1})


@claim(
    "newton/5-equilibrium-of-average", "It is one of the averaged system in d̃",
    eq(sp.Matrix([0, 0, 0, 0]), chain.logarithmic_averaged.vector.subs(_at)), place="Section V.B, Step 4",
    uses=[average_in_logarithm], corrects=equilibrium_printed,
)  # fmt: skip
def equilibrium_of_average(goal: Goal) -> Evidence:
    """e^(ln(1/H)) = 1/H."""
    return exact(goal)
