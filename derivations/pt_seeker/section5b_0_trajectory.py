"""Section 5, Theorem 2, Step 4: the averaged trajectory, and the Lyapunov function along it."""

from __future__ import annotations

from functools import cache

import sympy as sp

from ptproof.proof import (
    Evidence,
    ForAll,
    Goal,
    claim,
    eq,
    every,
    ge,
    instances,
    le,
    power_monotone,
    power_nonnegative,
    reals,
    specialise,
)

from . import chain
from .notation import (
    E,
    E_norm,
    F,
    T,
    a1,
    a2,
    b1,
    b2,
    c,
    d,
    f,
    k,
    kappa,
    position,
    q,
    source,
    t0,
    tau,
    x1,
    x2,
)  # fmt: skip
from .section5a_1_reduction import f_tau, stretch
from .section5a_2_averaging import averaged_system

SECTION = "5.2 Theorem, Step 4: the Lyapunov function along the averaged trajectory"

# The averaged trajectory X(s), a solution from the instant τ₀ ≥ t₀ on, and what is evaluated on it.
s = sp.Symbol("s", real=True)
start = sp.Symbol("tau_0", real=True)
X1, X2 = (sp.Function(name, real=True) for name in ("X1", "X2"))
F_s = F.func(*source)  # the field at the source
F_1, F_2 = sp.diff(F, x1), sp.diff(F, x2)


@cache
def at(expression: sp.Expr, time: sp.Expr) -> sp.Expr:
    """An expression in τ and the position, at an instant of the trajectory."""
    values = {x1: X1(time), x2: X2(time), tau: time}
    return expression.subs(values, simultaneous=True)


def solves(until: sp.Expr | None, since: sp.Expr = start) -> list[ForAll]:
    """X solves the averaged system on [since, until], or for all times from ``since`` on."""
    domain = (ge(s, since),) if until is None else (ge(s, since), le(s, until))
    return [
        ForAll((s,), eq(sp.Derivative(X(s), s), at(rate, s)), domain)
        for X, rate in zip((X1, X2), chain.averaged_tau.rhs, strict=True)
    ]


later = [ge(start, t0), ge(tau, start)]
gradient_norm = sp.sqrt(F_1**2 + F_2**2)
drift_norm = sp.sqrt(f_tau[0] ** 2 + f_tau[1] ** 2)
V_of_x = F_s - F
V_along = V_of_x.subs({x1: X1(tau), x2: X2(tau)}, simultaneous=True)
V_rate = sp.Derivative(V_along, tau)
distance = sp.sqrt(sum((entry - there) ** 2 for entry, there in zip(position, source, strict=True)))
here = {x1: X1(tau), x2: X2(tau)}


# A trajectory on which the assumptions of this part are seen to hold: F = −‖x‖² without drift, from (1, 0) at time 0.
EXAMPLE = {
    F: -(x1**2) - x2**2, f[0]: 0, f[1]: 0, X1(s): sp.exp(-s), X2(s): 0, x1: 1, x2: 0, source[0]: 0, source[1]: 0,
    kappa: 1, k: 1, a1: 1, a2: 1, b1: 2, b2: 2, d: 0, T: 1, t0: 0, start: 0, tau: 1, E_norm: 0,
    **dict.fromkeys(E, 0),
}  # fmt: skip


@claim(
    "5/step4-derivative", "dV/dτ along a solution of the averaged system",
    eq(
        V_rate,
        at(-(F_1 * f_tau[0] + F_2 * f_tau[1]) / stretch**2 - k / 2 * gradient_norm**2, tau),
    ),
    given=[*solves(tau), *later], labels=["eq:Lyapunov_derivative"], uses=[averaged_system],
)  # fmt: skip
def derivative(goal: Goal) -> Evidence:
    """The chain rule, and the averaged system from the pipeline at the instant τ."""
    return reals(goal, *instances(goal, tau))


@claim(
    "5/step4-cauchy-schwarz", "The drift against the gradient",
    le(-(F_1 * f_tau[0] + F_2 * f_tau[1]), drift_norm * gradient_norm), given=[ge(tau, t0)], place="Step 4",
)  # fmt: skip
def cauchy_schwarz(goal: Goal) -> Evidence:
    """Written out in two dimensions."""
    return reals(goal)


@claim(
    "5/step4-derivative-bound", "dV/dτ along a solution is at most what the norms give",
    le(V_rate, at(drift_norm * gradient_norm / stretch**2 - k / 2 * gradient_norm**2, tau)),
    given=[*solves(tau), *later], labels=["eq:Lyapunov_derivative_inequality"], uses=[derivative, cauchy_schwarz],
)  # fmt: skip
def derivative_bound(goal: Goal) -> Evidence:
    """The scalar product is replaced by the product of the norms; the factor 1/(1 + (τ − t₀)/T)² is positive."""
    return reals(goal, *specialise(goal, derivative, {}), *specialise(goal, cauchy_schwarz, here))


