"""Section 7.2: a field that is quadratic near its peak and quartic far away, and a bounded drift."""

from __future__ import annotations

import sympy as sp

from ptproof.problem.drift import bounded_drift
from ptproof.proof import (
    Evidence,
    Goal,
    Smooth,
    claim,
    cosine_parabola,
    cosine_quartic,
    enclosures,
    eq,
    every,
    exact,
    ge,
    gt,
    le,
    lt,
    norm_below,
    power_monotone,
    reals,
    sine_cubic,
    sine_square,
    smooth,
    specialise,
)
from ptproof.system import gradient

from .notation import a1, kappa, position, t, x1, x2
from .section7a_vanishing import at_source, norm

SECTION = "7.2 Simulation: nonvanishing drift"

field = sp.cos(x1) + sp.cos(x2) - (x1**4 + x2**4) / 2
peak = sp.Integer(2)
slope = gradient(field, position)
square = x1**2 + x2**2
radius = sp.Symbol("rho", positive=True)


# --- The field ------------------------------------------------------------------------------------------------------


@claim(
    "7.2/peak", "The value at the source is 2", eq(field, peak), given=at_source,
    labels=["eq:nonvanish_drift_field_simulation"],
)  # fmt: skip
def peak_value(goal: Goal) -> Evidence:
    """F(0) = 1 + 1."""
    return exact(goal)


@claim(
    "7.2/maximum", "The origin is the only global maximum", lt(field, peak), given=[gt(square, 0)],
    labels=["eq:nonvanish_drift_field_simulation"], uses=[peak_value],
)  # fmt: skip
def maximum(goal: Goal) -> Evidence:
    """Both cosines are at most 1 and the quartic part is negative."""
    return reals(goal)


@claim(
    "7.2/critical-point", "The gradient vanishes at the source", eq(slope, [0, 0]), given=at_source,
    labels=["eq:nonvanish_drift_field_simulation"],
)  # fmt: skip
def critical_point(goal: Goal) -> Evidence:
    """sin 0 = 0."""
    return exact(goal)


@claim("7.2/smooth", "The field is C²", Smooth((field,), position, 2), labels=["eq:nonvanish_drift_field_simulation"])
def smooth_field(goal: Goal) -> Evidence:
    """A polynomial plus two cosines."""
    return smooth(goal)


level = sp.Symbol("M", positive=True)


@claim(
    "7.2/radially-unbounded", "The field falls below every level far away", le(field, -level),
    given=[ge(square, level + 4)], labels=["eq:nonvanish_drift_field_simulation"],
)  # fmt: skip
def radially_unbounded(goal: Goal) -> Evidence:
    """F ≤ 2 − (x₁⁴ + x₂⁴)/2 ≤ 2 − ‖x‖⁴/4."""
    return reals(goal)


# --- Assumption 2 ---------------------------------------------------------------------------------------------------


def _upper(order: sp.Expr) -> sp.Expr:
    """F(x*) − a₁ ‖x‖^{2κ}, which the first half of eq:assumption2 puts below the field."""
    return peak - a1 * square**order


far = sp.sqrt(2 * a1 + 1)
near = 1 / (2 * a1 + 1)


@claim(
    "7.2/assumption-2-quadratic", "No paraboloid lies below the field on the whole plane",
    lt(field.subs({x1: far, x2: 0}), _upper(sp.S.One).subs({x1: far, x2: 0})),
    labels=["eq:nonvanish_drift_field_simulation", "eq:assumption2"], place="Section 7.2",
)  # fmt: skip
def quadratic(goal: Goal) -> Evidence:
    """The field falls like a fourth power: for each a₁ the bound of Assumption 2 with κ = 1 fails at x₁ = √(2a₁ + 1).
    The paper calls on Assumption 3 here, and on Assumption 2 only for what it derives from it, which is then local."""
    return reals(goal)


