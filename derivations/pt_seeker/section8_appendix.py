"""Appendix: the definitions of FxT-sSPUAS, and what their intervals are on the other clock."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    Exists,
    Goal,
    Prose,
    claim,
    definition,
    eq,
    every,
    exact,
    exists_by,
    ge,
    le,
    limits,
    lt,
    reals,
)

from .chain import clock
from .notation import T, mu, t, t0, tau
from .section2_change_of_time import inverse_map
from .section2_ranges import contraction_range

SECTION = "Appendix: the stability properties"

stability = definition(
    "appendix/stability", "Fixed-time singularly practically uniformly stable",
    Prose("For all T and all ε_x, ε_z there are δ_x, δ_z and ω₀ such that for every ω > ω₀ there is a μ₀ such that for "
          "every μ < μ₀ and every t₀ ≥ 0, what starts within δ_x, δ_z stays within ε_x, ε_z on [t₀, t₀ + T)"),
    labels=[], prose="x is measured from the set, z from the quasi-steady state.",
)  # fmt: skip
attractivity = definition(
    "appendix/attractivity", "Fixed-time singularly practically uniformly attractive",
    Prose("For all T and all δ_x, δ_z, ε_x, ε_z there are τ_f in [0, T) and ω₀ such that for every ω > ω₀ there is μ₀ "
          "such that for every μ < μ₀ and every t₀ ≥ 0, what starts within δ_x, δ_z is within ε_x from "
          "t₀ + (τ_f/μ)/(1 + τ_f/(μT)) on and within ε_z from t₀ + τ_f/(1 + τ_f/T) on, up to t₀ + T"),
    labels=["def:FxT-sPUA"], prose="The two starts of the intervals are the subject of the claims below.",
)  # fmt: skip
boundedness = definition(
    "appendix/boundedness", "Fixed-time singularly practically uniformly bounded",
    Prose("For all T and all δ_x, δ_z there are ε_x, ε_z and ω₀ such that for every ω > ω₀ there is a μ₀ such that for "
          "every μ < μ₀ and every t₀ ≥ 0, what starts within δ_x, δ_z stays within ε_x, ε_z on [t₀, t₀ + T)"),
    labels=[], prose="As stability, with the order of the two pairs of radii exchanged.",
)  # fmt: skip
all_three = definition(
    "appendix/fxt-sspuas", "FxT-sSPUAS",
    Prose("Stable, attractive and with bounded solutions, in the three senses above"),
    labels=["def:FxT-sSPUAS"], prose="With T set to infinity it is the property sSPUAS of Theorem 1.",
)  # fmt: skip

settling = sp.Symbol("tau_f0", nonnegative=True)  # the paper's τ_f, a length of dilated time
start_x = t0 + (settling / mu) / (1 + settling / (mu * T))
start_z = t0 + settling / (1 + settling / T)


@claim(
    "appendix/starts-are-images", "Both intervals start at images of dilated times",
    every(
        eq(start_x, clock.to_t.subs(tau, t0 + settling / mu)),
        eq(start_z, clock.to_t.subs(tau, t0 + settling)),
    ),
    labels=["def:FxT-sPUA", "eq:t_to_tau"], uses=[inverse_map],
)  # fmt: skip
def starts_are_images(goal: Goal) -> Evidence:
    """On the infinite interval x has settled from t₀ + τ_f/μ on, and z from t₀ + τ_f on; the contraction gives the
    printed starts."""
    return exact(goal)


@claim(
    "appendix/starts-in-time", "Both intervals start within the prescribed time, for every τ_f ≥ 0",
    every(ge(start_x, t0), lt(start_x, t0 + T), ge(start_z, t0), lt(start_z, t0 + T)),
    labels=["def:FxT-sPUA"], uses=[contraction_range],
)  # fmt: skip
def starts_in_time(goal: Goal) -> Evidence:
    """So neither interval is empty, however long the settling takes on the infinite interval."""
    return reals(goal)


@claim(
    "appendix/filter-settles-first", "The filter settles first", le(start_z, start_x), given=[lt(mu, 1)],
    labels=["def:FxT-sPUA"],
)  # fmt: skip
def filter_settles_first(goal: Goal) -> Evidence:
    """For μ < 1, as the contraction increases."""
    return reals(goal)


@claim(
    "appendix/first-half-only", "With τ_f < T the interval of z starts in the first half of the prescribed time",
    lt(start_z, t0 + T / 2), given=[lt(settling, T)], labels=["def:FxT-sPUA"],
)  # fmt: skip
def first_half_only(goal: Goal) -> Evidence:
    """The definition takes τ_f from [0, T), while τ_f is a length of dilated time, which has no such limit. So the
    definition asks for more than the image of the sSPUAS definition: z has to settle before t₀ + T/2."""
    return reals(goal)


later = sp.Symbol("t_s", real=True)


@claim(
    "appendix/every-start-occurs", "With τ_f from [0, ∞) every instant of I_t is such a start",
    Exists((settling,), (eq(start_z, later),)), given=[ge(later, t0), lt(later, t0 + T)], labels=["def:FxT-sPUA"],
)  # fmt: skip
def every_start_occurs(goal: Goal) -> Evidence:
    """τ_f = (t − t₀)/ν(t − t₀), which is below T for the first half of I_t only."""
    return exists_by(goal, {settling: sp.Max(0, (later - t0) / (1 - (later - t0) / T))})


@claim(
    "appendix/infinite-time", "As T tends to infinity the definitions become those on the infinite interval",
    every(
        eq(sp.Limit(start_x, T, sp.oo, "-"), t0 + settling / mu),
        eq(sp.Limit(start_z, T, sp.oo, "-"), t0 + settling),
        eq(sp.Limit(clock.to_t, T, sp.oo, "-"), tau),
        eq(sp.Limit(clock.to_tau, T, sp.oo, "-"), t),
    ),
    labels=["def:FxT-sPUA", "def:FxT-sSPUAS"], place="Appendix", uses=[starts_are_images],
)  # fmt: skip
def infinite_time(goal: Goal) -> Evidence:
    """The starts tend to t₀ + τ_f/μ and t₀ + τ_f, the range [0, T) of τ_f to [0, ∞), and both time maps to the
    identity: this is the equivalence that the text speaks of."""
    return limits(goal)
