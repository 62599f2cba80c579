"""The PT Seeker (eq:closed_loop_system_t): the gain is the rate of a clock, so that it arrives at t₀ + T."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from ptproof.problem.drift import Drift
from ptproof.problem.seekers.asymptotic import inputs, loop
from ptproof.problem.seekers.seeker import Letters, Seeker, feedback, letters, unicycle
from ptproof.system import System
from ptproof.transforms.clocks import CappedClock, Clock, capped


def prescribed_time_gain(clock: Clock | CappedClock, minimum: sp.Expr | None = None) -> sp.Expr:
    """K(t) = dτ/dt, 1/ν² for the paper's clock; with ``minimum`` ν_min it stays what it is at ν = ν_min (eq:kt)."""
    return clock.rate if minimum is None or isinstance(clock, CappedClock) else capped(clock, minimum).rate


def prescribed_time_seeker(
    field: sp.Expr, drift: Drift | Sequence[sp.Expr], *, k: sp.Expr, omega: sp.Expr, mu: sp.Expr,
    clock: Clock | CappedClock, minimum: sp.Expr | None = None, states: Letters | None = None,
) -> System:  # fmt: skip
    """The PT Seeker in t (eq:closed_loop_system_t); with ``minimum`` its gain is clipped (eq:kt).

    States (x₁, x₂, θ, z).
    """
    states = states or letters()
    law = feedback(field, states.filter, k, omega, mu, prescribed_time_gain(clock, minimum))
    return unicycle(clock.t, drift, law, states, "prescribed-time seeker")


SEEKER = Seeker("pt", "arrives at the prescribed time", loop, inputs, rank=1)
