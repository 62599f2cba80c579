"""Assumption 2 for the Newton seeker, in d and in ln d, for the exponents that the Propositions allow."""

from __future__ import annotations

import itertools
from collections import Counter

import sympy as sp

from ptproof.proof import Evidence, Goal, Relation, claim, eq, every, ge, gt, integrals, le, lt, reals, refute

from .chain import logarithmic_dithered
from .notation import P_RANGE, F_star, H, alpha, d, d_t, nu, omega_d, p, z1, z2
from .section2_preliminaries import along, double
from .section8_newton_average import POWERS, TRIPLES, _triple, f1, f2, f3, state, u1, u2, u3

SECTION = "Appendix: Assumption 2 for the Newton seeker"

FIELDS = (f1, f2, f3)


def total(places: tuple[int, ...]) -> sp.Expr:
    """The sum of the exponents of these fields."""
    return sp.expand(sum(POWERS[place - 1] for place in places))


@claim(
    "newton/A2-condition-on-pairs", "Assumption 2 for two fields: the integrals are zero where they have to be",
    every(eq(double(u3, u1), 0), eq(double(u1, u3), 0), eq(double(u3, u2), 0), eq(double(u2, u3), 0)),
    labels=["ass:second_order_ass2"],
)  # fmt: skip
def pairs(goal: Goal) -> Evidence:
    """p₁ + p₂ = 1; the other two sums may be greater. The bracket of a field with itself is zero."""
    return integrals(goal)


# Brackets of three fields whose coefficient is not zero: their exponents never add up to more than 2.
_counting = [places for places, (_, value) in TRIPLES.items() if value != 0]


@claim(
    "newton/A2-condition-on-triples", "Assumption 2 for three fields: no integral that is not zero is asked to be",
    every(*(le(total(places), 2) for places in _counting)), given=P_RANGE, labels=["ass:second_order_ass2"],
)  # fmt: skip
def triples(goal: Goal) -> Evidence:
    """The integrals of γ₁₂₁, γ₁₃₁ and γ₂₃₂; in the last the sum is 2 exactly."""
    return reals(goal)


@claim(
    "newton/A2-condition-on-triples-integrals", "Assumption 2 for three fields: the integrals that are zero",
    every(*(eq(_triple(*places), 0) for places, (_, value) in TRIPLES.items() if value == 0)),
    labels=["ass:second_order_ass2"],
)  # fmt: skip
def triple_integrals(goal: Goal) -> Evidence:
    """All others of the nine, with the limit τ in the middle integral."""
    return integrals(goal)


_third = along([f3, f3, f3, f3], state)[2]
_third_logarithmic = along([logarithmic_dithered.plain.fields[2]] * 4, logarithmic_dithered.state)[2]
_four = 4 * POWERS[2]
WITNESS = {p: sp.Rational(61, 100), F_star: 0, H: 1, alpha: 1, omega_d: 1, nu: 1, z1: 0, z2: 0}


@claim(
    "newton/A2-condition-on-quadruples-printed", "Assumption 2 for four fields: the derivative of f₃ along f₃ vanishes",
    eq(_third, 0), given=[*P_RANGE, ge(_four, 3)], labels=["ass:second_order_ass2", "prop:average_newton_seeker"],
    expected="refuted", grade="hypothesis",
    wrong="For p ≤ 5/8 the last condition of Assumption 2 does not hold: four times p₃ is 3 or more, and the third "
    "derivative of f₃ along itself is not zero. Section VI has p = 0.61.",
    survives="Yes for the averaged system, which is derived for all p between 1/2 and 1 without Assumption 2; the "
    "quoted theorem applies as it stands only for p > 5/8.",
)  # fmt: skip
def quadruples_printed(goal: Goal) -> Evidence:
    """f₃ is d² times a constant κ in its own direction, and its third derivative along itself is 24 κ⁴ d⁵."""
    return refute(goal, {**WITNESS, d: 1})


@claim(
    "newton/A2-condition-on-quadruples-logarithm-printed",
    "Assumption 2 for four fields: in ln d the derivative of f₃ along f₃ vanishes",
    eq(_third_logarithmic, 0), given=[*P_RANGE, ge(_four, 3)],
    labels=["ass:second_order_ass2", "thm:newton_ss_theorem"], expected="refuted", grade="hypothesis",
    wrong="For p ≤ 5/8 the last condition of Assumption 2 fails in the coordinate ln d as well.",
    survives="As for the seeker in d: the averaged system does, and for p > 5/8 so does the Theorem's use of Lemma 1.",
)  # fmt: skip
def quadruples_logarithm_printed(goal: Goal) -> Evidence:
    """The system to which the proof of the Theorem applies Lemma 1. Each derivative of e^d̃ is e^d̃ again."""
    return refute(goal, {**WITNESS, d_t: 0})


_words = [
    tuple(sorted(word.elements())) for word in map(Counter, itertools.combinations_with_replacement((1, 2, 3), 4))
]
_large = (gt(p, sp.Rational(5, 8)), lt(p, 1))


def _less(bound: sp.Expr) -> list[Relation]:
    return [lt(total(word), bound) for word in _words if word != (2, 2, 2, 2)]


@claim(
    "newton/A2-condition-on-quadruples", "For 5/8 < p < 1 Assumption 2 for four fields holds",
    every(*_less(sp.Integer(3)), *(eq(entry, 0) for entry in along([f2, f2, f2, f2], state))),
    given=_large, labels=["ass:second_order_ass2"], corrects=quadruples_printed,
)  # fmt: skip
def quadruples(goal: Goal) -> Evidence:
    """Of all choices of four exponents only four times p₂ may add up to 3, and f₂ is constant."""
    return reals(goal)


@claim(
    "newton/A2-condition-on-quadruples-logarithm", "For 5/8 < p < 1 Assumption 2 for four fields holds in ln d",
    every(
        *_less(sp.Integer(3)),
        *(eq(entry, 0) for entry in along([logarithmic_dithered.plain.fields[1]] * 4, logarithmic_dithered.state)),
    ),
    given=_large, labels=["ass:second_order_ass2"], corrects=quadruples_logarithm_printed,
)  # fmt: skip
def quadruples_logarithm(goal: Goal) -> Evidence:
    """The exponents are the same, and f₂ is."""
    return reals(goal)
