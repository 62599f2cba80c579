"""Appendix: the definitions of FxT-sSPUAS, and at which instants their intervals start on either clock."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    Exists,
    Goal,
    Prose,
    claim,
    defeats_every_choice,
    definition,
    eq,
    every,
    exact,
    exists_by,
    exp_monotone,
    ge,
    gt,
    le,
    lt,
    reals,
    refute,
)

from .chain import clock
from .notation import T, k, mu, t0, tau, tau_fast
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
matching = definition(
    "appendix/matching-attractivity", "Attractive within the prescribed time: the definition that matches Step 6",
    Prose("As the printed definition, with t_f in [0, ∞) in place of τ_f in [0, T), x within ε_x from "
          "t₀ + t_f/(1 + t_f/T) on, and z within ε_z from t₀ + μt_f/(1 + μt_f/T) on"),
    labels=[], prose="Ours. The starts are the images of t₀ + t_f and t₀ + μt_f, where sSPUAS has x and z settled in "
    "the slow time that Step 6 contracts.",
)  # fmt: skip

settling = sp.Symbol("tau_f0", nonnegative=True)  # the paper's τ_f, a length of dilated time
t_f = sp.Symbol("t_f", nonnegative=True)  # the settling time of sSPUAS: x needs t_f/μ and z needs t_f of fast time
later = sp.Symbol("t_s", real=True)


def image(instant: sp.Expr) -> sp.Expr:
    """The instant in t that belongs to one in τ, as eq:t_to_tau prints it."""
    return t0 + (instant - t0) / (1 + (instant - t0) / T)


start_x = t0 + (settling / mu) / (1 + settling / (mu * T))  # both as printed
start_z = t0 + settling / (1 + settling / T)
matching_x, matching_z = (image(t0 + length) for length in (t_f, mu * t_f))

# --- Which instants they are ----------------------------------------------------------------------------------------


@claim(
    "appendix/starts-are-images", "Both printed intervals start at images of fast times",
    every(
        eq(start_x, sp.Subs(clock.to_t, tau, t0 + settling / mu)),
        eq(start_z, sp.Subs(clock.to_t, tau, t0 + settling)),
    ),
    labels=["def:FxT-sPUA", "eq:t_to_tau"], uses=[inverse_map],
)  # fmt: skip
def starts_are_images(goal: Goal) -> Evidence:
    """sSPUAS counts time in the fast scale of system (1): there x has settled from t₀ + τ_f/μ on, and z from t₀ + τ_f
    on. The printed starts are what the contraction makes of these two instants, taken as they are."""
    return exact(goal)


started = mu * (t0 / mu + tau_fast)  # the slow time when tau_fast of fast time has passed since t₀/μ


@claim(
    "appendix/start-of-x-printed", "The interval of x starts at the image of the slow time at which x has settled",
    eq(start_x, sp.Subs(clock.to_t, tau, started.subs(tau_fast, settling / mu))), labels=["def:FxT-sPUA"],
    expected="refuted", grade="definition",
    wrong="The starts of the intervals are contracted from the fast time of system (1), Step 6 contracts the slow "
    "time, so that for the seeker the printed interval of x shrinks to nothing as μ tends to 0.",
    survives="Yes: Theorem 2 holds with the printed definition, where it says nothing about when x arrives, and with "
    "the matching one, where it says as much as the proof gives.",
)  # fmt: skip
def start_of_x_printed(goal: Goal) -> Evidence:
    """Refuted. The seeker in t is the contraction of the closed loop in the slow time τ = μτ̃. There x has settled τ_f
    after its start and z has settled μτ_f after it. For μ = 1/2, τ_f = T = 1 the printed start is t₀ + 2/3 and the
    image of the settling is t₀ + 1/2."""
    return refute(goal, {t0: 0, T: 1, settling: 1, mu: sp.Rational(1, 2)})


@claim(
    "appendix/matching-starts", "The images of the slow times at which x and z have settled",
    every(
        eq(matching_x, sp.Subs(clock.to_t, tau, started.subs(tau_fast, t_f / mu))),
        eq(matching_z, sp.Subs(clock.to_t, tau, started.subs(tau_fast, t_f))),
    ),
    labels=["def:FxT-sPUA", "eq:t_to_tau"], corrects=start_of_x_printed, uses=[inverse_map],
)  # fmt: skip
def matching_starts(goal: Goal) -> Evidence:
    """The fast time t₀/μ + σ is the slow time t₀ + μσ: with σ = t_f/μ for x and σ = t_f for z these are the starts of
    the matching definition. The system in fast time has to be started at t₀/μ for that, which the uniformity in the
    initial time allows."""
    return exact(goal)


@claim(
    "appendix/started-too-early", "Started at the fast time t₀ > 0, system (1) would start before t₀ in slow time",
    lt(mu * t0, t0), given=[lt(mu, 1), gt(t0, 0)],
)  # fmt: skip
def started_too_early(goal: Goal) -> Evidence:
    """The paper gives both systems the initial time t₀. The slow time μt₀ lies before the interval I_τ, so the two
    starts agree only if system (1) is started at t₀/μ."""
    return reals(goal)


@claim(
    "appendix/starts-in-time", "The printed intervals start within the prescribed time, for every τ_f ≥ 0",
    every(ge(start_x, t0), lt(start_x, t0 + T), ge(start_z, t0), lt(start_z, t0 + T)),
    labels=["def:FxT-sPUA"], uses=[contraction_range],
)  # fmt: skip
def starts_in_time(goal: Goal) -> Evidence:
    """So neither interval is empty, however long the settling takes on the infinite interval."""
    return reals(goal)


@claim(
    "appendix/filter-settles-first", "For μ < 1 the interval of z starts no later than that of x, in both definitions",
    every(le(start_z, start_x), le(matching_z, matching_x)), given=[lt(mu, 1)],
    labels=["def:FxT-sPUA"],
)  # fmt: skip
def filter_settles_first(goal: Goal) -> Evidence:
    """As the contraction increases."""
    return reals(goal)


# --- The range of τ_f -------------------------------------------------------------------------------------------------


@claim(
    "appendix/first-half-only", "t_f < T says that x arrives in the first half of the prescribed time",
    lt(matching_x, t0 + T / 2), given=[lt(t_f, T)], labels=["def:FxT-sPUA"],
)  # fmt: skip
def first_half_only(goal: Goal) -> Evidence:
    """The definition takes τ_f from [0, T), while it is a length of dilated time, which has no such limit. In the
    matching definition this range would ask x to be within ε_x before t₀ + T/2. The printed starts lose that: there
    every τ_f > 0 will do."""
    return reals(goal)


@claim(
    "appendix/second-half", "t_f ≥ T says that x is only known to arrive in the second half",
    ge(matching_x, t0 + T / 2), given=[ge(t_f, T)], labels=["def:FxT-sPUA"],
)  # fmt: skip
def second_half(goal: Goal) -> Evidence:
    """The converse, so that t_f < T and the first half are the same."""
    return reals(goal)


@claim(
    "appendix/every-start-occurs", "With t_f from [0, ∞) every instant of I_t is such a start",
    Exists((t_f,), (eq(matching_x, later),)), given=[ge(later, t0), lt(later, t0 + T)], labels=["def:FxT-sPUA"],
)  # fmt: skip
def every_start_occurs(goal: Goal) -> Evidence:
    """t_f = (t − t₀)/ν(t − t₀), which is below T for the first half of I_t only."""
    return exists_by(goal, {t_f: sp.Max(0, (later - t0) / (1 - (later - t0) / T))})


delta, eps = sp.symbols("delta epsilon_x", positive=True)
share, after = sp.symbols("w s", nonnegative=True)
far = gt(delta * sp.exp(-k * T), eps)  # δ/ε > e^{kT}


@claim(
    "appendix/short-settling", "Some t_f in [0, T) serves dx/dτ = −kx from δ to ε, for δ/ε > exp(kT)",
    Exists((share,), (le(delta * sp.exp(-k * (T * share / (1 + share) + after)), eps),), over=(after,)),
    given=[far], expected="refuted",
)  # fmt: skip
def short_settling(goal: Goal) -> Evidence:
    """Refuted for every t_f in [0, T), written as Tw/(1 + w) with w ≥ 0: at t_f itself the solution δe^(−kτ) is still
    above ε. The scalar example of Section 2.2 is uniformly asymptotically stable, so with the range [0, T) the matching
    definition would not follow from what Theorem 1 gives."""
    slower = exp_monotone(-k * T, -k * (T * share / (1 + share)))
    return defeats_every_choice(goal, {after: 0}, [slower])


@claim(
    "appendix/long-settling", "Every t_f from log(δ/ε)/k on does, of which there are some in [0, ∞)",
    le(delta * sp.exp(-k * (t_f + after)), eps), given=[ge(k * t_f, sp.log(delta / eps))],
    corrects=short_settling,
)  # fmt: skip
def long_settling(goal: Goal) -> Evidence:
    """The exponential falls, so it stays below ε from there on: the range has to be [0, ∞), as in sSPUAS."""
    return reals(goal, exp_monotone(-k * (t_f + after), -sp.log(delta / eps)))
