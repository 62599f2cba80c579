"""Section 7.1: a field with a ripple, and a drift away from its peak."""

from __future__ import annotations

import sympy as sp

from ptproof.problem.drift import gradient_drift
from ptproof.proof import (
    Evidence,
    Exists,
    Goal,
    Relation,
    Smooth,
    claim,
    cosine_parabola,
    enclosures,
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
    sine_square,
    smooth,
    specialise,
)
from ptproof.system import gradient, jacobian

from .notation import E_norm, G, R, V, a1, a2, b1, b2, c, position, x1, x2
from .section7_clipping import half_unit

SECTION = "7.1 Simulation: vanishing drift"

norm_x = sp.sqrt(x1**2 + x2**2)


def norm(vector: sp.MatrixBase) -> sp.Expr:
    """The Euclidean norm of a real column."""
    return sp.sqrt(sum(entry**2 for entry in vector))


# --- The field --------------------------------------------------------------------------------------------------

field = sp.Rational("2.5") + sp.cos(2 * sp.pi / 3 * x1) / 2 - (x1**2 + x2**2) / 2
peak = sp.Integer(3)
origin = {x1: 0, x2: 0}
at_source = [eq(x1, 0), eq(x2, 0)]
slope = gradient(field, position)
wave = 2 * sp.pi / 3 * x1
upper, lower = sp.Rational(1, 2) + sp.pi**2 / 9, sp.Rational(1, 2)  # a₁, a₂
least, steepest = sp.Rational(1, 2), 1 + 2 * sp.pi**2 / 9  # b₁, b₂


@claim("7.1/peak", "The value at the source is 3", eq(field, peak), given=at_source, labels=["eq:exp_field"])
def peak_value(goal: Goal) -> Evidence:
    """F(0) = 2.5 + 0.5."""
    return exact(goal)


@claim(
    "7.1/maximum", "The origin is the only global maximum", lt(field, peak), given=[gt(x1**2 + x2**2, 0)],
    labels=["eq:exp_field"], uses=[peak_value],
)  # fmt: skip
def maximum(goal: Goal) -> Evidence:
    """The cosine is at most 1 and the rest falls with the distance."""
    return reals(goal)


@claim(
    "7.1/critical-point", "The gradient vanishes at the source", eq(slope, [0, 0]), given=at_source,
    labels=["eq:exp_field"],
)  # fmt: skip
def critical_point(goal: Goal) -> Evidence:
    """sin 0 = 0."""
    return exact(goal)


@claim("7.1/smooth", "The field is C²", Smooth((field,), position, 2), labels=["eq:exp_field"])
def smooth_field(goal: Goal) -> Evidence:
    """A polynomial plus a cosine."""
    return smooth(goal)


level = sp.Symbol("M", positive=True)


@claim(
    "7.1/radially-unbounded", "The field falls below every level far away", le(field, -level),
    given=[ge(x1**2 + x2**2, 2 * (level + 3))], labels=["eq:exp_field"],
)  # fmt: skip
def radially_unbounded(goal: Goal) -> Evidence:
    """F ≤ 3 − ‖x‖²/2."""
    return reals(goal)


@claim(
    "7.1/field-bounds", "The field lies between two paraboloids, everywhere",
    every(le(peak - upper * (x1**2 + x2**2), field), le(field, peak - lower * (x1**2 + x2**2))),
    labels=["eq:exp_field"],
)  # fmt: skip
def field_bounds(goal: Goal) -> Evidence:
    """With a₁ = 1/2 + π²/9, by 1 − u²/2 ≤ cos u, and a₂ = 1/2, by cos u ≤ 1; both are the best possible."""
    return reals(goal, cosine_parabola(wave))


@claim(
    "7.1/ripple", "The ripple never takes more than half of the slope", ge(x1 / 2 + sp.pi / 3 * sp.sin(wave), 0),
    given=[ge(x1, 0), le(x1, 3)], labels=["eq:exp_field"],
)  # fmt: skip
def ripple(goal: Goal) -> Evidence:
    """A cover of 0 ≤ x₁ ≤ 3, which contains the steepest descent of the ripple. Beyond, |sin| ≤ 1 is enough."""
    return enclosures(goal, {x1: (0, 3)})


