"""Letters for what variables are above their lower bounds: what is known of a bound is then the sign of a letter."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import sympy as sp

from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.names import fresh
from ptproof.proof.statement import Relation


def slackened(goal: Goal) -> tuple[list[str], Goal]:
    """The goal without the variables that have a lower bound by what is known, if they stand in no exponent."""
    lines: list[str] = []
    left = list(goal.known)
    while left:
        item = left.pop(0)
        if (found := _bounded(item, goal)) is None:
            continue
        variable, bound = found
        name = fresh(f"gap{len(lines)}", goal.names)
        strictly = item.standard().sign == "<"
        above = sp.Symbol(name, **{"positive" if strictly else "nonnegative": True})
        lines.append(f"{'above' if strictly else 'at_least'} {goal.names[variable]} {goal.text(bound)} {name}")
        there: dict[sp.Basic, sp.Expr] = {variable: bound + above}
        change = partial(_put, there)
        left = [other.map(change) for other in left]
        known = tuple(other for other in goal.known if other is not item)
        goal = replace(goal, known=known).map(change, {**goal.names, above: name})
    return lines, goal


def _put(values: dict[sp.Basic, sp.Expr], side: sp.Basic) -> sp.Basic:
    found = side.xreplace(values)
    return sp.expand(found) if side.is_polynomial() else found


def _bounded(item: Relation, goal: Goal) -> tuple[sp.Symbol, sp.Expr] | None:
    """A variable that has no sign of its own, and its bound by the relation."""
    item = item.standard()
    if item.sign not in ("<", "<="):
        return None
    gap = sp.expand(item.right - item.left)
    if not gap.is_polynomial():
        return None
    for symbol in sorted(gap.free_symbols, key=lambda symbol: symbol.name):
        rest = gap - symbol
        exponents = (power.exp for power in goal.atoms(sp.Pow))
        if symbol.is_nonnegative is None and not rest.has(symbol) and not any(e.has(symbol) for e in exponents):
            return symbol, -rest
    return None
