"""Section 6.3: the asymptotic seeker under a bounded drift, from its averaged system to an input-to-state estimate.

All of it is about the averaged vehicle, from every start, and about every solution; V = 0 is included.
"""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Assumption,
    Evidence,
    Exists,
    Fact,
    ForAll,
    Goal,
    claim,
    comparison,
    defeats_every_choice,
    eq,
    ge,
    instances,
    le,
    power_nonnegative,
    power_of_root,
    reals,
    specialise,
    superadditive,
)  # fmt: skip

from .notation import V, a1, a2, c, d, f, k, kappa, position, q, t, t0, x1, x2
from .section5b_0_trajectory import (
    EXAMPLE,
    F_1,
    F_2,
    X1,
    X2,
    V_of_x,
    assumption_2,
    distance,
    gradient_bounds,
    s,
    v_bounds,
    v_nonnegative,
)
from .section5b_1_lyapunov import EXAMPLE_QUARTIC, W, along_X, at_order, n, sigma
from .section6a_asymptotic import asymptotic_average, averaged_asymptotic

SECTION = "6.3 Discussion: the asymptotic seeker under a bounded drift"

ONE = sp.S.One


def at(expression: sp.Expr, time: sp.Expr) -> sp.Expr:
    """An expression in t and the position, at an instant of the trajectory."""
    return expression.subs({x1: X1(time), x2: X2(time), t: time}, simultaneous=True)


# X is a solution of the averaged asymptotic system on [t₀, t], under a drift with ‖f(t, x)‖ ≤ d.
after = ge(t, t0)
bounded_drift = ForAll((t, *position), le(sp.sqrt(f[0] ** 2 + f[1] ** 2), d), (ge(t, t0),))
moved: list[Assumption] = [
    after,
    *(
        ForAll((s,), eq(sp.Derivative(X(s), s), at(rate, s)), (ge(s, t0), le(s, t)))
        for X, rate in zip((X1, X2), asymptotic_average.rhs, strict=True)
    ),
    bounded_drift,
]
V_now, V_start = at(V_of_x, t), at(V_of_x, t0)
V_rate = sp.Derivative(V_now, t)
here = {x1: X1(t), x2: X2(t)}
square = F_1**2 + F_2**2
# F = −‖x‖² under a constant drift away from the source, and F = −‖x‖⁴ without one: solutions that move.
PUSHED = EXAMPLE | {f[0]: sp.Rational(1, 2), d: sp.Rational(1, 2), X1(s): (1 + sp.exp(-s)) / 2, t: 1}
FALLING = EXAMPLE_QUARTIC | {n: 1, d: 2, t: 1}


@claim(
    "6.3/only-local-printed", "A large drift leaves the asymptotic seeker without a decrease however large V is",
    Exists((d,), (ge(c(2) * d * V ** q() - k * c(1) ** 2 / 2 * V ** (2 * q()), 0),), over=(V,)),
    place="Section 6.3", expected="refuted", grade="error",
    wrong="The text says that for the asymptotic seeker only local input-to-state stability can be established with "
    "respect to a bound of the drift; under its Assumption 2 the estimate is global, for every bound.",
    survives="Yes: the Proposition is about the PT Seeker. What distinguishes it is that its average reaches the "
    "source, while that of the asymptotic seeker ends at a distance that grows with the drift.",
)  # fmt: skip
def only_local(goal: Goal) -> Evidence:
    """How "only local" can be read: some drift is too large for the bound of dV/dt to be negative anywhere far out.
    It is negative wherever V^q > 2c₂d/(kc₁²), whatever d is, as the decrease has twice the power of what the drift
    adds."""
    base = 1 + 2 * c(2) * d / (k * c(1) ** 2)
    value = base ** (1 / q())
    return defeats_every_choice(goal, {V: value}, [power_of_root(value, base, q())])


