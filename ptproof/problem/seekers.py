"""The closed loops: a unicycle steered by its angular velocity alone, with a measurement y and a washout filter.

Each function returns the closed loop in the original time t, states (x₁, x₂, θ, z) or, with a saturated
angular acceleration, (x₁, x₂, θ, u₂, z). Symbols, numbers and undefined functions are all welcome.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import sympy as sp

from ptproof.errors import InputError
from ptproof.problem.drift import Drift
from ptproof.system import System
from ptproof.transforms.clocks.clock import Clock


@dataclass(frozen=True)
class Letters:
    """The states' letters: position x₁, x₂, heading θ, filter state z and angular velocity u₂."""

    position: tuple[sp.Symbol, sp.Symbol]
    heading: sp.Symbol
    filter: sp.Symbol
    angular_velocity: sp.Symbol


def letters() -> Letters:
    """x1, x2, theta, z and u2, all real."""
    x1, x2, theta, z, u2 = sp.symbols("x1 x2 theta z u2", real=True)
    return Letters((x1, x2), theta, z, u2)


@dataclass(frozen=True)
class Feedback:
    """What the seeker applies: forward velocity u₁, angular velocity u₂ and the filter's rate dz/dt."""

    forward: sp.Expr
    angular: sp.Expr
    filter_rate: sp.Expr


def feedback(field: sp.Expr, filter: sp.Symbol, k: sp.Expr, omega: sp.Expr, mu: sp.Expr, gain: sp.Expr) -> Feedback:
    """u₁ = K√ω, u₂ = K(ω − (k/μ)(y − z)), dz/dt = K(y − z)/μ, with the gain K (eq:pt_controlla for K = 1/ν²)."""
    innovation = (field - filter) / mu
    return Feedback(gain * sp.sqrt(omega), gain * (omega - k * innovation), gain * innovation)


def unicycle(time: sp.Symbol, drift: Sequence[sp.Expr], law: Feedback, states: Letters, name: str) -> System:
    """The unicycle (eq:unicycle_with_drift) under a feedback law."""
    if len(drift) != 2:
        raise InputError(f"{name}: a unicycle moves in the plane, but the drift has {len(drift)} entries")
    x1, x2 = states.position
    rhs = (
        drift[0] + law.forward * sp.cos(states.heading),
        drift[1] + law.forward * sp.sin(states.heading),
        law.angular,
        law.filter_rate,
    )
    return System(time, (x1, x2, states.heading, states.filter), rhs, name=name)


def prescribed_time_gain(clock: Clock, minimum: sp.Expr | None = None) -> sp.Expr:
    """K(t) = dτ/dt, 1/ν² for the paper's clock; with ``minimum`` ν_min clipped to 1/max(ν_min, ν)² (eq:kt).

    The clipped gain stays at 1/ν_min² from then on, also after t₀ + T.
    """
    if minimum is None:
        return clock.rate
    nu = 1 - (clock.t - clock.start) / clock.horizon
    return 1 / sp.Max(minimum, nu) ** 2


def prescribed_time_seeker(
    field: sp.Expr, drift: Drift | Sequence[sp.Expr], *, k: sp.Expr, omega: sp.Expr, mu: sp.Expr,
    clock: Clock, minimum: sp.Expr | None = None, states: Letters | None = None,
) -> System:  # fmt: skip
    """The PT Seeker in t (eq:closed_loop_system_t); with ``minimum`` its gain is clipped (eq:kt)."""
    states = states or letters()
    rate = drift.rate if isinstance(drift, Drift) else tuple(drift)
    law = feedback(field, states.filter, k, omega, mu, prescribed_time_gain(clock, minimum))
    return unicycle(clock.t, rate, law, states, "prescribed-time seeker")


def asymptotic_seeker(
    field: sp.Expr, drift: Drift | Sequence[sp.Expr], *, k: sp.Expr, omega: sp.Expr, mu: sp.Expr,
    time: sp.Symbol, gain: sp.Expr = sp.S.One, states: Letters | None = None,
) -> System:  # fmt: skip
    """The asymptotic seeker (eq:exponential_seeker); a constant ``gain`` other than 1 speeds it up."""
    states = states or letters()
    rate = drift.rate if isinstance(drift, Drift) else tuple(drift)
    law = feedback(field, states.filter, k, omega, mu, gain)
    return unicycle(time, rate, law, states, "asymptotic seeker")


def saturate(value: sp.Expr, level: sp.Expr) -> sp.Expr:
    """sat(value) = min(S, max(−S, value)) for the level S > 0."""
    return sp.Min(level, sp.Max(-level, value))


def saturated_seeker(
    field: sp.Expr, *, k: sp.Expr, omega: sp.Expr, mu: sp.Expr, epsilon: sp.Expr, level: sp.Expr,
    gain: sp.Expr, time: sp.Symbol, drift: Drift | Sequence[sp.Expr] | None = None, states: Letters | None = None,
) -> System:  # fmt: skip
    """The seeker whose angular velocity is reached through a saturated angular acceleration (eq:sat_seeker).

    ``gain`` is C(t): a clipped prescribed-time gain or a constant. The angular acceleration is
    sat(…)/ε, so its bound is level/ε.
    """
    states = states or letters()
    zero = (sp.Integer(0),) * 2
    rate = zero if drift is None else drift.rate if isinstance(drift, Drift) else tuple(drift)
    law = feedback(field, states.filter, k, omega, mu, gain)
    x1, x2 = states.position
    u2 = states.angular_velocity
    rhs = (
        rate[0] + law.forward * sp.cos(states.heading),
        rate[1] + law.forward * sp.sin(states.heading),
        u2,
        saturate(-u2 + law.angular, level) / epsilon,
        law.filter_rate,
    )
    return System(time, (x1, x2, states.heading, u2, states.filter), rhs, name="saturated seeker")
