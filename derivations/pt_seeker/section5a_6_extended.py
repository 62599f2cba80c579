"""Section 5, Theorem 2: the autonomous system of all starts meets Assumption 1 on all of ℝ, and its average."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, Smooth, claim, eq, every, exact, gt, le, reals, smooth
from ptproof.system import lie_bracket

from . import chain, extended
from .extended import pushed, rho, sigma, sigma_fast
from .notation import IN_TAU, E, F, T, f, k, mu, omega, position, t, t0, tau, z
from .section5a_2_averaging import averaged_system
from .section5a_3_uniformity import damping, drift_factor, one_system
from .section5a_bounds import assumption_b_drift_printed

SECTION = "5.1 Theorem, Steps 1 to 3: one system for all starts"

slow_state = (*position, rho)
b0 = (rho**4 * pushed[0], rho**4 * pushed[1], -(rho**3) / (2 * T))
b1 = (sp.cos(k * z), -sp.sin(k * z), 0)
b2 = (sp.sin(k * z), sp.cos(k * z), 0)
slow = mu * sigma_fast


_dithered = sp.Matrix(b1[:2]) * sp.cos(omega * slow) + sp.Matrix(b2[:2]) * sp.sin(omega * slow)


@claim(
    "5/extended-fields", "The system of all starts is of the class of Theorem 1, and its fields do not depend on time",
    eq(mu * sp.Matrix(b0[:2]) + mu * sp.sqrt(omega) * _dithered, extended.fast_time.vector[:2, 0]),
    uses=[one_system],
)  # fmt: skip
def extended_fields(goal: Goal) -> Evidence:
    """Three slow states x₁, x₂, ρ, and the dithers cos and sin as before. b₁ and b₂ have no component along ρ, whose
    rate is μ times the third component of b₀."""
    return exact(goal)


# The drift as a field in C², as Assumption 3 has it; F alone is in C² by Assumption 2.
steady = tuple(entry.subs(t, 0) for entry in f)


@claim(
    "5/extended-smooth", "Assumption 1A on all of ℝ: its fields are twice continuously differentiable",
    Smooth(
        (rho**4 * steady[0], rho**4 * steady[1], b0[2], *b1[:2], *b2[:2]), (sigma, *slow_state, z), 2,
        tuple((entry, 2) for entry in steady),
    ),
    place="Assumption 1A", uses=[extended_fields], corrects=assumption_b_drift_printed,
)  # fmt: skip
def extended_smooth(goal: Goal) -> Evidence:
    """With a drift in C², as Assumption 3 has it. As the fields do not depend on time, continuous derivatives are
    bounded on compact sets for all τ in ℝ, which is 1B with A₂ = A₄ = A₆ = 0: b₀'s pole before t₀ is gone."""
    return smooth(goal)


_composed = lie_bracket(extended.dithered.fields[0], extended.dithered.fields[1], slow_state)


@claim(
    "5/extended-bracket", "The bracket of its composed fields is k∇F",
    eq(k * chain.gradient_F, sp.Matrix(_composed[:2])),
    uses=[extended_fields],
)  # fmt: skip
def extended_bracket(goal: Goal) -> Evidence:
    """In position; they have no third component and do not depend on ρ, so the bracket has none."""
    return exact(goal)


@claim(
    "5/extended-bracket-smooth", "Assumption 1B: the derivatives of its bracket are continuous",
    Smooth(tuple(k * chain.gradient_F), (sigma, *slow_state, z), 1, ((F, 2),)), place="Assumption 1B",
    uses=[extended_bracket],
)  # fmt: skip
def extended_bracket_smooth(goal: Goal) -> Evidence:
    """k∇F is in C¹ because F is in C², so A₅ exists on each compact set."""
    return smooth(goal)


@claim(
    "5/extended-average", "The average of the system of all starts",
    eq(
        rho**4 * E * chain.gradient_F + k / 2 * chain.gradient_F, extended.averaged.vector[:2, 0],
    ),
    uses=[extended_bracket],
)  # fmt: skip
def extended_average(goal: Goal) -> Evidence:
    """ρ⁴E∇F + (k/2)∇F from the pipeline, beside dρ/dτ = −ρ³/(2T), in which nothing is averaged; autonomous."""
    return exact(goal)


_drifted = dict(zip((entry.func for entry in f), pushed, strict=True))


@claim(
    "5/extended-average-is-the-average", "Along the seeker's ρ it is the averaged system with f = E∇F",
    eq(
        extended.averaged.vector[:2, 0].subs(rho, damping),
        chain.averaged_tau.vector.replace(
            lambda node: isinstance(node, sp.Function) and node.func in _drifted, lambda node: _drifted[node.func]
        ),
    ),
    given=IN_TAU, labels=["eq:lie_bracket_system_real"],
    uses=[extended_average, averaged_system, drift_factor],
)  # fmt: skip
def extended_is_averaged(goal: Goal) -> Evidence:
    """Nothing else was averaged: eq:lie_bracket_system_real is the part of the new average that starts at ρ = 1."""
    return exact(goal)


# --- From any ρ -------------------------------------------------------------------------------------------------------

rho0 = sp.Symbol("rho_0", real=True, nonzero=True)
rho_at = rho0 / sp.sqrt(1 + rho0**2 * (tau - t0) / T)


@claim(
    "5/extended-rho", "ρ from any start: the solution, and that it never grows",
    every(
        eq(sp.Derivative(rho_at, tau), -(rho_at**3) / (2 * T)), eq(sp.Subs(rho_at, tau, t0), rho0),
        eq(sp.Subs(rho**2 * (1 + rho0**2 * (tau - t0) / T), rho, rho_at), rho0**2),
        le(rho_at**2, rho0**2), gt(rho_at**2, 0),
    ),
    given=IN_TAU, uses=[extended_average],
)  # fmt: skip
def extended_rho(goal: Goal) -> Evidence:
    """ρ(τ) = ρ₀/√(1 + ρ₀²(τ − t₀)/T); from ρ₀ = 0 it stays 0."""
    return reals(goal)


@claim(
    "5/extended-other-data", "From ρ₀ it is the averaged system for the drift ρ₀⁴E and the prescribed time T/ρ₀²",
    eq(
        extended.averaged.vector[:2, 0].subs(rho, rho_at),
        rho0**4 * E * chain.gradient_F / (1 + (tau - t0) / (T / rho0**2)) ** 2 + k / 2 * chain.gradient_F,
    ),
    given=IN_TAU, uses=[extended_rho],
)  # fmt: skip
def extended_other_data(goal: Goal) -> Evidence:
    """So what Step 4 shows for all E and T says what the new average does from every start."""
    return exact(goal)


extended_assumptions = (extended_fields, extended_smooth, extended_bracket_smooth)
