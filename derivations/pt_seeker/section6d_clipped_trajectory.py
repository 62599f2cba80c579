"""Section 6.4: the averaged trajectory under the clipped gain and a drift E∇F, for κ = 1: from its equation to a bound.

X solves the average under a gain, the field satisfies Assumption 2, and the drift is of case A of Assumption 3.
"""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Assumption,
    Evidence,
    Fact,
    ForAll,
    Goal,
    claim,
    eq,
    ge,
    instances,
    le,
    power_nonnegative,
    reals,
    specialise,
)

from .notation import C, E, E_norm, F, F_source, T, a1, a2, f, k, kappa, position, t, t0, x1, x2
from .section3_problem import g1, g2
from .section5b_0_trajectory import EXAMPLE, G_0, X1, X2, V_of_x, gradient_bounds, gradient_norm, v_bounds
from .section5b_0_trajectory import v_nonnegative as nonnegative
from .section5b_0_with_drift import (
    drift_by_gradient,
    high_factor,
    low_factor,
    norm_below,
    norm_of_E,
    power,
    pushed,
    rate,
    w1,
    w2,
    widening,
)
from .section5b_0_with_drift import slope as v_dot
from .section6c_feasibility import lowest
from .section6d_2_clipped_bounded import K, V_x, distance_then, moves, on_x, one, there
from .section6d_clipped import (
    C1,
    C2,
    ONE,
    V_t,
    average_with_gain,
    below_one,
    clipped,
    decay_rate,
    drift_rate,
    final,
    gain_after,
    later,
    s,
    slope,
    switch,
    total,
    v_after,
    v_final,
    with_gain,
)

SECTION = "6.4 Discussion: what the clipped gain guarantees"

# f(t, x) = E∇F(x) at all instants: a clipped seeker also runs after the prescribed time.
gradient_drift = [ForAll((t, *position), eq(f[i], pushed[i])) for i in (0, 1)]
drift_norm = sp.sqrt(f[0] ** 2 + f[1] ** 2)
steepness, push = on_x(gradient_norm, t), on_x(drift_norm, t)
case_a: list[Assumption] = [*one, *gradient_drift, norm_of_E]
# F = −‖x‖² and E = −I, so that X' = (2 − kK)X; with k = 4 and K = 1 it falls.
FALLING = EXAMPLE | {
    f[0]: 2 * x1, f[1]: 2 * x2, E[0, 0]: -1, E[1, 1]: -1, E_norm: 1, k: 4, X1(s): sp.exp(-2 * s), K(s): 1, t: 1,
}  # fmt: skip


@claim(
    "6.4/rate-by-norms", "dV/dt of the average under the gain C and any drift",
    le(with_gain.derivative_along(F_source - F), drift_norm * gradient_norm - C * k / 2 * gradient_norm**2),
    place="Section 6.4", uses=[average_with_gain],
)  # fmt: skip
def rate_by_norms(goal: Goal) -> Evidence:
    """The inequality of Cauchy and Schwarz."""
    return reals(goal)


@claim(
    "6.4/rate-along", "The rate of V along every averaged trajectory under any gain and any drift",
    le(sp.Derivative(V_x, t), push * steepness - k * K(t) / 2 * steepness**2),
    given=[ge(t, t0), *moves(t, K(s))], place="Section 6.4", uses=[rate_by_norms], example=FALLING,
)  # fmt: skip
def rate_along(goal: Goal) -> Evidence:
    """The chain rule, and X' from the averaged equation."""
    return reals(goal, *instances(goal, t), *specialise(goal, rate_by_norms, {C: K(t), **there}))


@claim(
    "6.4/drift-norm", "‖f‖ ≤ ‖E‖ ‖∇F‖ at a place of the trajectory", le(push, E_norm * steepness),
    given=[*gradient_drift, norm_of_E], place="Section 6.4", uses=[norm_below], example=FALLING,
)  # fmt: skip
def drift_norm_there(goal: Goal) -> Evidence:
    """Assumption 3A at the position and the instant."""
    put = {entry: on_x(value, t) for entry, value in zip((w1, w2, g1, g2), (*f, *slope), strict=True)}
    return reals(goal, *specialise(goal, norm_below, put), *instances(goal, (t, X1(t), X2(t))))


@claim(
    "6.4/gradient-v-inequality", "V along every averaged trajectory under any gain and a drift E∇F, κ = 1",
    le(sp.Derivative(V_x, t), (drift_rate - K(t) * decay_rate) * V_x),
    given=[ge(t, t0), *moves(t, K(s)), *case_a], place="Section 6.4",
    uses=[rate_along, drift_norm_there, gradient_bounds, nonnegative, drift_by_gradient], example=FALLING,
)  # fmt: skip
def gradient_inequality(goal: Goal) -> Evidence:
    """The square of the gradient is bounded by V from above where the drift pushes, and from below where the gain
    pulls."""
    values = {kappa: ONE, **there}
    by_letters = {
        v_dot: sp.Derivative(V_x, t), rate: push, G_0: steepness, power: sp.sqrt(V_x), k: k * K(t),
        low_factor: C1, high_factor: C2, widening: sp.S.Zero,
    }  # fmt: skip
    said = [*specialise(goal, nonnegative, values), power_nonnegative(V_x, sp.Rational(1, 2))]
    return reals(
        goal, *said, *specialise(goal, rate_along, {}), *specialise(goal, drift_norm_there, {}),
        *specialise(goal, gradient_bounds, values),
        *specialise(goal, drift_by_gradient, by_letters, said),
    )  # fmt: skip


