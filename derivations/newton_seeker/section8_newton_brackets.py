"""Appendix, Proposition 2: the brackets of the Newton seeker."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, claim, eq, exact, refute
from ptproof.system import lie_bracket

from .notation import F_star, F_z, H, alpha, d, nu, omega_d, z1, z2
from .section8_newton_average import PLACE, f1, f2, f3, state

SECTION = "Appendix: Proposition 2, the brackets"

AT = {F_star: 0, H: 1, alpha: 1, omega_d: 1, d: 1, nu: 1, z1: 0, z2: 1}


def nested(*fields: tuple[sp.Expr, ...]) -> sp.Matrix:
    """[[f, g], …] of two or three fields."""
    value = lie_bracket(fields[0], fields[1], state)
    return sp.Matrix(lie_bracket(value, fields[2], state) if len(fields) == 3 else value)


@claim(
    "newton/A2-bracket-12", "[f₁, f₂]", eq(sp.Matrix([0, d * alpha * H * z2, 0, 0]), nested(f1, f2)), place=PLACE,
)  # fmt: skip
def bracket_12(goal: Goal) -> Evidence:
    """As for the gradient seeker, times d."""
    return exact(goal)


third_13 = d**3 * 8 * H * omega_d * z2 * (F_z - nu) / alpha**2


@claim(
    "newton/A2-bracket-13-printed", "[f₁, f₃]",
    eq(sp.Matrix([0, -(d**2) * 8 * omega_d * ((F_z - F_star) ** 2 - nu) / alpha**2, third_13, 0]), nested(f1, f3)),
    place=f"{PLACE}, [f₁, f₃]", expected="refuted", grade="error",
    wrong="The second row of [f₁, f₃] has the wrong sign, and F* and ν in wrong places.",
    survives="Yes: the coefficient γ₁₃ of this bracket is zero.",
)  # fmt: skip
def bracket_13_printed(goal: Goal) -> Evidence:
    """Its second row is −(∂f₁/∂d) times the third row of f₃, which is not negative."""
    return refute(goal, AT)


@claim(
    "newton/A2-bracket-13", "[f₁, f₃] with (F(z) − ν)² in its second row",
    eq(sp.Matrix([0, d**2 * 8 * omega_d * (F_z - nu) ** 2 / alpha**2, third_13, 0]), nested(f1, f3)),
    place=PLACE, corrects=bracket_13_printed,
)  # fmt: skip
def bracket_13(goal: Goal) -> Evidence:
    """The third row is as printed."""
    return exact(goal)


@claim(
    "newton/A2-bracket-23", "[f₂, f₃]",
    eq(sp.Matrix([0, 0, d**2 * H * 8 * omega_d / alpha * z2, 0]), nested(f2, f3)), place=PLACE,
)  # fmt: skip
def bracket_23(goal: Goal) -> Evidence:
    """f₂ is constant."""
    return exact(goal)


@claim(
    "newton/A2-bracket-121", "[[f₁, f₂], f₁]",
    eq(sp.Matrix([0, H * alpha * d**2 * (nu - F_z) - alpha * (H * d * z2) ** 2, 0, 0]), nested(f1, f2, f1)),
    place=PLACE, uses=[bracket_12],
)  # fmt: skip
def bracket_121(goal: Goal) -> Evidence:
    """Its coefficient tends to 0."""
    return exact(goal)


@claim(
    "newton/A2-bracket-131-printed", "[[f₁, f₃], f₁]",
    eq(
        sp.Matrix([
            0,
            -16 * H * d**3 * omega_d * z2 / alpha**2 * (F_z - nu),
            8 * H * d**4 * (F_z - nu) / alpha**2 * (H * z2**2 - (F_z - nu)),
            0,
        ]),
        nested(f1, f3, f1),
    ),
    place=f"{PLACE}, [[f₁, f₃], f₁]", uses=[bracket_13], expected="refuted", grade="error",
    wrong="In [[f₁, f₃], f₁] the second row has the wrong sign and F(z) − ν instead of its square, and the third row "
    "lacks ω_d.",
    survives="Yes: the coefficient γ₁₃₁ of this bracket tends to 0.",
)  # fmt: skip
def bracket_131_printed(goal: Goal) -> Evidence:
    """The five rows that are printed, one of them empty, are taken as the four that are meant. At this witness the
    second row differs."""
    return refute(goal, AT)


@claim(
    "newton/A2-bracket-131", "[[f₁, f₃], f₁] corrected",
    eq(
        sp.Matrix([
            0,
            16 * H * d**3 * omega_d * z2 / alpha**2 * (F_z - nu) ** 2,
            8 * H * d**4 * omega_d * (F_z - nu) / alpha**2 * (H * z2**2 - (F_z - nu)),
            0,
        ]),
        nested(f1, f3, f1),
    ),
    place=PLACE, uses=[bracket_13], corrects=bracket_131_printed,
)  # fmt: skip
def bracket_131(goal: Goal) -> Evidence:
    """The two parts of the second row that come from (∂f₁/∂x) [f₁, f₃] cancel."""
    return exact(goal)


@claim(
    "newton/A2-bracket-232", "[[f₂, f₃], f₂]",
    eq(sp.Matrix([0, 0, -8 * omega_d * H * d**2, 0]), nested(f2, f3, f2)), place=PLACE, uses=[bracket_23],
)  # fmt: skip
def bracket_232(goal: Goal) -> Evidence:
    """With γ₂₃₂ = 1/8 it is the term −ω_d H d² of the averaged Riccati filter."""
    return exact(goal)
