"""Section 2: the two intervals of time."""

from __future__ import annotations

from ptproof.proof import Evidence, Goal, claim, every, ge, gt, le, lt, reals

from .notation import T, nu, t, t0, tau
from .section2_change_of_time import contraction_rate, dilation_rate, inverse_map, time_map

SECTION = "2 Preliminaries: intervals of time"

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
