"""Section 6.2: whether a drift E∇F reduces the speed of convergence, on the average."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, claim, eq, every, ge, le, reals, refute, specialise

from . import chain
from .notation import E11, E12, E21, E22, IN_TIME, E, E_norm, F, F_source, T, f, k, t, t0, x1, x2
from .section3_problem import against_gradient, g1, g2, h1_drift, h2_drift
from .section6a_asymptotic import distance_limit_in_t, drift_slows

SECTION = "6.2 Discussion: the drift and the speed of convergence"

slope = sp.Matrix(chain.gradient_F)
drift = E * slope
V_of_x = F_source - F


def rate(of: sp.Matrix) -> sp.Expr:
    """dV/dt of the average in t under a drift."""
    return chain.averaged_t.with_values(dict(zip(f, of, strict=True))).derivative_along(V_of_x)


change = rate(drift) - rate(sp.zeros(2, 1))


@claim(
    "6.2/drift-reduces-the-speed", "The drift E∇F reduces the speed of convergence, as the text says", ge(change, 0),
    given=IN_TIME, place="Section 6.2", expected="refuted", uses=[drift_slows], grade="wording",
    wrong="That a drift E∇F reduces the speed of convergence is said of every E; it is right of a repulsive one, and a "
    "drift towards the source makes V fall faster.",
    survives="Yes: the bound of the theorem takes the drift as if it were repulsive, and holds for every E.",
)  # fmt: skip
def drift_reduces(goal: Goal) -> Evidence:
    """On the average, for all E. The witness is E = I, a drift along the gradient."""
    return refute(goal, {
        F: -(x1**2 + x2**2) / 2, F_source: 0, x1: 1, x2: 0, E11: 1, E22: 1, E12: 0, E21: 0, k: 1, T: 1, t0: 0, t: 0,
    })  # fmt: skip


@claim(
    "6.2/drift-changes-the-speed", "The drift changes dV/dt by −∇FᵀE∇F, at most ‖E‖‖∇F‖² in either direction",
    every(
        eq(change, -(slope.T * E * slope)[0]),
        le(sp.Abs(change), E_norm * slope.dot(slope)),
    ),
    given=[*IN_TIME, le(drift.dot(drift), E_norm**2 * slope.dot(slope))], place="Section 6.2", corrects=drift_reduces,
    uses=[against_gradient],
)  # fmt: skip
def drift_changes(goal: Goal) -> Evidence:
    """Only the symmetric part of E counts, and its sign says whether the drift slows or helps. What is assumed holds
    for the spectral norm."""
    values = dict(zip((g1, g2, h1_drift, h2_drift), (*slope, *drift), strict=True))
    return reals(goal, *specialise(goal, against_gradient, values))


repulsive = [le(E11, 0), le(E22, 0), ge(E11 * E22, ((E12 + E21) / 2) ** 2)]


@claim(
    "6.2/repulsive-drift-slows", "A repulsive drift reduces the speed wherever it acts", ge(change, 0),
    given=[*IN_TIME, *repulsive], place="Section 6.2", uses=[drift_changes, distance_limit_in_t],
)  # fmt: skip
def repulsive_slows(goal: Goal) -> Evidence:
    """Where the symmetric part of E is negative semidefinite. That the limit is not influenced is the claim used: the
    bound tends to 0 for every E if κ = 1."""
    return reals(goal)
