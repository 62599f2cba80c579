"""Section 6.4: what the clipped gain guarantees on the average, under the vanishing drift with κ = 1.

The prescribed time ends while the gain is 1/ν_min². All of it is about the averaged vehicle; what is shown here of
everything that changes as V does is applied to its trajectories in the next part.
"""

from __future__ import annotations

import sympy as sp

from ptproof.averaging import average, split_dithers
from ptproof.problem.seekers import asymptotic_seeker
from ptproof.proof import (
    Evidence,
    ForAll,
    Goal,
    claim,
    comparison,
    eq,
    every,
    exact,
    ge,
    gt,
    le,
    lt,
    reals,
    specialise,
)
from ptproof.system import System
from ptproof.transforms.clocks import capped
from ptproof.transforms.reduction import split
from ptproof.transforms.states import change_variable, solve_state

from . import chain
from .notation import (
    C,
    E,
    E_norm,
    F,
    F_source,
    T,
    c,
    f,
    k,
    mu,
    nu,
    omega,
    p,
    position,
    t,
    t0,
    theta,
    z,
)  # fmt: skip
from .section3_problem import against_gradient, g1, g2, h1_drift, h2_drift, spectral_norm
from .section6c_feasibility import lowest

SECTION = "6.4 Discussion: what the clipped gain guarantees"

ONE = sp.S.One
s = sp.Symbol("s", real=True)
below_one = lt(lowest, 1)
switch = t0 + T * (1 - lowest)  # where ν has fallen to ν_min
final = t0 + T


def clipped(time: sp.Expr) -> sp.Expr:
    """The gain with ν replaced by max(ν_min, ν), for every ν_min."""
    return 1 / sp.Max(lowest, nu(time - t0)) ** 2


@claim(
    "6.4/clipped-gain-before", "Before the clip the gain is 1/ν²", eq(clipped(t), 1 / nu(t - t0) ** 2),
    given=[below_one, ge(t, t0), le(t, switch)], place="Section 6.4",
)  # fmt: skip
def gain_before(goal: Goal) -> Evidence:
    """ν falls to ν_min at t₀ + T(1 − ν_min)."""
    return reals(goal)


@claim(
    "6.4/clipped-gain-after", "From the clip on the gain is 1/ν_min²", eq(clipped(t), 1 / lowest**2),
    given=[below_one, ge(t, switch)], place="Section 6.4",
)  # fmt: skip
def gain_after(goal: Goal) -> Evidence:
    """It stays there, also after the prescribed time."""
    return reals(goal)


total = T * (2 / lowest - 1)
clock = capped(chain.clock, lowest)
early, late = clock.pieces


@claim(
    "6.4/clipped-clock", "The clock whose rate is the clipped gain",
    every(
        eq(early.to_tau.subs(t, t0), t0), eq(late.to_tau.subs(t, switch), early.to_tau.subs(t, switch)),
        eq(sp.Derivative(early.to_tau, t), 1 / nu(t - t0) ** 2), eq(sp.Derivative(late.to_tau, t), 1 / lowest**2),
    ),
    given=[below_one, gt(nu(t - t0), 0)], place="Section 6.4", uses=[gain_before, gain_after],
)  # fmt: skip
def clipped_clock(goal: Goal) -> Evidence:
    """It starts at t₀, runs at the rate 1/ν² before the clip and 1/ν_min² from there on, and does not jump."""
    return exact(goal)


@claim(
    "6.4/clipped-total-time", "Up to the prescribed time the dilated time T(2/ν_min − 1) passes",
    eq(late.to_tau.subs(t, final) - t0, total), place="Section 6.4", uses=[clipped_clock],
)  # fmt: skip
def total_time(goal: Goal) -> Evidence:
    """T(1/ν_min − 1) before the clip and T/ν_min during the last T ν_min: 17T/3 for ν_min = 0.3, 9T for 0.2."""
    return exact(goal)


# --- The average ------------------------------------------------------------------------------------------------------

# A seeker with the gain C runs in the time that C dilates like the asymptotic one, under the drift f/C.
_slower = asymptotic_seeker(F, [entry / C for entry in f], k=k, omega=omega, mu=mu, time=t, states=chain.letters)
_reduced = solve_state(change_variable(_slower, theta, p, theta + k * z, p - k * z), p, omega * t)
_average = average(split_dithers(split(_reduced, [z], mu).reduced_model(), omega))
slope = sp.Matrix(chain.gradient_F)
with_gain = System(t, position, tuple(C * entry for entry in _average.rhs), name="average under the gain C")


