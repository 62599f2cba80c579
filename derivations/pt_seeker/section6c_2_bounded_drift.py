"""Section 6.3: the asymptotic seeker under a bounded drift, from the rate of V to an input-to-state estimate.

All of it is about the averaged vehicle. V(s) and ‖∇F‖ are taken along its trajectory, V = 0 included.
"""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    Exists,
    ForAll,
    Goal,
    claim,
    comparison,
    defeats_every_choice,
    eq,
    ge,
    le,
    power_of_root,
    reals,
    specialise,
    superadditive,
)  # fmt: skip

from . import chain
from .notation import F, F_source, V, a1, a2, c, d, f, k, q, t, t0
from .section5b_1_lyapunov import n, sigma
from .section6a_asymptotic import asymptotic_average, asymptotic_derivative

SECTION = "6.3 Discussion: the asymptotic seeker under a bounded drift"

ONE = sp.S.One
s = sp.Symbol("s", real=True)
slope = sp.Matrix(chain.gradient_F)
square = slope.dot(slope)
drift_square = f[0] ** 2 + f[1] ** 2


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
    "6.3/asymptotic-rate", "dV/dt of the averaged asymptotic seeker under a bounded drift",
    le(asymptotic_average.derivative_along(F_source - F), d**2 / k - k / 4 * square), given=[le(drift_square, d**2)],
    place="Section 6.3", uses=[asymptotic_derivative],
)  # fmt: skip
def asymptotic_rate(goal: Goal) -> Evidence:
    """Half of the decrease pays for the drift, by d‖∇F‖ ≤ k‖∇F‖²/4 + d²/k. What is left needs no root of V, so that
    the source is no exception."""
    return reals(goal)


V_t = sp.Function("V", nonnegative=True)
G_t = sp.Function("G", nonnegative=True)
R_t = sp.Function("R", nonnegative=True)


def decay_rate(order: sp.Expr) -> sp.Expr:
    """k c₁²/4 for κ = order."""
    return k * c(1, order) ** 2 / 4


def falls(order: sp.Expr, power: sp.Expr) -> ForAll:
    """What the rate of V and the lower bound of the gradient give, for all times from t₀ to t."""
    rate = d**2 / k - decay_rate(order) * V_t(s) ** power
    return ForAll((s,), le(sp.Derivative(V_t(s), s), rate), (ge(s, t0), le(s, t)))


def along(order: sp.Expr, power: sp.Expr) -> list[ForAll]:
    """The same in two steps: the rate of V, and Assumption 2 for the gradient."""
    domain = (ge(s, t0), le(s, t))
    return [
        ForAll((s,), le(sp.Derivative(V_t(s), s), d**2 / k - k / 4 * G_t(s) ** 2), domain),
        ForAll((s,), le(c(1, order) ** 2 * V_t(s) ** power, G_t(s) ** 2), domain),
    ]


def level(order: sp.Expr, power: sp.Expr) -> sp.Expr:
    """Where the decrease balances the drift: V^(2q) = (2d/(kc₁))²."""
    return (4 * d**2 / (k * c(1, order)) ** 2) ** (1 / power)


# --- κ = 1 ------------------------------------------------------------------------------------------------------------

decayed_1 = sp.exp(-decay_rate(ONE) * (t - t0))


@claim(
    "6.3/v-kappa-1", "V under a bounded drift, κ = 1", le(V_t(t), V_t(t0) * decayed_1 + level(ONE, ONE)),
    given=[ge(t, t0), falls(ONE, ONE)], place="Section 6.3", uses=[asymptotic_rate],
)  # fmt: skip
def v_kappa_1(goal: Goal) -> Evidence:
    """A linear comparison equation."""
    return comparison(goal, V_t(t0) * sp.exp(-decay_rate(ONE) * (s - t0)) + level(ONE, ONE))


@claim(
    "6.3/asymptotic-iss-kappa-1", "The averaged asymptotic seeker is globally input-to-state stable (κ = 1)",
    le(a2 * R_t(t) ** 2, a1 * R_t(t0) ** 2 * decayed_1 + level(ONE, ONE)),
    given=[ge(t, t0), *along(ONE, ONE), le(a2 * R_t(t) ** 2, V_t(t)), le(V_t(t0), a1 * R_t(t0) ** 2)],
    place="Section 6.3", corrects=only_local, uses=[v_kappa_1],
)  # fmt: skip
def iss_kappa_1(goal: Goal) -> Evidence:
    """From every start and for every bound d of the drift: the square of the distance is bounded by what decays
    exponentially and a multiple of d². The distance ends below a residual that is proportional to d/k, not at zero."""
    return reals(goal, *specialise(goal, v_kappa_1, {}))


# --- κ = n + 1 ≥ 2 ----------------------------------------------------------------------------------------------------

order, power = n + 1, 1 + sigma
excess = sp.Symbol("varsigma", positive=True)  # 2q − 1
pace = sp.Symbol("A", positive=True)
balance = sp.Symbol("V_b", nonnegative=True)  # the V at which the decrease balances the drift


def decayed(value: sp.Expr, after: sp.Expr) -> sp.Expr:
    """The solution of w' = −A w^(1+ς) from ``value``, after a time."""
    return value * (1 + excess * value**excess * pace * after) ** (-1 / excess)


@claim(
    "6.3/decay-plus-level", "What falls like a power less a constant stays below the decay plus the level of balance",
    le(V_t(t), decayed(V_t(t0), t - t0) + balance),
    given=[
        ge(t, t0),
        ForAll((s,), le(sp.Derivative(V_t(s), s), pace * balance ** (1 + excess) - pace * V_t(s) ** (1 + excess)),
               (ge(s, t0), le(s, t))),
    ],
    place="Section 6.3", uses=[asymptotic_rate],
)  # fmt: skip
def decay_plus_level(goal: Goal) -> Evidence:
    """Powers of at least 1 are superadditive, so that the sum falls no faster than the inequality asks."""
    base = 1 + excess * V_t(t0) ** excess * pace * (s - t0)
    falling = decayed(V_t(t0), s - t0)
    return comparison(
        goal, falling + balance, denominators=[base], lemmas=[superadditive(falling, balance, 1 + excess)]
    )


letters = {excess: sigma, pace: decay_rate(order)}


@claim(
    "6.3/asymptotic-iss-kappa-2", "The averaged asymptotic seeker is globally input-to-state stable (κ ≥ 2)",
    le(a2 * R_t(t) ** (2 * order), decayed(V_t(t0), t - t0).subs(letters) + balance),
    given=[
        ge(t, t0), *along(order, power), eq(decay_rate(order) * balance**power, d**2 / k),
        le(a2 * R_t(t) ** (2 * order), V_t(t)),
    ],
    place="Section 6.3", corrects=only_local, uses=[decay_plus_level],
)  # fmt: skip
def iss_kappa_2(goal: Goal) -> Evidence:
    """From every start and for every bound d of the drift: what is left in the end grows like d^(2/(2q)), and the
    distance like d^(1/(2κ−1))."""
    return reals(goal, *specialise(goal, decay_plus_level, letters))
