"""Section 5, Theorem 2, Step 4: the Lyapunov function, and stability without drift."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    Fact,
    ForAll,
    Goal,
    claim,
    comparison,
    definition,
    eq,
    every,
    exact,
    ge,
    gt,
    instances,
    le,
    lt,
    power_monotone,
    power_nonnegative,
    power_positive,
    reals,
    specialise,
)

from .notation import (
    F,
    F_source,
    G,
    R,
    V,
    a1,
    a2,
    b1,
    b2,
    c,
    f,
    f_norm,
    k,
    kappa,
    position,
    q,
    t,
    t0,
    tau,
    x1,
    x2,
)  # fmt: skip
from .section5a_1_reduction import stretch
from .section5b_0_trajectory import (
    EXAMPLE,
    X1,
    X2,
    V_along,
    V_of_x,
    V_rate,
    assumption_2,
    at,
    distance,
    field_between,
    here,
    later,
    s,
    solves,
    start,
)
from .section5b_0_trajectory import v_bounds as everywhere_between
from .section5b_0_trajectory import v_differential_inequality as along_solution
from .section5b_0_trajectory import v_nonnegative as nonnegative
from .section5b_0_with_drift import in_time, instant

SECTION = "5.2 Theorem, Steps 4 to 6: stability"
ONE = sp.S.One

lyapunov_function = definition(
    "5/step4-lyapunov-function", "V = F(x*) − F(x̄)", eq(sp.Function("V")(x1, x2), -(F - F_source)),
    labels=["eq:Lyapunov_function"], prose="How much the field at the averaged vehicle is below its maximum.",
)  # fmt: skip

# From here on one symbol stands for each norm and for V at one instant. R is the distance ‖x̄ − x*‖.
F_value = sp.Symbol("F_x", real=True)


@claim(
    "5/step4-v-bounds-by-letters", "V between even powers of the distance",
    every(le(a2 * R ** (2 * kappa), V), le(V, a1 * R ** (2 * kappa))),
    given=[
        eq(V, -(F_value - F_source)),
        le(F_source - a1 * R ** (2 * kappa), F_value), le(F_value, F_source - a2 * R ** (2 * kappa)),
    ],
    place="Step 4",
)  # fmt: skip
def v_bounds(goal: Goal) -> Evidence:
    """Assumption 2, with F(x̄) moved to the other side."""
    return reals(goal)


between = (le(a2 * R ** (2 * kappa), V), le(V, a1 * R ** (2 * kappa)))
gradient_between = (le(b1 * R ** (2 * kappa - 1), G), le(G, b2 * R ** (2 * kappa - 1)))


@claim(
    "5/step4-gradient-bounds", "‖∇F‖ between powers of V",
    every(le(c(1) * V ** q(), G), le(G, c(2) * V ** q())),
    given=[*between, *gradient_between], labels=["eq:ass4"], uses=[v_bounds],
)  # fmt: skip
def gradient_bounds(goal: Goal) -> Evidence:
    """The distance is eliminated: V/a₁ ≤ ‖x̄ − x*‖^(2κ) ≤ V/a₂, raised to the power q, is a bound for
    ‖x̄ − x*‖^(2κ − 1)."""
    distance = R ** (2 * kappa)
    return reals(goal, power_monotone(V / a1, distance, q()), power_monotone(distance, V / a2, q()))


@claim(
    "5/step4-exponent-range", "1/2 ≤ q_κ < 1", every(le(sp.Rational(1, 2), q()), lt(q(), 1)), place="Step 4",
)  # fmt: skip
def exponent_range(goal: Goal) -> Evidence:
    """For every integer κ ≥ 1; equality at κ = 1."""
    return reals(goal)


V_dot = sp.Symbol("V_dot", real=True)
derivative_given = le(V_dot, f_norm * G / stretch**2 - k / 2 * G**2)
after = ge(tau, t0)


def v_inequality(order: sp.Expr) -> sp.Expr:
    """The right-hand side of eq:lyapunov_derivative_inequality_2 as printed, for a given κ."""
    return c(2, order) / stretch**2 * f_norm * V ** q(order) - k * c(1, order) ** 2 / 2 * V ** (2 * q(order))


@claim(
    "5/step4-v-inequality-by-letters", "A differential inequality for V alone",
    le(V_dot, v_inequality(kappa)), given=[after, derivative_given, *between, *gradient_between],
    place="Step 4", uses=[gradient_bounds],
)  # fmt: skip
def v_differential_inequality(goal: Goal) -> Evidence:
    """The gradient's norm is bounded above where it multiplies the drift, and below where it is squared."""
    return reals(goal, power_positive(V, q()))


# --- Case i: no drift ---------------------------------------------------------------------------------------

# Without drift: f(t, x) = 0 at all instants and positions.
no_drift = [ForAll((t, *position), eq(entry, 0), in_time) for entry in f]


@claim(
    "5/step4-driftless", "Without drift V decreases along every solution",
    le(V_rate, at(-k * c(1) ** 2 / 2 * V_of_x ** (2 * q()), tau)),
    given=[*solves(tau), *later, *assumption_2, *no_drift],
    labels=["eq:lyapunov_derivative_inequality_kappa_2"], uses=[along_solution, nonnegative], example=EXAMPLE,
)  # fmt: skip
def driftless(goal: Goal) -> Evidence:
    """‖f‖ = 0 in the inequality for V."""
    return reals(
        goal, *specialise(goal, along_solution, {}), *instances(goal, instant(tau)),
        *specialise(goal, nonnegative, here),
    )  # fmt: skip


