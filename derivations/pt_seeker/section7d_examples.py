"""Section 7: what is simulated, against the printed closed loops with the printed data."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from ptproof.problem import Problem, example
from ptproof.proof import Assumption, Evidence, Goal, Relation, claim, eq, every, ge, lt, reals

from . import section7a_vanishing, section7b_nonvanishing, section7c_saturated
from .notation import C, F, S, T, epsilon, f, k, mu, nu, omega, position, t, t0, x1, x2
from .section4_design import closed_t_printed
from .section6a_asymptotic import printed_asymptotic
from .section7_clipping import clipped_gain, printed_gain
from .section7c_saturated import printed_rates, saturation

SECTION = "7.5 Simulation: the examples as they are simulated"

limits = {epsilon: sp.Rational("0.0004"), S: sp.Integer(4)}
vanishing, nonvanishing, saturated = (example(name) for name in ("vanishing", "nonvanishing", "saturated"))


@dataclass(frozen=True)
class Printed:
    """What the paper gives for an example; μ = 0.001 and t₀ = 0 throughout."""

    field: sp.Expr
    drift: Sequence[sp.Expr]
    gain: str
    frequency: int
    horizon: int
    start: tuple[int, int]

    @property
    def values(self) -> dict[Any, sp.Expr]:
        """For the letters of the printed systems."""
        return {
            F: self.field, f[0]: self.drift[0], f[1]: self.drift[1], k: sp.Rational(self.gain),
            omega: sp.Integer(self.frequency), mu: sp.Rational("0.001"), T: sp.Integer(self.horizon), t0: sp.S.Zero,
        }  # fmt: skip

    def system(self, rates: sp.Matrix) -> sp.Matrix:
        """A printed system with these data, and 1/ν² clipped as printed."""
        return sp.Matrix(rates).subs(1 / nu(t - t0) ** 2, printed_gain).xreplace({**self.values, **limits})

    @property
    def during(self) -> tuple[Assumption, ...]:
        """From t₀ = 0 until the prescribed time."""
        return ge(t, 0), lt(t, self.horizon)


def measured(problem: Problem, data: Printed) -> Relation:
    """The filter starts at the field's value at the printed start."""
    return eq(sp.Subs(data.field, position, data.start), problem.measured)


def loops(problem: Problem, data: Printed) -> tuple[Relation, ...]:
    """The simulated systems of both seekers, and the start of the filter."""
    return (
        eq(data.system(closed_t_printed), problem.closed_loop("pt").vector),
        eq(data.system(printed_asymptotic), problem.closed_loop("asymptotic").vector),
        measured(problem, data),
    )


data_vanishing = Printed(section7a_vanishing.field, tuple(-section7a_vanishing.slope), "1.8", 30, 1, (-2, -2))
data_nonvanishing = Printed(
    section7b_nonvanishing.field, [(1 + sp.sin(3 * t)) * sp.cos(entry) for entry in (x1, x2)], "1", 50, 2, (1, -1)
)
data_saturated = Printed(section7c_saturated.field, [sp.S.Zero] * 2, "1.4", 30, 1, (2, 2))


@claim(
    "7.1/as-simulated", "With vanishing drift what is simulated are the printed closed loops with the printed data",
    every(*loops(vanishing, data_vanishing)), given=data_vanishing.during,
    labels=["eq:exp_field", "eq:kt"], place="Section 7.1", uses=[clipped_gain],
)  # fmt: skip
def vanishing_as_simulated(goal: Goal) -> Evidence:
    """Both seekers, from the problem file that is simulated: field, drift −∇F, k, ω, μ, T, t₀ and the clip. The clock
    gives the clipped gain by cases, the paper as a minimum."""
    return reals(goal)


@claim(
    "7.2/as-simulated", "With nonvanishing drift what is simulated are the printed closed loops with the printed data",
    every(*loops(nonvanishing, data_nonvanishing)), given=data_nonvanishing.during,
    labels=["eq:nonvanish_drift_field_simulation", "eq:nonvanish_drift", "eq:kt"], place="Section 7.2",
    uses=[clipped_gain],
)  # fmt: skip
def nonvanishing_as_simulated(goal: Goal) -> Evidence:
    """The same for this example; cos(x) is taken entry by entry."""
    return reals(goal)


with_clip = printed_rates.subs(C, printed_gain)
with_constant = printed_rates.subs(C, sp.Rational("11.11"))


@claim(
    "7.3/as-simulated", "With saturation what is simulated are the printed systems with the printed data",
    every(
        eq(data_saturated.system(with_clip), saturated.closed_loop("saturated").vector),
        eq(data_saturated.system(with_constant), saturated.closed_loop("saturated-constant").vector),
        measured(saturated, data_saturated),
    ),
    given=data_saturated.during, labels=["eq:sat_seeker", "eq:kt"], place="Section 7.3",
    uses=[clipped_gain, saturation],
)  # fmt: skip
def saturated_as_simulated(goal: Goal) -> Evidence:
    """With the clipped gain and with the constant one: field, k, ω, μ, T, t₀, the clip, ε, S and 11.11."""
    return reals(goal)
