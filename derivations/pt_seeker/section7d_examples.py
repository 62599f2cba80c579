"""Section 7: the examples that ship with the package, which are the ones that are simulated, against the paper."""

from __future__ import annotations

import sympy as sp

from ptproof.problem import Problem, example
from ptproof.proof import Evidence, Goal, Relation, claim, eq, every, exact

from . import section7a_vanishing, section7b_nonvanishing, section7c_saturated
from .notation import t, x1, x2
from .section7_clipping import minimum

SECTION = "7.5 Simulation: the examples as they are simulated"

vanishing, nonvanishing, saturated = (example(name) for name in ("vanishing", "nonvanishing", "saturated"))


def numbers(problem: Problem) -> sp.ImmutableDenseMatrix:
    """k, ω, μ, T, t₀, the clip and the start."""
    tuning = problem.tuning
    chosen = [tuning.k, tuning.omega, tuning.mu, tuning.T, tuning.t0, tuning.nu_min]
    return sp.ImmutableDenseMatrix([*chosen, *problem.initial.x])


def printed(k: str, omega: int, horizon: int, start: tuple[int, int]) -> list[sp.Expr]:
    """The same as the paper gives them; μ = 0.001 and t₀ = 0 throughout."""
    return [sp.Rational(k), sp.Integer(omega), sp.Rational("0.001"), sp.Integer(horizon), sp.S.Zero, minimum, *start]


def same_data(problem: Problem, field: sp.Expr, drift: list[sp.Expr], values: list[sp.Expr]) -> tuple[Relation, ...]:
    """Field, drift and numbers of an example are the printed ones."""
    return eq(problem.field.expression, field), eq(sp.Matrix(problem.drift.rate), drift), eq(numbers(problem), values)


@claim(
    "7.1/as-simulated", "The example with vanishing drift is simulated with the paper's data",
    every(*same_data(
        vanishing, section7a_vanishing.field, list(-section7a_vanishing.slope), printed("1.8", 30, 1, (-2, -2))
    )),
    labels=["eq:exp_field"], place="Section 7.1",
)  # fmt: skip
def vanishing_as_simulated(goal: Goal) -> Evidence:
    """Field, drift −∇F, k, ω, μ, T, t₀, the clip and the start."""
    return exact(goal)


@claim(
    "7.2/as-simulated", "The example with nonvanishing drift is simulated with the paper's data",
    every(*same_data(
        nonvanishing, section7b_nonvanishing.field,
        [(1 + sp.sin(3 * t)) * sp.cos(x1), (1 + sp.sin(3 * t)) * sp.cos(x2)], printed("1", 50, 2, (1, -1)),
    )),
    labels=["eq:nonvanish_drift_field_simulation", "eq:nonvanish_drift"], place="Section 7.2",
)  # fmt: skip
def nonvanishing_as_simulated(goal: Goal) -> Evidence:
    """Field, drift, k, ω, μ, T, t₀, the clip and the start; cos(x) is taken entry by entry."""
    return exact(goal)


clip = saturated.saturation
assert clip is not None


@claim(
    "7.3/as-simulated", "The saturated example is simulated with the paper's data",
    every(
        *same_data(saturated, section7c_saturated.field, [sp.S.Zero] * 2, printed("1.4", 30, 1, (2, 2))),
        eq(clip.epsilon, sp.Rational("0.0004")),
        eq(clip.level, sp.Integer(4)),
        eq(clip.gain, sp.Rational("11.11")),
    ),
    labels=["eq:sat_seeker"], place="Section 7.3",
)  # fmt: skip
def saturated_as_simulated(goal: Goal) -> Evidence:
    """Field, k, ω, μ, T, t₀, the clip and the start, and ε, S and the constant gain."""
    return exact(goal)
