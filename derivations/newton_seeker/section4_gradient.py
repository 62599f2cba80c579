"""Section IV: the gradient seeker, the rotating frame, and its averaged system."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, ForAll, Goal, claim, definition, eq, every, exact, refute

from . import chain
from .notation import (
    HALF,
    J_0,
    F_star,
    F_x,
    F_z,
    H,
    I,
    Lambda,
    Y,
    alpha_t,
    c,
    field_at,
    h,
    letter,
    nu,
    omega,
    omega_0,
    position,
    rate_of,
    rotated,
    source,
    t,
    z,
    z1,
    z2,
)  # fmt: skip
from .section2_preliminaries import s
from .section8_gradient_average import bounded, form, means, pairs, powers, quadruples, triples

SECTION = "IV Gradient-based source seeking"

ahead = sp.Matrix([sp.cos(omega_0 * t), sp.sin(omega_0 * t)])
second = sp.Matrix([0, 1])
offset = sp.Matrix(position) - sp.Matrix(source)


def forward(field: sp.Expr, gain: sp.Expr = c) -> sp.Expr:
    """The forward velocity u₁ as printed."""
    return gain * (field - nu) * sp.sin(omega * t) + alpha_t * sp.cos(omega * t)


law = definition(
    "newton/4-law", "The gradient seeker",
    every(
        eq(sp.Symbol("u1", real=True), forward(F_x)), eq(sp.Symbol("u2", real=True), omega_0),
        eq(rate_of("nu"), h * (F_x - nu)),
    ),
    labels=["eq:gradient_seeker_control_law"], prose="Due to Zhang and others.",
)  # fmt: skip


@claim(
    "newton/4-closed-loop", "The closed loop with θ = ω₀t",
    eq(sp.Matrix([*(forward(F_x) * ahead), h * (F_x - nu)]), chain.gradient.vector), labels=["eq:gradient_seeker"],
)  # fmt: skip
def closed_loop(goal: Goal) -> Evidence:
    """The heading is solved for and put in."""
    return exact(goal)


_heading = sp.Function("theta", real=True)
_turns = ForAll((s,), eq(sp.Derivative(_heading(s), s), omega_0))


@claim(
    "newton/4-heading-printed", "dθ/dt = ω₀ gives θ = ω₀t",
    eq(_heading(t), omega_0 * t), given=[_turns], place="Section IV", expected="refuted", grade="wording",
    wrong="dθ/dt = ω₀ alone does not give θ = ω₀t: in Section III the start is at any time with any orientation.",
    survives="Yes: with the frame turned by the same angle the closed loop in z is the same.",
)  # fmt: skip
def heading_printed(goal: Goal) -> Evidence:
    """θ(t) = ω₀t + 1 is as good a solution."""
    return refute(goal, {_heading(s): s + 1, omega_0: 1, t: 0})


in_z_printed = sp.Matrix([*(J_0 * z + forward(F_z) * second), h * (F_z - nu)])


@claim(
    "newton/4-any-heading", "From every orientation θ₀ and time t₀ the closed loop is the same in the frame at θ",
    eq(in_z_printed, chain.gradient_from_any_heading.vector), place="Section IV", corrects=heading_printed,
)  # fmt: skip
def any_heading(goal: Goal) -> Evidence:
    """θ = θ₀ + ω₀(t − t₀) solves the heading's equation, and Y is taken at that angle instead of ω₀t."""
    return exact(goal)


# --- The rotating frame ----------------------------------------------------------------------------------------------


@claim(
    "newton/4-rotation-undone", "z = Yᵀ(x − x*) and x − x* = Yz undo each other",
    every(eq(Y() * (Y().T * offset), offset), eq(Y().T * (Y() * z), z)),
    labels=["eq:z_transformation", "eq-inverse-of-x-to-z"],
)  # fmt: skip
def rotation_undone(goal: Goal) -> Evidence:
    """Y is orthogonal."""
    return exact(goal)


@claim(
    "newton/4-inverse", "x − x* = Yz for z = Yᵀ(x − x*)", eq(offset, Y() * z),
    given=[eq(own, entry) for own, entry in zip(rotated, Y().T * offset, strict=True)],
    labels=["eq:z_transformation", "eq-inverse-of-x-to-z"],
)  # fmt: skip
def inverse(goal: Goal) -> Evidence:
    """z put in."""
    return exact(goal)


