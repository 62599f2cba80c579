"""Section 7.1: what the averaged systems of the two seekers do in the example with vanishing drift."""

from __future__ import annotations

from typing import Any

import sympy as sp

from ptproof.proof import Evidence, Goal, claim, ge, gt, instances, le, lt, reals, specialise

from .chain import averaged_t, gradient_F
from .notation import E, E_norm, F, T, a1, a2, b1, b2, f, k, kappa, nu, position, t, t0, x1, x2
from .section3_problem import against_gradient, g1, g2, h1_drift, h2_drift
from .section5b_0_trajectory import EXAMPLE, V_of_x, assumption_2, distance, gradient_norm
from .section5b_0_trajectory import v_nonnegative as nonnegative
from .section5b_1_lyapunov import at_order
from .section6a_asymptotic import asymptotic_average, averaged_asymptotic, condition
from .section7a_vanishing import drift, field, gradient_bounds, peak

SECTION = "7.1 Simulation: the averages of both seekers"

values: dict[Any, Any] = {F: field, f[0]: drift.rate[0], f[1]: drift.rate[1], k: sp.Rational("1.8")}
asymptotic = asymptotic_average.with_values(values)
prescribed = averaged_t.with_values(values)
slope = sp.Matrix(gradient_F)
away_from_source = gt(x1**2 + x2**2, 0)


@claim(
    "7.1/asymptotic-average-leaves", "On the average the asymptotic seeker loses height, wherever it is",
    gt(asymptotic.derivative_along(peak - field), 0), given=[away_from_source], place="Section 7.1",
    uses=[averaged_asymptotic, gradient_bounds],
)  # fmt: skip
def asymptotic_leaves(goal: Goal) -> Evidence:
    """V = 3 − F grows at the rate (1 − k/2)‖∇F‖², as k = 1.8 < 2 = 2‖E‖: the drift outweighs the seeking. This agrees
    with the simulation, in which the asymptotic seeker moves away."""
    return reals(goal)


@claim(
    "7.1/pt-average-climbs", "On the average the PT Seeker gains height as soon as ν² < 0.9",
    lt(prescribed.derivative_along(peak - field), 0),
    given=[away_from_source, ge(t, t0), lt(t, t0 + T), lt(nu(t - t0) ** 2, sp.Rational("0.9"))], place="Section 7.1",
    uses=[gradient_bounds],
)  # fmt: skip
def pt_climbs(goal: Goal) -> Evidence:
    """V falls at the rate (k/(2ν²) − 1)‖∇F‖². The drift has the upper hand during
    about the first 5 % of the time only."""
    return reals(goal)


# --- What the drift away implies --------------------------------------------------------------------------------------

R = sp.Symbol("R", positive=True)  # the distance at one place
V_there, G = sp.symbols("V_x G_x", nonnegative=True)  # V and ‖∇F‖ there
rate = sp.Symbol("V_dot", real=True)
# F = −‖x‖² and E = −I with k = 1: V grows at (1, 0).
STANDING = EXAMPLE | {E[0, 0]: -1, E[1, 1]: -1, E_norm: 1}


@claim(
    "7.1/leaving-implies-by-letters", "A rate of V that is not negative, and what k is then",
    le(k, condition.right),
    given=[
        ge(rate, 0), le(rate, (E_norm - k / 2) * G**2),
        le(a2 * R**2, V_there), le(V_there, a1 * R**2), le(b1 * R, G), le(G, b2 * R),
    ],
    labels=["eq:convergence_cond"], place="Section 7.1",
)  # fmt: skip
def leaving_implies_by_letters(goal: Goal) -> Evidence:
    """c₁² ≤ ‖∇F‖²/V ≤ c₂² at the place, so that the threshold is at least 2‖E‖."""
    return reals(goal)


leaving = asymptotic_average.with_values(dict(zip(f, E * slope, strict=True))).derivative_along(V_of_x)


@claim(
    "7.1/leaving-implies", "Where an average loses height under f = E∇F, k does not satisfy the convergence condition",
    le(k, condition.right),
    given=[
        gt(distance, 0), ge(leaving, 0), *at_order(assumption_2, sp.S.One),
        le((E * slope).dot(E * slope), E_norm**2 * slope.dot(slope)),
    ],
    labels=["eq:convergence_cond"], place="Section 7.1",
    uses=[averaged_asymptotic, against_gradient, leaving_implies_by_letters, nonnegative], example=STANDING,
)  # fmt: skip
def leaving_implies(goal: Goal) -> Evidence:
    """At one place other than the source V does not fall. This is what the text infers from the simulation, for the
    average: it holds for every field of Assumption 2 with κ = 1, every drift matrix and all constants."""
    norms = dict(zip((g1, g2, h1_drift, h2_drift), (*slope, *E * slope), strict=True))
    said = [
        *instances(goal, position), *specialise(goal, nonnegative, {kappa: sp.S.One}),
        *specialise(goal, against_gradient, norms),
    ]  # fmt: skip
    values = {R: distance, V_there: V_of_x, G: gradient_norm, rate: leaving}
    return reals(goal, *said, *specialise(goal, leaving_implies_by_letters, values, said))
