"""Facts of real analysis that a proof may use, each an implication that holds for all real values.

A lemma is named in the proof with the terms that it is used for; z3 has to establish its hypotheses itself.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from ptproof.proof.facts import lemma
from ptproof.proof.statement import Implication, Relation, eq, ge, gt, le, lt


@lemma
def power_monotone(lower: sp.Expr, upper: sp.Expr, exponent: sp.Expr) -> Implication:
    """0 ≤ a ≤ b and p ≥ 0 give a^p ≤ b^p: s ↦ s^p does not decrease on [0, ∞)."""
    hypotheses = (le(0, lower), le(lower, upper), ge(exponent, 0))
    return Implication(hypotheses, le(lower**exponent, upper**exponent), "monotone power")


@lemma
def power_strict(lower: sp.Expr, upper: sp.Expr, exponent: sp.Expr) -> Implication:
    """0 < a < b and p > 0 give a^p < b^p."""
    hypotheses = (lt(0, lower), lt(lower, upper), gt(exponent, 0))
    return Implication(hypotheses, lt(lower**exponent, upper**exponent), "monotone power")


@lemma
def power_positive(base: sp.Expr, exponent: sp.Expr) -> Implication:
    """b > 0 gives b^p > 0."""
    return Implication((gt(base, 0),), gt(base**exponent, 0), "positive power")


@lemma
def power_nonnegative(base: sp.Expr, exponent: sp.Expr) -> Implication:
    """b ≥ 0 and p > 0 give b^p ≥ 0."""
    return Implication((ge(base, 0), gt(exponent, 0)), ge(base**exponent, 0), "power of what is not negative")


@lemma
def superadditive(smaller: sp.Expr, rest: sp.Expr, exponent: sp.Expr) -> Implication:
    """a, b ≥ 0 and p ≥ 1 give a^p + b^p ≤ (a + b)^p: with s = a/(a + b), s^p + (1 − s)^p ≤ s + (1 − s) = 1."""
    hypotheses = (ge(smaller, 0), ge(rest, 0), ge(exponent, 1))
    conclusion = le(smaller**exponent + rest**exponent, (smaller + rest) ** exponent)
    return Implication(hypotheses, conclusion, "superadditive power")


@lemma
def exp_monotone(lower: sp.Expr, upper: sp.Expr) -> Implication:
    """a ≤ b gives e^a ≤ e^b."""
    return Implication((le(lower, upper),), le(sp.exp(lower), sp.exp(upper)), "monotone exponential")


@lemma
def exp_line(argument: sp.Expr) -> Implication:
    """1 + u ≤ e^u: the exponential is convex, and its tangent at 0 is below it."""
    return Implication((), le(1 + argument, sp.exp(argument)), "exponential above its tangent")


@lemma
def exp_line_strict(argument: sp.Expr) -> Implication:
    """u ≠ 0 gives 1 + u < e^u: the exponential is strictly convex."""
    hypotheses = (Relation(argument, "!=", sp.S.Zero),)
    return Implication(hypotheses, lt(1 + argument, sp.exp(argument)), "exponential strictly above its tangent")


@lemma
def cosine_parabola(argument: sp.Expr) -> Implication:
    """1 − u²/2 ≤ cos u: both sides and their slopes agree at 0, and −1 ≤ −cos u compares the second derivatives."""
    return Implication((), ge(sp.cos(argument), 1 - argument**2 / 2), "cosine parabola")


@lemma
def cosine_quartic(argument: sp.Expr) -> Implication:
    """cos u ≤ 1 − u²/2 + u⁴/24: integrate the cosine parabola twice from 0."""
    upper = 1 - argument**2 / 2 + argument**4 / 24
    return Implication((), le(sp.cos(argument), upper), "cosine quartic")


@lemma
def sine_line(argument: sp.Expr) -> Implication:
    """u ≥ 0 gives sin u ≤ u."""
    return Implication((ge(argument, 0),), le(sp.sin(argument), argument), "sine below its tangent")


@lemma
def sine_cubic(argument: sp.Expr) -> Implication:
    """u ≥ 0 gives sin u ≥ u − u³/6: integrate the cosine parabola from 0."""
    return Implication((ge(argument, 0),), ge(sp.sin(argument), argument - argument**3 / 6), "sine cubic")


@lemma
def sine_square(argument: sp.Expr) -> Implication:
    """sin² u ≤ u²: the slope of the sine is at most 1 in absolute value, and sin 0 = 0."""
    return Implication((), le(sp.sin(argument) ** 2, argument**2), "sine below its argument")


@lemma
def norm_below(entries: Sequence[sp.Expr], factor: sp.Expr, others: Sequence[sp.Expr]) -> Implication:
    """K ≥ 0 and |gᵢ| ≤ K |xᵢ| for every i, squared, give ‖g‖ ≤ K ‖x‖: add up and take the root."""
    hypotheses = tuple(le(g**2, factor**2 * x**2) for g, x in zip(entries, others, strict=True))
    norms = [sp.sqrt(sp.Add(*(entry**2 for entry in column))) for column in (entries, others)]
    return Implication((ge(factor, 0), *hypotheses), le(norms[0], factor * norms[1]), "norm entry by entry")


@lemma
def power_of_root(value: sp.Expr, base: sp.Expr, exponent: sp.Expr) -> Implication:
    """b > 0, p ≠ 0 and v = b^(1/p) give v^p = b: powers of a positive number multiply their exponents."""
    hypotheses = (gt(base, 0), Relation(exponent, "!=", sp.S.Zero), eq(value, base ** (1 / exponent)))
    return Implication(hypotheses, eq(value**exponent, base), "power of a root")