@claim(
    "6.4/average-with-gain", "The average under any gain C: the gain multiplies the gradient and not the drift",
    eq([f[i] + C * k / 2 * slope[i] for i in (0, 1)], with_gain.vector), place="Section 6.4",
)  # fmt: skip
def average_with_gain(goal: Goal) -> Evidence:
    """C is the gain at one instant: 1/ν² gives eq:LBA_reduced_model_t, 1 the average of the asymptotic seeker."""
    return exact(goal)


drift = E * slope
drifted = with_gain.with_values(dict(zip(f, drift, strict=True)))


@claim(
    "6.4/rate-with-gain", "dV/dt of the average under the gain C and a drift E∇F",
    le(drifted.derivative_along(F_source - F), (E_norm - C * k / 2) * slope.dot(slope)),
    given=[le(drift.dot(drift), E_norm**2 * slope.dot(slope))], place="Section 6.4",
    uses=[average_with_gain, against_gradient, spectral_norm],
)  # fmt: skip
def rate_with_gain(goal: Goal) -> Evidence:
    """At most (‖E‖ − Ck/2)‖∇F‖²: the drift and the seeking as one difference. What is assumed holds for the spectral
    norm of E."""
    values = dict(zip((g1, g2, h1_drift, h2_drift), (*slope, *drift), strict=True))
    return reals(goal, *specialise(goal, against_gradient, values))


# --- What changes as V does -------------------------------------------------------------------------------------------

V_t = sp.Function("V", real=True)
C1, C2 = c(1, ONE), c(2, ONE)
drift_rate, decay_rate = C2**2 * E_norm, k * C1**2 / 2


def linear(first: sp.Expr, end: sp.Expr, gain: sp.Expr) -> ForAll:
    """The linear inequality that follows."""
    rate = (drift_rate - gain * decay_rate) * V_t(s)
    return ForAll((s,), le(sp.Derivative(V_t(s), s), rate), (ge(s, first), le(s, end)))


def bound_before(end: sp.Expr) -> sp.Expr:
    """The exponent of V from t₀ to ``end``, before the clip."""
    return drift_rate * (end - t0) - decay_rate * (end - t0) / nu(end - t0)


@claim(
    "6.4/v-before-the-clip", "V before the clip",
    le(V_t(t), V_t(t0) * sp.exp(bound_before(t))),
    given=[below_one, ge(t, t0), le(t, switch), linear(t0, t, 1 / nu(s - t0) ** 2)], place="Section 6.4",
    uses=[rate_with_gain, gain_before],
)  # fmt: skip
def v_before(goal: Goal) -> Evidence:
    """The comparison equation is linear. In t the drift acts for the time t − t₀, the gain for (t − t₀)/ν."""
    return comparison(goal, V_t(t0) * sp.exp(bound_before(s)), denominators=[nu(s - t0)])


later = sp.Symbol("t_2", real=True)


@claim(
    "6.4/v-after-the-clip", "V after the clip",
    le(V_t(later), V_t(switch) * sp.exp((drift_rate - decay_rate / lowest**2) * (later - switch))),
    given=[below_one, ge(later, switch), linear(switch, later, 1 / lowest**2)], place="Section 6.4",
    uses=[rate_with_gain, gain_after],
)  # fmt: skip
def v_after(goal: Goal) -> Evidence:
    """The same with a constant gain: V goes on falling exponentially if k c₁² > 2ν_min²c₂²‖E‖."""
    return comparison(goal, V_t(switch) * sp.exp((drift_rate - decay_rate / lowest**2) * (s - switch)))


@claim(
    "6.4/v-at-the-prescribed-time", "V at the prescribed time, under the clipped gain",
    le(V_t(final), V_t(t0) * sp.exp(drift_rate * T) * sp.exp(-decay_rate * total)),
    given=[below_one, linear(t0, final, clipped(s))], place="Section 6.4",
    uses=[v_before, v_after, gain_before, gain_after, total_time],
)  # fmt: skip
def v_final(goal: Goal) -> Evidence:
    """The drift enters as without the clip, since it is not multiplied by the gain: c₂²‖E‖T. What the gain does is
    that of the dilated time T(2/ν_min − 1)."""
    first = specialise(goal, v_before, {t: switch})
    return reals(goal, *first, *specialise(goal, v_after, {later: final}))
