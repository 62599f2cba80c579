"""Appendix: what the printed definition asks of the seeker, and that it is met trivially."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    Exists,
    ForAll,
    Goal,
    claim,
    defeats_every_choice,
    eq,
    exists_by,
    ge,
    le,
    limits,
    lt,
    reals,
    refute,
    specialise,
)
from ptproof.system import System
from ptproof.transforms import contract

from .chain import clock, fast_time, reduced_coordinates
from .notation import IN_TIME, F, T, f, k, mu, omega, t, t0, tau, tau_fast, x1, x2, z
from .section2_change_of_time import contraction_rate
from .section8_1_definitions import eps, later, settling, starts_are_images, t_f
from .section8_1_definitions import start_x as printed_x
from .section8_1_definitions import start_z as printed_z
from .section8_2_contraction import in_dilated_time, in_time, instant, s, same_signal, small_in_time

SECTION = "Appendix: the stability properties"

chosen = sp.Symbol("tau_f0", positive=True)  # a τ_f > 0, whichever
start_x, start_z = (start.subs(settling, chosen) for start in (printed_x, printed_z))
smaller = sp.Symbol("mu_1", positive=True)
factor = sp.Symbol("w", positive=True)
bound = sp.Symbol("mu_0", positive=True)


@claim(
    "appendix/start-of-x-limit", "The printed start of x tends to t₀ + T as μ tends to 0",
    eq(sp.Limit(start_x, mu, 0, "+"), t0 + T), labels=["def:FxT-sPUA"], uses=[starts_are_images],
)  # fmt: skip
def start_of_x_limit(goal: Goal) -> Evidence:
    """For every τ_f > 0: what is asked of x is asked on an interval that shrinks to nothing."""
    return limits(goal)


@claim(
    "appendix/start-of-x-falls", "A smaller μ makes the printed interval of x shorter",
    lt(start_x, start_x.subs(mu, smaller)), given=[lt(smaller, mu)], labels=["def:FxT-sPUA"],
)  # fmt: skip
def start_of_x_falls(goal: Goal) -> Evidence:
    """Although μ → 0 is what makes the approximation better."""
    return reals(goal)


@claim(
    "appendix/start-of-x-late", "For every instant before t₀ + T there is μ₀ such that below it x may arrive later",
    Exists((bound,), (lt(later, start_x.subs(mu, bound / (1 + factor))),), over=(factor,)),
    given=[lt(later, t0 + T)], labels=["def:FxT-sPUA"], uses=[start_of_x_limit],
)  # fmt: skip
def start_of_x_late(goal: Goal) -> Evidence:
    """Every μ below μ₀ is μ₀/(1 + w) with w > 0. Nothing is asked of x at the instant named."""
    ahead = later - t0
    return exists_by(goal, {bound: chosen * (T - ahead) / (T * (1 + sp.Max(0, ahead)))})


# --- It is met by whatever settles at all -----------------------------------------------------------------------------

x_settled = ForAll((s,), lt(in_dilated_time(s), eps), (ge(s, t0 + t_f),))
z_settled = ForAll((s,), lt(in_dilated_time(s), eps), (ge(s, t0 + mu * t_f),))


@claim(
    "appendix/printed-met-for-x", "Whatever τ_f > 0 was chosen, x meets the printed definition for μt_f ≤ τ_f",
    lt(in_time(t), eps),
    given=[same_signal, x_settled, le(mu * t_f, chosen), ge(t, start_x), lt(t, t0 + T)],
    labels=["def:FxT-sPUA"], uses=[small_in_time],
)  # fmt: skip
def printed_met_for_x(goal: Goal) -> Evidence:
    """Let x have settled from t₀ + t_f on in the slow time. Then μ₀ = τ_f/t_f serves, for each τ_f > 0: the same one
    for all radii δ and ε, and as small as one likes. μ₀ is chosen last, so t_f may even grow with ω. The printed
    definition thus says nothing about when x arrives."""
    return reals(goal, *specialise(goal, small_in_time, {instant: t0 + t_f}))


@claim(
    "appendix/printed-met-for-z", "And so does z", lt(in_time(t), eps),
    given=[same_signal, z_settled, le(mu * t_f, chosen), ge(t, start_z), lt(t, t0 + T)],
    labels=["def:FxT-sPUA"], uses=[small_in_time],
)  # fmt: skip
def printed_met_for_z(goal: Goal) -> Evidence:
    """z has settled from t₀ + μt_f on in the slow time, which is t₀ when μ tends to 0. The printed start of z is any
    fixed instant after t₀, so here too every τ_f > 0 serves; but it does ask z to have settled before that instant."""
    return reals(goal, *specialise(goal, small_in_time, {instant: t0 + mu * t_f}))


slow_arrival = 1 / sp.sqrt(mu)


@claim(
    "appendix/printed-allows-delay", "The printed definition is met by an x that needs 1/√μ of slow time",
    lt(in_time(t), eps),
    given=[
        same_signal, ForAll((s,), lt(in_dilated_time(s), eps), (ge(s, t0 + slow_arrival),)),
        le(sp.sqrt(mu), chosen), ge(t, start_x), lt(t, t0 + T),
    ],
    labels=["def:FxT-sPUA"], uses=[small_in_time],
)  # fmt: skip
def printed_allows_delay(goal: Goal) -> Evidence:
    """For √μ ≤ τ_f. Such an x arrives at an instant that tends to t₀ + T as μ tends to 0."""
    return reals(goal, *specialise(goal, small_in_time, {instant: t0 + slow_arrival}))


@claim(
    "appendix/delay-within-some-time", "That time has a bound t_f that serves all μ below some μ₀",
    Exists((t_f, bound), (le(slow_arrival.subs(mu, bound / (1 + factor)), t_f),), over=(factor,)), expected="refuted",
)  # fmt: skip
def delay_within_some_time(goal: Goal) -> Evidence:
    """Refuted, so an x like that does not meet the matching definition, nor sSPUAS: the printed definition does not
    imply either."""
    return defeats_every_choice(goal, {factor: bound * (1 + t_f) ** 2})


# --- The system that the printed starts belong to ---------------------------------------------------------------------

_fast = System(tau, fast_time.state, tuple(rate.subs(tau_fast, tau) for rate in fast_time.rhs), name="fast time as τ")


@claim(
    "appendix/contraction-of-the-fast-time", "The contraction of the fast time of system (1) is the seeker",
    eq(contract(_fast, clock).vector, contract(reduced_coordinates, clock).vector), given=IN_TIME,
    expected="refuted", uses=[contraction_rate],
)  # fmt: skip
def contraction_of_the_fast_time(goal: Goal) -> Evidence:
    """Refuted: this system has the printed starts, but its rates are μ times those of the seeker. The filter's rate
    (F − z)/ν² lacks the factor 1/μ."""
    plain = {t: 0, t0: 0, T: 1, x1: 0, x2: 0, z: 0, k: 1, omega: 1, mu: 2}
    return refute(goal, {F: 1, f[0]: 0, f[1]: 0, **plain})
