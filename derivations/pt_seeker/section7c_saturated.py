"""Section 7.3: the seeker with a saturated angular acceleration."""

from __future__ import annotations

import sympy as sp

from ptproof.problem.seekers import feedback, prescribed_time_gain, saturated_seeker
from ptproof.proof import (
    Evidence,
    Exists,
    Goal,
    Smooth,
    claim,
    definition,
    eq,
    every,
    exact,
    exists_by,
    ge,
    gt,
    le,
    lt,
    reals,
    refute,
    smooth,
)
from ptproof.system import gradient

from .chain import clock, letters
from .notation import (
    C,
    F,
    S,
    T,
    a1,
    a2,
    b1,
    b2,
    epsilon,
    f,
    k,
    mu,
    nu,
    omega,
    position,
    rate_of,
    t,
    t0,
    theta,
    u2,
    x1,
    x2,
    z,
)
from .section4_design import closed_t_printed

SECTION = "7.3 Simulation: saturated angular acceleration"

signal = sp.Symbol("w", real=True)
y = sp.Symbol("y", real=True)  # the measurement at one instant


def sat(value: sp.Expr) -> sp.Expr:
    """sat as the paper defines it."""
    return sp.Min(S, sp.Max(-S, value))


# --- The seeker -----------------------------------------------------------------------------------------------------

seeker = saturated_seeker(F, k=k, omega=omega, mu=mu, epsilon=epsilon, level=S, gain=C, time=t, states=letters)


argument = -u2 + C * (omega - k / mu * (F - z))
printed_rates = sp.Matrix([
    C * sp.sqrt(omega) * sp.cos(theta),
    C * sp.sqrt(omega) * sp.sin(theta),
    u2,
    sat(argument) / epsilon,
    C * (F - z) / mu,
])  # fmt: skip

definition(
    "7.3/saturated-seeker-printed", "The saturated seeker as printed",
    every(*(eq(rate_of(name, t), rate)
            for name, rate in zip(("x1", "x2", "theta", "u2", "z"), printed_rates, strict=True))),
    labels=["eq:sat_seeker", "eq:sat_acc"],
    prose="The angular velocity is a state of its own, and sat(x) = min(S, max(−S, x)).",
)  # fmt: skip


@claim(
    "7.3/saturated-seeker",
    "With C = 1/ν², while u₂ is at its steady state, the saturated seeker moves as the PT Seeker without drift",
    eq(
        closed_t_printed.subs({f[0]: 0, f[1]: 0}),
        sp.Matrix([seeker.rhs[i] for i in (0, 1, 2, 4)]).subs(C, prescribed_time_gain(clock)),
    ),
    given=[eq(argument.subs(C, 1 / nu(t - t0) ** 2), 0), ge(t, t0), lt(t, t0 + T)],
    labels=["eq:sat_seeker", "eq:closed_loop_system_t"],
)  # fmt: skip
def printed_seeker(goal: Goal) -> Evidence:
    """The seeker of the pipeline, whose heading turns at the rate u₂, against the printed closed loop."""
    return reals(goal)


@claim(
    "7.3/saturation", "The saturation: odd, bounded by S, and the identity up to S",
    every(
        le(sp.Abs(sat(signal)), S),
        eq(sat(-signal), -sat(signal)),
        eq(sat(signal), (sp.Abs(signal + S) - sp.Abs(signal - S)) / 2),
    ),
    place="Section 7.3",
)  # fmt: skip
def saturation(goal: Goal) -> Evidence:
    """The last form shows all of it: it is the signal itself between −S and S."""
    return reals(goal)


@claim(
    "7.3/saturation-identity", "Up to the level the saturation does nothing", eq(sat(signal), signal),
    given=[le(signal, S), ge(signal, -S)], place="Section 7.3",
)  # fmt: skip
def saturation_identity(goal: Goal) -> Evidence:
    """By cases."""
    return reals(goal)


acceleration = sat(-u2 + C * (omega - k / mu * (y - z))) / epsilon
law = feedback(y, z, k, omega, mu, prescribed_time_gain(clock))


@claim(
    "7.3/steady-state", "The steady state of the angular velocity is the only one",
    eq(u2, C * (omega - k / mu * (y - z))), given=[eq(acceleration, 0)],
    labels=["eq:sat_acc"], place="Section 7.3", uses=[saturation],
)  # fmt: skip
def steady_state(goal: Goal) -> Evidence:
    """The saturation vanishes only where its argument does."""
    return reals(goal)


@claim(
    "7.3/steady-state-is-one", "It is a steady state",
    eq(acceleration, 0), given=[eq(u2, C * (omega - k / mu * (y - z)))], labels=["eq:sat_acc"], place="Section 7.3",
)  # fmt: skip
def steady_state_is_one(goal: Goal) -> Evidence:
    """sat 0 = 0."""
    return exact(goal)


@claim(
    "7.3/steady-state-feedback", "With C(t) = 1/ν² the steady state is the PT feedback", eq(u2, law.angular),
    given=[eq(acceleration.subs(C, 1 / nu(t - t0) ** 2), 0), ge(t, t0), lt(t, t0 + T)],
    labels=["eq:sat_seeker", "eq:u2"], place="Section 7.3",
)  # fmt: skip
def steady_state_feedback(goal: Goal) -> Evidence:
    """The feedback comes from the pipeline, with the clock's gain; under clipping C is the clipped gain in both."""
    return reals(goal)


