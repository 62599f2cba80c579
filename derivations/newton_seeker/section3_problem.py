"""Section III: the unicycle and the field."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, claim, definition, eq, every, exact, le, reals

from .notation import F_star, F_x, H, I, position, rate_of, source, theta, x1, x2, xs1, xs2

SECTION = "III Unicycle source seeking problem"

u1, u2 = sp.symbols("u1 u2", real=True)
unicycle = definition(
    "newton/3-unicycle", "The unicycle",
    every(
        eq(sp.Matrix([rate_of("x1"), rate_of("x2")]), u1 * sp.Matrix([sp.cos(theta), sp.sin(theta)])),
        eq(rate_of("theta"), u2), eq(sp.Symbol("y", real=True), sp.Function("F", real=True)(x1, x2)),
    ),
    labels=["eq:unicycle_model", "eq:unicycle_with_drift-a"],
    prose="The inputs are forward and angular velocity; the start is any x₀ and θ₀ at any time t₀.",
)  # fmt: skip

field = definition(
    "newton/3-field", "Assumption 3: F(x) = F* − H‖x − x*‖²/2",
    eq(sp.Function("F", real=True)(x1, x2), F_star - sp.Rational(1, 2) * H * ((x1 - xs1) ** 2 + (x2 - xs2) ** 2)),
    labels=["eq:shapeofField", "ass:shape_of_field"], prose="H is positive and unknown.",
)  # fmt: skip


@claim(
    "newton/3-maximum", "The maximum is F*, at the source",
    every(le(F_x, F_star), eq(F_x.subs(dict(zip(position, source, strict=True))), F_star)),
    labels=["ass:shape_of_field"],
)  # fmt: skip
def maximum(goal: Goal) -> Evidence:
    """H is positive."""
    return reals(goal)


@claim(
    "newton/3-hessian", "The Hessian of the field is −H times the identity",
    eq(sp.Matrix(sp.hessian(F_x, position)), -H * I), labels=["ass:shape_of_field"],
)  # fmt: skip
def hessian(goal: Goal) -> Evidence:
    """What the paper calls the Hessian is this but for the sign."""
    return exact(goal)
