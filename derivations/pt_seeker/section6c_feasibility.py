"""Sections 6.3 and 6.4: the nonvanishing drift under the asymptotic seeker, and clipping of the gain."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Claim, Evidence, Goal, claim, eq, every, ge, le, limits, lt, power_positive, reals, specialise

from .notation import G, T, V, a1, a2, c, d, f_norm, h1, h2, k, kappa, nu, omega, q, t, t0, tau
from .section5d_1_interval import Z, beta, bounds_at, distance, falls, gamma, input_gain, m, s, start
from .section5d_2_estimates import kappa_1, kappa_2
from .section6a_asymptotic import asymptotic_derivative

SECTION = "6.3 Discussion: nonvanishing drift and feasibility"

V_dot = sp.Symbol("V_dot", real=True)
U_of_V = V ** (1 / (2 * kappa))


@claim(
    "6.3/asymptotic-u-inequality", "The inequality for U under the asymptotic seeker",
    le((1 - q()) * V ** (-q()) * V_dot, -h1 * U_of_V ** (2 * kappa - 1) + h2 * d),
    given=[
        le(V_dot, f_norm * G - k / 2 * G**2), le(f_norm, d), le(c(1) * V ** q(), G), le(G, c(2) * V ** q()),
    ],
    place="Section 6.3", uses=[asymptotic_derivative],
)  # fmt: skip
def asymptotic_u_inequality(goal: Goal) -> Evidence:
    """As in the proof of the Proposition, but the input is not damped with time."""
    return reals(goal, power_positive(V, q()))


def global_iss(order: sp.Expr, tag: str, words: str, upper_bound: Claim) -> Claim:
    """The input-to-state estimate of the averaged asymptotic seeker, for one kind of κ."""
    forcing = input_gain(order) * d

    @claim(
        f"6.3/asymptotic-global-iss-{tag}", f"The averaged asymptotic seeker is input-to-state stable ({words})",
        le(distance(tau), beta(distance(t0), tau - t0, order) + gamma(forcing, order)),
        given=[ge(tau, t0), *falls(order, forcing, ge(s, t0), le(s, tau)), le(a2, a1), *bounds_at(order, tau, t0)],
        place="Section 6.3", uses=[upper_bound, asymptotic_u_inequality],
    )  # fmt: skip
    def estimate(goal: Goal) -> Evidence:
        """The paper says that only local input-to-state stability can be established here. Under its own Assumption 2,
        on the whole plane, the estimate of the Proposition's proof holds for every initial distance and every bound of
        the drift: it never used that ζ decays. What the asymptotic seeker lacks is the decay of the input, so the
        distance gets below a residual, not to zero."""
        return reals(goal, *specialise(goal, upper_bound, {start: t0, Z: forcing}))

    return estimate


def _named(claims: tuple[Claim, ...], name: str) -> Claim:
    return next(item for item in claims if item.id == name)


asymptotic_iss = (
    global_iss(sp.Integer(1), "kappa-1", "κ = 1", _named(kappa_1, "prop/upper-bound-kappa-1")),
    global_iss(m + 1, "kappa-2", "κ ≥ 2", _named(kappa_2, "prop/upper-bound-kappa-2")),
)

# --- 6.4 --------------------------------------------------------------------------------------------------------------

turn = sp.Symbol("turn", positive=True)  # ω − (k/μ)(y − z) at one instant
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
