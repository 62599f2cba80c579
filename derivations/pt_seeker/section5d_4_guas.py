"""Section 5: global uniform asymptotic stability without drift, and existence for all times, for the averaged system."""

from __future__ import annotations

from ptproof.proof import (
    Claim,
    Evidence,
    Fact,
    Goal,
    Prose,
    Smooth,
    cited,
    claim,
    ge,
    le,
    power_nonnegative,
    power_monotone,
    reals,
    smooth,
    specialise,
)

import sympy as sp

from . import chain
from .notation import F, T, a1, a2, c, d, k, kappa, position, q, t0, tau, x1, x2
from .section5a_1_reduction import f_tau
from .section5b_0_trajectory import EXAMPLE, X1, X2, V_along, assumption_2, later, s, solves
from .section5b_0_trajectory import start as since
from .section5b_0_trajectory import v_nonnegative as nonnegative
from .section5b_1_lyapunov import EXAMPLE_AT_REST, at_order, driftless, no_drift
from .section5b_2_gradient_drift import case_two, distance_bound_tau, printed_bound
from .section5c_1_proposition import constants_ordered, u_bounds
from .section5d_1_interval import Z, beta, first, gamma, m, rate_of, regular, start, zeta_at
from .section5d_2_estimates import kappa_1, kappa_2, pull, slope
from .section5d_3_trajectory import PUT_IN, assumed, at_times, distance_at, example, named, solution_1, solution_2

SECTION = "5.5 The averaged system: stability without drift, and existence for all times"

# --- Theorem 2, Step 4, case i --------------------------------------------------------------------------------------


@claim(
    "5/step4-driftless-by-letters", "The inequality without drift by the letters of U",
    le(slope, -2 * kappa * rate_of(kappa) * pull), given=[le(slope, -k * c(1) ** 2 / 2 * pull)],
    place="Step 4, case i",
)  # fmt: skip
def by_letters(goal: Goal) -> Evidence:
    """k c₁²/2 is 2κh₁."""
    return reals(goal)


def stable_without_drift(order: sp.Expr, tag: str, words: str, scalar: tuple[Claim, ...]) -> Claim:
    """The class-KL bound along every solution without drift, for one kind of κ."""
    upper_bound, class_kl = named(scalar, "upper-bound"), named(scalar, "beta-class-kl")

    @claim(
        f"5/step4-guas-driftless-{tag}",
        f"Case i: a class-KL bound for every averaged solution from every start: GUAS ({words})",
        le(distance_at(tau), beta(distance_at(since), tau - since, order)),
        given=[*solves(tau), *later, *at_order(assumption_2, order), *no_drift], place="Step 4, case i",
        uses=[upper_bound, class_kl, driftless, by_letters, nonnegative, u_bounds, constants_ordered],
        example=EXAMPLE if order == 1 else EXAMPLE_AT_REST | {m: 1},
    )  # fmt: skip
    def stable(goal: Goal) -> Evidence:
        """The estimate of the Proposition's proof without input. The initial time τ₀ stands in the bound by τ − τ₀ only,
        and β is of class KL: no theorem on Lyapunov functions is needed."""

        def along(there: Goal, point: sp.Expr) -> list[Fact]:
            value = V_along.subs(tau, point)
            square = value ** (2 * q(order))
            said = [
                *specialise(there, nonnegative, {kappa: order, x1: X1(point), x2: X2(point)}),
                power_nonnegative(value, 2 * q(order)),
            ]  # fmt: skip
            values = {kappa: order, slope: sp.Derivative(value, point), pull: square}
            return [
                *said, *specialise(there, driftless, {kappa: order, tau: point}),
                *specialise(there, by_letters, values, said),
            ]  # fmt: skip

        return reals(
            goal, *at_times(goal, order, since, tau),
            *specialise(goal, upper_bound, {**PUT_IN, Z: 0, start: since}, along=along),
        )  # fmt: skip

    return stable


guas_driftless = (
    stable_without_drift(sp.Integer(1), "kappa-1", "κ = 1", kappa_1),
    stable_without_drift(m + 1, "kappa-2", "κ ≥ 2", kappa_2),
)

# --- Existence for all times ----------------------------------------------------------------------------------------


@claim(
    "prop/averaged-regular", "The right-hand side of the averaged system is continuously differentiable",
    Smooth(tuple(chain.averaged_tau.rhs), (tau, *position), 1, ((F, 2), *((entry, 2) for entry in f_tau))),
    given=[ge(tau, t0)], place="Proof of the Proposition",
)  # fmt: skip
def averaged_regular(goal: Goal) -> Evidence:
    """For F and f twice continuously differentiable: so it is continuous, and locally Lipschitz in the position."""
    return smooth(goal)