@claim(
    "newton/4-orthogonal", "YᵀY = YYᵀ = I", every(eq(Y().T * Y(), I), eq(Y() * Y().T, I)), place="Section IV",
)  # fmt: skip
def orthogonal(goal: Goal) -> Evidence:
    """sin² + cos² = 1."""
    return exact(goal)


@claim(
    "newton/4-rotation-rate", "dYᵀ/dt = Yᵀ J₀", eq(sp.diff(Y().T, t), Y().T * J_0), labels=["eq:J_0_def"],
)  # fmt: skip
def rotation_rate(goal: Goal) -> Evidence:
    """The frame turns with ω₀."""
    return exact(goal)


@claim("newton/4-generator", "YᵀJ₀Y = J₀", eq(Y().T * J_0 * Y(), J_0), place="Section IV")
def generator(goal: Goal) -> Evidence:
    """Rotations of the plane commute."""
    return exact(goal)


@claim(
    "newton/4-field-in-z", "F is F* − H‖z‖²/2",
    eq(F_star - HALF * H * (z1**2 + z2**2), F_x.subs(dict(zip(position, sp.Matrix(source) + Y() * z, strict=True)))),
    place="Section IV", uses=[orthogonal],
)  # fmt: skip
def field_in_z(goal: Goal) -> Evidence:
    """A rotation does not change the distance."""
    return exact(goal)


_X = [sp.Function(f"x_{i}", real=True)(t) for i in (1, 2)]
_moved = sp.Matrix(_X) - sp.Matrix(source)


@claim(
    "newton/4-product-rule", "dz/dt = (dYᵀ/dt)(x − x*) + Yᵀ dx/dt",
    eq(sp.diff(Y().T, t) * _moved + Y().T * sp.diff(sp.Matrix(_X), t), sp.diff(Y().T * _moved, t)),
    place="Section IV",
)  # fmt: skip
def product_rule(goal: Goal) -> Evidence:
    """For every differentiable x(t)."""
    return exact(goal)


@claim(
    "newton/4-in-z", "The closed loop in z", eq(in_z_printed, chain.gradient_in_z.vector),
    labels=["eq:gradient_seeker_in_z"],
    uses=[closed_loop, rotation_undone, rotation_rate, generator, field_in_z, product_rule],
)  # fmt: skip
def in_z(goal: Goal) -> Evidence:
    """Yᵀ takes (cos ω₀t, sin ω₀t) to (0, 1)."""
    return exact(goal)


# --- Proposition 1 ---------------------------------------------------------------------------------------------------


@claim(
    "newton/4-average", "Proposition 1: the averaged gradient seeker",
    eq(sp.Matrix([*((J_0 + Lambda) * z), h * (F_z - nu)]), chain.gradient_averaged.vector),
    labels=["eq:LBS_gradient_seeker", "prop:average_gradient_seeker", "eq:Lambda_def"],
    uses=[in_z, form, powers, means, bounded, pairs, triples, quadruples],
)  # fmt: skip
def average_gradient(goal: Goal) -> Evidence:
    """The end of the pipeline, for all p with exponents between 0 and 1; z and ν stand for their averages."""
    return exact(goal)


zb1, zb2 = (letter(f"zb{i}", rf"\bar{{z}}_{i}", "m", "z, averaged, beside z itself") for i in (1, 2))


@claim(
    "newton/4-field-of-average-printed", "F(z̄) = F* − H‖z‖²/2, as printed",
    eq(F_star - HALF * H * (z1**2 + z2**2), field_at(zb1, zb2)), labels=["eq:field_in_z"],
    expected="refuted", grade="misprint", wrong="F(z̄) is written with z where z̄ is meant.",
    survives="Yes: everything after it uses F at z̄.",
)  # fmt: skip
def field_of_average_printed(goal: Goal) -> Evidence:
    """z belongs to the closed loop, z̄ to its average; the same bar is missing where r is introduced."""
    return refute(goal, {F_star: 0, H: 1, z1: 1, z2: 0, zb1: 0, zb2: 0})


@claim(
    "newton/4-field-of-average", "F(z̄) = F* − H‖z̄‖²/2",
    eq(F_star - HALF * H * (zb1**2 + zb2**2), F_z.subs(dict(zip(rotated, (zb1, zb2), strict=True)))),
    labels=["eq:field_in_z"], corrects=field_of_average_printed,
)  # fmt: skip
def field_of_average(goal: Goal) -> Evidence:
    """The field in z at z̄."""
    return exact(goal)
