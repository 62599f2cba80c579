"""Section 7.1: what the averaged systems of the two seekers do in the example with vanishing drift."""

from __future__ import annotations

from typing import Any

import sympy as sp

from ptproof.proof import Evidence, Goal, claim, ge, gt, lt, reals

from .chain import averaged_t
from .notation import F, T, f, k, nu, t, t0, x1, x2
from .section6a_asymptotic import asymptotic_average, averaged_asymptotic
from .section7a_vanishing import drift, field, gradient_bounds, peak

SECTION = "7.1 Simulation: the averages of both seekers"

values: dict[Any, Any] = {F: field, f[0]: drift.rate[0], f[1]: drift.rate[1], k: sp.Rational("1.8")}
asymptotic = asymptotic_average.with_values(values)
prescribed = averaged_t.with_values(values)
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
