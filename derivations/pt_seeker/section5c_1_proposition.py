"""Section 5, Proposition: a bounded drift that does not vanish, and the class-KL estimate in both times."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Assumption,
    Claim,
    Evidence,
    Fact,
    ForAll,
    Goal,
    claim,
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

from . import chain
from .notation import (
    IN_TIME,
    T,
    U,
    V,
    a1,
    a2,
    c,
    d,
    f,
    f_norm,
    h1,
    h2,
    k,
    kappa,
    nu,
    position,
    q,
    r,
    source,
    t,
    t0,
    tau,
    zeta,
)  # fmt: skip
from .section5a_2_averaging import averaged_system
from .section5b_0_trajectory import (
    EXAMPLE,
    R_0,
    V_0,
    V_along,
    V_of_x,
    V_rate,
    assumption_2,
    at,
    distance,
    drift_norm,
    field_between,
    here,
    later,
    m,
    order,
    s,
    solves,
    v_bounds,
)
from .section5b_0_trajectory import v_differential_inequality as along_solution
from .section5b_0_trajectory import v_nonnegative as nonnegative
from .section5b_0_with_drift import in_time, instant

SECTION = "5.3 Proposition: a bounded drift that does not vanish"

stretch = 1 + (tau - t0) / T
V_dot, U_dot = sp.symbols("V_dot U_dot", real=True)
lag = sp.Symbol("eta", nonnegative=True)  # (τ − t₀)/T


@claim(
    "prop/averaged-in-t", "The averaged reduced model in the original time",
    eq(sp.Matrix([f[i] + k / 2 * chain.gradient_F[i] / nu(t - t0) ** 2 for i in (0, 1)]), chain.averaged_t.vector),
    given=IN_TIME, labels=["eq:LBA_reduced_model_t"], uses=[averaged_system],
)  # fmt: skip
def averaged_in_t(goal: Goal) -> Evidence:
    """The Lie bracket system, contracted: the drift gets back its full size, the gradient the growing gain."""
    return exact(goal)


# --- The scalar inequality --------------------------------------------------------------------------------------------

# Assumption 3B: ‖f(t, x)‖ ≤ d(t); and the letter d, at least the largest of these bounds from t₀ up to now.
d_of = sp.Function("d_t", nonnegative=True)
assumption_3b = ForAll((t, *position), le(sp.sqrt(f[0] ** 2 + f[1] ** 2), d_of(t)), in_time)


def largest(until: sp.Expr | None) -> ForAll:
    """d_of ≤ d from t₀ up to the instant of the original time that belongs to ``until``, or always."""
    last = lt(s, t0 + T) if until is None else le(s, chain.clock.to_t.subs(tau, until))
    return ForAll((s,), le(d_of(s), d), (ge(s, t0), last))


pushed: list[Assumption] = [*solves(tau), *later, *assumption_2, assumption_3b, largest(tau)]
PUSHED = EXAMPLE | {d_of(t): 0}
size, pull, factor = sp.symbols("p_x P w", nonnegative=True)


@claim(
    "prop/larger-drift", "A larger bound of the drift in the inequality for V",
    le(V_dot, factor * d * size - pull),
    given=[le(V_dot, factor * f_norm * size - pull), le(f_norm, d)], place="Proof of the Proposition",
)  # fmt: skip
def larger_drift(goal: Goal) -> Evidence:
    """Its factor is not negative."""
    return reals(goal)


@claim(
    "prop/bounded-drift", "The inequality for V along a solution under a bounded drift",
    le(V_rate, at(c(2) * d / stretch**2 * V_of_x ** q() - k * c(1) ** 2 / 2 * V_of_x ** (2 * q()), tau)),
    given=pushed, labels=["eq:lyapunov_derivative_inequality_bounded"],
    uses=[along_solution, nonnegative, larger_drift], example=PUSHED,
)  # fmt: skip
def bounded_drift(goal: Goal) -> Evidence:
    """The norm of the drift is replaced by the largest bound met so far. The letter d is read along the clock: at
    τ it is the bound that holds at the instant t that belongs to τ."""
    power = V_along ** q()
    said = [*specialise(goal, nonnegative, here), power_nonnegative(V_along, q()), power_nonnegative(V_along, 2 * q())]
    values = {
        V_dot: V_rate, factor: c(2) / stretch**2, f_norm: at(drift_norm, tau), size: power,
        pull: k * c(1) ** 2 / 2 * V_along ** (2 * q()),
    }  # fmt: skip
    return reals(
        goal, *said, *specialise(goal, along_solution, {}), *specialise(goal, larger_drift, values, said),
        *instances(goal, instant(tau), instant(tau)[0]),
    )  # fmt: skip


V_of = sp.Function("V", positive=True)(tau)
U_of_V = V ** (1 / (2 * kappa))


@claim(
    "prop/u-substitution", "U = V^(1−q) = V^(1/2κ), and its derivative",
    every(
        eq(V ** (1 - q()), U_of_V),
        eq((1 - q()) * V ** (-q()), sp.diff(V ** (1 / (2 * kappa)), V)),
        eq(sp.Derivative(V_of ** (1 - q()), tau), (1 - q()) * V_of ** (-q()) * sp.Derivative(V_of, tau)),
    ),
    place="Proof of the Proposition",
)  # fmt: skip
def u_substitution(goal: Goal) -> Evidence:
    """Away from the source, where V > 0. The power is chosen so that the drift enters additively."""
    return exact(goal)


U_along = V_along ** (1 / (2 * kappa))
U_rate = sp.Derivative(U_along, tau)
away = gt(V_along, 0)


@claim(
    "prop/u-inequality-by-letters", "What the inequality for V says of U, where V > 0",
    le((1 - q()) * V ** (-q()) * V_dot, -h1 * U_of_V ** (2 * kappa - 1) + h2 * d / (1 + lag) ** 2),
    given=[le(V_dot, c(2) * d / (1 + lag) ** 2 * V ** q() - k * c(1) ** 2 / 2 * V ** (2 * q()))],
    place="Proof of the Proposition", uses=[u_substitution],
)  # fmt: skip
def u_by_letters(goal: Goal) -> Evidence:
    """Multiplying by (1 − q)V^(−q) turns V^q into 1 and V^(2q) into U^(2κ−1), with the constants h₁ and h₂ as
    printed."""
    return reals(goal)


@claim(
    "prop/u-inequality", "The inequality for U along a solution, where it is not at the source",
    le(U_rate, -h1 * U_along ** (2 * kappa - 1) + h2 * d / stretch**2),
    given=[*pushed, away], labels=["eq:Ux_inequality"], uses=[bounded_drift, u_by_letters], example=PUSHED,
)  # fmt: skip
def u_inequality(goal: Goal) -> Evidence:
    """dU/dτ by the chain rule. At the source U has no derivative; the bound of the distance below does without it."""
    values = {V: V_along, V_dot: V_rate, lag: (tau - t0) / T}
    return reals(goal, *specialise(goal, u_by_letters, values), *specialise(goal, bounded_drift, {}))


@claim(
    "prop/root-by-letters", "The root of the bounds of V, for κ = m + 1",
    every(le(a2 ** (1 / (2 * order)) * R_0, V_0 ** (1 / (2 * order))),
          le(V_0 ** (1 / (2 * order)), a1 ** (1 / (2 * order)) * R_0)),
    given=[le(a2 * R_0 ** (2 * order), V_0), le(V_0, a1 * R_0 ** (2 * order))], place="Proof of the Proposition",
)  # fmt: skip
def root_by_letters(goal: Goal) -> Evidence:
    """The root increases."""
    root, power = 1 / (2 * order), R_0 ** (2 * order)
    return reals(goal, power_monotone(a2 * power, V_0, root), power_monotone(V_0, a1 * power, root))


@claim(
    "prop/u-bounds", "U between multiples of the distance, at every position",
    every(
        le(a2 ** (1 / (2 * kappa)) * distance, V_of_x ** (1 / (2 * kappa))),
        le(V_of_x ** (1 / (2 * kappa)), a1 ** (1 / (2 * kappa)) * distance),
    ),
    given=field_between, labels=["eq:Ux_bounds"], uses=[v_bounds, nonnegative, root_by_letters],
)  # fmt: skip
def u_bounds(goal: Goal) -> Evidence:
    """The 2κ-th root of the bounds of V."""
    said = [*specialise(goal, v_bounds, {}), *specialise(goal, nonnegative, {})]
    values = {m: kappa - 1, R_0: distance, V_0: V_of_x}
    return reals(goal, *said, *specialise(goal, root_by_letters, values, said))


@claim(
    "prop/constants-ordered", "a₂ ≤ a₁", le(a2, a1), given=field_between, place="Assumption 2",
)  # fmt: skip
def constants_ordered(goal: Goal) -> Evidence:
    """The two bounds of the field at the distance 1 from the source."""
    return reals(goal, *instances(goal, (source[0] + 1, source[1])))


@claim(
    "prop/u-inequality-in-distance-by-letters", "The bound of dU/dτ by the distance and ζ",
    le(U_dot, -h1 * a2 ** ((2 * kappa - 1) / (2 * kappa)) * R_0 ** (2 * kappa - 1) + sp.Abs(zeta)),
    given=[le(U_dot, -h1 * U ** (2 * kappa - 1) + zeta), le(a2 ** (1 / (2 * kappa)) * R_0, U)],
    place="Proof of the Proposition",
)  # fmt: skip
def in_distance_by_letters(goal: Goal) -> Evidence:
    """The lower bound of U, raised to the power 2κ − 1."""
    return reals(goal, power_monotone(a2 ** (1 / (2 * kappa)) * R_0, U, r))


@claim(
    "prop/u-inequality-in-distance", "dU/dτ along a solution bounded by the distance and ζ",
    le(
        U_rate,
        -h1 * a2 ** ((2 * kappa - 1) / (2 * kappa)) * at(distance, tau) ** (2 * kappa - 1)
        + sp.Abs(h2 * d / stretch**2),
    ),
    given=[*pushed, away], labels=["eq:Ux_inequality2"],
    uses=[u_inequality, u_bounds, in_distance_by_letters], example=PUSHED,
)  # fmt: skip
def u_inequality_in_distance(goal: Goal) -> Evidence:
    """ζ = h₂d/(1 + (τ − t₀)/T)², and the lower bound of U at X(τ)."""
    return reals(goal, *in_letters(goal, in_distance_by_letters), *specialise(goal, u_inequality, {}))


def in_letters(goal: Goal, claimed: Claim) -> list[Fact]:
    """A claim about the letters R, U, dU/dτ and ζ, with what they stand for along the solution."""
    positive = power_positive(V_along, 1 / (2 * kappa))
    values = {U_dot: U_rate, U: U_along, R_0: at(distance, tau), zeta: h2 * d / stretch**2}
    return [positive, *specialise(goal, u_bounds, here), *specialise(goal, claimed, values, [positive])]
