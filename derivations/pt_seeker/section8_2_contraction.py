"""Appendix: what holds from an instant on holds from its image on, for each T; and what letting T tend to ∞ adds."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Claim,
    Evidence,
    Exists,
    ForAll,
    Goal,
    claim,
    defeats_every_choice,
    eq,
    every,
    exists_by,
    ge,
    instances,
    le,
    limits,
    lt,
    reals,
)

from .chain import clock
from .notation import IN_TAU, IN_TIME, T, mu, t, t0, tau
from .section2_change_of_time import inverse_map
from .section2_ranges import contraction_range, dilation_range
from .section8_1_definitions import eps, image, matching_starts, settling, start_x, start_z, starts_are_images

SECTION = "Appendix: the stability properties"

# --- The same statement on both clocks --------------------------------------------------------------------------------

s = sp.Symbol("s", real=True)
in_dilated_time = sp.Function("D", nonnegative=True)  # a distance along the closed loop in τ
in_time = sp.Function("D_t", nonnegative=True)  # and the same distance along the closed loop in t
instant = sp.Symbol("tau_s", real=True)  # from here on it is small
same_signal = ForAll((s,), eq(in_time(s), in_dilated_time(clock.to_tau.subs(t, s))), (ge(s, t0), lt(s, t0 + T)))
small_in_tau = ForAll((s,), lt(in_dilated_time(s), eps), (ge(s, instant),))
small_in_t = ForAll((s,), lt(in_time(s), eps), (ge(s, image(instant)), lt(s, t0 + T)))


@claim(
    "appendix/small-in-time", "What is below ε from τ_s on in dilated time is so from the image of τ_s on in time",
    lt(in_time(t), eps), given=[same_signal, small_in_tau, ge(instant, t0), ge(t, image(instant)), lt(t, t0 + T)],
    labels=["def:FxT-sPUA", "def:FxT-sSPUAS"], uses=[inverse_map, dilation_range],
)  # fmt: skip
def small_in_time(goal: Goal) -> Evidence:
    """The dilation increases, so t ≥ a⁻¹(τ_s) gives a(t) ≥ τ_s. With τ_s = t₀ this is stability and boundedness, with
    t₀ + t_f and t₀ + μt_f attractivity. It holds for each T: no limit is needed."""
    return reals(goal, *instances(goal, t, clock.to_tau))


@claim(
    "appendix/small-in-dilated-time", "And conversely", lt(in_dilated_time(tau), eps),
    given=[same_signal, small_in_t, ge(instant, t0), ge(tau, instant)],
    labels=["def:FxT-sPUA", "def:FxT-sSPUAS"], uses=[inverse_map, contraction_range],
)  # fmt: skip
def small_in_dilated_time(goal: Goal) -> Evidence:
    """The contraction increases and leads onto I_t. So the matching definition in t and sSPUAS in τ are equivalent:
    quantifiers, radii and starts are the same."""
    return reals(goal, *instances(goal, clock.to_t))


# --- Letting T tend to infinity ---------------------------------------------------------------------------------------


@claim(
    "appendix/infinite-time", "As T tends to infinity the starts tend to those of sSPUAS and both maps to the identity",
    every(
        eq(sp.Limit(start_x, T, sp.oo, "-"), t0 + settling / mu),
        eq(sp.Limit(start_z, T, sp.oo, "-"), t0 + settling),
        eq(sp.Limit(clock.to_t, T, sp.oo, "-"), tau),
        eq(sp.Limit(clock.to_tau, T, sp.oo, "-"), t),
    ),
    labels=["def:FxT-sPUA", "def:FxT-sSPUAS"], place="Appendix", uses=[starts_are_images],
)  # fmt: skip
def infinite_time(goal: Goal) -> Evidence:
    """At each instant. The printed starts tend to those of sSPUAS, in which τ_f has the range [0, ∞)."""
    return limits(goal)


length = sp.Symbol("L", positive=True)
longer = sp.Symbol("w", nonnegative=True)


@claim(
    "appendix/close-on-compact-intervals", "On an interval of length L both maps are close to the identity for large T",
    every(
        ge(tau - clock.to_t, 0), le(tau - clock.to_t, length**2 / T),
        ge(clock.to_tau - t, 0), le(clock.to_tau - t, 2 * length**2 / T),
    ),
    given=[*IN_TAU, *IN_TIME, le(tau, t0 + length), le(t, t0 + length), ge(T, 2 * length)],
    labels=["def:FxT-sSPUAS"], place="Appendix", uses=[inverse_map],
)  # fmt: skip
def close_on_compact_intervals(goal: Goal) -> Evidence:
    """τ − a⁻¹(τ) = (τ − t₀)²/(T + τ − t₀) and a(t) − t = (t − t₀)²/(T − (t − t₀)): the rate at which they converge is
    1/T, and uniform on compact intervals."""
    return reals(goal)


@claim(
    "appendix/uniform-on-compact-intervals", "So the contraction converges uniformly there",
    Exists(
        (horizon := sp.Symbol("T_1", positive=True),),
        (lt(tau - image(tau).subs(T, horizon + longer), eps),), over=(tau, longer),
    ),
    given=[*IN_TAU, le(tau, t0 + length)],
    labels=["def:FxT-sSPUAS"], place="Appendix", uses=[close_on_compact_intervals],
)  # fmt: skip
def uniform_on_compact_intervals(goal: Goal) -> Evidence:
    """For every ε and every L some T₁ serves all T ≥ T₁ and all τ in [t₀, t₀ + L]: T₁ = 2L²/ε."""
    return exists_by(goal, {horizon: 2 * length**2 / eps})


@claim(
    "appendix/uniform-on-the-half-line", "For some T the contraction is within ε of the identity on all of I_τ",
    Exists((horizon,), (le(tau - image(tau).subs(T, horizon), eps),), over=(tau,)),
    given=IN_TAU, expected="refuted",
)  # fmt: skip
def uniform_on_the_half_line(goal: Goal) -> Evidence:
    """Refuted for every T and every ε, at τ = t₀ + T + 2ε. The contraction stays below t₀ + T, so however large T is,
    what happens late is moved by any amount. Letting T tend to infinity carries statements about compact intervals from
    one definition to the other, and none about all times: that each T has its equivalence is the claim above."""
    return defeats_every_choice(goal, {tau: t0 + horizon + 2 * eps})


equivalence: tuple[Claim, ...] = (small_in_time, small_in_dilated_time, matching_starts)
