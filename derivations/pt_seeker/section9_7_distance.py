"""Beyond the paper: the distance from the source, for every κ, where the drift is never stronger than the feedback.

The bound is the Proposition's function β of class KL, with (τ − τ₀)²/(T + τ − τ₀) for the time: what is lost against
τ − τ₀ is less than T, and it is lost by the drift.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import sympy as sp

from ptproof.proof import (
    Assumption,
    Claim,
    Evidence,
    Fact,
    Goal,
    claim,
    eq,
    every,
    exact,
    ge,
    gt,
    le,
    lt,
    power_monotone,
    power_nonnegative,
    reals,
    specialise,
    squeezed,
)
from ptproof.proof.substitution import Substitution

from .notation import IN_TIME, E_norm, T, a1, a2, f, k, kappa, nu, position, t, t0, tau, x1, x2
from .section5b_0_trajectory import F_1, F_2, X1, X2, V_along, assumption_2, later, solves, start, v_nonnegative
from .section5b_0_trajectory import v_bounds as between
from .section5b_0_with_drift import gradient_drift_given
from .section5b_1_lyapunov import n
from .section5b_2_gradient_drift import distance_at
from .section5d_1_interval import beta, decay, elapsed, end, first, fixed, low, m, regular, second
from .section5d_1_one_interval import root_of_a_bound, some_u, some_v
from .section5d_2_estimates import kappa_1, kappa_2
from .section5d_3_trajectory import named
from .section6b_3_only import g
from .section9_3_every_order import (
    KINDS,
    At,
    bound,
    for_order,
    form_by_norm,
    form_of_minors,
    form_of_norm,
    never_stronger,
    norm_bounds,
    pushed,
    saved,
    semidefinite,
    semidefinite_form,
    sigma,
)

SECTION = "Beyond the paper"
Kind: TypeAlias = tuple[Claim, Claim, Claim]

V_end, V_begin, R_end, R_begin = sp.symbols("V_end V_begin R_end R_begin", nonnegative=True)
won = sp.Symbol("varsigma", nonnegative=True)  # the time in the bound of V


def v_of_distance(order: sp.Expr, tag: str, words: str, scalar: tuple[Claim, ...]) -> Claim:
    """From the bound of V to one of the distance, for one kind of κ."""
    decay_monotone = named(scalar, "decay-monotone")
    root = V_begin ** (1 / (2 * order))
    renamed = {m: order - 1} if order != 1 else {}

    @claim(
        f"beyond/distance-by-v-{tag}", f"From the bound of V to a bound of the distance, {words}",
        le(R_end, beta(R_begin, won, order)),
        given=[
            le(a2 * R_end ** (2 * order), V_end), le(V_begin, a1 * R_begin ** (2 * order)),
            le(V_end, bound(order, V_begin).subs(saved, won)),
        ],
        uses=[root_of_a_bound, decay_monotone],
    )  # fmt: skip
    def by_v(goal: Goal) -> Evidence:
        """Roots are taken, and the decay from a larger start is larger."""
        high = a1 ** (1 / (2 * order)) * R_begin
        said = [power_nonnegative(V_begin, 1 / (2 * order)), *regular(order, root, won), *regular(order, high, won)]
        values = {kappa: order, some_v: V_end, some_u: decay(root, won, order)}
        return reals(
            goal, *said, *specialise(goal, root_of_a_bound, values, said),
            *specialise(goal, root_of_a_bound, {kappa: order, some_v: V_begin, some_u: high}),
            power_monotone(a2 * R_end ** (2 * order), V_end, 1 / (2 * order)),
            *specialise(goal, decay_monotone, {**renamed, first: root, second: high, elapsed: won}, said),
        )  # fmt: skip

    return by_v


@claim(
    "beyond/time-of-the-bound", "The time in the bound starts at 0, does not decrease, and lags by less than T",
    every(
        eq(sp.Subs(saved, tau, start), 0), ge(sp.Derivative(saved, tau), 0),
        ge(saved, tau - start - T), le(saved, tau - start),
    ),
    given=[ge(tau, start)],
)  # fmt: skip
def time_of_the_bound(goal: Goal) -> Evidence:
    """(τ − τ₀)²/(T + τ − τ₀)."""
    return reals(goal)


in_t = (t - t0) ** 2 / (T * nu(t - t0))


@claim(
    "beyond/time-of-the-bound-in-t", "In the original time it is (t − t₀)²/(Tν)",
    eq(in_t, saved.subs({start: t0, tau: end}, simultaneous=True)), given=IN_TIME, uses=[time_of_the_bound],
)  # fmt: skip
def time_in_t(goal: Goal) -> Evidence:
    """It tends to infinity as t tends to t₀ + T."""
    return exact(goal)


def for_kind(general: Claim, by_v: Claim, order: sp.Expr, tag: str, words: str, scalar: tuple[Claim, ...]) -> Kind:
    """The distance along every averaged trajectory, for one kind of κ."""
    assumed = [never_stronger, *for_order(assumption_2, order)]
    example = dict(general.example)

    @claim(
        f"beyond/distance-{tag}", f"A drift that is never stronger: the distance along averaged trajectories, {words}",
        le(distance_at(tau), beta(distance_at(start), saved, order)), given=[*solves(tau), *later, *assumed],
        uses=[general, between, v_nonnegative, by_v, time_of_the_bound], example=example,
    )  # fmt: skip
    def distance(goal: Goal) -> Evidence:
        """β is of class KL, and at the start it is (a₁/a₂)^(1/2κ) times the distance."""
        said = [
            fact for time in (tau, start) for used in (between, v_nonnegative)
            for fact in specialise(goal, used, {kappa: order, x1: X1(time), x2: X2(time)})
        ]  # fmt: skip
        values = {
            R_end: distance_at(tau), R_begin: distance_at(start), V_end: V_along, V_begin: V_along.subs(tau, start),
            won: saved,
        }  # fmt: skip
        root = power_nonnegative(V_along.subs(tau, start), sigma)
        return reals(goal, *said, root, *specialise(goal, general, {}), *specialise(goal, by_v, values, said))

    @claim(
        f"beyond/distance-in-t-{tag}", f"The same in the original time, {words}",
        le(distance_at(end), beta(distance_at(t0), in_t, order)), given=[*IN_TIME, *solves(end, t0), *assumed],
        uses=[distance, time_in_t], example={**example, t: sp.Rational(1, 2)},
    )  # fmt: skip
    def distance_in_t(goal: Goal) -> Evidence:
        """x̄(t) is X at the dilated time of t; the start is at t₀."""
        return reals(goal, *specialise(goal, distance, {tau: end, start: t0}), *specialise(goal, time_in_t, {}))

    @claim(
        f"beyond/distance-at-the-end-{tag}", f"Such an averaged trajectory reaches the source in the time T, {words}",
        eq(sp.Limit(distance_at(end), t, t0 + T, "-"), 0), given=[*solves(None, t0), *assumed],
        uses=[distance_in_t, *(() if order == 1 else (named(scalar, "beta-uniform"),))],
        example=example,
    )  # fmt: skip
    def reaches(goal: Goal) -> Evidence:
        """The distance lies between 0 and a bound that tends to 0."""
        start_at = distance_at(t0)

        def facts(there: Goal) -> list[Fact]:
            said = specialise(there, distance_in_t, {})
            if order == 1:
                return said
            return [*said, *specialise(there, named(scalar, "beta-uniform"), {m: n, second: start_at, low: in_t})]

        bound = beta(start_at, in_t, order) if order == 1 else fixed(in_t, order)
        return squeezed(goal, bound, [gt(t, t0), lt(t, t0 + T)], facts)

    return distance, distance_in_t, reaches


SCALARS = (kappa_1, kappa_2)
by_v_claims = tuple(
    v_of_distance(order, tag, words, scalar) for (_, order, tag, words), scalar in zip(KINDS, SCALARS, strict=True)
)
kind_one, kind_above = (
    for_kind(general, by_v, order, tag, words, scalar)
    for by_v, (general, order, tag, words), scalar in zip(by_v_claims, KINDS, SCALARS, strict=True)
)


# --- f = E∇F: what the theorem is about, for every κ ------------------------------------------------------------------


def theorem(tag: str, words: str, drift: Sequence[Assumption], uses: Sequence[Claim], says: At) -> Claim:
    """The average under f = E∇F reaches the source, for κ ≥ 2; ``says`` knows the form at a gradient."""
    _, distance_in_t, reaches = kind_above
    (_, order, _, kind), uniform = KINDS[1], named(kappa_2, "beta-uniform")

    @claim(
        f"beyond/theorem-{tag}", f"If {words}, every averaged trajectory under f = E∇F reaches the source in T, {kind}",
        reaches.statement,
        given=[*solves(None, t0), *gradient_drift_given, *drift, *for_order(assumption_2, order)],
        uses=[distance_in_t, uniform, *uses], example=dict(reaches.example),
    )  # fmt: skip
    def in_time(goal: Goal) -> Evidence:
        """From everywhere. Theorem 2 says this for κ = 1, and for every E, since its bound allows the average to be
        driven away at first; for κ ≥ 2 that may end in an escape."""

        def along(there: Goal, point: sp.Expr) -> list[Fact]:
            if not isinstance(point, sp.Tuple):
                return []
            put = Substitution(dict(zip((t, *position), point, strict=True))).into
            return says(there, dict(zip((*g, *pushed), map(put, (F_1, F_2, *f)), strict=True)))

        def facts(there: Goal) -> list[Fact]:
            values = {m: n, second: distance_at(t0), low: in_t}
            return [*specialise(there, distance_in_t, {}, along=along), *specialise(there, uniform, values)]

        return squeezed(goal, fixed(in_t, order), [gt(t, t0), lt(t, t0 + T)], facts)

    return in_time


theorem_norm = theorem("norm", "k ≥ 2‖E‖", [norm_bounds, ge(k, 2 * E_norm)], [form_by_norm], form_of_norm)
theorem_semidefinite = theorem(
    "semidefinite", "(k/2)I + (E + Eᵀ)/2 is positive semidefinite", semidefinite, [semidefinite_form], form_of_minors
)
