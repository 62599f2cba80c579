"""Section 1 and the abstract: what is said of the algorithm there and decided nowhere else."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Exists, Goal, claim, eq, exists_by, le, reals

from .chain import averaged_t, gradient_F
from .notation import IN_TIME, f
from .section2_ranges import contraction_range
from .section6a_asymptotic import distance_limit_in_t

SECTION = "1 Introduction"


@claim(
    "1/source-is-no-equilibrium", "Under a nonvanishing drift the source is no equilibrium of the average",
    eq(averaged_t.vector, list(f)), given=[*IN_TIME, eq(gradient_F[0], 0), eq(gradient_F[1], 0)],
    place="Abstract, Section 1.3",
)  # fmt: skip
def no_equilibrium(goal: Goal) -> Evidence:
    """At the source the averaged vehicle moves with the drift f(t, x*). So the source is not stable, and Theorem 1,
    which asks for that, does not carry the robustness against bounded perturbations over to the vehicle: what the
    Proposition proves is about the average."""
    return reals(goal)


wait, residual, start = sp.symbols("sigma epsilon_x R_start", positive=True)
rate, factor = sp.symbols("A B_start", positive=True)


@claim(
    "1/in-any-time", "From any start and with any gain the bound of the average gets as small as one likes",
    Exists((wait,), (le(factor * start * sp.exp(-rate * wait), residual),)),
    place="Abstract, Section 1.1", uses=[distance_limit_in_t, contraction_range],
)  # fmt: skip
def in_any_time(goal: Goal) -> Evidence:
    """The bound of the averaged distance is B R e^(−Aσ), σ the dilated time, with B = √(a₁/a₂) e^(c₂²‖E‖T/2) and
    A = kc₁²/4 for κ = 1. There is a σ at which it is below ε, and its instant lies before t₀ + T,
    whatever T is. For κ ≥ 2 with a drift this is false; for the vehicle ω has to be chosen for start, T and ε."""
    return exists_by(goal, {wait: sp.log(factor * start / residual + 1) / rate})