@claim(
    "6.3/asymptotic-derivative", "dV/dt along a solution of the averaged asymptotic system",
    eq(V_rate, at(-(F_1 * f[0] + F_2 * f[1]) - k / 2 * square, t)), given=moved, place="Section 6.3",
    uses=[averaged_asymptotic], example=PUSHED,
)  # fmt: skip
def asymptotic_derivative(goal: Goal) -> Evidence:
    """The chain rule, and the system at the instant t."""
    return reals(goal, *instances(goal, t))


@claim(
    "6.3/drift-paid-for", "What the drift adds is at most half of the decrease and its own square",
    le(-(F_1 * f[0] + F_2 * f[1]), k / 4 * square + (f[0] ** 2 + f[1] ** 2) / k), place="Section 6.3",
)  # fmt: skip
def drift_paid_for(goal: Goal) -> Evidence:
    """The square of (k/2)∇F + f is not negative."""
    return reals(goal)


@claim(
    "6.3/asymptotic-rate", "dV/dt along a solution under a bounded drift",
    le(V_rate, at(d**2 / k - k / 4 * square, t)), given=moved,
    place="Section 6.3", uses=[asymptotic_derivative, drift_paid_for], example=PUSHED,
)  # fmt: skip
def asymptotic_rate(goal: Goal) -> Evidence:
    """Half of the decrease pays for the drift, but for d²/k. What is left needs no root of V, so that the source is
    no exception."""
    return reals(
        goal, *specialise(goal, asymptotic_derivative, {}), *specialise(goal, drift_paid_for, here),
        *instances(goal, (t, X1(t), X2(t))),
    )  # fmt: skip


def decay_rate(order: sp.Expr) -> sp.Expr:
    """k c₁²/4 for κ = order."""
    return k * c(1, order) ** 2 / 4


@claim(
    "6.3/asymptotic-v-inequality", "The differential inequality for V along a solution, for every κ",
    le(V_rate, d**2 / k - decay_rate(kappa) * V_now ** (2 * q())), given=[*moved, *assumption_2],
    place="Section 6.3", uses=[asymptotic_rate, gradient_bounds, v_nonnegative], example=PUSHED,
)  # fmt: skip
def v_inequality(goal: Goal) -> Evidence:
    """The gradient's norm is at least c₁V^q."""
    return reals(
        goal, *specialise(goal, asymptotic_rate, {}), *specialise(goal, gradient_bounds, here),
        *specialise(goal, v_nonnegative, here), power_nonnegative(V_now, q()),
    )  # fmt: skip


def v_at(there: Goal, order: sp.Expr, time: sp.Expr) -> list[Fact]:
    """At an instant of the solution V ≥ 0, and V lies between its bounds by the distance."""
    place = {kappa: order, x1: X1(time), x2: X2(time)}
    return [*specialise(there, v_nonnegative, place), *specialise(there, v_bounds, place)]


def falls(there: Goal, order: sp.Expr, time: sp.Expr) -> list[Fact]:
    """At an instant up to t the inequality for V, and V ≥ 0."""
    value = at(V_of_x, time)
    return [
        *v_at(there, order, time), power_nonnegative(value, 2 * q(order)),
        *specialise(there, v_inequality, {kappa: order, t: time}),
    ]  # fmt: skip


# --- What falls as V does ---------------------------------------------------------------------------------------------

on = (ge(s, t0), le(s, t))
not_negative = ForAll((s,), ge(W(s), 0), on)
decayed_1 = sp.exp(-decay_rate(ONE) * (t - t0))
level_1 = 4 * d**2 / (k * c(1, ONE)) ** 2  # V at which the decrease balances the drift


@claim(
    "6.3/v-kappa-1", "What falls as V does under a bounded drift, κ = 1",
    le(W(t), W(t0) * decayed_1 + level_1),
    given=[after, ForAll((s,), le(sp.Derivative(W(s), s), d**2 / k - decay_rate(ONE) * W(s)), on), not_negative],
    place="Section 6.3",
)  # fmt: skip
def v_kappa_1(goal: Goal) -> Evidence:
    """A linear comparison equation."""
    return comparison(goal, W(t0) * sp.exp(-decay_rate(ONE) * (s - t0)) + level_1)


