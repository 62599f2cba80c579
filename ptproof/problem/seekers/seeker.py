"""A seeker as a record, and what the seekers have in common: a unicycle that is steered by its angular velocity alone.

It has a measurement y and a washout filter. Symbols, numbers and undefined functions are all welcome in a law.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
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


Law = Callable[[sp.Expr, Drift | Sequence[sp.Expr], sp.Expr, Letters], System]
Inputs = Callable[[sp.Expr, sp.Expr, Letters], Mapping[str, sp.Expr]]


@dataclass(frozen=True)
class Seeker:
    """One way to seek. The package offers it wherever seekers are chosen, once a file of this folder has it as SEEKER.

    Attributes
    ----------
    name
        What the user writes.
    words
        What it is, for the help of the commands.
    law
        From field, drift, gain K and the states' letters to the closed loop in ``TIME``, with the symbols of
        :class:`ptproof.problem.model.parameters`; its first states are the position.
    inputs
        From field, gain and letters to what it applies, by name.
    gain
        K where it is constant; None for the rate of the problem's clock. τ is the clock with this rate.
    averaged
        Whether θ + kz turns at the rate ω in τ, so that it has reduced coordinates, a reduced model and an average.
    tables
        The tables beyond those of every problem file that it needs. A problem that has them is meant for it: of all
        seekers whose tables a problem has, its default is the first with the most.
    commands
        The commands that offer it.
    rank
        Its place in lists, the smaller the earlier.
    """

    name: str
    words: str
    law: Law
    inputs: Inputs
    gain: sp.Expr | None = None
    averaged: bool = True
    tables: tuple[str, ...] = ()
    commands: tuple[str, ...] = ("simulate",)
    rank: int = 100
