"""Section 5, Assumption 1 for the drift term b₀ of the seeker, on I_τ."""

from __future__ import annotations

import sympy as sp

from ptproof.problem.drift import gradient_drift
from ptproof.proof import Evidence, Goal, Smooth, claim, every, ge, le, reals, smooth

from .notation import E, F, T, f, position, t0, tau
from .section5a_1_reduction import f_tau, stretch
from .section5a_2_averaging import drift_brace

SECTION = "5.1 Theorem, Steps 1 to 3: the averaged system"

on_the_interval = [ge(tau, t0)]


@claim(
    "5/assumption-a-drift", "Assumption 1A on I_τ: b₀ is twice continuously differentiable",
    Smooth(tuple(entry / stretch**2 for entry in f_tau), (tau, *position), 2, tuple((entry, 2) for entry in f)),
    given=on_the_interval, place="Assumption 1A", uses=[drift_brace],
)  # fmt: skip
def assumption_a_drift(goal: Goal) -> Evidence:
    """A drift in C², at the instant t that belongs to τ, over the square of the stretch, which is at least 1 there."""
    return smooth(goal)


gradient_f = gradient_drift(E.tolist(), F, position).rate
damped = [entry / stretch**2 for entry in gradient_f]


@claim(
    "5/assumption-b-drift-derivatives", "Assumption 1B on I_τ for f = E∇F: the derivatives of b₀ are bounded",
    every(
        *(le(sp.diff(b, tau) ** 2, (2 / T) ** 2 * rate**2) for b, rate in zip(damped, gradient_f, strict=True)),
        *(le(sp.diff(b, x) ** 2, sp.diff(rate, x) ** 2)
          for b, rate in zip(damped, gradient_f, strict=True) for x in position),
        *(le(sp.diff(b, tau, x) ** 2, (2 / T) ** 2 * sp.diff(rate, x) ** 2)
          for b, rate in zip(damped, gradient_f, strict=True) for x in position),
    ),
    given=on_the_interval, place="Assumption 1B", uses=[drift_brace],
)  # fmt: skip
def assumption_b_drift_derivatives(goal: Goal) -> Evidence:
    """In time at most 2‖E∇F‖/T, in position at most what the drift itself has; the right-hand sides do not depend on
    time and are continuous, hence bounded on compact sets. A general f(t, x) that is C² on [t₀, t₀ + T) only may have
    unbounded derivatives near t₀ + T; Theorem 2 does not speak of such drifts."""
    return reals(goal)
