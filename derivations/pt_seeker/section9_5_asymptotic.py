"""Beyond the paper: where (k/2)I + (E + Eᵀ)/2 is positive definite, the averaged asymptotic seeker always converges."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import sympy as sp

from ptproof.proof import (
    Assumption,
    Claim,
    Evidence,
    Fact,
    ForAll,
    Goal,
    claim,
    comparison,
    eq,
    ge,
    instances,
    le,
    power_nonnegative,
    reals,
    specialise,
)

from .notation import F, b1, b2, c, kappa, position, q, t, t0, x1, x2
from .section5b_0_trajectory import EXAMPLE, V_of_x, assumption_2, gradient_bounds, s, v_nonnegative
from .section5b_1_lyapunov import n
from .section9_1_gain import X, along, definite, definite_rate, follows_average, slowest, square

SECTION = "Beyond the paper"

eigenvalue = sp.Symbol("lambda", positive=True)
V_now = along(V_of_x, t)
V_rate = sp.Derivative(V_now, t)
here = {position[0]: X[0](t), position[1]: X[1](t)}
setting: tuple[Assumption, ...] = (ge(t, t0), *follows_average(), *definite, eq(eigenvalue, slowest))
example: dict[Any, Any] = {**EXAMPLE, t: 1, eigenvalue: sp.Rational(1, 4)}


@claim(
    "beyond/asymptotic-rate", "V of the averaged asymptotic seeker falls at least at λ‖∇F‖² along its trajectories",
    le(V_rate, -eigenvalue * along(square, t)), given=setting, uses=[definite_rate], example=example,
)  # fmt: skip
def asymptotic_rate(goal: Goal) -> Evidence:
    """λ is determinant over trace of (k/2)I + (E + Eᵀ)/2."""
    return reals(goal, *instances(goal, t), *specialise(goal, definite_rate, here))


@claim(
    "beyond/asymptotic-v-inequality", "Then V satisfies a differential inequality for every κ",
    le(V_rate, -eigenvalue * c(1) ** 2 * V_now ** (2 * q())), given=[*setting, *assumption_2],
    uses=[asymptotic_rate, gradient_bounds, v_nonnegative], example=example,
)  # fmt: skip
def asymptotic_v_inequality(goal: Goal) -> Evidence:
    """The gradient's lower bound by V."""
    return reals(
        goal, *specialise(goal, asymptotic_rate, {}), *specialise(goal, gradient_bounds, here),
        *specialise(goal, v_nonnegative, here), power_nonnegative(V_now, q()),
    )  # fmt: skip


V = sp.Function("V", real=True)
sigma = n / (n + 1)


def bound(order: sp.Expr, value: sp.Expr, passed: sp.Expr) -> sp.Expr:
    """The bound of V after the time ``passed``, from the value at the start."""
    paid = eigenvalue * c(1, order) ** 2 * passed
    return value * (sp.exp(-paid) if order == 1 else (1 + sigma * value**sigma * paid) ** (-1 / sigma))


def scalar(order: sp.Expr, tag: str, words: str) -> Claim:
    """What the inequality gives, for one kind of κ."""
    falls = le(sp.Derivative(V(s), s), -eigenvalue * c(1, order) ** 2 * V(s) ** (2 * q(order)))

    @claim(
        f"beyond/asymptotic-v-bound-{tag}", f"What the inequality gives, {words}",
        le(V(t), bound(order, V(t0), t - t0)),
        given=[ge(t, t0), ForAll((s,), falls, (ge(s, t0), le(s, t))), ForAll((s,), ge(V(s), 0)), ge(V(t0), 0)],
    )  # fmt: skip
    def v_bound(goal: Goal) -> Evidence:
        """The comparison equation is solved; V(t₀) = 0 is included."""
        base = 1 + sigma * V(t0) ** sigma * eigenvalue * c(1, order) ** 2 * (s - t0)
        root = power_nonnegative(V(t0), sigma)
        return comparison(
            goal, bound(order, V(t0), s - t0), denominators=[] if order == 1 else [base], lemmas=[root]
        )  # fmt: skip

    return v_bound


def convergence(order: sp.Expr, tag: str, words: str, lemma: Claim, values: Mapping[Any, Any]) -> Claim:
    """Convergence of the averaged asymptotic seeker, for one kind of κ."""
    V_start = V_now.subs(t, t0)
    between = [ForAll(item.variables, item.relation.map(lambda side: side.subs(kappa, order))) for item in assumption_2]

    @claim(
        f"beyond/asymptotic-convergence-{tag}", f"The averaged asymptotic seeker converges from everywhere, {words}",
        le(V_now, bound(order, V_start, t - t0)), given=[*setting, *between],
        uses=[asymptotic_v_inequality, v_nonnegative, lemma], example={**example, **values},
    )  # fmt: skip
    def converges(goal: Goal) -> Evidence:
        """V is below an explicit bound that is of class KL in V(t₀) and t − t₀, along every trajectory: no theorem on
        Lyapunov functions is needed."""

        def nonnegative(there: Goal, time: sp.Expr) -> list[Fact]:
            return specialise(there, v_nonnegative, {kappa: order, x1: X[0](time), x2: X[1](time)})

        def facts(there: Goal, time: sp.Expr) -> list[Fact]:
            if le(time, t) not in there.assumptions:
                return nonnegative(there, time)
            return [*nonnegative(there, time), *specialise(there, asymptotic_v_inequality, {kappa: order, t: time})]

        begins = [*nonnegative(goal, t0), power_nonnegative(V_start, sigma)]
        said = specialise(goal, lemma, {V(s): along(V_of_x, s)}, begins, along=facts)
        return reals(goal, *said, *begins, *nonnegative(goal, t))

    return converges


above = n + 1
at_rest = {F: -((x1**2 + x2**2) ** 2), b1: 4, b2: 4, n: 1, X[0](s): 0, x1: 0}
converges_one = convergence(sp.S.One, "kappa-1", "κ = 1", scalar(sp.S.One, "kappa-1", "κ = 1"), {})
converges_above = convergence(above, "kappa-2", "κ ≥ 2", scalar(above, "kappa-2", "κ ≥ 2"), at_rest)
