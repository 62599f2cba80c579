"""Equations from others: a variable put in, exponentials by one of them, and squares of roots."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.substitutions import substituted


def by_equations(goal: Goal) -> Iterator[str]:
    """Tactics for an equation, each for the whole goal."""
    if goal.relation.has(sp.pi) and goal.relation.has(sp.sin, sp.cos):
        yield "whole_periods; rational"
    if lines := list(_exponentials(goal)):
        yield "; ".join([*lines, "rational"])
    yield from _by_one(goal)
    yield from _by_roots(goal)


def _gap(goal: Goal) -> sp.Expr:
    return sp.together(goal.relation.left - goal.relation.right)


def _vanishes(expression: sp.Expr) -> bool:
    return sp.expand(sp.fraction(sp.together(expression))[0]) == 0


def _exponentials(goal: Goal) -> Iterator[str]:
    """Every exponential as a whole power of one of them."""
    found = sorted({part for part in goal.relation.left.atoms(sp.exp) | goal.relation.right.atoms(sp.exp)},
                   key=lambda part: (part.args[0].could_extract_minus_sign(), sp.default_sort_key(part)))  # fmt: skip
    for small in found:
        times = {large: sp.cancel(large.args[0] / small.args[0]) for large in found if large != small}
        if times and all(number.is_Integer for number in times.values()):
            for large, number in times.items():
                power = f"({goal.text(small)} ^ {abs(number)})"
                yield f"power_as {goal.text(large)} {power if number > 0 else f'(/ {power})'}"
            return


def _by_one(goal: Goal) -> Iterator[str]:
    """By one of the equations that are known, solved for a symbol."""
    gap = _gap(goal)
    for item in goal.known:
        for symbol, value in ((item.left, item.right), (item.right, item.left)):
            if item.sign == "=" and symbol.is_Symbol and gap.has(symbol) and not value.has(symbol):
                if _vanishes(gap.xreplace({symbol: value})):
                    yield f"replace_by {goal.text(symbol)} {goal.text(value)}; rational"


def _by_roots(goal: Goal) -> Iterator[str]:
    """The difference as multiples of what squares of roots are less what they are of."""
    lines, simpler = substituted(goal)
    rest, parts = _gap(simpler), list[str]()
    roots = sorted((part for part in rest.atoms(sp.Pow) if part.exp.is_Rational and part.exp.q == 2),
                   key=sp.default_sort_key)  # fmt: skip
    bases = list(dict.fromkeys(root.base for root in roots))
    stands = {base: sp.Dummy() for base in bases}
    rest = rest.replace(
        lambda part: part.is_Pow and part.base in stands and part.exp.is_Rational and part.exp.q == 2,
        lambda part: stands[part.base] ** part.exp.p,
    )
    top, bottom = sp.fraction(rest)
    if not bases or bottom.has(*stands.values()):
        return
    back = {stands[base]: sp.sqrt(base) for base in bases}
    for base in bases:
        symbol = stands[base]
        quotient, top = sp.div(sp.expand(top), symbol**2 - base, symbol)
        if quotient != 0:
            factor = simpler.text(sp.cancel(quotient / bottom).xreplace(back))
            text, below = simpler.text(sp.sqrt(base)), simpler.text(base)
            parts.append(f"{factor} * ({text} * {text} - {below})")
    if not parts or not _vanishes(top):
        return
    squared = [f"squared_root {simpler.text(base)}" for base in bases]
    yield "; ".join([*lines, f"zero_as ({' + '.join(parts)})", *(f"try ({line})" for line in squared), "is_zero"])
