"""Sums that differ by a factor only, such as T + t0 - t and 1 - (t - t0)/T, by one of them: fewer to multiply out."""

from __future__ import annotations

from functools import partial

import sympy as sp

from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.masks import free_parts, put


def aligned(goal: Goal) -> tuple[list[str], Goal]:
    """The goal in which sums that are bases of powers are a product with another one of them, where they can be."""
    lines: list[str] = []
    chosen: list[sp.Expr] = []
    sides = [side for item in goal.relations() for side in (item.left, item.right)]
    parts = (part for side in sides for part in free_parts(side) if isinstance(part, sp.Pow))
    sums = {part.base for part in parts if part.base.is_Add and part.base.is_rational_function()}
    for one in sorted(sums, key=lambda part: (_is_fraction(part), sp.default_sort_key(part))):
        product = next(filter(None, (_by(one, other) for other in chosen)), None)
        other = product and goal.map(partial(put, {one: product}))
        # SymPy multiplies a number into a sum that is in no power: then it is the same sum again.
        if other is None or any(item.has(one) for item in other.relations()):
            chosen.append(one)
            continue
        lines.append(f"try (same_sum {goal.text(one)} {goal.text(product)})")
        goal = other
    return lines, goal


def _is_fraction(part: sp.Expr) -> bool:
    return sp.fraction(sp.together(part))[1] != 1


def _by(one: sp.Expr, other: sp.Expr) -> sp.Expr | None:
    factor = sp.cancel(one / other)
    return None if factor.has(sp.Add) else sp.Mul(factor, other, evaluate=False)
