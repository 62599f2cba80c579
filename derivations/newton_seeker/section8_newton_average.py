"""Appendix, Proposition 2: the Newton seeker by fields and powers, and its coefficients."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, claim, eq, every, exact, gt, integrals, le, lt, reals, refute

from . import chain
from .chain import phase
from .notation import J_0, P_RANGE, F_z, alpha, alpha_t, c, d, h, nu, omega, omega_d, p, rotated, t, z
from .section2_preliminaries import double, triple
from .section8_gradient_average import first_coefficient, mean, put_together, second_coefficients

SECTION = "Appendix: Proposition 2, the coefficients"

state = (*rotated, d, nu)
f0 = (*(J_0 * z), omega_d * d, h * (F_z - nu))
f1 = (0, d * (F_z - nu), 0, 0)
f2 = (0, alpha, 0, 0)
f3 = (0, 0, d**2 * 8 * omega_d / alpha**2 * (nu - F_z), 0)
POWERS = (1 - p, p, 2 - 2 * p)
u1, u2, u3 = sp.sin(phase), sp.cos(phase), sp.cos(2 * phase)
gains = {c: omega ** (1 - p), alpha_t: alpha * omega**p}
PLACE = "Appendix, Proposition 2"


@claim(
    "newton/A2-form", "The Newton seeker as drift and fields with powers of ω",
    eq(
        put_together(f0, (f1, POWERS[0], u1), (f2, POWERS[1], u2), (f3, POWERS[2], u3)),
        sp.Matrix(chain.newton_in_z.rhs).subs(gains),
    ),
    given=P_RANGE, place=PLACE,
)  # fmt: skip
def form(goal: Goal) -> Evidence:
    """As in the proof of Proposition 1; ω²/α̃² is ω^(2 − 2p)/α²."""
    return exact(goal)


@claim(
    "newton/A2-powers", "The exponents are between 0 and 1",
    every(*(part for power in POWERS for part in (gt(power, 0), lt(power, 1)))), given=P_RANGE, place=PLACE,
)  # fmt: skip
def powers(goal: Goal) -> Evidence:
    """p > 1/2 is what the third one needs."""
    return reals(goal)


@claim(
    "newton/A2-third-dither", "cos 2ωt has the mean zero over a period",
    eq(mean(u3), 0), labels=["ass:second_order_ass1"],
)  # fmt: skip
def third_dither(goal: Goal) -> Evidence:
    """Over the period 2π of all three dithers in ωt."""
    return integrals(goal)


@claim(
    "newton/A2-third-dither-bounded", "cos 2ωt is at most 1 in absolute value",
    le(sp.Abs(u3.subs(phase, omega * t)), 1), labels=["ass:second_order_ass1"],
)  # fmt: skip
def third_dither_bounded(goal: Goal) -> Evidence:
    """Item 2 of Assumption 1."""
    return reals(goal)


# --- Brackets of two fields ------------------------------------------------------------------------------------------


@claim(
    "newton/A2-first-coefficients", "γ₁₂(ω) = −1/2, γ₁₃(ω) = γ₂₃(ω) = 0",
    every(
        eq(omega**2 / (2 * sp.pi) * double(u2, u1), -sp.Rational(1, 2)),
        eq(omega ** (3 - 3 * p) / (2 * sp.pi) * double(u3, u1), 0),
        eq(omega ** (3 - p) / (2 * sp.pi) * double(u3, u2), 0),
    ),
    place=PLACE, uses=[first_coefficient],
)  # fmt: skip
def first_coefficients(goal: Goal) -> Evidence:
    """The values as printed; the power of ω before the second integral, which is zero, is the subject of the next
    claim."""
    return integrals(goal)


def factor(*places: int, parts: int = 1) -> sp.Expr:
    """ω^(p_i + p_j + …)/(parts T)."""
    return omega ** sum(POWERS[place - 1] for place in places) * omega / (2 * sp.pi * parts)


@claim(
    "newton/A2-factor-13-printed", "The factor before the integral of γ₁₃",
    eq(omega ** (3 - 3 * p) / (2 * sp.pi), factor(1, 3)), given=P_RANGE, place=f"{PLACE}, γ₁₃",
    expected="refuted", grade="misprint",
    wrong="The power of ω in γ₁₃ is printed as 3 − 3p where it is 4 − 3p.",
    survives="Yes: the integral is zero, and so is γ₁₃.",
)  # fmt: skip
def factor_13_printed(goal: Goal) -> Evidence:
    """p₁ + p₃ = 3 − 3p, and 1/T = ω/(2π) has one more ω; in γ₁₂ and γ₂₃ it is there."""
    return refute(goal, {omega: 2, p: sp.Rational(3, 4)})


@claim(
    "newton/A2-factors", "The factors before the integrals of γ₁₂, γ₁₃ and γ₂₃",
    every(
        eq(omega**2 / (2 * sp.pi), factor(1, 2)),
        eq(omega ** (4 - 3 * p) / (2 * sp.pi), factor(1, 3)),
        eq(omega ** (3 - p) / (2 * sp.pi), factor(2, 3)),
    ),
    given=P_RANGE, place=PLACE, corrects=factor_13_printed,
)  # fmt: skip
def factors(goal: Goal) -> Evidence:
    """ω^(p_i + p_j)/T with T = 2π/ω."""
    return exact(goal)


# --- Brackets of three fields ----------------------------------------------------------------------------------------

EIGHTH = sp.Rational(1, 8)
# For each i, j, m the exponent of ω before the integral, and the value, as printed.
TRIPLES = {
    (1, 2, 1): (3 - p, 1 / (2 * omega**p)), (1, 2, 2): (2 + p, sp.S.Zero), (1, 2, 3): (4 - 2 * p, sp.S.Zero),
    (1, 3, 1): (5 - 4 * p, -1 / (8 * omega ** (4 * p - 2))), (1, 3, 2): (4 - 2 * p, sp.S.Zero),
    (1, 3, 3): (6 - 5 * p, sp.S.Zero),
    (2, 3, 1): (4 - 2 * p, sp.S.Zero), (2, 3, 2): (sp.Integer(3), EIGHTH), (2, 3, 3): (5 - 3 * p, sp.S.Zero),
}  # fmt: skip


def _triple(i: int, j: int, m: int) -> sp.Expr:
    waves = (u1, u2, u3)
    return triple(waves[i - 1], waves[j - 1], waves[m - 1])


@claim(
    "newton/A2-second-coefficients", "The nine γ_ijm(ω)",
    every(
        *(eq(omega**exponent / (6 * sp.pi) * _triple(*places), value) for places, (exponent, value) in TRIPLES.items())
    ),
    place=PLACE, uses=[second_coefficients],
)  # fmt: skip
def second_coefficients_newton(goal: Goal) -> Evidence:
    """By antiderivatives that are checked, three times each."""
    return integrals(goal)


@claim(
    "newton/A2-second-factors", "The factors before the integrals of the nine γ_ijm",
    every(
        *(eq(omega**exponent / (6 * sp.pi), factor(*places, parts=3)) for places, (exponent, _) in TRIPLES.items())
    ),
    given=P_RANGE, place=PLACE,
)  # fmt: skip
def second_factors(goal: Goal) -> Evidence:
    """ω^(p_i + p_j + p_m)/(3T)."""
    return exact(goal)


@claim(
    "newton/A2-vanishing-powers", "γ₁₂₁ and γ₁₃₁ have negative powers of ω",
    every(lt(-p, 0), lt(2 - 4 * p, 0)), given=P_RANGE, place=PLACE,
)  # fmt: skip
def vanishing_powers(goal: Goal) -> Evidence:
    """So that they tend to 0 as ω → ∞, and γ₂₃₂ = 1/8 alone is left of the nine. The second needs p > 1/2."""
    return reals(goal)


_found = chain.newton_found.gammas


@claim(
    "newton/A2-derived-coefficients", "All coefficients are those that the averaging of the closed loop finds",
    every(
        eq(-sp.Rational(1, 2), _found[1, 2].mean * omega ** _found[1, 2].exponent),
        eq(0, _found[1, 3].mean), eq(0, _found[2, 3].mean),
        *(eq(value, _found[places].mean * omega ** _found[places].exponent) for places, (_, value) in TRIPLES.items()),
    ),
    given=P_RANGE, place=PLACE, uses=[first_coefficients, second_coefficients_newton],
)  # fmt: skip
def derived_coefficients(goal: Goal) -> Evidence:
    """Printed values against those of the pipeline, which takes its dithers from the closed loop."""
    return exact(goal)
