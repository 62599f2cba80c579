"""Section 7.2: the averaged asymptotic seeker in the example with a bounded drift is bounded, and does not settle."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Fact, ForAll, Goal, claim, comparison, eq, ge, le, lt, reals, specialise

from .notation import k, t, t0, x1, x2
from .section6a_asymptotic import averaged_asymptotic
from .section7b_nonvanishing import slope, square
from .section7e_bounded_drift import (
    X,
    asymptotic,
    asymptotic_rate,
    damping,
    first,
    never_settles,
    pt_falls,
    pull,
    pulled,
    s,
    size,
    stays,
    turn_1,
    turn_2,
)

SECTION = "7.2 Simulation: the averages of both seekers"

W = sp.Function("W", nonnegative=True)
Y = sp.Function("X_2", real=True)
level = 32 / k**2
# The first instant of a trajectory from the source at time 0, where its velocity is (1, 1).
BEGUN = {k: 1, t0: 0, first: 0, t: 0, X(s): s, Y(s): s}


@claim(
    "7.2/asymptotic-average-falls", "The rate of the squared distance of the averaged asymptotic seeker",
    le(asymptotic.derivative_along(square), -k * square / 2 + 16 / k), place="Section 7.2",
    uses=[averaged_asymptotic, pull, pt_falls],
)  # fmt: skip
def asymptotic_falls(goal: Goal) -> Evidence:
    """As for the PT Seeker, with a drift that nothing damps."""
    beat = 1 + sp.sin(3 * t)
    values = {
        pulled: x1 * slope[0] + x2 * slope[1], size: beat, damping: sp.S.One, turn_1: sp.cos(x1), turn_2: sp.cos(x2),
    }  # fmt: skip
    return reals(goal, *specialise(goal, pull, {}), *specialise(goal, pt_falls, values))


@claim(
    "7.2/asymptotic-average-comparison", "What falls like this is bounded",
    le(W(t), W(t0) * sp.exp(-k / 2 * (t - t0)) + level),
    given=[ge(t, t0), ForAll((s,), le(sp.Derivative(W(s), s), -k * W(s) / 2 + 16 / k), (ge(s, t0), le(s, t)))],
    place="Section 7.2", uses=[asymptotic_falls],
)  # fmt: skip
def bounded_comparison(goal: Goal) -> Evidence:
    """The comparison lemma."""
    return comparison(goal, W(t0) * sp.exp(-k / 2 * (s - t0)) + level)


def on_x(expression: sp.Expr, time: sp.Expr) -> sp.Expr:
    """An expression in t and the position, on the trajectory."""
    return expression.subs({t: time, x1: X(time), x2: Y(time)}, simultaneous=True)


def solves(since: sp.Expr) -> list[ForAll]:
    """X and Y are the coordinates of the averaged asymptotic seeker from an instant on, up to t."""
    return [
        ForAll((s,), eq(sp.Derivative(state(s), s), on_x(rate, s)), (ge(s, since), le(s, t)))
        for state, rate in zip((X, Y), asymptotic.rhs, strict=True)
    ]


def put(time: sp.Expr) -> dict[sp.Expr, sp.Expr]:
    """The values of a claim at one instant of the trajectory."""
    return {t: time, x1: X(time), x2: Y(time)}


@claim(
    "7.2/asymptotic-average-bounded", "The averaged asymptotic seeker stays bounded, as the text says of the vehicle",
    le(on_x(square, t), on_x(square, t0) * sp.exp(-k / 2 * (t - t0)) + level), given=[ge(t, t0), *solves(t0)],
    place="Section 7.2", uses=[asymptotic_falls, bounded_comparison], example=BEGUN,
)  # fmt: skip
def asymptotic_bounded(goal: Goal) -> Evidence:
    """From every start, for every k. The level, for k = 1 a distance of 5.7, is no estimate of how far it gets."""

    def along(here: Goal, time: sp.Expr) -> list[Fact]:
        return specialise(here, asymptotic_falls, put(time))

    return reals(goal, *specialise(goal, bounded_comparison, {W(s): on_x(square, s)}, along=along))


@claim(
    "7.2/asymptotic-average-does-not-settle",
    "For k < 7/3 no averaged trajectory of the asymptotic seeker is near the source for long",
    le((7 - 3 * k) * (t - first), sp.Rational(38, 3)),
    given=[ge(t, first), lt(k, sp.Rational(7, 3)), *stays, solves(first)[0]], place="Section 7.2",
    uses=[asymptotic_rate, never_settles], example=BEGUN,
)  # fmt: skip
def does_not_settle(goal: Goal) -> Evidence:
    """X is the first coordinate of such a trajectory, whose rate does not depend on the second one. With k = 1 it is
    within 1/2 of the source for at most 19/6 seconds at a time: it does not come to rest at the source. That it
    oscillates is more than is claimed."""

    def along(here: Goal, time: sp.Expr) -> list[Fact]:
        return specialise(here, asymptotic_rate, {t: time, x1: X(time)})

    return reals(goal, *specialise(goal, never_settles, {}, along=along))
