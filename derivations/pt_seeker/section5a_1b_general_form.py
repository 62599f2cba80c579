"""Section 5, Theorem 2, Step 2: the closed loop in the fast time is a system of the class of Theorem 1."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, claim, eq, every, exact

from . import chain
from .notation import IN_FAST_TIME, k, mu, omega, tau, z
from .section2_averaging import phase
from .section5a_1_reduction import f_tau, fast_time, measured, slow, stretch, y

SECTION = "5.1 Theorem, Steps 1 to 3: the averaged system"

# The fields of the general form as functions of (τ, x, z), with z a variable of its own, and the dithers u(τ, θ).
b0 = tuple(entry / stretch**2 for entry in f_tau)
b1 = (sp.cos(k * z), -sp.sin(k * z))
b2 = (sp.sin(k * z), sp.cos(k * z))
dithered_fields = (b1, b2)
u1, u2 = sp.cos(phase), sp.sin(phase)
g = y - z


def _slow_rates() -> sp.Matrix:
    """μ b₀ + μ√ω Σ bᵢ uᵢ at the slow time μτ̃ and the phase ωμτ̃."""
    dithered = sp.Matrix(b1) * u1 + sp.Matrix(b2) * u2
    return (mu * sp.Matrix(b0) + mu * sp.sqrt(omega) * dithered).subs({tau: slow, phase: omega * slow})


@claim(
    "5/step2-general-form", "The closed loop in the fast time is of the class of Theorem 1",
    every(eq(_slow_rates(), chain.fast_time.vector[:2, 0]), eq(g, chain.fast_time.rhs[2])),
    given=[*IN_FAST_TIME, measured], labels=["eq:tau_pt_system_eps"], place="Step 2", uses=[fast_time],
)  # fmt: skip
def general_form(goal: Goal) -> Evidence:
    """With b₀ = f/(1 + (τ − t₀)/T)², b₁ = (cos kz, −sin kz), b₂ = (sin kz, cos kz), u₁ = cos θ, u₂ = sin θ and g = y −
    z the general form has the rates of the closed loop, while z is still a state. So b₁ and b₂ depend on z alone, b₀
    does not depend on z, and the dithers are functions of the phase alone."""
    return exact(goal)