@claim(
    "7.1/gradient-bounds", "The gradient lies between two cones, everywhere",
    every(le(least * norm_x, norm(slope)), le(norm(slope), steepest * norm_x)),
    labels=["eq:exp_field"], uses=[ripple],
)  # fmt: skip
def gradient_bounds(goal: Goal) -> Evidence:
    """With b₁ = 1/2, by the bound of the ripple on both sides of the source, and b₂ = 1 + 2π²/9, by |sin u| ≤ |u|."""
    return reals(goal, *specialise(goal, ripple, {x1: -x1}), sine_square(wave))


@claim(
    "7.1/assumption-2", "The field satisfies Assumption 2 on the whole plane with κ = 1",
    Exists(
        (a1, a2, b1, b2),
        (
            le(peak - a1 * (x1**2 + x2**2), field),
            le(field, peak - a2 * (x1**2 + x2**2)),
            le(b1 * norm_x, norm(slope)),
            le(norm(slope), b2 * norm_x),
        ),
        over=position,
    ),
    labels=["eq:exp_field", "eq:assumption2", "eq:assumption3"],
    uses=[field_bounds, gradient_bounds, maximum, critical_point, smooth_field, radially_unbounded],
)  # fmt: skip
def assumption_2(goal: Goal) -> Evidence:
    """Explicit constants for all four bounds."""
    return exists_by(goal, {a1: upper, a2: lower, b1: least, b2: steepest})


# --- The drift --------------------------------------------------------------------------------------------------

minus_identity = sp.ImmutableDenseMatrix([[-1, 0], [0, -1]])
drift = gradient_drift(minus_identity.tolist(), field, position)
derivative = jacobian(drift.rate, position)
derivative_at_source = derivative.subs(origin)
eigenvalue = sp.Symbol("lambda", real=True)
characteristic = eq((derivative_at_source - eigenvalue * sp.eye(2)).det(), 0)
printed_matrix = sp.ImmutableDenseMatrix([[2 * (sp.pi**2 / 9 + 1), 0], [0, 1]])
other_one = Relation(eigenvalue, "!=", sp.S.One)
largest = 2 * sp.pi**2 / 9 + 1


@claim(
    "7.1/drift-matrix", "The derivative of the drift at the source, as printed", eq(derivative, printed_matrix),
    given=at_source, labels=["eq:drift_term"], expected="refuted", grade="number",
    wrong="The factor 2 stands in front of the sum π²/9 + 1; it belongs to π²/9 alone.",
    survives="Yes: the drift is unstable with the right matrix as well, and no bound uses the number.",
)  # fmt: skip
def drift_matrix(goal: Goal) -> Evidence:
    """The factor 2 belongs to π²/9 alone: differentiating F twice, the quadratic term contributes 1, not 2."""
    return refute(goal, origin)


@claim(
    "7.1/drift-matrix-corrected", "The derivative of the drift at the source",
    eq(derivative, sp.ImmutableDenseMatrix([[2 * sp.pi**2 / 9 + 1, 0], [0, 1]])),
    given=at_source, labels=["eq:drift_term"], corrects=drift_matrix,
)  # fmt: skip
def drift_matrix_corrected(goal: Goal) -> Evidence:
    """Two derivatives of the field at the origin."""
    return exact(goal)


@claim(
    "7.1/eigenvalue-1", "λ₁ ≈ 4.19, as printed", le(sp.Abs(eigenvalue - sp.Rational("4.19")), half_unit),
    given=[characteristic, other_one], labels=["eq:drift_term"], expected="refuted", place="Section 7.1",
    grade="number", wrong="The eigenvalue is that of the matrix as printed; the drift has 2π²/9 + 1 ≈ 3.19.",
    survives="Yes: it is positive, which is all that is used.",
)  # fmt: skip
def eigenvalue_1(goal: Goal) -> Evidence:
    """This is the eigenvalue of the matrix as printed, not of the derivative of the drift."""
    return refute(goal, {eigenvalue: largest})


