"""Sections 6.3 and 6.4: the nonvanishing drift under the asymptotic seeker, and clipping of the gain."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Claim,
    Evidence,
    Fact,
    Goal,
    claim,
    eq,
    every,
    instances,
    le,
    limits,
    lt,
    power_nonnegative,
    reals,
    specialise,
)

from .notation import T, c, d, f, k, kappa, nu, omega, q, t, t0, tau, x1, x2
from .section5b_0_trajectory import (
    G_0,
    X1,
    X2,
    V_of_x,
    assumption_2,
    cauchy_schwarz,
    distance,
    gradient_bounds,
    gradient_norm,
    v_nonnegative,
)
from .section5b_1_lyapunov import at_order
from .section5c_1_proposition import constants_ordered, u_bounds
from .section5d_1_interval import Z, beta, gamma, input_gain, m, rate_of, start
from .section5d_2_estimates import kappa_1, kappa_2
from .section5d_3_trajectory import PUT_IN, named
from .section6c_2_bounded_drift import FALLING, PUSHED, V_now, V_rate, asymptotic_derivative, at, here, moved

SECTION = "6.3 Discussion: nonvanishing drift and feasibility"

slope = sp.Symbol("V_dot", real=True)
pushed, size, low, high = sp.symbols("f_x p_x c_1 c_2", nonnegative=True)


@claim(
    "6.3/drift-by-letters", "A bounded drift in the rate of V",
    le(slope, high * d * size - k * low**2 / 2 * size**2),
    given=[le(slope, pushed * G_0 - k / 2 * G_0**2), le(pushed, d), le(low * size, G_0), le(G_0, high * size)],
    place="Section 6.3",
)  # fmt: skip
def drift_by_letters(goal: Goal) -> Evidence:
    """The gradient's norm is bounded above where it multiplies the drift, and below where it is squared."""
    return reals(goal)


drift_norm = sp.sqrt(f[0] ** 2 + f[1] ** 2)


@claim(
    "6.3/asymptotic-u-inequality",
    "The inequality for V by the letters of U, along a solution of the asymptotic average",
    le(V_rate, 2 * kappa * (input_gain(kappa) * d * V_now ** q() - rate_of(kappa) * V_now ** (2 * q()))),
    given=[*moved, *assumption_2], place="Section 6.3",
    uses=[asymptotic_derivative, cauchy_schwarz, gradient_bounds, v_nonnegative, drift_by_letters], example=PUSHED,
)  # fmt: skip
def asymptotic_u_inequality(goal: Goal) -> Evidence:
    """As in the proof of the Proposition, with h₁ and h₂ as printed, but the input is not damped with time. It says
    U' ≤ −h₁U^(2κ−1) + h₂d of U = V^(1/2κ) away from the source."""
    said = [
        *specialise(goal, v_nonnegative, here), power_nonnegative(V_now, q()), power_nonnegative(V_now, 2 * q()),
        *instances(goal, (t, X1(t), X2(t))),
    ]  # fmt: skip
    values = {
        slope: V_rate, pushed: at(drift_norm, t), G_0: at(gradient_norm, t), size: V_now ** q(), low: c(1), high: c(2)
    }  # fmt: skip
    return reals(
        goal, *said, *specialise(goal, asymptotic_derivative, {}), *specialise(goal, cauchy_schwarz, {**here, tau: t}),
        *specialise(goal, gradient_bounds, here), *specialise(goal, drift_by_letters, values, said),
    )  # fmt: skip