@claim(
    "7.2/assumption-2-higher", "Nor does a higher even power of the distance",
    lt(field.subs({x1: near, x2: 0}), _upper(kappa).subs({x1: near, x2: 0})), given=[ge(kappa, 2)],
    labels=["eq:nonvanish_drift_field_simulation", "eq:assumption2"], place="Section 7.2",
)  # fmt: skip
def higher(goal: Goal) -> Evidence:
    """The peak is as sharp as that of a paraboloid: for each κ ≥ 2 and a₁ the bound fails close to it, at
    x₁ = 1/(2a₁ + 1)."""
    return reals(goal, cosine_quartic(near), power_monotone(near**2, sp.S.One, kappa - 2))


inside = [le(square, radius**2)]
steepest = 1 + 2 * radius**2  # b₂


@claim(
    "7.2/field-lower", "The field stays below a paraboloid, everywhere", le(field, peak - square / 2),
    labels=["eq:nonvanish_drift_field_simulation", "eq:assumption2"],
)  # fmt: skip
def field_lower(goal: Goal) -> Evidence:
    """With a₂ = 1/2, since cos u ≤ 1 − u²/2 + u⁴/24 and the quartic part of the field outweighs u⁴/24. The
    field has a quadratic peak, so κ = 1 is the only order that fits at the source."""
    return reals(goal, cosine_quartic(x1), cosine_quartic(x2))


@claim(
    "7.2/field-upper", "On every disc the field stays above a paraboloid",
    le(peak - (1 + radius**2) / 2 * square, field), given=inside,
    labels=["eq:nonvanish_drift_field_simulation", "eq:assumption2"],
)  # fmt: skip
def field_upper(goal: Goal) -> Evidence:
    """With a₁ = (1 + ρ²)/2 on the disc of radius ρ: a constant that grows with the disc."""
    return reals(goal, cosine_parabola(x1), cosine_parabola(x2))


@claim(
    "7.2/slope-along-axis", "Along one axis the slope is at least the distance", ge(sp.sin(x1) + 2 * x1**3, x1),
    given=[ge(x1, 0)], labels=["eq:nonvanish_drift_field_simulation"],
)  # fmt: skip
def slope_along_axis(goal: Goal) -> Evidence:
    """sin u ≥ u − u³/6, and 2u³ makes up for u³/6."""
    return reals(goal, sine_cubic(x1))


@claim(
    "7.2/gradient-lower", "The gradient is at least as large as the distance, everywhere",
    le(sp.sqrt(square), norm(slope)), labels=["eq:nonvanish_drift_field_simulation", "eq:assumption3"],
    uses=[slope_along_axis],
)  # fmt: skip
def gradient_lower(goal: Goal) -> Evidence:
    """With b₁ = 1, entry by entry, by the oddness of each."""
    signs = ({x1: x1}, {x1: -x1}, {x1: x2}, {x1: -x2})
    return reals(goal, *(fact for values in signs for fact in specialise(goal, slope_along_axis, values)))


@claim(
    "7.2/slope-along-axis-upper", "Along one axis the slope is at most a multiple of the distance",
    le(slope[0] ** 2, steepest**2 * x1**2), given=[le(x1**2, radius**2)],
    labels=["eq:nonvanish_drift_field_simulation"],
)  # fmt: skip
def slope_along_axis_upper(goal: Goal) -> Evidence:
    """By |sin u| ≤ |u|."""
    return reals(goal, sine_square(x1))


@claim(
    "7.2/gradient-upper", "On every disc the gradient is at most a multiple of the distance",
    le(norm(slope), steepest * sp.sqrt(square)), given=inside,
    labels=["eq:nonvanish_drift_field_simulation", "eq:assumption3"], uses=[slope_along_axis_upper],
)  # fmt: skip
def gradient_upper(goal: Goal) -> Evidence:
    """With b₂ = 1 + 2ρ² on the disc of radius ρ, entry by entry."""
    other_axis = specialise(goal, slope_along_axis_upper, {x1: x2})
    return reals(goal, *other_axis, norm_below(list(slope), steepest, position))


