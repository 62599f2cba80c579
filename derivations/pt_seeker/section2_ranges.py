"""Section 2: the two intervals of time, the period in v_ji, and the sum over pairs of dithers."""

from __future__ import annotations

import sympy as sp

from ptproof.averaging import average
from ptproof.proof import Evidence, Goal, claim, eq, every, exact, ge, gt, integrals, le, lt, reals, refute
from ptproof.system import DitherSystem, lie_bracket

from .notation import T, nu, omega, t, t0, tau, x1, x2
from .section2_averaging import iterated_integral, phase
from .section2_change_of_time import contraction_rate, dilation_rate, inverse_map, time_map

SECTION = "2 Preliminaries: intervals, period, pairs of dithers"

to_tau = t0 + (t - t0) / nu(t - t0)
to_t = t0 + (tau - t0) / (1 + (tau - t0) / T)
in_t = [ge(t, t0), lt(t, t0 + T)]  # I_t
in_tau = [ge(tau, t0)]  # I_τ


@claim(
    "2.2/dilation-range", "The time map leads from I_t into I_τ", every(ge(to_tau, t0), gt(nu(t - t0), 0)), given=in_t,
    labels=["eq:tau_to_t"], uses=[time_map],
)  # fmt: skip
def dilation_range(goal: Goal) -> Evidence:
    """[t₀, t₀ + T) into [t₀, ∞). With the inverse map, which leads back, and the limits at the ends it is onto."""
    return reals(goal)


@claim(
    "2.2/contraction-range", "The inverse map leads from I_τ into I_t", every(ge(to_t, t0), lt(to_t, t0 + T)),
    given=in_tau, labels=["eq:t_to_tau"], uses=[inverse_map],
)  # fmt: skip
def contraction_range(goal: Goal) -> Evidence:
    """[t₀, ∞) into [t₀, t₀ + T): the end of the prescribed time is never reached in finite τ."""
    return reals(goal)


@claim(
    "2.2/time-maps-increase", "Both maps increase", gt(1 / nu(t - t0) ** 2, 0), given=in_t,
    labels=["eq:dtau_dt"], uses=[contraction_rate],
)  # fmt: skip
def dilation_increases(goal: Goal) -> Evidence:
    """dτ/dt > 0 on I_t, so the order of events is the same on both clocks, and the inverse map increases as well."""
    return reals(goal)


@claim(
    "2.2/dilation-rate-range", "dt/dτ falls from 1 and stays positive",
    every(gt(1 / (1 + (tau - t0) / T) ** 2, 0), le(1 / (1 + (tau - t0) / T) ** 2, 1)), given=in_tau,
    labels=["eq:dt_dtau"], uses=[dilation_rate],
)  # fmt: skip
def dilation_rate_range(goal: Goal) -> Evidence:
    """This factor damps the drift in dilated time."""
    return reals(goal)


# --- v_ji ---------------------------------------------------------------------------------------------------


@claim(
    "2.1/iterated-integral-printed", "v₂₁ = 1/2 with the letter T of the prescribed time, as printed",
    eq(iterated_integral(sp.sin(phase), sp.cos(phase), T), sp.Rational(1, 2)), place="Section 2.1",
    labels=["eq:Lie_Bracket_System"], expected="refuted", grade="misprint",
    wrong="The letter T of the prescribed time stands where the period T_f of the dithers is meant.",
    survives="Yes: the seeker's coefficients are computed over the period 2π.",
)  # fmt: skip
def iterated_integral_printed(goal: Goal) -> Evidence:
    """The formula for v_ji integrates over [0, T] and divides by T. Assumption 1D calls the period of the dithers T_f;
    T is the prescribed time everywhere else. With that T the dithers cos and sin give 1/2 − sin(2T)/(4T), which is
    1/2 − 1/π at T = π/4, and not the 1/2 of the averaged system."""
    return refute(goal, {T: sp.pi / 4})


period = sp.Symbol("T_f", positive=True)
frequency = 2 * sp.pi / period


@claim(
    "2.1/iterated-integral", "v₂₁ over one period T_f",
    eq(
        iterated_integral(sp.sin(frequency * phase), sp.cos(frequency * phase), period), period / (4 * sp.pi),
    ),
    place="Section 2.1", labels=["eq:Lie_Bracket_System"], corrects=iterated_integral_printed,
)  # fmt: skip
def iterated_integral_period(goal: Goal) -> Evidence:
    """For cosine and sine of any period T_f the coefficient is T_f/(4π); the period 2π of the seeker's dithers
    gives 1/2."""
    return integrals(goal)


_fields = tuple(tuple(sp.Function(f"b{i}{j}", real=True)(tau, x1, x2) for j in (1, 2)) for i in range(5))
_dithers = (sp.cos(phase), sp.sin(phase), sp.cos(2 * phase), sp.sin(2 * phase))
_four = average(DitherSystem(tau, phase, omega, (x1, x2), _fields[0], _fields[1:], _dithers))
_brackets = {
    (i, j): sp.Matrix(lie_bracket(_fields[i], _fields[j], (x1, x2))) for i in range(1, 5) for j in range(i + 1, 5)
}


def _by_hand() -> sp.Matrix:
    """b₀ + Σ_{i<j} [bᵢ, bⱼ] v_ji with the v_ji of two pairs, at the frequencies 1 and 2."""
    half, quarter = sp.Rational(1, 2), sp.Rational(1, 4)
    return sp.Matrix(_fields[0]) + _brackets[1, 2] * half + _brackets[3, 4] * quarter


@claim(
    "2.1/iterated-integrals-of-four", "v_ji of four dithers at two frequencies",
    every(
        eq(iterated_integral(_dithers[1], _dithers[0]), sp.Rational(1, 2)),
        eq(iterated_integral(_dithers[3], _dithers[2]), sp.Rational(1, 4)),
        *(eq(iterated_integral(_dithers[j], _dithers[i]), 0) for i, j in ((0, 2), (0, 3), (1, 2), (1, 3))),
    ),
    place="Section 2.1", labels=["eq:Lie_Bracket_System"],
)  # fmt: skip
def four_integrals(goal: Goal) -> Evidence:
    """Pairs of different frequencies contribute nothing."""
    return integrals(goal)


@claim(
    "2.1/lie-bracket-system-of-four", "The Lie bracket system of four arbitrary fields",
    eq(_by_hand(), _four.vector), labels=["eq:Lie_Bracket_System"], uses=[four_integrals],
)  # fmt: skip
def lie_bracket_system_of_four(goal: Goal) -> Evidence:
    """The printed sum is one over all pairs i < j: here six of them, four with the coefficient 0."""
    return exact(goal)
