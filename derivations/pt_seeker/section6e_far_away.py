"""Section 6: with the clipped gain and a signal that decays to zero the average barely progresses from far away."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Fact, ForAll, Goal, claim, eq, ge, le, reals, specialise

from .notation import C, F, f, k, omega, t0, x1, x2
from .section6a_decaying import X1, X2, distance_squared, signal, square
from .section6d_clipped import below_one, clipped, final, gain_after, gain_before, s, total, total_time, with_gain
from .section6e_after_the_clip import Along, advance_after, advance_before, advances

SECTION = "6.4 Discussion: what the clipped gain costs"

average = with_gain.with_values({F: signal, f[0]: sp.S.Zero, f[1]: sp.S.Zero})


@claim(
    "6.4/decaying-rate", "Under the gain C the fourth power of the distance falls at most at the rate 4kC",
    le(average.derivative_along(-(square**2)), 4 * k * C), place="Section 6",
)  # fmt: skip
def decaying_rate(goal: Goal) -> Evidence:
    """For F = 1/(1 + ‖x‖²) without drift."""
    return reals(goal)


def moves(end: sp.Expr, gain: sp.Expr) -> list[ForAll]:
    """X is a trajectory of that average under the gain."""
    return [
        ForAll((s,), eq(sp.Derivative(X(s), s), rate.subs({C: gain, x1: X1(s), x2: X2(s)})), (ge(s, t0), le(s, end)))
        for X, rate in zip((X1, X2), average.rhs, strict=True)
    ]


@claim(
    "6.4/grows-at-the-rate-of-the-gain", "What grows at most at a multiple of the clipped gain, at the prescribed time",
    le(Along(final), Along(t0) + sp.sqrt(omega) * total), given=[below_one, advances(t0, final, clipped(s))],
    place="Section 6", uses=[advance_before, advance_after, gain_before, gain_after, total_time],
)  # fmt: skip
def grows(goal: Goal) -> Evidence:
    """As the vehicle's way does, with √ω for the multiple."""
    return reals(goal, *specialise(goal, advance_before, {}), *specialise(goal, advance_after, {}))


@claim(
    "6.4/decaying-barely-progresses", "Under the clipped gain the average barely progresses from far away",
    ge(distance_squared(final) ** 2, distance_squared(t0) ** 2 - 4 * k * total),
    given=[below_one, *moves(final, clipped(s))], place="Section 6",
    uses=[decaying_rate, grows],
)  # fmt: skip
def barely(goal: Goal) -> Evidence:
    """The fourth power of the distance falls by at most 4kT(2/ν_min − 1) up to the prescribed time: from the distance R
    with R⁴ ≥ r⁴ + 4kT(2/ν_min − 1) the average is not nearer than r then."""
    way = {Along(s): -(distance_squared(s) ** 2), omega: 16 * k**2}

    def along(here: Goal, time: sp.Expr) -> list[Fact]:
        return specialise(here, decaying_rate, {C: clipped(time), x1: X1(time), x2: X2(time)})

    return reals(goal, *specialise(goal, grows, way, along=along))
