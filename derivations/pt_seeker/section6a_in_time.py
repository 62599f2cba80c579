"""Section 6.1 and the abstract: what the average gains by the prescribed time, and that the time may be any.

All of it is about the averaged vehicle. For the vehicle the dither's frequency may have to be chosen for the T.
"""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    Fact,
    ForAll,
    Goal,
    claim,
    comparison,
    eq,
    every,
    exact,
    exp_monotone,
    ge,
    le,
    limits,
    lt,
    reals,
    specialise,
)
from ptproof.system import System
from ptproof.transforms.time import contract

from . import chain
from .notation import IN_TIME, E_norm, F, T, a1, a2, c, f, k, nu, t, t0, tau, x1, x2
from .section5b_0_trajectory import EXAMPLE, X1, X2, solves
from .section5b_2_gradient_drift import case_two, distance_at
from .section6a_asymptotic import asymptotic_average, distance_bound_in_t, end

SECTION = "6.1 Discussion: what the average gains by the prescribed time"

s, first, last = sp.symbols("s s_1 s_2", real=True)
driftless = dict.fromkeys(f, sp.S.Zero)
slow = asymptotic_average.with_values(driftless)
W = sp.Function("W", real=True)


@claim(
    "6.1/same-path", "Without drift the averaged PT Seeker is the averaged asymptotic one, run on the faster clock",
    eq(chain.averaged_t.with_values(driftless).vector, contract(System(tau, slow.state, slow.rhs), chain.clock).vector),
    given=IN_TIME, place="Section 6.1",
)  # fmt: skip
def same_path(goal: Goal) -> Evidence:
    """So at the instant t it is where the asymptotic one is at t₀ + (t − t₀)/ν."""
    return exact(goal)


@claim(
    "6.1/clock-ahead", "The faster clock is ahead, and by as much as one likes towards the prescribed time",
    every(le(t, end), eq(end - t, (t - t0) ** 2 / (T * nu(t - t0)))), given=IN_TIME, place="Section 6.1",
)  # fmt: skip
def clock_ahead(goal: Goal) -> Evidence:
    """(t − t₀)/ν against t − t₀."""
    return reals(goal)


@claim(
    "6.1/height-grows", "Along the averaged asymptotic seeker without drift the field does not fall",
    le(slow.derivative_along(-F), 0), place="Section 6.1",
)  # fmt: skip
def height_grows(goal: Goal) -> Evidence:
    """It grows at the rate (k/2)‖∇F‖², for every field."""
    return reals(goal)


pace = sp.Symbol("p", real=True)


@claim(
    "6.1/not-growing", "What grows at most at a constant rate", le(W(last), W(first) + pace * (last - first)),
    given=[ge(last, first), ForAll((s,), le(sp.Derivative(W(s), s), pace), (ge(s, first), le(s, last)))],
    place="Section 6.1",
)  # fmt: skip
def not_growing(goal: Goal) -> Evidence:
    """The comparison lemma. With the rate 0: what does not grow is not larger later."""
    return comparison(goal, W(first) + pace * (s - first))


def on_x(expression: sp.Expr, time: sp.Expr) -> sp.Expr:
    """An expression in the position, on the trajectory."""
    return expression.subs({x1: X1(time), x2: X2(time)}, simultaneous=True)


on_the_way = [
    ForAll((s,), eq(sp.Derivative(X(s), s), on_x(rate, s)), (ge(s, t0), le(s, end)))
    for X, rate in zip((X1, X2), slow.rhs, strict=True)
]


@claim(
    "6.1/pt-average-higher", "Without drift the averaged PT Seeker is at every instant at least as high in the field",
    ge(on_x(F, end), on_x(F, t)), given=[*IN_TIME, *on_the_way], place="Section 6.1",
    uses=[same_path, clock_ahead, height_grows, not_growing], example=EXAMPLE | {t: sp.Rational(1, 2)},
)  # fmt: skip
def higher(goal: Goal) -> Evidence:
    """X is the averaged asymptotic seeker: at the same instant, from the same start, the averaged PT Seeker is where X
    is at a later time. This is the advantage that the text speaks of, for every field and on the average."""

    def along(here: Goal, time: sp.Expr) -> list[Fact]:
        return specialise(here, height_grows, {x1: X1(time), x2: X2(time)})

    values = {W(s): -on_x(F, s), first: t, last: end, pace: sp.S.Zero}
    said = specialise(goal, clock_ahead, {})
    return reals(goal, *said, *specialise(goal, not_growing, values, said, along=along))


# --- As short a time as the user desires ------------------------------------------------------------------------------

near = sp.Symbol("epsilon_x", positive=True)
length = sp.Symbol("L", nonnegative=True)
arrival = t0 + T * length / (T + length)
growth, pull = sp.exp(c(2, sp.S.One) ** 2 / 2 * E_norm * T), k * c(1, sp.S.One) ** 2 / 4


def after(dilated: sp.Expr, start: sp.Expr) -> sp.Expr:
    """The bound of the distance after a dilated time."""
    return sp.sqrt(a1 / a2) * start * growth * sp.exp(-pull * dilated)


@claim(
    "6.2/within-any-distance", "For every T > 0 the average comes within every ε of the source before t₀ + T",
    le(distance_at(end), near),
    given=[*IN_TIME, ge(t, arrival), le(after(length, distance_at(t0)), near), *solves(end, t0), *case_two],
    place="Abstract", uses=[distance_bound_in_t], example=EXAMPLE | {t: sp.Rational(1, 2), length: 1, near: 1},
)  # fmt: skip
def within_any_distance(goal: Goal) -> Evidence:
    """For f = E∇F and κ = 1, from every start. L is a dilated time after which the bound is at most ε; it grows with
    the start and with T, and the average has arrived from t₀ + TL/(T + L) on. For the vehicle this says nothing by
    itself: ω₀ and μ₀ of the theorem may depend on T."""
    lag = (t - t0) / nu(t - t0)
    return reals(
        goal, *specialise(goal, distance_bound_in_t, {}), exp_monotone(-pull * lag, -pull * length),
    )  # fmt: skip


start = sp.Symbol("R_start", nonnegative=True)


@claim(
    "6.2/arrival-in-time", "That instant is before t₀ + T, and before t₀ + L, for every T and L",
    every(lt(arrival, t0 + T), le(arrival, t0 + length)), place="Abstract", uses=[within_any_distance],
)  # fmt: skip
def arrival_in_time(goal: Goal) -> Evidence:
    """TL/(T + L) is less than both."""
    return reals(goal)


@claim(
    "6.2/arrival-exists", "Such a dilated time exists for every ε, start and T",
    eq(sp.Limit(after(length, start), length, sp.oo, "-"), 0), place="Abstract", uses=[within_any_distance],
)  # fmt: skip
def arrival_exists(goal: Goal) -> Evidence:
    """The bound tends to 0 with the dilated time."""
    return limits(goal)
