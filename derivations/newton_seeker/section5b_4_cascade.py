"""Section V.B, Steps 3 to 5: input-to-state stability of r, the cascade, and the Theorem."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    Goal,
    Prose,
    cited,
    claim,
    eq,
    every,
    exact,
    exp_monotone,
    ge,
    gt,
    le,
    limits,
    lt,
    reals,
    refute,
)

from . import chain
from .notation import J_0, H, Lambda_t, alpha, d_h, d_plus, d_t, h, letter, omega_0, r, z1, z2
from .section4_gradient import rotation_undone
from .section5a_design import in_z
from .section5b_1_coordinates import average_in_logarithm, equilibrium_of_average, in_logarithm, shifted
from .section5b_3_decrease import subsystem_stable
from .section8_gradient_average import bounded, means
from .section8_newton_average import powers, third_dither, third_dither_bounded
from .section8_newton_conditions import pairs, quadruples_logarithm, triple_integrals, triples

SECTION = "V.B Newton-based source seeking: analysis, Steps 3 to 5"
STEP_3, STEP_4, STEP_5 = (f"Section V.B, Step {number}" for number in (3, 4, 5))

# Assumptions 1 and 2 for the closed loop in z and d̃.
CONDITIONS = (
    powers, means, bounded, third_dither, third_dither_bounded, pairs, triples, triple_integrals, quadruples_logarithm,
)  # fmt: skip

R = letter("R", r"|\bar{z}|", "m", "norm of z̄", nonnegative=True)
g = letter("g", "|g|", "1", "norm of g = (z̄, d̂)", nonnegative=True)
norm_J0 = letter("norm_J0", r"\|J_0\|", "1/s", "norm of J₀", nonnegative=True)
norm_L = letter("norm_L", r"\|\tilde{\Lambda}\|", "1/s", "norm of Λ̃", nonnegative=True)
r_dot = chain.shifted.rhs[3]
is_R, is_g = eq(R**2, z1**2 + z2**2), eq(g**2, R**2 + d_h**2)
NORMS = [eq(norm_J0, omega_0), eq(norm_L, alpha / 2)]


@claim(
    "newton/5-norms", "‖J₀‖ = ω₀ and ‖Λ̃‖ = α/2",
    every(eq(J_0.T * J_0, omega_0**2 * sp.eye(2)), eq(Lambda_t.T * Lambda_t, sp.diag(0, (alpha / 2) ** 2))),
    place=STEP_3,
)  # fmt: skip
def norms(goal: Goal) -> Evidence:
    """The squares of the norms are the greatest eigenvalues of these."""
    return exact(goal)


def supply(size: sp.Expr, exponent: sp.Expr) -> sp.Expr:
    """H s² (‖J₀‖ + e^… ‖Λ̃‖), the input of the filter's error."""
    return H * size**2 * (norm_J0 + sp.exp(exponent) * norm_L)


@claim(
    "newton/5-iss-printed", "dr/dt ≤ −h|r| + H‖z̄‖²(‖J₀‖ + e^d̂ ‖Λ̃‖)",
    le(r_dot, -h * sp.Abs(r) + supply(R, d_h)), given=[is_R, *NORMS], place=f"{STEP_3}, dr/dt", uses=[shifted, norms],
    expected="refuted", grade="misprint", wrong="For r < 0 it is −hr = h|r| that stands in dr/dt; d|r|/dt is meant.",
    survives="Yes: the inequality holds for d|r|/dt, which is what input-to-state stability needs.",
)  # fmt: skip
def iss_printed(goal: Goal) -> Evidence:
    """At z̄ = 0 and r = −1 it says h ≤ −h. It is printed with ‖z‖ for ‖z̄‖."""
    return refute(goal, {r: -1, z1: 0, z2: 0, R: 0, d_h: 0, h: 1, H: 1, alpha: 2, omega_0: 1, norm_J0: 1, norm_L: 1})


@claim(
    "newton/5-iss-first", "d|r|/dt ≤ −h|r| + H‖z̄‖²(‖J₀‖ + e^d̂ ‖Λ̃‖)",
    le(r * r_dot, sp.Abs(r) * (-h * sp.Abs(r) + supply(R, d_h))), given=[is_R, *NORMS], place=STEP_3,
    uses=[shifted, norms], corrects=iss_printed,
)  # fmt: skip
def iss_first(goal: Goal) -> Evidence:
    """Both sides times |r|: r dr/dt is |r| d|r|/dt where r is not 0. z̄ᵀJ₀z̄ is 0, and z₂² ≤ ‖z̄‖²."""
    return reals(goal)


size, fall = R + sp.Abs(d_h), -h * sp.Abs(r)


@claim(
    "newton/5-iss-second", "H‖z̄‖²(‖J₀‖ + e^d̂ ‖Λ̃‖) ≤ H(‖z̄‖ + |d̂|)²(‖J₀‖ + e^(‖z̄‖ + |d̂|) ‖Λ̃‖)",
    le(fall + supply(R, d_h), fall + supply(size, size)), place=STEP_3,
)  # fmt: skip
def iss_second(goal: Goal) -> Evidence:
    """Both factors grow; −h|r| stands on both sides."""
    return reals(goal, exp_monotone(d_h, size))


@claim("newton/5-iss-sum", "‖z̄‖ + |d̂| ≤ 2|g|", le(size, 2 * g), given=[is_g], place=STEP_3)
def iss_sum(goal: Goal) -> Evidence:
    """Neither is greater than |g|."""
    return reals(goal)