# --- The bound of the acceleration ----------------------------------------------------------------------------------

chosen = {S: sp.Integer(4), epsilon: sp.Rational("0.0004")}


@claim(
    "7.3/acceleration-at-4", "The angular acceleration is saturated at ±4, as printed",
    le(sp.Abs(acceleration.subs(chosen)), 4), expected="refuted", place="Section 7.3", grade="wording",
    wrong="Said of the angular acceleration, ±4 is the level of the signal that 1/ε multiplies.",
    survives="Yes: nothing is derived from it; the equation is right.",
)  # fmt: skip
def acceleration_at_4(goal: Goal) -> Evidence:
    """What is saturated at ±4 is the signal that 1/ε multiplies. With the parameters of the example and the filter at
    the field's value, a heading at rest is accelerated 2500 times as hard."""
    start = {u2: 0, C: 1, omega: 30, k: sp.Rational("1.4"), mu: sp.Rational("0.001"), y: -4, z: -4}
    return refute(goal, start)


@claim(
    "7.3/signal-at-4", "The saturated signal is bounded by 4", le(sp.Abs((epsilon * acceleration).subs(chosen)), 4),
    labels=["eq:sat_acc"], place="Section 7.3",
)  # fmt: skip
def signal_at_4(goal: Goal) -> Evidence:
    """ε du₂/dt."""
    return reals(goal)


@claim(
    "7.3/acceleration-bound", "The angular acceleration is bounded by S/ε", le(sp.Abs(acceleration), S / epsilon),
    labels=["eq:sat_acc"], place="Section 7.3",
)  # fmt: skip
def acceleration_bound(goal: Goal) -> Evidence:
    """The saturated signal over ε."""
    return reals(goal)


@claim(
    "7.3/acceleration-at-10000", "With the paper's parameters the angular acceleration is bounded by 10 000",
    le(sp.Abs(acceleration.subs(chosen)), 10_000), labels=["eq:sat_acc"], corrects=acceleration_at_4,
    place="Section 7.3",
)  # fmt: skip
def acceleration_at_10000(goal: Goal) -> Evidence:
    """4/0.0004; the value is attained, by the witness against the printed bound."""
    return reals(goal)


@claim(
    "7.3/constant-gain", "The constant gain 11.11 is below the largest clipped gain",
    lt(sp.Rational("11.11"), 1 / sp.Rational("0.3") ** 2), place="Section 7.3",
)  # fmt: skip
def constant_gain(goal: Goal) -> Evidence:
    """11.11 < 100/9: the time-varying gain ends a little above the constant one."""
    return reals(goal)


# --- The field ------------------------------------------------------------------------------------------------------

field = -(x1**2 + x2**2) / 2
slope = gradient(field, position)
square = x1**2 + x2**2
steepness = sp.sqrt(slope[0] ** 2 + slope[1] ** 2)


@claim(
    "7.3/peak", "The value at the source is 0, and the gradient vanishes there",
    every(eq(field, 0), eq(slope, [0, 0])), given=[eq(x1, 0), eq(x2, 0)], place="Section 7.3",
)  # fmt: skip
def peak_value(goal: Goal) -> Evidence:
    """By substitution."""
    return exact(goal)


@claim(
    "7.3/maximum", "The origin is the only global maximum", lt(field, 0), given=[gt(square, 0)], place="Section 7.3",
    uses=[peak_value],
)  # fmt: skip
def maximum(goal: Goal) -> Evidence:
    """A negative definite quadratic form."""
    return reals(goal)


@claim("7.3/smooth", "The field is C²", Smooth((field,), position, 2), place="Section 7.3")
def smooth_field(goal: Goal) -> Evidence:
    """A polynomial."""
    return smooth(goal)


level = sp.Symbol("M", positive=True)


@claim(
    "7.3/radially-unbounded", "The field falls below every level far away", le(field, -level),
    given=[ge(square, 2 * level)], place="Section 7.3",
)  # fmt: skip
def radially_unbounded(goal: Goal) -> Evidence:
    """It depends on the distance alone."""
    return reals(goal)


@claim(
    "7.3/assumption-2", "The field satisfies Assumption 2 on the whole plane with κ = 1",
    Exists(
        (a1, a2, b1, b2),
        (
            le(-a1 * square, field),
            le(field, -a2 * square),
            le(b1 * sp.sqrt(square), steepness),
            le(steepness, b2 * sp.sqrt(square)),
        ),
        over=position,
    ),
    labels=["eq:assumption2", "eq:assumption3"], place="Section 7.3",
    uses=[peak_value, maximum, smooth_field, radially_unbounded],
)  # fmt: skip
def assumption_2(goal: Goal) -> Evidence:
    """With a₁ = a₂ = 1/2 and b₁ = b₂ = 1, all four as equalities."""
    half = sp.Rational(1, 2)
    return exists_by(goal, {a1: half, a2: half, b1: sp.S.One, b2: sp.S.One})