@claim(
    "7.1/eigenvalue-1-of-print", "4.19 is the eigenvalue of the matrix as printed",
    le(sp.Abs(printed_matrix[0, 0] - sp.Rational("4.19")), half_unit), labels=["eq:drift_term"],
)  # fmt: skip
def eigenvalue_1_of_print(goal: Goal) -> Evidence:
    """So the number follows from the slip in the matrix and is not a second one."""
    return enclosures(goal)


@claim(
    "7.1/eigenvalue-1-exact", "The eigenvalue that is not 1", eq(eigenvalue, largest),
    given=[characteristic, other_one], labels=["eq:drift_term"], uses=[drift_matrix_corrected],
)  # fmt: skip
def eigenvalue_1_exact(goal: Goal) -> Evidence:
    """The matrix is diagonal."""
    return reals(goal)


@claim(
    "7.1/eigenvalue-1-rounded", "2π²/9 + 1 rounds to 3.19", le(sp.Abs(largest - sp.Rational("3.19")), half_unit),
    labels=["eq:drift_term"],
)  # fmt: skip
def eigenvalue_1_rounded(goal: Goal) -> Evidence:
    """2π²/9 + 1 = 3.1932…"""
    return enclosures(goal)


@claim(
    "7.1/eigenvalue-1-corrected", "λ₁ ≈ 3.19", le(sp.Abs(eigenvalue - sp.Rational("3.19")), half_unit),
    given=[characteristic, other_one], labels=["eq:drift_term"], corrects=eigenvalue_1,
    uses=[eigenvalue_1_exact, eigenvalue_1_rounded], place="Section 7.1",
)  # fmt: skip
def eigenvalue_1_corrected(goal: Goal) -> Evidence:
    """The exact eigenvalue, rounded."""
    return reals(goal)


@claim(
    "7.1/eigenvalue-2", "λ₂ = 1 is an eigenvalue", characteristic, given=[eq(eigenvalue, 1)],
    labels=["eq:drift_term"], uses=[drift_matrix_corrected], place="Section 7.1",
)  # fmt: skip
def eigenvalue_2(goal: Goal) -> Evidence:
    """It makes the characteristic polynomial vanish."""
    return exact(goal)


@claim(
    "7.1/unstable", "The drift is unstable: all eigenvalues are positive", gt(eigenvalue, 0), given=[characteristic],
    labels=["eq:drift_term"], uses=[drift_matrix_corrected], place="Section 7.1",
)  # fmt: skip
def unstable(goal: Goal) -> Evidence:
    """The conclusion of the paper stands with the corrected numbers."""
    return reals(goal)


@claim(
    "7.1/drift-vanishes", "The drift vanishes at the source", eq(sp.Matrix(drift.rate), [0, 0]), given=at_source,
    place="Section 7.1", labels=["eq:drift_term"],
)  # fmt: skip
def drift_vanishes(goal: Goal) -> Evidence:
    """As E∇F with E = −I, it is of case A of Assumption 3."""
    return exact(goal)


@claim("7.1/drift-smooth", "The drift is C²", Smooth(drift.rate, position, 2), place="Section 7.1")
def drift_smooth(goal: Goal) -> Evidence:
    """As the field is C³."""
    return smooth(goal)


@claim(
    "7.1/k-too-small", "k = 1.8 does not satisfy the convergence condition, whatever the constants",
    le(sp.Rational("1.8"), 2 * (c(2, sp.S.One) / c(1, sp.S.One)) ** 2 * E_norm),
    given=[
        eq(E_norm, minus_identity.norm(2)), le(a2 * R**2, V), le(V, a1 * R**2), le(b1 * R, G), le(G, b2 * R),
    ],
    labels=["eq:convergence_cond"], place="Section 7.1",
)  # fmt: skip
def k_too_small(goal: Goal) -> Evidence:
    """Assumption 2 at a single point other than the source already gives a₂ ≤ a₁ and b₁ ≤ b₂, so that the
    threshold is at least 2‖E‖ = 2, for every choice of constants."""
    return reals(goal)
