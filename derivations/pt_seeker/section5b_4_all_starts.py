"""Section 5, Theorem 2, Steps 4 and 5: the average of all starts is stable, by explicit bounds."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Claim,
    Evidence,
    Goal,
    claim,
    eq,
    every,
    exp_monotone,
    gt,
    le,
    limits,
    lt,
    reals,
    specialise,
)

from .notation import R0, E_norm, R, T, a1, a2, c, k, tau
from .section5a_3_uniformity import drift_factor
from .section5a_6_extended import extended_rho
from .section5b_3_all_trajectories import all_trajectories

SECTION = "5.2 Theorem, Steps 4 to 6: stability"

drift_rate, decay_rate = c(2, sp.S.One) ** 2 * E_norm, k * c(1, sp.S.One) ** 2 / 2
rho0 = sp.Symbol("rho_0", nonnegative=True)  # |ρ| at the start


def distance_bound(start: sp.Expr, factor: sp.Expr, passed: sp.Expr) -> sp.Expr:
    """The bound of the distance from the source along the average, for a start at that distance with that ρ₀."""
    return sp.sqrt(a1 / a2) * start * sp.exp(drift_rate * T * factor**2 / 2) * sp.exp(-decay_rate / 2 * passed)


# --- The distance from the set {x*} × [−1, 1] -------------------------------------------------------------------------

D0 = sp.Symbol("D_0", nonnegative=True)  # of the start, in (x, ρ)
D1 = sp.Symbol("D_1", nonnegative=True)
lag = sp.Symbol("tau_hat", nonnegative=True)  # τ − t₀
rho = sp.Symbol("rho", nonnegative=True)  # |ρ|


def beyond(factor: sp.Expr) -> sp.Expr:
    """How far ρ is outside [−1, 1], for ρ ≥ 0."""
    return sp.Max(factor - 1, 0)


def away(position: sp.Expr, factor: sp.Expr) -> sp.Expr:
    """The distance of (x, ρ) from {x*} × [−1, 1]."""
    return sp.sqrt(position**2 + beyond(factor) ** 2)


def kl(start: sp.Expr, passed: sp.Expr) -> sp.Expr:
    """The class-KL bound of that distance."""
    return distance_bound(start, 1 + start, passed) + start * sp.exp(1 - passed / T)


@claim(
    "5/step4-seeker-distance", "For the seeker, where 0 < ρ ≤ 1, the distance from the set is that from the source",
    eq(away(R, rho), R), given=[gt(rho, 0), le(rho, 1)], uses=[drift_factor],
)  # fmt: skip
def seeker_distance(goal: Goal) -> Evidence:
    """So what holds within δ and ε of the set {x*} × [−1, 1] holds within δ and ε of the source."""
    return reals(goal)


@claim(
    "5/step4-rho-part", "ρ enters [−1, 1] by the time T, and before that does not leave it further",
    le(beyond(rho), beyond(rho0) * sp.exp(1 - lag / T)), given=[eq(rho**2 * (1 + rho0**2 * lag / T), rho0**2)],
    uses=[extended_rho],
)  # fmt: skip
def rho_part(goal: Goal) -> Evidence:
    """From τ − t₀ = T on ρ² ≤ ρ₀²/(1 + ρ₀²) < 1; until then the exponential is at least 1."""
    return reals(goal, exp_monotone(0, 1 - lag / T))


B = sp.Symbol("B", nonnegative=True)


@claim(
    "5/step4-all-starts-parts", "ρ adds at most D₀ exp(1 − (τ − t₀)/T) to any bound of the position",
    le(away(R, rho), B + away(R0, rho0) * sp.exp(1 - lag / T)),
    given=[le(R, B), eq(rho**2 * (1 + rho0**2 * lag / T), rho0**2)], uses=[rho_part],
)  # fmt: skip
def all_starts_parts(goal: Goal) -> Evidence:
    """Without drift, where the position does not depend on ρ, this is all that is needed: B is then the bound of Step 4
    for every κ."""
    return reals(goal, *specialise(goal, rho_part, {}))


@claim(
    "5/step4-all-starts-guas", "The distance from the set {x*} × [−1, 1] has a class-KL bound along the average",
    le(away(R, rho), kl(away(R0, rho0), lag)),
    given=[le(R, distance_bound(R0, rho0, lag)), eq(rho**2 * (1 + rho0**2 * lag / T), rho0**2)],
    uses=[all_trajectories, all_starts_parts],
)  # fmt: skip
def all_starts_guas(goal: Goal) -> Evidence:
    """R is the distance from the source and ρ stands for |ρ|, at the start and now. From ρ₀ = 0 the average has no
    drift, and the bound is that of Step 4 for E = 0. The average does not depend on time, so neither does the bound on
    the initial time."""
    start = away(R0, rho0)
    return reals(
        goal, *specialise(goal, all_starts_parts, {B: distance_bound(R0, rho0, lag)}),
        exp_monotone(drift_rate * T * rho0**2 / 2, drift_rate * T * (1 + start) ** 2 / 2),
    )  # fmt: skip


@claim(
    "5/step4-all-starts-class-kl", "The bound is of class KL",
    every(
        eq(sp.Subs(kl(D0, lag), D0, 0), 0), lt(kl(D0, lag), kl(D1, lag)),
    ),
    given=[lt(D0, D1)], uses=[all_starts_guas],
)  # fmt: skip
def all_starts_class_kl(goal: Goal) -> Evidence:
    """It is 0 at 0 and increases with the distance at the start."""
    return reals(goal, exp_monotone(drift_rate * T * (1 + D0) ** 2 / 2, drift_rate * T * (1 + D1) ** 2 / 2))


D2 = sp.Symbol("D_2", positive=True)


@claim(
    "5/step4-all-starts-vanishes", "It decreases with time, to 0",
    eq(sp.Limit(kl(D2, tau), tau, sp.oo, "-"), 0), uses=[all_starts_class_kl],
)  # fmt: skip
def all_starts_vanishes(goal: Goal) -> Evidence:
    """Two exponentials."""
    return limits(goal)


@claim(
    "5/step4-all-starts-decreases", "Strictly", lt(sp.Derivative(kl(D2, lag), lag), 0),
    uses=[all_starts_vanishes],
)  # fmt: skip
def all_starts_decreases(goal: Goal) -> Evidence:
    """Both rates are positive."""
    return reals(goal)


stable_average: tuple[Claim, ...] = (
    all_trajectories,
    all_starts_guas,
    all_starts_class_kl,
    all_starts_vanishes,
    all_starts_decreases,
)