@claim(
    "7.2/assumption-2-on-discs", "Both bounds of Assumption 2 on every disc, with κ = 1",
    every(
        le(peak - (1 + radius**2) / 2 * square, field),
        le(field, peak - square / 2),
        le(sp.sqrt(square), norm(slope)),
        le(norm(slope), steepest * sp.sqrt(square)),
    ),
    given=inside, labels=["eq:nonvanish_drift_field_simulation", "eq:assumption2", "eq:assumption3"],
    place="Section 7.2",
    uses=[field_upper, field_lower, gradient_lower, gradient_upper, maximum, critical_point, smooth_field],
)  # fmt: skip
def on_discs(goal: Goal) -> Evidence:
    """With a₁ = (1 + ρ²)/2, a₂ = 1/2, b₁ = 1 and b₂ = 1 + 2ρ² on the disc of radius ρ about the source. So what the
    paper derives from the assumption holds locally for this example, as it remarks for such fields in Section 6; the
    start, at distance √2, lies inside for every ρ > √2."""
    return reals(goal)


# --- The drift ------------------------------------------------------------------------------------------------------

beat = 1 + sp.sin(3 * t)
drift = bounded_drift((beat * sp.cos(x1), beat * sp.cos(x2)), bound=sp.sqrt(2) * beat)
strength = norm(sp.Matrix(drift.rate))
largest_bound = 2 * sp.sqrt(2)


@claim(
    "7.2/drift-bound", "The drift is bounded by d(t), and d(t) by 2√2",
    every(le(strength, sp.sqrt(2) * (1 + sp.sin(3 * t))), le(sp.sqrt(2) * (1 + sp.sin(3 * t)), largest_bound)),
    labels=["eq:nonvanish_drift"],
)  # fmt: skip
def drift_bound(goal: Goal) -> Evidence:
    """As cosines and sines are at most 1: case B of Assumption 3, with a bound that holds at all times. The cosine of
    the vector x is read entry by entry."""
    return reals(goal)


@claim(
    "7.2/drift-bound-attained", "The bound 2√2 is attained at the source within the prescribed time",
    eq(strength, largest_bound), given=[eq(t, sp.pi / 6), *at_source], labels=["eq:nonvanish_drift"],
)  # fmt: skip
def drift_bound_attained(goal: Goal) -> Evidence:
    """At t = π/6."""
    return exact(goal)


@claim(
    "7.2/drift-nonvanishing", "The drift does not vanish at the source",
    eq(sp.Matrix(drift.rate), [1, 1]), given=[eq(t, 0), *at_source], labels=["eq:nonvanish_drift"],
)  # fmt: skip
def drift_nonvanishing(goal: Goal) -> Evidence:
    """It is (1, 1) there at the start, so that it is not of the class E∇F."""
    return exact(goal)


@claim(
    "7.2/drift-pauses", "At one instant the drift does vanish",
    eq(sp.Matrix(drift.rate), [0, 0]), given=[eq(t, sp.pi / 2)], labels=["eq:nonvanish_drift"],
)  # fmt: skip
def drift_pauses(goal: Goal) -> Evidence:
    """At t = π/2, inside the prescribed time, it is zero everywhere; "nonvanishing" is meant as opposed to case A."""
    return exact(goal)


@claim(
    "7.2/drift-instants", "Both instants lie within the prescribed time", every(lt(sp.pi / 6, 2), lt(sp.pi / 2, 2)),
    labels=["eq:nonvanish_drift"],
)  # fmt: skip
def drift_instants(goal: Goal) -> Evidence:
    """With T = 2, as π < 4."""
    return enclosures(goal)


@claim(
    "7.2/drift-smooth", "The drift is C² in time and position", Smooth(drift.rate, (t, *position), 2),
    labels=["eq:nonvanish_drift"],
)  # fmt: skip
def drift_smooth(goal: Goal) -> Evidence:
    """Products of sines and cosines."""
    return smooth(goal)
