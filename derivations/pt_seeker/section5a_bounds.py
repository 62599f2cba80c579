"""Section 5, Assumption 1 for the drift term b₀ of the seeker, on I_τ."""

from __future__ import annotations

import sympy as sp

from ptproof.problem.drift import gradient_drift
from ptproof.proof import (
    Evidence,
    Exists,
    Goal,
    Smooth,
    claim,
    defeats_every_choice,
    eq,
    every,
    exact,
    ge,
    gt,
    le,
    limits,
    reals,
    smooth,
)

from . import chain
from .notation import IN_TAU, IN_TIME, E, F, T, f, nu, position, t, t0, tau, x1, x2, z
from .section5a_1_reduction import f_tau, quasi_steady_state, quasi_steady_state_solves, stretch
from .section5a_1b_general_form import b0, general_form
from .section5a_2_averaging import drift_brace
from .section5a_4_assumption_1 import (
    arguments,
    assumption_a,
    assumption_b_bracket,
    assumption_b_field_derivatives,
    assumption_b_fields,
    assumption_c,
    assumption_d_mean,
    assumption_d_period,
    assumption_e,
    assumption_f,
    bounds_are_continuous,
    layer_function,
    norm,
)  # fmt: skip

SECTION = "5.1 Theorem, Steps 1 to 3: Assumption 1"

A = sp.Symbol("A", positive=True)


@claim(
    "5/assumption-b-drift-printed", "Assumption 1B asks for a bound of b₀ at every real τ",
    Exists((A,), (le(1 / stretch**2, A),), over=(tau,)), place="Assumption 1B", expected="refuted", grade="hypothesis",
    wrong="The bounds are asked for all real τ; with a drift, b₀ has a pole at τ = t₀ − T.",
    survives="Yes: the system is started at t₀, and for τ ≥ t₀ the bounds hold.",
)  # fmt: skip
def assumption_b_drift_printed(goal: Goal) -> Evidence:
    """b₀ = f/(1 + (τ − t₀)/T)² has a pole at τ = t₀ − T, so with a drift the assumption fails as it is written, for all
    τ in ℝ. The theorem is applied on τ ≥ t₀ only, where it holds."""
    return defeats_every_choice(goal, {tau: t0 - T + T / (A + 1)})


@claim(
    "5/assumption-b-drift", "Assumption 1B on I_τ: b₀ is at most the drift",
    le(norm(b0), norm(f_tau)), given=IN_TAU,
    place="Assumption 1B", uses=[general_form], corrects=assumption_b_drift_printed,
)  # fmt: skip
def assumption_b_drift(goal: Goal) -> Evidence:
    """From the initial time on the factor is at most 1. For f = E∇F this is a continuous function of x alone; for a
    drift below d(t) it is at most the largest d."""
    return reals(goal)


@claim(
    "5/assumption-a-drift", "Assumption 1A on I_τ: b₀ is twice continuously differentiable for a drift in C²",
    Smooth(b0, arguments, 2, tuple((entry, 2) for entry in f)),
    given=IN_TAU, place="Assumption 1A", uses=[drift_brace],
)  # fmt: skip
def assumption_a_drift(goal: Goal) -> Evidence:
    """Assumption 3 takes f in C². It is taken at the instant t that belongs to τ, and divided by the square of the
    stretch, which is at least 1 there."""
    return smooth(goal)


gradient_f = gradient_drift(E.tolist(), F, position).rate
damped = [entry / stretch**2 for entry in gradient_f]


@claim(
    "5/assumption-a-gradient-drift", "Assumption 1A on I_τ for f = E∇F with F in C³",
    Smooth(tuple(damped), arguments, 2, ((F, 3),)), given=IN_TAU, place="Assumption 1A", uses=[drift_brace],
)  # fmt: skip
def assumption_a_gradient_drift(goal: Goal) -> Evidence:
    """That the drift is in C², as Assumption 3 says, asks of F one derivative more than Assumption 2, unless E
    happens to take it away."""
    return smooth(goal)


_h, _away = sp.Symbol("h", real=True), sp.Symbol("h", positive=True)
_rough = -(x1**2) - x2**2 - sp.Abs(x1) ** 3 / (1 + x1**2)
_slope = -2 * x1 - x1 * sp.Abs(x1) * (3 + x1**2) / (1 + x1**2) ** 2  # by x₁
_distance, _steepness = x1**2 + x2**2, _slope**2 + (2 * x2) ** 2


@claim(
    "5/assumption-a-rough-field", "−‖x‖² − |x₁|³/(1 + x₁²) is in C²",
    Smooth((_rough,), position, 2), place="Assumption 1A",
)  # fmt: skip
def rough_field(goal: Goal) -> Evidence:
    """A field for the next claims."""
    return smooth(goal)


@claim(
    "5/assumption-a-rough-slope", "Its slope, on both sides of x₁ = 0",
    every(*(
        eq(sp.Derivative(_rough.subs(x1, side * _away), _away), side * _slope.subs(x1, side * _away))
        for side in (1, -1)
    )),
    place="Assumption 1A", uses=[rough_field],
)  # fmt: skip
def rough_slope(goal: Goal) -> Evidence:
    """With x₁ = h and x₁ = −h for h > 0; at 0 the slope is 0, as the field is in C²."""
    return exact(goal)