def global_iss(order: sp.Expr, tag: str, words: str, scalar: tuple[Claim, ...]) -> Claim:
    """The input-to-state estimate of the averaged asymptotic seeker, for one kind of κ."""
    upper_bound, forcing = named(scalar, "upper-bound"), input_gain(order) * d

    @claim(
        f"6.3/asymptotic-global-iss-{tag}",
        f"The averaged asymptotic seeker is input-to-state stable with the Proposition's functions ({words})",
        le(at(distance, t), beta(at(distance, t0), t - t0, order) + gamma(forcing, order)),
        given=[*moved, *at_order(assumption_2, order)], place="Section 6.3",
        uses=[upper_bound, asymptotic_u_inequality, v_nonnegative, u_bounds, constants_ordered],
        example=PUSHED if order == 1 else FALLING | {m: 1},
    )  # fmt: skip
    def estimate(goal: Goal) -> Evidence:
        """The paper says that only local input-to-state stability can be established here. Under its own Assumption 2,
        on the whole plane, the estimate of the Proposition's proof holds along every solution, for every initial
        distance and every bound of the drift: it never used that ζ decays. What the asymptotic seeker lacks is the
        decay of the input, so the distance gets below a residual, not to zero."""

        def placed(there: Goal, claimed: Claim, time: sp.Expr) -> list[Fact]:
            return specialise(there, claimed, {kappa: order, x1: X1(time), x2: X2(time)})

        def along(there: Goal, time: sp.Expr) -> list[Fact]:
            value = at(V_of_x, time)
            return [
                *placed(there, v_nonnegative, time), power_nonnegative(value, q(order)),
                power_nonnegative(value, 2 * q(order)),
                *specialise(there, asymptotic_u_inequality, {kappa: order, t: time}),
            ]  # fmt: skip

        ends = [fact for time in (t0, t) for used in (v_nonnegative, u_bounds) for fact in placed(goal, used, time)]
        values = {**PUT_IN, Z: forcing, start: t0, tau: t}
        return reals(
            goal, *ends, *specialise(goal, constants_ordered, {kappa: order}),
            *specialise(goal, upper_bound, values, along=along),
        )  # fmt: skip

    return estimate


asymptotic_iss = (
    global_iss(sp.Integer(1), "kappa-1", "κ = 1", kappa_1),
    global_iss(m + 1, "kappa-2", "κ ≥ 2", kappa_2),
)

# --- 6.4 --------------------------------------------------------------------------------------------------------------

turn = sp.Symbol("Omega", positive=True)  # ω − (k/μ)(y − z) at one instant
lowest = sp.Symbol("nu_min", positive=True)


@claim(
    "6.4/inputs-grow", "Both inputs grow without limit",
    every(
        eq(sp.Limit(sp.sqrt(omega) / nu(t - t0) ** 2, t, t0 + T, "-"), sp.oo),
        eq(sp.Limit(turn / nu(t - t0) ** 2, t, t0 + T, "-"), sp.oo),
    ),
    place="Section 6.4",
)  # fmt: skip
def inputs_grow(goal: Goal) -> Evidence:
    """u₁ always; u₂ where its factor ω − (k/μ)(y − z) stays away from zero, for instance where the filter has settled
    and the factor is ω."""
    return limits(goal)


@claim(
    "6.4/clipped-gain-range", "Letting ν decay down to 0.2–0.3 multiplies the inputs by 11 to 25 at most",
    every(le(sp.Rational(100, 9), 1 / lowest**2), le(1 / lowest**2, 25)),
    given=[le(sp.Rational(1, 5), lowest), le(lowest, sp.Rational(3, 10))], place="Section 6.4",
)  # fmt: skip
def clipped_gain_range(goal: Goal) -> Evidence:
    """1/0.3² = 100/9 and 1/0.2² = 25."""
    return reals(goal)


@claim(
    "6.4/clipping-time", "The gain is clipped for the last part ν_min of the prescribed time",
    every(eq(nu(T * (1 - lowest)), lowest), lt(T * (1 - lowest), T)), place="Section 6.4",
)  # fmt: skip
def clipping_time(goal: Goal) -> Evidence:
    """From t₀ + T(1 − ν_min) on the seeker is an asymptotic one with the constant gain 1/ν_min²: for the last 20 to 30
    per cent of T."""
    return reals(goal)


@claim(
    "6.4/clipped-dilated-time", "Up to the clipping only a finite dilated time has passed",
    eq((t - t0) / nu(t - t0), T * (1 / lowest - 1)), given=[eq(t, t0 + T * (1 - lowest))], place="Section 6.4",
)  # fmt: skip
def clipped_dilated_time(goal: Goal) -> Evidence:
    """T(1/ν_min − 1), which is 7T/3 for 0.3 and 4T for 0.2. So the clipped seeker reaches a neighbourhood of the source
    in the prescribed time, whose size the bounds in τ give, and not the source."""
    return reals(goal)
