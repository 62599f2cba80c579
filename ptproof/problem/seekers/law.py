"""What the seekers have in common: a unicycle steered by its angular velocity alone, with a measurement y and a
washout filter. Symbols, numbers and undefined functions are all welcome.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import sympy as sp

from ptproof.errors import InputError
from ptproof.problem.drift import Drift
from ptproof.problem.model import parameters
from ptproof.system import System

TUNED = {"k": parameters.k, "omega": parameters.omega, "mu": parameters.mu}


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


def unicycle(time: sp.Symbol, drift: Drift | Sequence[sp.Expr], law: Feedback, states: Letters, name: str) -> System:
    """The unicycle (eq:unicycle_with_drift) under a feedback law."""
    rate = tuple(drift.rate if isinstance(drift, Drift) else drift)
    if len(rate) != 2:
        raise InputError(f"{name}: a unicycle moves in the plane, but the drift has {len(rate)} entries")
    velocity = (rate[0] + law.forward * sp.cos(states.heading), rate[1] + law.forward * sp.sin(states.heading))
    state = (*states.position, states.heading, states.filter)
    return System(time, state, (*velocity, law.angular, law.filter_rate), name=name)
