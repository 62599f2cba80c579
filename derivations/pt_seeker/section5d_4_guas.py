"""Section 5: global uniform asymptotic stability of the average without drift, and existence for all times."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Claim,
    Evidence,
    Fact,
    Goal,
    Prose,
    Smooth,
    cited,
    claim,
    le,
    power_nonnegative,
    reals,
    smooth,
    specialise,
)

from . import chain
from .notation import IN_TAU, F, f, kappa, position, q, tau, x1, x2
from .section5b_0_trajectory import EXAMPLE, X1, X2, V_along, assumption_2, later, solves
from .section5b_0_trajectory import start as since
from .section5b_0_trajectory import v_nonnegative as nonnegative
from .section5b_1_lyapunov import EXAMPLE_QUARTIC, at_order, driftless, no_drift
from .section5b_2_gradient_drift import distance_bound_tau
from .section5c_1_proposition import constants_ordered, u_bounds
from .section5d_1_interval import Z, beta, m, start
from .section5d_2_estimates import kappa_1, kappa_2
from .section5d_3_trajectory import PUT_IN, at_times, distance_at, named, solution_1, solution_2

SECTION = "5.5 The averaged system: stability without drift, and existence for all times"

# --- Theorem 2, Step 4, case i --------------------------------------------------------------------------------------


def stable_without_drift(order: sp.Expr, tag: str, words: str, scalar: tuple[Claim, ...]) -> Claim:
    """The class-KL bound along every solution without drift, for one kind of κ."""
    upper_bound, class_kl = named(scalar, "upper-bound"), named(scalar, "beta-class-kl")

    @claim(
        f"5/step4-guas-driftless-{tag}",
        f"Case i: a class-KL bound for every averaged solution from every start: GUAS ({words})",
        le(distance_at(tau), beta(distance_at(since), tau - since, order)),
        given=[*solves(tau), *later, *at_order(assumption_2, order), *no_drift], place="Step 4, case i",
        uses=[upper_bound, class_kl, driftless, nonnegative, u_bounds, constants_ordered],
        example=EXAMPLE if order == 1 else EXAMPLE_QUARTIC | {m: 1},
    )  # fmt: skip
    def stable(goal: Goal) -> Evidence:
        """The estimate of the Proposition's proof without input. The initial time τ₀ stands in the bound by τ − τ₀
        only, and β is of class KL: no theorem on Lyapunov functions is needed."""

        def along(there: Goal, point: sp.Expr) -> list[Fact]:
            value = V_along.subs(tau, point)
            said = [
                *specialise(there, nonnegative, {kappa: order, x1: X1(point), x2: X2(point)}),
                power_nonnegative(value, 2 * q(order)),
            ]  # fmt: skip
            return [*said, *specialise(there, driftless, {kappa: order, tau: point})]

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
    "5/averaged-regular", "The right-hand side of the averaged system is continuously differentiable",
    Smooth(tuple(chain.averaged_tau.rhs), (tau, *position), 1, ((F, 2), *((entry, 2) for entry in f))),
    given=IN_TAU, place="Step 4",
)  # fmt: skip
def averaged_regular(goal: Goal) -> Evidence:
    """For F and f twice continuously differentiable: so it is continuous, and locally Lipschitz in the position."""
    return smooth(goal)


existence = claim(
    "5/averaged-solutions-exist", "The averaged system has one solution from every start, for all times",
    Prose("From every start at a time τ₀ ≥ t₀ the averaged system has exactly one solution, on all of [τ₀, ∞), without "
          "drift, with the drift E∇F and κ = 1, and with a drift that has a bound"),
    expected="cited", place="Step 4",
    uses=[
        averaged_regular, *guas_driftless, distance_bound_tau, solution_1[0], solution_2[0],
        named(kappa_1, "beta-class-kl"), named(kappa_2, "beta-class-kl"),
    ],
)(cited(
    "Khalil, Nonlinear Systems, 3rd edition, Theorem 3.3: the right-hand side is continuous and locally Lipschitz, and "
    "a solution stays in a compact set as long as it exists, here in the ball of the bound at the start, since the "
    "bounds are claimed on every interval on which there is a solution and decrease with time"
))  # fmt: skip