# Assumption 2, for every position.
field_between = [
    ForAll(position, le(a2 * distance ** (2 * kappa), V_of_x)),
    ForAll(position, le(V_of_x, a1 * distance ** (2 * kappa))),
]
gradient_between = [
    ForAll(position, le(b1 * distance ** (2 * kappa - 1), gradient_norm)),
    ForAll(position, le(gradient_norm, b2 * distance ** (2 * kappa - 1))),
]
assumption_2 = [*field_between, *gradient_between]


@claim(
    "5/step4-v-bounds", "V between even powers of the distance",
    every(le(a2 * distance ** (2 * kappa), -(F - F_s)), le(-(F - F_s), a1 * distance ** (2 * kappa))),
    given=field_between, labels=["eq:ass2"],
)  # fmt: skip
def v_bounds(goal: Goal) -> Evidence:
    """Assumption 2, with F(x̄) moved to the other side, at any position."""
    return reals(goal, *instances(goal, position))


@claim(
    "5/step4-v-nonnegative", "V is never negative", ge(V_of_x, 0), given=field_between, place="Step 4",
    uses=[v_bounds],
)  # fmt: skip
def v_nonnegative(goal: Goal) -> Evidence:
    """Its lower bound is not. At the source it is 0."""
    return reals(goal, *instances(goal, position), power_nonnegative(distance, 2 * kappa))


# One number for each norm and for V: not negative, 0 at the source.
V_0, R_0, G_0 = sp.symbols("V_x R_x G_x", nonnegative=True)
m = sp.Symbol("m", nonnegative=True, integer=True)  # κ − 1: no power of 0 has an exponent below 0
order = m + 1


@claim(
    "5/step4-norms-by-v", "What bounds V and the gradient by the distance bounds the gradient by V, for κ = m + 1",
    every(le(c(1, order) * V_0 ** q(order), G_0), le(G_0, c(2, order) * V_0 ** q(order))),
    given=[
        le(a2 * R_0 ** (2 * order), V_0), le(V_0, a1 * R_0 ** (2 * order)),
        le(b1 * R_0 ** (2 * order - 1), G_0), le(G_0, b2 * R_0 ** (2 * order - 1)),
    ],
    place="Step 4",
)  # fmt: skip
def norms_by_v(goal: Goal) -> Evidence:
    """The distance is eliminated: V/a₁ ≤ ‖x̄ − x*‖^(2κ) ≤ V/a₂, raised to the power q, is a bound for
    ‖x̄ − x*‖^(2κ − 1)."""
    power = R_0 ** (2 * order)
    return reals(goal, power_monotone(V_0 / a1, power, q(order)), power_monotone(power, V_0 / a2, q(order)))


@claim(
    "5/step4-gradient-bounds-everywhere", "‖∇F‖ between powers of V, at every position, the source included",
    every(le(c(1) * V_of_x ** q(), gradient_norm), le(gradient_norm, c(2) * V_of_x ** q())),
    given=assumption_2, labels=["eq:ass4"], uses=[v_nonnegative, norms_by_v], example=EXAMPLE,
)  # fmt: skip
def gradient_bounds(goal: Goal) -> Evidence:
    """Assumption 2 at the position, with V ≥ 0."""
    said = [*specialise(goal, v_nonnegative, {}), *instances(goal, position)]
    values = {m: kappa - 1, V_0: V_of_x, R_0: distance, G_0: gradient_norm}
    return reals(goal, *specialise(goal, norms_by_v, values, said), *said)


def v_inequality(order: sp.Expr) -> sp.Expr:
    """The right-hand side of eq:lyapunov_derivative_inequality_2 as printed, for a given κ, at any position."""
    return c(2, order) / stretch**2 * drift_norm * V_of_x ** q(order) - k * c(1, order) ** 2 / 2 * V_of_x ** (
        2 * q(order)
    )


@claim(
    "5/step4-v-inequality", "A differential inequality for V along a solution",
    le(V_rate, at(v_inequality(kappa), tau)),
    given=[*solves(tau), *later, *assumption_2],
    labels=["eq:lyapunov_derivative_inequality_2"], uses=[gradient_bounds, v_nonnegative, derivative_bound],
    example=EXAMPLE,
)  # fmt: skip
def v_differential_inequality(goal: Goal) -> Evidence:
    """The gradient's norm is bounded above where it multiplies the drift, and below where it is squared. Where the
    solution meets the source both sides are 0."""
    return reals(
        goal, *specialise(goal, derivative_bound, {}), *specialise(goal, gradient_bounds, here),
        *specialise(goal, v_nonnegative, here), power_nonnegative(V_along, q()),
    )  # fmt: skip