@claim(
    "5/assumption-a-rough-field-bounds", "It satisfies Assumption 2 with κ = 1, a₁ = 3/2, a₂ = 1, b₁ = 2 and b₂ = 4",
    every(
        le(-3 * _distance / 2, _rough), le(_rough, -_distance),
        le(2**2 * _distance, _steepness), le(_steepness, 4**2 * _distance),
    ),
    place="Assumption 1A", uses=[rough_field, rough_slope],
)  # fmt: skip
def rough_field_bounds(goal: Goal) -> Evidence:
    """|x₁|³/(1 + x₁²) is at most x₁²/2; its slope has the sign of −x₁ and is at most 2|x₁|. The gradient's bounds are
    squared."""
    return reals(goal)


@claim(
    "5/assumption-a-rough-drift", "Its gradient, as a drift, is not in C²",
    every(*(
        eq(sp.Limit((_slope.subs(x1, _h) + 2 * _h) / _h**2, _h, 0, side), value)
        for side, value in (("+", -3), ("-", 3))
    )),
    place="Assumption 1A", uses=[rough_field_bounds],
)  # fmt: skip
def rough_drift(goal: Goal) -> Evidence:
    """If the slope had a second derivative at 0, both limits would be half of it. So Assumption 2 and f = E∇F do not
    give f ∈ C²: where Assumption 3 asks for it, the field has to have it."""
    return limits(goal)


def _squares(entry: sp.Expr, by: sp.Symbol) -> sp.Expr:
    """The squares of the derivatives by a coordinate and by z, of which b₀ has none."""
    return sp.diff(entry, by) ** 2 + sp.diff(entry, z) ** 2


_pairs = list(zip(damped, gradient_f, strict=True))


@claim(
    "5/assumption-b-drift-derivatives", "Assumption 1B on I_τ for f = E∇F: the derivatives of b₀ are bounded",
    every(
        *(le(sp.diff(b, tau) ** 2, (2 / T) ** 2 * rate**2) for b, rate in _pairs),
        *(le(_squares(b, v), sp.diff(rate, v) ** 2) for b, rate in _pairs for v in position),
        *(le(_squares(sp.diff(b, tau), v), (2 / T) ** 2 * sp.diff(rate, v) ** 2)
          for b, rate in _pairs for v in position),
    ),
    given=IN_TAU, place="Assumption 1B", uses=[drift_brace],
)  # fmt: skip
def assumption_b_drift_derivatives(goal: Goal) -> Evidence:
    """A₂, A₃ and A₄, entry by entry: in time at most 2/T times E∇F, in position at most what the drift itself has,
    mixed 2/T times that. The right-hand sides do not depend on time."""
    return reals(goal)


@claim(
    "5/assumption-b-drift-bounds-are-continuous", "These bounds are continuous in x, so bounded on compact sets",
    Smooth((*gradient_f, *(sp.diff(rate, v) for rate in gradient_f for v in position)), position, 0, ((F, 2),)),
    place="Assumption 1B", uses=[assumption_b_drift_derivatives],
)  # fmt: skip
def drift_bounds_are_continuous(goal: Goal) -> Evidence:
    """E∇F and its derivatives are for F in C², which is Assumption 2."""
    return smooth(goal)


_bounded = sp.sin(x1 / nu(t - t0) ** 3)  # f₁
_bounded_b0 = _bounded.subs(t, chain.clock.to_t) / stretch**2


@claim(
    "5/assumption-b-bounded-drift-admitted", "f = (sin(x₁/ν³), 0) is in C² on [t₀, t₀ + T)",
    Smooth((_bounded,), (t, x1, x2), 2), given=IN_TIME, place="Assumption 1B",
)  # fmt: skip
def bounded_drift_admitted(goal: Goal) -> Evidence:
    """A drift for the next claim."""
    return smooth(goal)


@claim(
    "5/assumption-b-bounded-drift", "A bounded drift in C² does not have to meet Assumption 1B",
    every(
        le(_bounded, 1), ge(_bounded, -1),
        gt(sp.diff(_bounded_b0, x1).subs({tau: t0 + T * A, x1: 0}), A),
    ),
    given=IN_TIME, place="Assumption 1B", uses=[bounded_drift_admitted],
)  # fmt: skip
def assumption_b_bounded_drift(goal: Goal) -> Evidence:
    """f = (sin(x₁/ν³), 0) is bounded by 1, so Assumption 3B admits it. At x₁ = 0 the derivative of b₀ by x₁ is 1 + (τ −
    t₀)/T, which exceeds every A at τ = t₀ + TA. So Theorem 1 can't be applied under Assumption 3B alone, and the
    Proposition speaks of the averaged system only."""
    return reals(goal)


# What Theorem 1 asks by Assumption 1, all of it, on I_τ.
assumption_1 = (
    general_form, assumption_a, assumption_a_drift, assumption_a_gradient_drift, assumption_b_fields,
    assumption_b_field_derivatives, assumption_b_bracket, bounds_are_continuous, assumption_b_drift,
    assumption_b_drift_derivatives, drift_bounds_are_continuous, assumption_c, assumption_d_period, assumption_d_mean,
    assumption_e, assumption_f, quasi_steady_state_solves, quasi_steady_state, layer_function,
)  # fmt: skip
