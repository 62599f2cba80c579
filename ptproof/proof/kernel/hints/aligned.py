"""Sums that differ by a factor only, such as T + t0 - t and 1 - (t - t0)/T, by one of them: fewer to multiply out."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import sympy as sp

from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.masks import free_parts, put


def aligned(goal: Goal) -> tuple[list[str], Goal]:
    """The goal in which sums are the negative of another one, and bases of powers a product with one, if they are."""
    lines: list[str] = []
    chosen: list[sp.Expr] = []
    sums = dict.fromkeys(_sums(goal))
    bases = {power.base for power in goal.atoms(sp.Pow)}
    for one in sorted(sums, key=lambda part: (part not in bases, _fractions(part), sp.default_sort_key(part))):
        product = next(filter(None, (_by(one, other, one in bases) for other in chosen)), None)
        if product is None:
            chosen.append(one)
            continue
        lines.append(f"try (same_sum {goal.text(one)} {goal.text(product)})")
        goal = goal.map(partial(put, {one: product}))
    return lines, goal


def _sums(goal: Goal) -> Iterator[sp.Expr]:
    for item in goal.relations():
        for side in (item.left, item.right):
            yield from (part for part in free_parts(side) if part.is_Add)


def _fractions(part: sp.Expr) -> bool:
    return sp.fraction(sp.together(part))[1] != 1


def _by(one: sp.Expr, other: sp.Expr, is_base: bool) -> sp.Expr | None:
    if one == -other:
        return sp.Mul(-1, other, evaluate=False)
    if not is_base or not (one.is_rational_function() and other.is_rational_function()):
        return None
    factor = sp.cancel(one / other)
    return None if factor.has(sp.Add) else sp.Mul(factor, other, evaluate=False)