@claim(
    "newton/5-iss-third", "H(‖z̄‖ + |d̂|)²(‖J₀‖ + e^(‖z̄‖ + |d̂|) ‖Λ̃‖) ≤ H(2|g|)²(‖J₀‖ + e^(2|g|) ‖Λ̃‖)",
    le(fall + supply(size, size), fall + supply(2 * g, 2 * g)), given=[is_g], place=STEP_3, uses=[iss_sum],
)  # fmt: skip
def iss_third(goal: Goal) -> Evidence:
    """Both factors grow."""
    return reals(goal, exp_monotone(size, 2 * g))


_s, _more = sp.symbols("s s_more", nonnegative=True)


def rho_2(value: sp.Expr) -> sp.Expr:
    """ρ₂(s) = H(2s)²(‖J₀‖ + e^(2s) ‖Λ̃‖); ρ₁(s) = hs."""
    return supply(2 * value, 2 * value)


@claim(
    "newton/5-iss-last", "−h|r| + H(2|g|)²(‖J₀‖ + e^(2|g|) ‖Λ̃‖) ≤ −ρ₁(|r|) + ρ₂(|g|)",
    le(fall + supply(2 * g, 2 * g), -(h * sp.Abs(r)) + rho_2(g)), place=STEP_3,
)  # fmt: skip
def iss_last(goal: Goal) -> Evidence:
    """The two functions are not printed; with these it is an equality."""
    return reals(goal)


@claim(
    "newton/5-class-k", "ρ₁ and ρ₂ are 0 at 0 and increase",
    every(
        eq(h * 0, 0), eq(rho_2(sp.S.Zero), 0), lt(h * _s, h * _more), lt(rho_2(_s), rho_2(_more)),
    ),
    given=[lt(_s, _more), *NORMS], place=STEP_3, uses=[norms],
)  # fmt: skip
def class_k(goal: Goal) -> Evidence:
    """With ρ₁(s) = hs and ρ₂(s) = H(2s)²(‖J₀‖ + e^(2s) ‖Λ̃‖); ‖J₀‖ = ω₀ is positive."""
    return reals(goal, exp_monotone(2 * _s, 2 * _more))


_far = sp.Symbol("s", positive=True)


@claim(
    "newton/5-rho-2-below", "ρ₂(s) is not less than H(2s)²ω₀", ge(rho_2(_far), H * (2 * _far) ** 2 * omega_0),
    given=NORMS, place=STEP_3, uses=[norms],
)  # fmt: skip
def rho_2_below(goal: Goal) -> Evidence:
    """The exponential is positive."""
    return reals(goal)


@claim(
    "newton/5-class-k-infinity", "ρ₁ and ρ₂ have no bound",
    every(
        eq(sp.Limit(h * _far, _far, sp.oo), sp.oo),
        eq(sp.Limit(H * (2 * _far) ** 2 * omega_0, _far, sp.oo), sp.oo),
    ),
    place=STEP_3, uses=[rho_2_below],
)  # fmt: skip
def class_k_infinity(goal: Goal) -> Evidence:
    """Of ρ₂ it is the bound from below."""
    return limits(goal)


iss = claim(
    "newton/5-iss", "The equation of r is input-to-state stable with respect to g = (z̄, d̂)",
    Prose("d|r|/dt is bounded by −ρ₁(|r|) + ρ₂(|g|) with ρ₁ and ρ₂ of class K∞"),
    uses=[iss_first, iss_second, iss_third, iss_last, class_k, class_k_infinity], place=STEP_3, expected="cited",
)(cited("M. Krstić, I. Kanellakopoulos, P. Kokotović, Nonlinear and Adaptive Control Design, Theorem C.3"))  # fmt: skip

cascade = claim(
    "newton/5-cascade", "The origin of the averaged system is globally uniformly asymptotically stable",
    Prose("An input-to-state stable system driven by one whose origin is globally uniformly asymptotically stable"),
    uses=[subsystem_stable, iss], labels=["eq:LBS_newton_seeker_exp_origin"], expected="cited",
)(cited("H. Khalil, Nonlinear Systems, 3rd edition, Lemma 4.7"))  # fmt: skip

practical = claim(
    "newton/5-practical", "The point z = 0, d̃ = ln(1/H), ν = F* is sGPUAS for the closed loop in z and d̃, for p > 5/8",
    Prose("Lemma 1: a GUAS average makes the system practically so, under Assumptions 1 and 2"),
    uses=[cascade, in_logarithm, average_in_logarithm, equilibrium_of_average, *CONDITIONS],
    labels=["lemma:sGPUAS"], place=STEP_4, expected="cited",
)(cited("C. Labar, E. Garone, M. Kinnaert, C. Ebenbauer, Automatica 106 (2019), Lemma 3"))  # fmt: skip


@claim(
    "newton/5-back", "d = e^d̃ is 1/H at d̃ = ln(1/H), and positive for all d̃",
    every(eq(sp.exp(sp.log(1 / H)), 1 / H), gt(sp.exp(d_t), 0), eq(sp.exp(sp.log(d_plus)), d_plus)), place=STEP_5,
)  # fmt: skip
def back(goal: Goal) -> Evidence:
    """All of d > 0 is reached."""
    return reals(goal)


theorem = claim(
    "newton/5-theorem", "Theorem 1: x*, 1/H, F* is sGPUAS for the Newton seeker on d > 0, for p > 5/8",
    Prose("The stability of the last step in the coordinates x, d and ν"),
    uses=[practical, back, rotation_undone, in_z], labels=["thm:newton_ss_theorem"], expected="cited",
)(cited("the definition of sGPUAS in other coordinates: |z| = |x − x*|, and ln d is near ln(1/H) where d is near "
        "1/H; no engine speaks of sGPUAS"))  # fmt: skip
