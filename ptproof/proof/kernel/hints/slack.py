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
    while (found := next(filter(None, (_bounded(item, goal) for item in goal.known)), None)) is not None:
        item, variable, bound = found
        name = fresh(f"gap{len(lines)}", goal.names)
        strictly = item.sign in ("<", ">")
        above = sp.Symbol(name, **{"positive" if strictly else "nonnegative": True})
        lines.append(f"{'above' if strictly else 'at_least'} {goal.names[variable]} {goal.text(bound)} {name}")
        goal = replace(goal, known=tuple(other for other in goal.known if other != item))
        goal = goal.map(partial(_put, {variable: bound + above}), {**goal.names, above: name})
    return lines, goal


def _put(there: dict[sp.Basic, sp.Basic], side: sp.Basic) -> sp.Basic:
    """The side with the value in it, multiplied out if it is a polynomial."""
    new = side.xreplace(there)
    return sp.expand(new) if new.is_polynomial() else new


def _bounded(item: Relation, goal: Goal) -> tuple[Relation, sp.Symbol, sp.Expr] | None:
    """The relation, a variable that has no sign of its own, and its lower bound by the relation."""
    upright = item.standard()
    if upright.sign not in ("<", "<="):
        return None
    gap = sp.expand(upright.right - upright.left)
    if not gap.is_polynomial():
        return None
    exponents = sp.Tuple(*(power.exp for power in goal.atoms(sp.Pow)))
    for symbol in sorted(gap.free_symbols, key=lambda symbol: symbol.name):
        rest = gap - symbol
        if symbol.is_nonnegative is None and not rest.has(symbol) and not exponents.has(symbol):
            return item, symbol, -rest
    return None