# --- The distance ---

after_rate = drift_rate - decay_rate / lowest**2
V_start, V_end, R_start, R_end = sp.symbols("V_start V_end R_start R_end", nonnegative=True)
growth = sp.Symbol("g", real=True)


@claim(
    "6.4/distance-by-v", "From a bound of V by an exponential to one of the distance, for κ = 1",
    le(R_end, sp.sqrt(a1 / a2) * R_start * sp.exp(growth / 2)),
    given=[le(a2 * R_end**2, V_end), le(V_start, a1 * R_start**2), le(V_end, V_start * sp.exp(growth))],
    place="Section 6.4",
)  # fmt: skip
def root_of_v(goal: Goal) -> Evidence:
    """The root is taken, which halves the exponent."""
    return reals(goal)


def root_values(end: sp.Expr, exponent: sp.Expr, first: sp.Expr = t0) -> dict[sp.Symbol, sp.Expr]:
    """That claim from one instant of the trajectory to another."""
    return {
        R_end: distance_then(end), R_start: distance_then(first), V_end: on_x(V_of_x, end),
        V_start: on_x(V_of_x, first), growth: exponent,
    }  # fmt: skip


def end_facts(goal: Goal, end: sp.Expr, first: sp.Expr = t0) -> list[Fact]:
    """Assumption 2 at both instants."""
    return [
        fact for time in (end, first) for used in (v_bounds, nonnegative)
        for fact in specialise(goal, used, {kappa: ONE, x1: X1(time), x2: X2(time)})
    ]  # fmt: skip


@claim(
    "6.4/distance-at-the-prescribed-time",
    "The averaged distance at the prescribed time, with the clip and a drift E∇F, κ = 1",
    le(
        distance_then(final),
        sp.sqrt(a1 / a2) * distance_then(t0) * sp.exp(drift_rate / 2 * T) * sp.exp(-decay_rate / 2 * total),
    ),
    given=[below_one, *moves(final, clipped(s)), *case_a], place="Section 6.4",
    uses=[gradient_inequality, v_final, v_bounds, nonnegative, root_of_v],
    example=FALLING | {lowest: sp.Rational(1, 2), X1(s): 0, x1: 0},
)  # fmt: skip
def distance_final(goal: Goal) -> Evidence:
    """eq:x_bar_upper_bound at τ − t₀ = T(2/ν_min − 1), from the averaged equation: for every start, gain and drift
    matrix the average ends in a neighbourhood of the source whose size this gives. It shrinks to 0 with ν_min and not
    before."""

    def along(here: Goal, time: sp.Expr) -> list[Fact]:
        if le(time, final) not in here.assumptions:
            return []
        return specialise(here, gradient_inequality, {t: time, K(s): clipped(s)})

    ends = end_facts(goal, final)
    said = [*ends, *specialise(goal, v_final, {V_t(s): on_x(V_of_x, s)}, ends, along=along)]
    return reals(
        goal, *said, *specialise(goal, root_of_v, root_values(final, drift_rate * T - decay_rate * total), said)
    )


on = (ge(s, switch), le(s, later))
last_moves = [
    ForAll((s,), eq(sp.Derivative(X(s), s), on_x(rate.subs(C, 1 / lowest**2), s)), on)
    for X, rate in zip((X1, X2), with_gain.rhs, strict=True)
]


@claim(
    "6.4/distance-after-the-clip", "The averaged distance after the clip, under a drift E∇F, κ = 1",
    le(distance_then(later), sp.sqrt(a1 / a2) * distance_then(switch) * sp.exp(after_rate / 2 * (later - switch))),
    given=[below_one, ge(later, switch), *last_moves, *case_a], place="Section 6.4",
    uses=[gradient_inequality, gain_after, v_after, v_bounds, nonnegative, root_of_v],
    example=FALLING | {lowest: sp.Rational(1, 2), k: 1, later: 1},
)  # fmt: skip
def distance_after(goal: Goal) -> Evidence:
    """Also after the prescribed time, with the last gain 1/ν_min². The rate is negative if k c₁² > 2ν_min²c₂²‖E‖: the
    condition of the asymptotic seeker with that gain."""

    def along(here: Goal, time: sp.Expr) -> list[Fact]:
        return specialise(here, gradient_inequality, {t: time, t0: switch, K(s): 1 / lowest**2})

    ends = end_facts(goal, later, switch)
    said = [*ends, *specialise(goal, v_after, {V_t(s): on_x(V_of_x, s)}, ends, along=along)]
    values = root_values(later, after_rate * (later - switch), switch)
    return reals(goal, *said, *specialise(goal, root_of_v, values, said))
