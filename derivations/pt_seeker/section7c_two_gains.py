"""Section 7.3: the time-varying gain against the constant one, without and with the saturation."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    ForAll,
    Goal,
    claim,
    comparison,
    enclosures,
    eq,
    every,
    exact,
    ge,
    gt,
    le,
    lt,
    reals,
    specialise,
)  # fmt: skip
from ptproof.system import System, gradient
from ptproof.transforms.clocks import CappedClock, Clock, capped, constant_clock
from ptproof.transforms.time import contract

from . import chain
from .notation import C, F, S, T, epsilon, f, k, mu, nu, omega, t, t0, tau, theta, x1, x2, z
from .section6c_feasibility import lowest
from .section6d_clipped import clipped, total_time
from .section6e_after_the_clip import X_t, residual_exact
from .section7_clipping import in_time, minimum, printed_gain
from .section7c_saturated import chosen, field, steady_state_feedback

SECTION = "7.3 Simulation: the two gains"

constant = sp.Rational("11.11")  # k_h
clock = capped(chain.clock, minimum)
early, late = clock.pieces
switch, final = t0 + (1 - minimum) * T, t0 + T
s = sp.Symbol("s", real=True)


# --- Without saturation -----------------------------------------------------------------------------------------------


at_gain_one = chain.asymptotic.with_values(dict.fromkeys(f, 0))


def driven(gain: sp.Expr) -> sp.Matrix:
    """eq:sat_seeker with the gain C(t), its angular velocity at the printed steady state."""
    return sp.Matrix([
        gain * sp.sqrt(omega) * sp.cos(theta), gain * sp.sqrt(omega) * sp.sin(theta),
        gain * (omega - k / mu * (F - z)), gain / mu * (F - z),
    ])  # fmt: skip


def on_clock(clock: Clock | CappedClock) -> sp.Matrix:
    """The asymptotic seeker without drift, run on a clock."""
    return contract(System(tau, at_gain_one.state, at_gain_one.rhs), clock).vector


@claim(
    "7.3/same-path", "Without drift and saturation the vehicle drives the same path with either gain",
    every(
        eq(driven(printed_gain), on_clock(clock)),
        eq(driven(constant), on_clock(constant_clock(t, tau, start=t0, rate=constant))),
    ),
    given=in_time, labels=["eq:sat_seeker"], place="Section 7.3", uses=[steady_state_feedback],
)  # fmt: skip
def same_path(goal: Goal) -> Evidence:
    """Each is the asymptotic seeker, run on a clock of its own whose rate is the gain: it decides only how far along
    the path the vehicle is. This is about the vehicle itself."""
    return reals(goal)


@claim(
    "7.3/constant-gain-ahead-at-first", "Before the clip the constant gain is ahead: its dilated time is longer",
    lt(early.to_tau - t0, constant * (t - t0)), given=[gt(t, t0), le(t, switch)], place="Section 7.3",
    uses=[same_path],
)  # fmt: skip
def ahead_at_first(goal: Goal) -> Evidence:
    """(t − t₀)/ν with ν ≥ 0.3 is at most 3.34(t − t₀)."""
    return reals(goal)


@claim(
    "7.3/constant-gain-ahead", "And it stays ahead up to the prescribed time",
    lt(late.to_tau - t0, constant * (t - t0)), given=[ge(t, switch), le(t, final)], place="Section 7.3",
    uses=[same_path],
)  # fmt: skip
def ahead(goal: Goal) -> Evidence:
    """After the clip the time-varying gain is larger by 1/900 only, and does not catch up."""
    return reals(goal)


@claim(
    "7.3/dilated-times", "At the prescribed time 11.11T against 17T/3",
    every(eq(late.to_tau.subs(t, final) - t0, sp.Rational(17, 3) * T), lt(sp.Rational(17, 3) * T, constant * T)),
    place="Section 7.3", uses=[total_time],
)  # fmt: skip
def dilated_times(goal: Goal) -> Evidence:
    """So without saturation the constant gain is where the time-varying one is at T already at 0.51T: that it is slower
    in the simulation can only come from the saturation, as the text says."""
    return reals(goal)


varying, steady = (sp.Function(name, real=True) for name in ("X", "Y"))


def moves(state: sp.Expr, gain: sp.Expr) -> ForAll:
    """A coordinate of the averaged vehicle for F = −‖x‖²/2 under a gain."""
    return ForAll((s,), eq(sp.Derivative(state, s), -gain * k / 2 * state), (ge(s, t0), le(s, final)))


@claim(
    "7.3/coordinate-with-constant-gain", "A coordinate of the average under a constant gain, from above",
    le(steady(final), steady(t0) * sp.exp(-C * k / 2 * T)),
    given=[ForAll((s,), le(sp.Derivative(steady(s), s), -C * k / 2 * steady(s)), (ge(s, t0), le(s, final)))],
    place="Section 7.3",
)  # fmt: skip
def coordinate(goal: Goal) -> Evidence:
    """A linear comparison equation."""
    return comparison(goal, steady(t0) * sp.exp(-C * k / 2 * (s - t0)))


@claim(
    "7.3/constant-gain-nearer", "On the average a constant gain above 17/3 brings the vehicle nearer by T",
    every(
        le(steady(final) ** 2, varying(final) ** 2 * sp.exp(-(C - sp.Rational(17, 3)) * k * T)),
        lt(sp.Rational(17, 3), constant),
    ),
    given=[
        gt(C, sp.Rational(17, 3)), moves(varying(s), clipped(s).subs(lowest, minimum)), moves(steady(s), C),
        eq(steady(t0), varying(t0)),
    ],
    place="Section 7.3", uses=[residual_exact, coordinate, dilated_times],
)  # fmt: skip
def nearer(goal: Goal) -> Evidence:
    """Each coordinate, squared, from the same start, for the field of the example without saturation. With 11.11 and
    k = 1.4 it is nearer by a factor of 45."""
    both = (steady(s), -steady(s))
    return reals(
        goal, *specialise(goal, residual_exact, {lowest: minimum, X_t(s): varying(s)}),
        *(fact for value in both for fact in specialise(goal, coordinate, {steady(s): value})),
    )  # fmt: skip


# --- With the saturation ----------------------------------------------------------------------------------------------

# The command C(ω − k dF/dτ) of an exact differentiator, which the settled filter approximates: its rate along the path.
steepness = gradient(field, (x1, x2))
values = {k: sp.Rational("1.4"), omega: sp.Integer(30)}
climb = sp.sqrt(omega) * (steepness[0] * sp.cos(theta) + steepness[1] * sp.sin(theta))  # dF/dτ
command = C * (omega - k * climb)
ideal = System(t, (x1, x2, theta), (C * sp.sqrt(omega) * sp.cos(theta), C * sp.sqrt(omega) * sp.sin(theta), command))
gain_slope = sp.Symbol("C_dot", real=True)  # dC/dt
command_rate = (ideal.derivative_along(command) + gain_slope * command / C).subs({**values, x1: 2, x2: 2})
limit = chosen[S] / chosen[epsilon]


@claim(
    "7.3/gain-at-the-start", "The time-varying gain starts at 1 with the slope 2/T",
    every(eq(sp.Subs(1 / nu(s) ** 2, s, 0), 1), eq(sp.Subs(sp.Derivative(1 / nu(s) ** 2, s), s, 0), 2 / T)),
    place="Section 7.3",
)  # fmt: skip
def gain_at_the_start(goal: Goal) -> Evidence:
    """s is the time t − t₀."""
    return exact(goal)


@claim(
    "7.3/command-rate-varying", "With the time-varying gain the command starts well within what u₂ can follow",
    le(sp.Abs(command_rate.subs({C: 1, gain_slope: 2})), limit / 6), given=[ge(theta, -sp.pi), le(theta, sp.pi)],
    labels=["eq:sat_acc"], place="Section 7.3", uses=[gain_at_the_start],
)  # fmt: skip
def command_rate_varying(goal: Goal) -> Evidence:
    """For every heading at the start of the example, with the filter's output at dF/dτ. The limit is S/ε = 10 000."""
    return enclosures(goal, {theta: (sp.Rational(-22, 7), sp.Rational(22, 7))})


@claim(
    "7.3/command-rate-constant", "With the constant gain the command turns seven times faster than u₂ can follow",
    le(7 * limit, sp.Abs(command_rate.subs({C: constant, gain_slope: 0, theta: 3 * sp.pi / 4}))),
    labels=["eq:sat_acc"], place="Section 7.3",
)  # fmt: skip
def command_rate_constant(goal: Goal) -> Evidence:
    """At the same start, for a vehicle that looks across the gradient. Both factors of the rate grow with the gain, so
    it grows with its square, 123. This is how the saturation slows the seeker with the constant gain."""
    return enclosures(goal)
