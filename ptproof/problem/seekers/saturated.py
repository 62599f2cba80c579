"""The seeker whose angular velocity is reached through a saturated angular acceleration (eq:sat_seeker)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy as sp

from ptproof.problem.drift import Drift, no_drift
from ptproof.problem.model import TIME, parameters
from ptproof.problem.seekers.seeker import TUNED, Letters, Seeker, feedback, letters, unicycle
from ptproof.system import System


def saturate(value: sp.Expr, level: sp.Expr) -> sp.Expr:
    """sat(value) = min(S, max(−S, value)) for the level S > 0."""
    return sp.Min(level, sp.Max(-level, value))


def saturated_seeker(
    field: sp.Expr, *, k: sp.Expr, omega: sp.Expr, mu: sp.Expr, epsilon: sp.Expr, level: sp.Expr,
    gain: sp.Expr, time: sp.Symbol, drift: Drift | Sequence[sp.Expr] | None = None, states: Letters | None = None,
) -> System:  # fmt: skip
    """The saturated seeker (eq:sat_seeker), states (x₁, x₂, θ, u₂, z).

    ``gain`` is C(t): a clipped prescribed-time gain or a constant. The angular acceleration is
    sat(…)/ε, so its bound is level/ε.
    """
    states = states or letters()
    law = feedback(field, states.filter, k, omega, mu, gain)
    u2, name = states.angular_velocity, "saturated seeker"
    steered = unicycle(time, no_drift() if drift is None else drift, law, states, name)
    forward, filter_rate = steered.rhs[:2], steered.rhs[3]
    rhs = (*forward, u2, saturate(-u2 + law.angular, level) / epsilon, filter_rate)
    return System(time, (*states.position, states.heading, u2, states.filter), rhs, name=name)


def loop(field: sp.Expr, drift: Drift | Sequence[sp.Expr], gain: sp.Expr, states: Letters) -> System:
    """Its closed loop with the gain C in the letters of a problem."""
    limits = {"epsilon": parameters.epsilon, "level": parameters.level}
    return saturated_seeker(field, **TUNED, **limits, gain=gain, time=TIME, drift=drift, states=states)


def inputs(field: sp.Expr, gain: sp.Expr, states: Letters) -> Mapping[str, sp.Expr]:
    """Forward velocity and angular acceleration."""
    _, _, _, acceleration, _ = loop(field, no_drift(), gain, states).rhs
    return {"u1": gain * sp.sqrt(parameters.omega), "a": acceleration}


SEEKER = Seeker(
    "saturated", "as pt, through a saturated angular acceleration", loop, inputs, averaged=False,
    tables=("saturation",), rank=3,
)  # fmt: skip
