"""Sections III to VII: what the running text says beside the formulas."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, Smooth, claim, eq, every, exact, gt, integrals, lt, reals, refute, smooth

from . import chain
from .notation import F_z, H, J_n, alpha, alpha_t, d, h, nu, omega, omega_0, omega_d, r, t, z1, z2
from .section4_linear import equilibrium as gradient_equilibrium
from .section4_linear import linearisation as gradient_linearisation
from .section5a_design import average_newton, equilibrium, linearisation
from .section5b_1_coordinates import shifted
from .section8_newton_average import u1, u2, u3

SECTION = "Running text of Sections III to VII"

_near, _far = sp.symbols("s_1 s_2", nonnegative=True)


@claim(
    "newton/3-decays", "The field decays with the distance from the source",
    lt(F_z.subs({z1: _far, z2: 0}), F_z.subs({z1: _near, z2: 0})), given=[lt(_near, _far)], place="Section III",
)  # fmt: skip
def decays(goal: Goal) -> Evidence:
    """By distances s₁ < s₂, on which alone it depends."""
    return reals(goal)


@claim(
    "newton/A2-smooth", "The fields are C³, in d and in ln d",
    Smooth(
        tuple(entry for system in (chain.newton_dithered, chain.logarithmic_dithered)
              for field in (system.plain.drift, *system.plain.fields) for entry in field if entry != 0),
        (*chain.newton_dithered.state, *chain.logarithmic_dithered.state[2:3]), 3,
    ),
    labels=["ass:second_order_ass1"],
)  # fmt: skip
def fields_smooth(goal: Goal) -> Evidence:
    """Item 1 of Assumption 1, for the gradient seeker too, whose fields are these at d = 1. It is printed with
    ℝⁿ × ℝⁿ, where ℝⁿ → ℝⁿ is meant."""
    return smooth(goal)


_T = 2 * sp.pi / omega


def _later(wave: sp.Expr, by: sp.Expr) -> sp.Expr:
    return wave.subs(chain.phase, omega * (t + by))


@claim(
    "newton/A2-period", "T = 2π/ω is a period of all dithers",
    every(*(eq(_later(wave, _T), _later(wave, sp.S.Zero)) for wave in (u1, u2, u3))), place="Appendix",
)  # fmt: skip
def period(goal: Goal) -> Evidence:
    """LCM(1, 1, 1/2) = 1. No shorter one is a period of the first two."""
    return exact(goal)


@claim(
    "newton/4-depends-on-H", "The averaged gradient seeker's linear part depends on H, by −α/2 in one place",
    eq(sp.diff(chain.gradient_averaged.linearization(gradient_equilibrium), H), sp.Matrix(3, 3, lambda i, j: (
        -alpha / 2 if i == j == 1 else 0))),
    place="Section IV", uses=[gradient_linearisation],
)  # fmt: skip
def depends_on_H(goal: Goal) -> Evidence:
    """So that its convergence is governed by H."""
    return exact(goal)


@claim(
    "newton/5-independent-of-H", "The averaged Newton seeker's linear part does not depend on H",
    eq(sp.diff(chain.newton_averaged.linearization(equilibrium), H), sp.zeros(4, 4)), place="Section V.A",
    uses=[linearisation],
)  # fmt: skip
def independent_of_H(goal: Goal) -> Evidence:
    """This is the rate at the source. How long d takes to come to 1/H depends on H: newton/6-half-way."""
    return exact(goal)


_plane = [[J_n[i, j] for j in (0, 1, 3)] for i in (0, 1, 3)]


@claim(
    "newton/5-linearised-printed", "The rows of J_n but for d are the averaged gradient seeker, linearised",
    eq(sp.Matrix(_plane), chain.gradient_averaged.linearization(gradient_equilibrium)), place="Section V.A",
    labels=["eq:newton_seeker_lin"], expected="refuted", grade="wording",
    wrong="J_n is said to come from the averaged gradient seeker, which has no d, and H in its linear part.",
    survives="Yes: J_n is the averaged Newton seeker linearised, to whose equilibrium the sentence refers.",
)  # fmt: skip
def linearised_printed(goal: Goal) -> Evidence:
    """At H = 2 the entries −α/2 and −αH/2 differ."""
    return refute(goal, {H: 2, alpha: 1, omega_0: 1, h: 1})


@claim(
    "newton/5-linearised", "They are the averaged Newton seeker, linearised",
    eq(sp.Matrix(_plane), chain.newton_averaged.linearization(equilibrium).extract([0, 1, 3], [0, 1, 3])),
    place="Section V.A", labels=["eq:newton_seeker_lin"], uses=[linearisation], corrects=linearised_printed,
)  # fmt: skip
def linearised(goal: Goal) -> Evidence:
    """The same entries."""
    return exact(goal)


_swung = F_z.subs(z2, z2 + alpha_t / omega * sp.sin(omega * t))


@claim(
    "newton/5-hessian-estimate", "The filtered signal times cos 2ωt is, on average, an estimate of the Hessian",
    eq(
        sp.Integral(8 * omega**2 / alpha_t**2 * (_swung - nu) * sp.cos(2 * omega * t), (t, 0, _T)) / _T,
        H,
    ),
    place="Section V.A",
)  # fmt: skip
def hessian_estimate(goal: Goal) -> Evidence:
    """With α̃ cos ωt the position swings by (α̃/ω) sin ωt, and F by a multiple of sin² ωt. The mean is H exactly."""
    return integrals(goal)


@claim(
    "newton/5-zero-unstable", "d̄ = 0 is an equilibrium of the averaged Riccati filter, and unstable",
    every(
        eq(chain.newton_averaged.rhs[2].subs(d, 0), 0),
        eq(sp.diff(chain.newton_averaged.rhs[2], d).subs(d, 0), omega_d), gt(omega_d, 0),
    ),
    place="Section V.B, Step 1", uses=[average_newton],
)  # fmt: skip
def zero_unstable(goal: Goal) -> Evidence:
    """So that no global stability can be shown in d, and ln d is needed."""
    return reals(goal)


@claim(
    "newton/5-cascade-structure", "The subsystem (z̄, d̂) does not depend on r, and that of d̂ not on z̄",
    every(
        eq(sp.diff(sp.Matrix(chain.shifted.rhs[:3]), r), sp.zeros(3, 1)),
        eq(sp.Matrix([sp.diff(chain.shifted.rhs[2], symbol) for symbol in (z1, z2)]), sp.zeros(2, 1)),
    ),
    place="Section V.B, Step 3", uses=[shifted],
)  # fmt: skip
def cascade_structure(goal: Goal) -> Evidence:
    """The form that the theorem on cascades asks for."""
    return exact(goal)


_rate, _lambda = sp.Symbol("rho", positive=True), sp.Symbol("lambda", real=True)
CHOICE = {alpha: 4 * _rate, omega_0: _rate, omega_d: _rate, h: _rate}


@claim(
    "newton/7-rate-assigned", "The convergence rate can be assigned by a choice of the gains",
    eq(
        (_lambda * sp.eye(4) - chain.newton_averaged.linearization(equilibrium).subs(CHOICE)).det(method="berkowitz"),
        (_lambda + _rate) ** 4,
    ),
    place="Section VII", uses=[linearisation],
)  # fmt: skip
def rate_assigned(goal: Goal) -> Evidence:
    """With α = 4ρ and ω₀ = ω_d = h = ρ all four eigenvalues are −ρ, whatever H is."""
    return exact(goal)
