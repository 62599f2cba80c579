"""The asymptotic seeker (eq:exponential_seeker), which arrives as t → ∞."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy as sp

from ptproof.problem.drift import Drift
from ptproof.problem.model import TIME
from ptproof.problem.seekers.seeker import TUNED, Letters, Seeker, feedback, letters, unicycle
from ptproof.system import System


def asymptotic_seeker(
    field: sp.Expr, drift: Drift | Sequence[sp.Expr], *, k: sp.Expr, omega: sp.Expr, mu: sp.Expr,
    time: sp.Symbol, gain: sp.Expr = sp.S.One, states: Letters | None = None,
) -> System:  # fmt: skip
    """The asymptotic seeker (eq:exponential_seeker); another ``gain`` than 1 speeds it up.

    The closed loop in ``time``, states (x₁, x₂, θ, z).
    """
    states = states or letters()
    law = feedback(field, states.filter, k, omega, mu, gain)
    return unicycle(time, drift, law, states, "asymptotic seeker")


def loop(field: sp.Expr, drift: Drift | Sequence[sp.Expr], gain: sp.Expr, states: Letters) -> System:
    """Its closed loop with the gain K in the letters of a problem."""
    return asymptotic_seeker(field, drift, **TUNED, time=TIME, gain=gain, states=states)


def inputs(field: sp.Expr, gain: sp.Expr, states: Letters) -> Mapping[str, sp.Expr]:
    """Forward and angular velocity."""
    law = feedback(field, states.filter, **TUNED, gain=gain)
    return {"u1": law.forward, "u2": law.angular}


SEEKER = Seeker("asymptotic", "arrives as t tends to infinity", loop, inputs, gain=sp.S.One, rank=2)