order, power = n + 1, 1 + sigma
excess = sp.Symbol("varsigma", positive=True)  # 2q − 1
pace = sp.Symbol("A", positive=True)
balance = sp.Symbol("V_b", nonnegative=True)  # the V at which the decrease balances the drift


def decayed(value: sp.Expr, passed: sp.Expr) -> sp.Expr:
    """The solution of w' = −A w^(1+ς) from ``value``, after a time."""
    return value * (1 + excess * value**excess * pace * passed) ** (-1 / excess)


@claim(
    "6.3/decay-plus-level", "What falls like a power less a constant stays below the decay plus the level of balance",
    le(W(t), decayed(W(t0), t - t0) + balance),
    given=[
        after, not_negative,
        ForAll((s,), le(sp.Derivative(W(s), s), pace * balance ** (1 + excess) - pace * W(s) ** (1 + excess)), on),
    ],
    place="Section 6.3",
)  # fmt: skip
def decay_plus_level(goal: Goal) -> Evidence:
    """Powers of at least 1 are superadditive, so that the sum falls no faster than the inequality asks."""
    base = 1 + excess * W(t0) ** excess * pace * (s - t0)
    falling = decayed(W(t0), s - t0)
    return comparison(
        goal, falling + balance, denominators=[base],
        lemmas=[superadditive(falling, balance, 1 + excess), power_nonnegative(W(t0), excess)],
    )  # fmt: skip


# --- The estimates ----------------------------------------------------------------------------------------------------


def squared(time: sp.Expr) -> sp.Expr:
    """‖X − x*‖² at an instant."""
    return at(distance, time) ** 2


@claim(
    "6.3/asymptotic-iss-kappa-1", "The averaged asymptotic seeker is globally input-to-state stable (κ = 1)",
    le(a2 * squared(t), a1 * squared(t0) * decayed_1 + level_1),
    given=[*moved, *at_order(assumption_2, ONE)], place="Section 6.3", corrects=only_local,
    uses=[v_kappa_1, v_inequality, v_nonnegative, v_bounds], example=PUSHED,
)  # fmt: skip
def iss_kappa_1(goal: Goal) -> Evidence:
    """Along every solution and for every bound d of the drift: the square of the distance is bounded by what decays
    exponentially and a multiple of d². The distance ends below a residual that is proportional to d/k, not at zero."""
    return reals(
        goal, *v_at(goal, ONE, t), *v_at(goal, ONE, t0),
        *specialise(goal, v_kappa_1, {W(s): along_X}, along=lambda there, time: falls(there, ONE, time)),
    )  # fmt: skip


letters = {excess: sigma, pace: decay_rate(order)}


@claim(
    "6.3/asymptotic-iss-kappa-2", "The averaged asymptotic seeker is globally input-to-state stable (κ ≥ 2)",
    le(a2 * at(distance, t) ** (2 * order), decayed(V_start, t - t0).subs(letters) + balance),
    given=[*moved, *at_order(assumption_2, order), eq(decay_rate(order) * balance**power, d**2 / k)],
    place="Section 6.3", corrects=only_local,
    uses=[decay_plus_level, v_inequality, v_nonnegative, v_bounds], example=FALLING | {balance: 1},
)  # fmt: skip
def iss_kappa_2(goal: Goal) -> Evidence:
    """Along every solution and for every bound d of the drift: what is left in the end grows like d^(2/(2q)), and the
    distance like d^(1/(2κ−1))."""
    begun = [*v_at(goal, order, t0), power_nonnegative(V_start, sigma)]
    values = {**letters, W(s): along_X}
    return reals(
        goal, *begun, *v_at(goal, order, t),
        *specialise(goal, decay_plus_level, values, along=lambda there, time: falls(there, order, time)),
    )  # fmt: skip
