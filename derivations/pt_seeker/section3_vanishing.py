"""Section 3: what Assumption 3A says of a drift E∇F."""

from __future__ import annotations

import sympy as sp

from ptproof.problem.drift import gradient_drift
from ptproof.proof import Evidence, Goal, claim, eq, le, lt, reals

from .chain import gradient_F
from .notation import E, F, F_source, R, a2, kappa, position
from .section3_problem import F_value, source_is_maximum, upper_field

SECTION = "3 Problem statement"

drift = sp.Matrix(gradient_drift(E.tolist(), F, position).rate)


@claim(
    "3/gradient-drift-vanishes", "A drift E∇F vanishes where ∇F does, whatever E is", eq(drift, [0, 0]),
    given=[eq(gradient_F[0], 0), eq(gradient_F[1], 0)], place="Assumption 3A",
)  # fmt: skip
def gradient_drift_vanishes(goal: Goal) -> Evidence:
    """At the source ∇F = 0 by Assumption 2, so f(t, x*) = 0 follows from f = E∇F and is no condition of its own."""
    return reals(goal)


level = sp.Symbol("M", positive=True)


@claim(
    "3/radially-unbounded", "The upper bound of Assumption 2 already makes the field radially unbounded",
    lt(F_value, -level), given=[upper_field, lt(F_source + level, a2 * R ** (2 * kappa))], place="Assumption 2",
)  # fmt: skip
def radially_unbounded(goal: Goal) -> Evidence:
    """F falls below −M as soon as a₂‖x − x*‖^(2κ) exceeds F(x*) + M."""
    return reals(goal)


@claim(
    "3/maximum-as-printed", "F(x*) ≥ F(x) for all x ≠ x*", le(F_value, F_source), given=[upper_field],
    place="Assumption 2", uses=[source_is_maximum],
)  # fmt: skip
def maximum_as_printed(goal: Goal) -> Evidence:
    """It follows from the upper bound, even strictly."""
    return reals(goal)
