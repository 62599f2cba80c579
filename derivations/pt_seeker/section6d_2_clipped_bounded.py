"""Section 6.4: what the clipped gain guarantees on the average under a bounded drift, for κ = 1.

Without the clip the average reaches the source. With it the gain stays finite, and what is left at the prescribed time
is a level that does not depend on the start, beside what is left of the start.
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
    ge,
    instances,
    le,
    limits,
    reals,
    specialise,
)

from .notation import C, F, F_source, T, a1, a2, c, d, f, k, kappa, nu, position, t, t0, x1, x2
from .section5b_0_trajectory import EXAMPLE, X1, X2, V_of_x, assumption_2, distance, gradient_bounds, v_bounds
from .section5b_0_trajectory import v_nonnegative as nonnegative
from .section5b_1_lyapunov import at_order
from .section6c_feasibility import lowest
from .section6d_clipped import (
    ONE,
    average_with_gain,
    below_one,
    clipped,
    final,
    gain_after,
    gain_before,
    later,
    s,
    slope,
    switch,
    total,
    total_time,
    with_gain,
)

SECTION = "6.4 Discussion: what the clipped gain guarantees"

V_t = sp.Function("V", real=True)
square = slope.dot(slope)
decay = k * c(1, ONE) ** 2 / 4
level = (2 * d / (k * c(1, ONE))) ** 2  # of V where the gain 1 balances the drift


@claim(
    "6.4/bounded-rate", "dV/dt of the average under the gain C and a bounded drift",
    le(with_gain.derivative_along(F_source - F), d**2 / (C * k) - C * k / 4 * square),
    given=[le(f[0] ** 2 + f[1] ** 2, d**2)], place="Section 6.4", uses=[average_with_gain],
)  # fmt: skip
def bounded_rate(goal: Goal) -> Evidence:
    """Half of the decrease pays for the drift."""
    return reals(goal)


def rate_of_v(value: sp.Expr, gain: sp.Expr) -> sp.Expr:
    """The bound of the rate of V for κ = 1."""
    return d**2 / (gain * k) - gain * decay * value


def falls(first: sp.Expr, end: sp.Expr, gain: sp.Expr) -> ForAll:
    """V falls at that rate at least, from ``first`` to ``end``."""
    return ForAll((s,), le(sp.Derivative(V_t(s), s), rate_of_v(V_t(s), gain)), (ge(s, first), le(s, end)))


@claim(
    "6.4/bounded-before-the-clip", "V before the clip, under a bounded drift",
    le(V_t(t), V_t(t0) * sp.exp(-decay * (t - t0) / nu(t - t0)) + level),
    given=[below_one, ge(t, t0), le(t, switch), falls(t0, t, 1 / nu(s - t0) ** 2)], place="Section 6.4",
    uses=[bounded_rate],
)  # fmt: skip
def bounded_before(goal: Goal) -> Evidence:
    """The gain is at least 1, so that the level at which the gain 1 balances the drift is never left upwards."""
    return comparison(goal, V_t(t0) * sp.exp(-decay * (s - t0) / nu(s - t0)) + level, denominators=[nu(s - t0)])


@claim(
    "6.4/bounded-after-the-clip", "V after the clip, under a bounded drift",
    le(V_t(later), V_t(switch) * sp.exp(-decay / lowest**2 * (later - switch)) + lowest**4 * level),
    given=[below_one, ge(later, switch), falls(switch, later, 1 / lowest**2)], place="Section 6.4",
    uses=[bounded_rate],
)  # fmt: skip
def bounded_after(goal: Goal) -> Evidence:
    """The same with the gain 1/ν_min², for all times, also after the prescribed one: V ends at or below
    ν_min⁴(2d/(kc₁))², and with a drift that does not vanish it stays in general above 0."""
    return comparison(goal, V_t(switch) * sp.exp(-decay / lowest**2 * (s - switch)) + lowest**4 * level)


def at_the_end(start: sp.Expr) -> sp.Expr:
    """The bound of V at the prescribed time, for V or a bound of it at the start."""
    return start * sp.exp(-decay * total) + level * (sp.exp(-decay * T / lowest) + lowest**4)


@claim(
    "6.4/bounded-at-the-prescribed-time", "V at the prescribed time, under the clipped gain and a bounded drift",
    le(V_t(final), at_the_end(V_t(t0))), given=[below_one, falls(t0, final, clipped(s))], place="Section 6.4",
    uses=[bounded_before, bounded_after, gain_before, gain_after, total_time],
)  # fmt: skip
def bounded_final(goal: Goal) -> Evidence:
    """Of the start the share e^(−(kc₁²/4)T(2/ν_min − 1)) is left, and of the drift a level that is fixed by
    ν_min⁴ and by what decays from the clip to the end."""
    return reals(goal, *specialise(goal, bounded_before, {t: switch}), *specialise(goal, bounded_after, {later: final}))


@claim(
    "6.4/bounded-residual-vanishes", "Both parts of the bound tend to 0 as ν_min tends to 0",
    eq(sp.Limit(at_the_end(V_t(t0)), lowest, 0, "+"), 0), place="Section 6.4", uses=[bounded_final],
)  # fmt: skip
def bounded_residual(goal: Goal) -> Evidence:
    """As the Proposition has it without the clip. For κ = 1 the level in the distance is proportional to ν_min²d/k."""
    return limits(goal)


# --- Along a trajectory -----------------------------------------------------------------------------------------------

K = sp.Function("K", positive=True)  # the gain in time
there = {x1: X1(t), x2: X2(t)}


def on_x(expression: sp.Expr, time: sp.Expr) -> sp.Expr:
    """An expression in t and the position, on the trajectory X."""
    return expression.subs({t: time, x1: X1(time), x2: X2(time)}, simultaneous=True)


def moves(end: sp.Expr, gain: sp.Expr) -> list[ForAll]:
    """X is a trajectory of the average under the gain, from t₀ to ``end``."""
    rates = [entry.subs(C, gain) for entry in with_gain.rhs]
    return [
        ForAll((s,), eq(sp.Derivative(X(s), s), on_x(rate, s)), (ge(s, t0), le(s, end)))
        for X, rate in zip((X1, X2), rates, strict=True)
    ]


bounded = ForAll((t, *position), le(f[0] ** 2 + f[1] ** 2, d**2))
one = at_order(assumption_2, ONE)
V_x = on_x(V_of_x, t)


@claim(
    "6.4/bounded-v-inequality", "V along every averaged trajectory under any gain and a bounded drift, κ = 1",
    le(sp.Derivative(V_x, t), rate_of_v(V_x, K(t))), given=[ge(t, t0), *moves(t, K(s)), bounded, *one],
    place="Section 6.4", uses=[bounded_rate, gradient_bounds, nonnegative],
    example=EXAMPLE | {K(s): 1, t: 1},
)  # fmt: skip
def bounded_inequality(goal: Goal) -> Evidence:
    """The rate of V by the gradient, and the gradient by V."""
    values = {kappa: ONE, **there}
    return reals(
        goal, *instances(goal, t, (t, X1(t), X2(t))), *specialise(goal, bounded_rate, {C: K(t), **there}),
        *specialise(goal, gradient_bounds, values), *specialise(goal, nonnegative, values),
    )  # fmt: skip


def distance_then(time: sp.Expr) -> sp.Expr:
    """‖X − x*‖."""
    return on_x(distance, time)


@claim(
    "6.4/bounded-distance", "The averaged distance at the prescribed time, with the clip and a bounded drift, κ = 1",
    le(a2 * distance_then(final) ** 2, at_the_end(a1 * distance_then(t0) ** 2)),
    given=[below_one, *moves(final, clipped(s)), bounded, *one], place="Section 6.4",
    uses=[bounded_inequality, bounded_final, v_bounds, nonnegative],
    example=EXAMPLE | {lowest: sp.Rational(1, 2), X1(s): 0, x1: 0},
)  # fmt: skip
def bounded_distance(goal: Goal) -> Evidence:
    """From everywhere, for every gain and every bound d: this is what is left of the Proposition under the clip."""

    def facts(here: Goal, time: sp.Expr) -> list[Fact]:
        place = {kappa: ONE, x1: X1(time), x2: X2(time)}
        said = specialise(here, nonnegative, place)
        if le(time, final) in here.assumptions:
            said += specialise(here, bounded_inequality, {t: time, K(s): clipped(s)})
        return said

    ends = [
        fact for time in (final, t0) for used in (v_bounds, nonnegative)
        for fact in specialise(goal, used, {kappa: ONE, x1: X1(time), x2: X2(time)})
    ]  # fmt: skip
    return reals(goal, *ends, *specialise(goal, bounded_final, {V_t(s): on_x(V_of_x, s)}, ends, along=facts))
