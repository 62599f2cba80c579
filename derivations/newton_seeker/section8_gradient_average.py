"""Appendix, Proposition 1: the gradient seeker by fields and powers, coefficients and brackets."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import Evidence, Goal, claim, definition, eq, every, exact, gt, integrals, le, lt, reals
from ptproof.system import lie_bracket

from . import chain
from .chain import phase
from .notation import J_0, P_RANGE, F_z, H, alpha, alpha_t, c, h, nu, omega, p, rotated, t, z, z2
from .section2_preliminaries import along, double, triple

SECTION = "Appendix: Proposition 1"

state = (*rotated, nu)
f0 = (*(J_0 * z), h * (F_z - nu))
f1 = (0, F_z - nu, 0)
f2 = (0, alpha, 0)
POWERS = (1 - p, p)
sine, cosine = sp.sin(phase), sp.cos(phase)
gains = {c: omega ** (1 - p), alpha_t: alpha * omega**p}
gains_by_powers = definition(
    "newton/A-gains", "The gains by powers of the frequency: c = ω^(1 − p), α̃ = αω^p",
    every(*(eq(letter, value) for letter, value in gains.items())), labels=["prop:average_gradient_seeker"],
    prose="With p between 1/2 and 1, in both Propositions and in the Theorem.",
)  # fmt: skip


def put_together(drift: sp.Matrix, *parts: tuple[tuple[sp.Expr, ...], sp.Expr, sp.Expr]) -> sp.Matrix:
    """f₀ + Σ f_i ω^(p_i) u_i(ωt)."""
    waves = (sp.Matrix(field) * omega**power * wave.subs(phase, omega * t) for field, power, wave in parts)
    return sum(waves, sp.Matrix(drift))


@claim(
    "newton/A1-form", "The gradient seeker as drift and fields with powers of ω",
    eq(
        put_together(f0, (f1, POWERS[0], sine), (f2, POWERS[1], cosine)),
        sp.Matrix(chain.gradient_in_z.rhs).subs(gains),
    ),
    given=P_RANGE, place="Appendix, Proposition 1",
)  # fmt: skip
def form(goal: Goal) -> Evidence:
    """The fields over the braces, put together again, are the closed loop in z with c = ω^(1 − p) and α̃ = αω^p."""
    return exact(goal)


@claim(
    "newton/A1-powers", "The exponents are between 0 and 1",
    every(*(part for power in POWERS for part in (gt(power, 0), lt(power, 1)))), given=P_RANGE,
    place="Appendix, Proposition 1",
)  # fmt: skip
def powers(goal: Goal) -> Evidence:
    """As the general system asks for."""
    return reals(goal)


def mean(wave: sp.Expr) -> sp.Expr:
    """∫₀^{2π} u(t) dt."""
    return sp.Integral(wave.subs(phase, t), (t, 0, 2 * sp.pi))


@claim(
    "newton/A1-means", "The dithers have the mean zero over a period", every(eq(mean(sine), 0), eq(mean(cosine), 0)),
    labels=["ass:second_order_ass1"],
)  # fmt: skip
def means(goal: Goal) -> Evidence:
    """Item 3 of Assumption 1; the period 2π is seen."""
    return integrals(goal)


@claim(
    "newton/A1-bounded", "The dithers are at most 1 in absolute value",
    every(*(le(sp.Abs(wave.subs(phase, omega * t)), 1) for wave in (sine, cosine))), labels=["ass:second_order_ass1"],
)  # fmt: skip
def bounded(goal: Goal) -> Evidence:
    """Item 2 of Assumption 1."""
    return reals(goal)


@claim(
    "newton/A1-first-coefficient", "γ₁₂(ω) = −1/2",
    eq(omega**2 / (2 * sp.pi) * double(cosine, sine), -sp.Rational(1, 2)), place="Appendix, Proposition 1",
)  # fmt: skip
def first_coefficient(goal: Goal) -> Evidence:
    """The sum of the two exponents is 1, and 1/T has another ω."""
    return integrals(goal)


bracket_12 = (0, alpha * H * z2, 0)
bracket_121 = (0, alpha * H * (nu - F_z) - alpha * H**2 * z2**2, 0)


@claim(
    "newton/A1-first-bracket", "[f₁, f₂]", eq(sp.Matrix(bracket_12), sp.Matrix(lie_bracket(f1, f2, state))),
    place="Appendix, Proposition 1",
)  # fmt: skip
def first_bracket(goal: Goal) -> Evidence:
    """By the definition of the Notation."""
    return exact(goal)


@claim(
    "newton/A1-second-coefficients", "γ₁₂₁(ω) and γ₁₂₂(ω)",
    every(
        eq(omega ** (3 - p) / (6 * sp.pi) * triple(sine, cosine, sine), 1 / (2 * omega**p)),
        eq(omega ** (2 + p) / (6 * sp.pi) * triple(sine, cosine, cosine), 0),
    ),
    place="Appendix, Proposition 1",
)  # fmt: skip
def second_coefficients(goal: Goal) -> Evidence:
    """With the factor 1/(3T) = ω/(6π)."""
    return integrals(goal)


@claim(
    "newton/A1-second-bracket", "[[f₁, f₂], f₁]",
    eq(sp.Matrix(bracket_121), sp.Matrix(lie_bracket(lie_bracket(f1, f2, state), f1, state))),
    place="Appendix, Proposition 1", uses=[first_bracket],
)  # fmt: skip
def second_bracket(goal: Goal) -> Evidence:
    """It counts for nothing in the limit: γ₁₂₁ tends to 0."""
    return exact(goal)


@claim(
    "newton/A1-condition-on-pairs", "Assumption 2 for two fields: only [f₂, f₂] is asked to vanish",
    every(le(2 * (1 - p), 1), le((1 - p) + p, 1), eq(lie_bracket(f2, f2, state)[1], 0)),
    given=P_RANGE, labels=["ass:second_order_ass2"],
)  # fmt: skip
def pairs(goal: Goal) -> Evidence:
    """p₂ + p₂ > 1 is the only sum of two exponents that is greater than 1."""
    return reals(goal)


@claim(
    "newton/A1-condition-on-triples", "Assumption 2 for three fields: only brackets that begin with [f₂, f₂] are asked",
    every(le(3 * (1 - p), 2), le(2 * (1 - p) + p, 2), le((1 - p) + 2 * p, 2)),
    given=P_RANGE, labels=["ass:second_order_ass2"],
)  # fmt: skip
def triples(goal: Goal) -> Evidence:
    """All other sums of three exponents are at most 2."""
    return reals(goal)


@claim(
    "newton/A1-condition-on-quadruples", "Assumption 2 for four fields holds for the gradient seeker",
    every(
        *(lt(n * (1 - p) + (4 - n) * p, 3) for n in range(1, 5)),
        *(eq(entry, 0) for entry in along([f2, f2, f2, f2], state)),
    ),
    given=P_RANGE, labels=["ass:second_order_ass2"],
)  # fmt: skip
def quadruples(goal: Goal) -> Evidence:
    """Four exponents add up to 3 or more only where all are p₂, and f₂ is constant."""
    return reals(goal)
