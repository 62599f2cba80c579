"""Section 3: the unicycle, the field and the drift, and what follows from their assumptions at once."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, claim, definition, eq, every, gt, le, lt, power_positive, reals, specialise

from .notation import E11, E12, E21, E22, E, E_norm, F, F_source, R, a1, a2, b1, b2, f, kappa, rate_of, t, theta

SECTION = "3 Problem statement"

u1_input, u2_input, y = (sp.Symbol(name, real=True) for name in ("u1", "u2", "y"))

unicycle_position = definition(
    "3/unicycle-position", "The position of the unicycle under a drift",
    eq(sp.Matrix([rate_of("x_1", t), rate_of("x_2", t)]),
       sp.Matrix([f[0] + u1_input * sp.cos(theta), f[1] + u1_input * sp.sin(theta)])),
    labels=["eq:unicycle_with_drift", "eq:unicycle_with_drift-a"],
    prose="Forward velocity u₁ along the heading, plus the drift.",
)  # fmt: skip
unicycle_heading = definition(
    "3/unicycle-heading", "Heading and measurement", every(eq(rate_of("theta", t), u2_input), eq(y, F)),
    labels=["eq:unicycle_with_drift"], prose="The heading is actuated by u₂; the field is measured at the vehicle.",
)  # fmt: skip

# Assumption 2, with one symbol for the distance ‖x − x*‖ and one for the norm of the gradient.
F_value = sp.Symbol("F_x", real=True)
G = sp.Symbol("G", nonnegative=True)
lower_field = le(F_source - a1 * R ** (2 * kappa), F_value)
upper_field = le(F_value, F_source - a2 * R ** (2 * kappa))
lower_gradient = le(b1 * R ** (2 * kappa - 1), G)
upper_gradient = le(G, b2 * R ** (2 * kappa - 1))

field_bounds = definition(
    "3/field-bounds", "Assumption 2: the field between even powers of the distance", every(lower_field, upper_field),
    labels=["eq:assumption2"], prose="The constants a₁, a₂ and the order κ are not known to the vehicle.",
)  # fmt: skip
gradient_bounds = definition(
    "3/gradient-bounds", "Assumption 2: the gradient between odd powers of the distance",
    every(lower_gradient, upper_gradient), labels=["eq:assumption3"],
    prose="At the source itself both bounds are 0.",
)  # fmt: skip


@claim(
    "3/constants-ordered", "The constants are ordered: a₂ ≤ a₁ and b₁ ≤ b₂", every(le(a2, a1), le(b1, b2)),
    given=[lower_field, upper_field, lower_gradient, upper_gradient], labels=["eq:assumption2", "eq:assumption3"],
)  # fmt: skip
def constants_ordered(goal: Goal) -> Evidence:
    """One point away from the source is enough: there the lower bound must not exceed the upper one."""
    return reals(goal)


@claim(
    "3/source-is-maximum", "Away from the source the field is smaller and its gradient does not vanish",
    every(lt(F_value, F_source), gt(G, 0)), given=[upper_field, lower_gradient],
    labels=["eq:assumption2", "eq:assumption3"],
)  # fmt: skip
def source_is_maximum(goal: Goal) -> Evidence:
    """So the maximum is strict and the source is the only critical point."""
    return reals(goal, power_positive(R, 2 * kappa), power_positive(R, 2 * kappa - 1))


# The spectral norm: the largest singular value, as a formula in the entries.
m11, m12, m22 = E11**2 + E21**2, E11 * E12 + E21 * E22, E12**2 + E22**2
spectral_norm_squared = (m11 + m22 + sp.sqrt((m11 - m22) ** 2 + 4 * m12**2)) / 2
g1, g2 = sp.symbols("g1 g2", real=True)
_a, _b, _c = sp.symbols("m11 m12 m22", real=True)


@claim(
    "3/quadratic-form", "A symmetric form is at most its larger eigenvalue times the square of the length",
    le(
        _a * g1**2 + 2 * _b * g1 * g2 + _c * g2**2,
        (_a + _c + sp.sqrt((_a - _c) ** 2 + 4 * _b**2)) / 2 * (g1**2 + g2**2),
    ),
    place="Step 4, case ii",
)  # fmt: skip
def quadratic_form(goal: Goal) -> Evidence:
    """The eigenvalue is written out for two dimensions, with one symbol for each entry of the form."""
    return reals(goal)


@claim(
    "3/spectral-norm", "‖E g‖² ≤ ‖E‖² ‖g‖²",
    le(sum(entry**2 for entry in E * sp.Matrix([g1, g2])), spectral_norm_squared * (g1**2 + g2**2)),
    uses=[quadratic_form], place="Step 4, case ii",
)  # fmt: skip
def spectral_norm(goal: Goal) -> Evidence:
    """‖Eg‖² is the form of EᵀE, so the bound for quadratic forms is used at the entries of EᵀE."""
    return reals(goal, *specialise(goal, quadratic_form, {_a: m11, _b: m12, _c: m22}))


h1_drift, h2_drift = sp.symbols("h_1 h_2", real=True)


@claim(
    "3/drift-against-the-gradient", "For a drift h of at most ‖E‖‖g‖ the product g·h is at most ‖E‖‖g‖² in size",
    every(
        le(-(g1 * h1_drift + g2 * h2_drift), E_norm * (g1**2 + g2**2)),
        le(g1 * h1_drift + g2 * h2_drift, E_norm * (g1**2 + g2**2)),
    ),
    given=[le(h1_drift**2 + h2_drift**2, E_norm**2 * (g1**2 + g2**2))], place="Step 4, case ii", uses=[spectral_norm],
)  # fmt: skip
def against_gradient(goal: Goal) -> Evidence:
    """The inequality of Cauchy and Schwarz for the gradient g and the drift h = Eg."""
    return reals(goal)