@claim(
    "5/step4-driftless-definite", "Without drift the rate of V is negative away from the source",
    lt(-k * c(1) ** 2 / 2 * V_of_x ** (2 * q()), 0), given=[*field_between, gt(distance, 0)],
    place="Step 4, case i", uses=[everywhere_between],
)  # fmt: skip
def driftless_definite(goal: Goal) -> Evidence:
    """k c₁² > 0, and V ≥ a₂‖x − x*‖^(2κ) > 0."""
    return reals(
        goal, *specialise(goal, everywhere_between, {}), power_positive(distance, 2 * kappa),
        power_positive(V_of_x, 2 * q()),
    )  # fmt: skip


V_away = sp.Function("V", positive=True)  # V along a trajectory that has not met the source

# Along a trajectory W(s) stands for V(X(s)): not negative, and 0 where the source is met. In the last three claims of
# this part W is put in.
W = sp.Function("W", real=True)
W_nonnegative = ForAll((s,), ge(W(s), 0), (ge(s, start), le(s, tau)))
along_X = V_of_x.subs({x1: X1(s), x2: X2(s)}, simultaneous=True)


def on_interval(rate: sp.Expr, value: sp.Expr) -> ForAll:
    """d(value)/ds ≤ rate on [τ₀, τ]."""
    return ForAll((s,), le(sp.Derivative(value, s), rate), (ge(s, start), le(s, tau)))


# A trajectory for F = −‖x‖⁴ without drift, from (1, 0) at time 0.
EXAMPLE_QUARTIC = EXAMPLE | {F: -((x1**2 + x2**2) ** 2), X1(s): 1 / sp.sqrt(1 + 4 * s), b1: 4, b2: 4, kappa: 2}

# κ = n + 1 with n = 1, 2, …: the exponents below are then known to be positive.
n = sp.Symbol("n", positive=True, integer=True)
driftless_rate = -k * c(1, n + 1) ** 2 / 2
sigma = n / (n + 1)  # 2q − 1


@claim(
    "5/step4-sigma", "2q_κ − 1 = (κ − 1)/κ", eq(2 * q() - 1, (kappa - 1) / kappa), place="Step 4, case i",
)  # fmt: skip
def sigma_form(goal: Goal) -> Evidence:
    """The exponent of the comparison equation beyond 1; it is n/(n + 1) for κ = n + 1."""
    return exact(goal)


def forgets(value: sp.Expr, until: sp.Expr) -> sp.Expr:
    """The solution of v' = −(k c₁²/2) v^(2q) for κ = n + 1, from ``value`` at τ₀."""
    return value * (1 - sigma * value**sigma * driftless_rate * (until - start)) ** (-1 / sigma)


@claim(
    "5/step4-driftless-comparison", "What decreases as V does without drift has an explicit bound, for κ = n + 1 ≥ 2",
    le(W(tau), forgets(W(start), tau)),
    given=[on_interval(driftless_rate * W(s) ** (1 + sigma), W(s)), W_nonnegative, ge(tau, start)],
    place="Step 4, case i", uses=[sigma_form],
)  # fmt: skip
def driftless_comparison(goal: Goal) -> Evidence:
    """The comparison equation is of Bernoulli's type."""
    base = 1 - sigma * W(start) ** sigma * driftless_rate * (s - start)
    lemmas = [power_nonnegative(W(start), sigma)]
    return comparison(goal, W(start) * base ** (-1 / sigma), denominators=[base], lemmas=lemmas)


def at_order(items: list[ForAll], order: sp.Expr) -> list[ForAll]:
    """Assumption 2 for κ = order."""
    return [ForAll(item.variables, item.relation.map(lambda side: side.subs(kappa, order))) for item in items]


V_start = V_along.subs(tau, start)


@claim(
    "5/step4-driftless-bound", "Without drift V has an explicit bound along every solution, for κ = n + 1 ≥ 2",
    le(V_along, forgets(V_start, tau)),
    given=[*solves(tau), *later, *at_order(assumption_2, n + 1), *no_drift],
    place="Step 4, case i", uses=[driftless, driftless_comparison, nonnegative], 
    example=EXAMPLE_QUARTIC | {n: 1},
)  # fmt: skip
def driftless_bound(goal: Goal) -> Evidence:
    """From every initial time and every initial position, also where the solution meets the source."""

    def along(there: Goal, point: sp.Expr) -> list[Fact]:
        position_then = {x1: X1(point), x2: X2(point)}
        return [
            *specialise(there, driftless, {kappa: n + 1, tau: point}),
            *specialise(there, nonnegative, {kappa: n + 1, **position_then}),
        ]  # fmt: skip

    begun = {kappa: n + 1, x1: X1(start), x2: X2(start)}
    return reals(
        goal, *specialise(goal, nonnegative, begun), power_nonnegative(V_start, sigma),
        *specialise(goal, driftless_comparison, {W(s): along_X}, along=along),
    )  # fmt: skip
