"""Section 5, Theorem 2, Step 4: V along the averaged trajectory with gradient drift, for every κ."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    ForAll,
    Goal,
    claim,
    eq,
    ge,
    instances,
    le,
    lt,
    power_nonnegative,
    reals,
    specialise,
)

from . import chain
from .notation import (
    E,
    E_norm,
    T,
    c,
    f,
    k,
    kappa,
    position,
    q,
    t,
    t0,
    tau,
)  # fmt: skip
from .section3_problem import g1, g2, spectral_norm, spectral_norm_squared
from .section5a_1_reduction import f_tau, stretch
from .section5b_0_trajectory import (
    EXAMPLE,
    F_1,
    F_2,
    G_0,
    X1,
    X2,
    V_along,
    V_of_x,
    V_rate,
    assumption_2,
    at,
    derivative,
    derivative_bound,
    drift_norm,
    gradient_bounds,
    gradient_norm,
    here,
    later,
    solves,
    v_nonnegative,
)

SECTION = "5.2 Theorem, Step 4: the Lyapunov function along the averaged trajectory"

# --- Gradient drift, for every κ ----------------------------------------------------------------------------

gradient = sp.Matrix([F_1, F_2])
pushed = E * gradient
in_time = (ge(t, t0), lt(t, t0 + T))
# Assumption 3A: f(t, x) = E∇F(x), at all instants and positions.
gradient_drift_given = [ForAll((t, *position), eq(f[i], pushed[i]), in_time) for i in (0, 1)]
norm_of_E = eq(E_norm, sp.sqrt(spectral_norm_squared))


def instant(time: sp.Expr) -> tuple[sp.Expr, ...]:
    """The original time and the position at an instant of the trajectory, for assumptions about the drift."""
    return (chain.clock.to_t.subs(tau, time), X1(time), X2(time))


@claim(
    "5/step4-gradient-drift-derivative", "dV/dτ along a solution with gradient drift is a form in the gradient",
    eq(V_rate, at(-(gradient.T * (E / stretch**2 + k / 2 * sp.eye(2)) * gradient)[0], tau)),
    given=[*solves(tau), *later, *gradient_drift_given], place="Step 4, case ii", uses=[derivative],
    example=EXAMPLE,
)  # fmt: skip
def gradient_drift_derivative(goal: Goal) -> Evidence:
    """E∇F in the place of f. Only the symmetric part of E counts."""
    return reals(goal, *specialise(goal, derivative, {}), *instances(goal, instant(tau)))


size_1, size_2, size_3 = sp.symbols("A_1 A_2 A_3", nonnegative=True)


@claim(
    "5/step4-roots", "The root of a bound by a product", le(sp.sqrt(size_1), sp.sqrt(size_2) * sp.sqrt(size_3)),
    given=[le(size_1, size_2 * size_3)], place="Step 4, case ii",
)  # fmt: skip
def roots(goal: Goal) -> Evidence:
    """The root increases, and that of a product is the product of the roots."""
    return reals(goal)


w1, w2 = sp.symbols("w1 w2", real=True)


@claim(
    "5/step4-norm-of-e", "‖E g‖ ≤ ‖E‖ ‖g‖ for the spectral norm, the largest singular value",
    le(sp.sqrt(w1**2 + w2**2), sp.sqrt(spectral_norm_squared) * sp.sqrt(g1**2 + g2**2)),
    given=[eq(w, entry) for w, entry in zip((w1, w2), E * sp.Matrix([g1, g2]), strict=True)],
    place="Step 4, case ii", uses=[spectral_norm, roots],
)  # fmt: skip
def norm_below(goal: Goal) -> Evidence:
    """The root of the claim about squares."""
    values = {size_1: w1**2 + w2**2, size_2: spectral_norm_squared, size_3: g1**2 + g2**2}
    return reals(goal, *specialise(goal, roots, values))


@claim(
    "5/step4-drift-norm", "‖f‖ ≤ ‖E‖ ‖∇F‖ along a solution", le(at(drift_norm, tau), E_norm * at(gradient_norm, tau)),
    given=[*later, *gradient_drift_given, norm_of_E], place="Step 4, case ii", uses=[norm_below], example=EXAMPLE,
)  # fmt: skip
def drift_norm_below(goal: Goal) -> Evidence:
    """Assumption 3A at the position and the instant."""
    values = dict(zip((w1, w2, g1, g2), (at(entry, tau) for entry in (*f_tau, F_1, F_2)), strict=True))
    return reals(goal, *specialise(goal, norm_below, values), *instances(goal, instant(tau)))


rate, low_factor, high_factor, widening, power = sp.symbols("Lambda c_1 c_2 w p_x", nonnegative=True)
slope = sp.Symbol("V_dot", real=True)


@claim(
    "5/step4-drift-by-gradient", "A drift that is at most a multiple of the gradient",
    le(slope, (high_factor**2 * E_norm / (1 + widening) ** 2 - k * low_factor**2 / 2) * power**2),
    given=[
        le(slope, rate * G_0 / (1 + widening) ** 2 - k / 2 * G_0**2), le(rate, E_norm * G_0),
        le(low_factor * power, G_0), le(G_0, high_factor * power),
    ],
    place="Step 4, case ii",
)  # fmt: skip
def drift_by_gradient(goal: Goal) -> Evidence:
    """The square of the gradient's norm is bounded above where it multiplies ‖E‖, and below where it pulls."""
    return reals(goal)


def drift_inequality(order: sp.Expr) -> sp.Expr:
    """The right-hand side of the inequality for V with gradient drift, for a given κ, at any position."""
    factor = c(2, order) ** 2 * E_norm / stretch**2 - k * c(1, order) ** 2 / 2
    return factor * V_of_x ** (2 * q(order))


@claim(
    "5/step4-gradient-drift-inequality", "With gradient drift: a differential inequality along a solution, for every κ",
    le(V_rate, at(drift_inequality(kappa), tau)),
    given=[*solves(tau), *later, *assumption_2, *gradient_drift_given, norm_of_E], place="Step 4, case ii",
    uses=[gradient_bounds, v_nonnegative, derivative_bound, drift_norm_below, drift_by_gradient], example=EXAMPLE,
)  # fmt: skip
def gradient_drift_inequality(goal: Goal) -> Evidence:
    """‖E∇F‖ ≤ ‖E‖‖∇F‖, and ‖∇F‖ between its bounds by V."""
    values = {
        slope: V_rate, rate: at(drift_norm, tau), G_0: at(gradient_norm, tau), power: V_along ** q(),
        low_factor: c(1), high_factor: c(2), widening: (tau - t0) / T,
    }  # fmt: skip
    said = [*specialise(goal, v_nonnegative, here), power_nonnegative(V_along, q())]
    return reals(
        goal, *said, *specialise(goal, drift_by_gradient, values, said),
        *specialise(goal, derivative_bound, {}), *specialise(goal, gradient_bounds, here),
        *specialise(goal, drift_norm_below, {}),
    )  # fmt: skip
