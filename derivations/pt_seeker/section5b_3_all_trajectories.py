"""Section 5, Theorem 2, Step 4: the bound of the distance along every trajectory of the average of all starts."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, ForAll, Goal, claim, eq, ge, le, reals, specialise

from . import extended
from .extended import rho
from .notation import E11, E12, E21, E22, E_norm, T, f, t0, tau
from .section3_problem import spectral_norm_squared
from .section5a_6_extended import extended_other_data, rho0, rho_at
from .section5b_0_trajectory import EXAMPLE, X1, X2, assumption_2, at, s, start
from .section5b_0_with_drift import norm_of_E
from .section5b_1_lyapunov import at_order
from .section5b_2_gradient_drift import distance_at, distance_bound_tau, printed_bound

SECTION = "5.2 Theorem, Steps 4 to 6: stability"

factor = sp.Symbol("lambda", positive=True)
entries = (E11, E12, E21, E22)


def scaled(by: sp.Expr) -> dict[sp.Symbol, sp.Expr]:
    """The entries of the drift's matrix, each times a number."""
    return {entry: by * entry for entry in entries}


@claim(
    "5/step4-norm-scales", "‖λE‖ = λ‖E‖",
    eq(sp.sqrt(spectral_norm_squared.subs(scaled(factor), simultaneous=True)), factor * E_norm), given=[norm_of_E],
)  # fmt: skip
def norm_scales(goal: Goal) -> Evidence:
    """The spectral norm of a multiple."""
    return reals(goal)


along = [
    ForAll((s,), eq(sp.Derivative(X(s), s), at(rate.subs(rho, rho_at), s)), (ge(s, t0), le(s, tau)))
    for X, rate in zip((X1, X2), extended.averaged.rhs[:2], strict=True)
]


@claim(
    "5/step4-all-trajectories", "The distance along every trajectory of the average of all starts, from any ρ₀ ≠ 0",
    le(distance_at(tau), printed_bound(distance_at(t0), t0).subs({E_norm: rho0**4 * E_norm, T: T / rho0**2})),
    given=[*along, ge(tau, t0), *at_order(assumption_2, sp.S.One), norm_of_E],
    uses=[distance_bound_tau, extended_other_data, norm_scales], example=EXAMPLE | {rho0: 1},
)  # fmt: skip
def all_trajectories(goal: Goal) -> Evidence:
    """It is a trajectory of the averaged system for the drift ρ₀⁴E and the prescribed time T/ρ₀². So the bound of Step
    4 holds with c₂²‖E‖Tρ₀² in the place of c₂²‖E‖T."""
    pushed = [rho0**4 * entry for entry in extended.pushed]
    values = {
        f[0]: pushed[0], f[1]: pushed[1], **scaled(rho0**4), E_norm: rho0**4 * E_norm, T: T / rho0**2, start: t0
    }  # fmt: skip
    scales = specialise(goal, norm_scales, {factor: rho0**4})
    return reals(goal, *specialise(goal, distance_bound_tau, values, scales), *scales)
