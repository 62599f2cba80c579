"""Beyond the paper: from the instant on at which the drift is beaten, the average is that of another start.

(k/2)I + (E + Eᵀ)/2/(1 + (τ − t₀)/T)² becomes positive definite at some instant, whatever E is. With the clock restarted
there the system has the same form, and the theorem's bound holds from there on, for every κ.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from ptproof.proof import (
    Assumption,
    Claim,
    Evidence,
    Exists,
    Fact,
    Goal,
    Relation,
    claim,
    eq,
    exact,
    exists_by,
    ge,
    instances,
    power_nonnegative,
    reals,
    specialise,
)

from . import chain
from .notation import E11, E12, E21, E22, E, T, f, k, kappa, position, t0, tau
from .section5b_0_trajectory import X1, X2, V_along, assumption_2, solves, start, v_nonnegative
from .section5b_0_with_drift import gradient_drift_given, instant
from .section5b_1_lyapunov import sigma
from .section5b_3_all_trajectories import scaled
from .section9_3_every_order import KINDS, for_definite, for_order

SECTION = "Beyond the paper"

begin = sp.Symbol("tau_1", real=True)  # where the clock is restarted
horizon = T + begin - t0  # the prescribed time of the restarted clock
factor = (T / horizon) ** 2  # of the drift's matrix
drift = E * sp.Matrix(chain.gradient_F)
pushed = dict(zip(f, drift, strict=True))
from_there = [ge(begin, t0), ge(tau, begin)]
# The same as letters.
H, share = sp.symbols("H rho_1", positive=True)
named = [eq(H, horizon), eq(share, factor)]

# --- The same form ----------------------------------------------------------------------------------------------------


average = chain.averaged_tau.with_values(pushed)
loop = chain.closed_loop_tau.with_values(pushed)


def restart(rates: sp.Matrix) -> sp.Matrix:
    """The rates of a system under f = E∇F with the restarted clock."""
    return rates.subs({**scaled(factor), T: horizon, t0: begin}, simultaneous=True)


@claim(
    "beyond/restart", "From τ₁ on the average is that of the prescribed time T + τ₁ − t₀ and of the drift ρE∇F",
    eq(restart(average.vector), average.vector), given=from_there,
)  # fmt: skip
def restart_average(goal: Goal) -> Evidence:
    """Exactly, with ρ = (T/(T + τ₁ − t₀))², which is what has been lost of the drift by then."""
    return exact(goal)


@claim(
    "beyond/restart-closed-loop", "So is the closed loop itself",
    eq(restart(loop.vector), loop.vector), given=from_there,
)  # fmt: skip
def restart_loop(goal: Goal) -> Evidence:
    """Position, heading and filter: the seeker does not know when it was started."""
    return exact(goal)


# --- The theorem from there on ----------------------------------------------------------------------------------------


@claim(
    "beyond/restart-factor", "The drift's factor, by a clock that is restarted at τ₁",
    eq(share / (1 + (tau - begin) / H) ** 2, 1 / (1 + (tau - t0) / T) ** 2), given=[*from_there, *named],
    uses=[restart_average],
)  # fmt: skip
def restart_factor(goal: Goal) -> Evidence:
    """With letters for T + τ₁ − t₀ and for the part of the drift that is left at τ₁."""
    return reals(goal)


def of_restart(general: Claim, order: sp.Expr, tag: str, words: str, beaten: Sequence[Assumption]) -> Claim:
    """What ``general`` says from τ₁ on, where the drift is beaten at τ₁."""
    assert isinstance(general.statement, Relation)

    @claim(
        f"beyond/restart-{tag}", f"If {words}, V of the average has the class-KL bound from every τ₀ ≥ τ₁ on",
        general.statement.map(lambda side: side.subs(T, H)),
        given=[
            *solves(tau), *named, ge(begin, t0), ge(start, begin), ge(tau, start), *gradient_drift_given, *beaten,
            *for_order(assumption_2, order),
        ],
        uses=[general, restart_average, restart_factor, v_nonnegative],
        example={**dict(general.example), begin: 0, H: 1, share: 1},
    )  # fmt: skip
    def from_restart(goal: Goal) -> Evidence:
        """A trajectory of the average from τ₀ on is one of the restarted average, whose drift is beaten at its own
        start. The bound is that of the theorem with T + τ₁ − t₀ for T, and does not depend on τ₀."""

        def along(there: Goal, point: sp.Expr) -> list[Fact]:
            if isinstance(point, sp.Tuple):
                return []
            return [*instances(there, instant(point)), *specialise(there, restart_factor, {tau: point})]

        values = {
            **scaled(share), **{entry: share * push for entry, push in pushed.items()}, T: H, t0: begin
        }  # fmt: skip
        begins = specialise(goal, v_nonnegative, {kappa: order, position[0]: X1(start), position[1]: X2(start)})
        root = power_nonnegative(V_along.subs(tau, start), sigma)
        return reals(goal, *specialise(goal, general, values, along=along), *begins, root)

    return from_restart


matrix = share * E + k / 2 * sp.eye(2)  # of the restarted average, at its start
semidefinite = [  # by its principal minors
    ge(matrix[0, 0], 0), ge(matrix[1, 1], 0), ge(matrix[0, 0] * matrix[1, 1] - (share * (E12 + E21) / 2) ** 2, 0),
]  # fmt: skip
restarted_definite = tuple(
    of_restart(general, order, f"semidefinite-{tag}",
               f"ρ(E + Eᵀ)/2 + (k/2)I is positive semidefinite for ρ = (T/(T + τ₁ − t₀))² and {words}", semidefinite)
    for general, (_, order, tag, words) in zip(for_definite, KINDS, strict=True)
)  # fmt: skip
size = sum(map(sp.Abs, (E11, E22, E12 + E21)))


@claim(
    "beyond/restart-comes", "For every E, k and T there is an instant τ₁ at which that matrix is positive semidefinite",
    Exists((begin,), (ge(begin, t0), *(part.map(lambda side: side.subs(share, factor)) for part in semidefinite))),
    uses=[*restarted_definite],
)  # fmt: skip
def comes(goal: Goal) -> Evidence:
    """At the latest at τ₁ = t₀ + 2T(|E₁₁| + |E₂₂| + |E₁₂ + E₂₁|)/k. So for every κ an averaged trajectory that exists
    until then comes to the source: to escape before is all that a gradient drift can make it do."""
    return exists_by(goal, {begin: t0 + 2 * T * size / k})
