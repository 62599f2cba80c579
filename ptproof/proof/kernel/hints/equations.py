"""Equations from others: a variable put in, exponentials by one of them, and squares of roots."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.terms import term


def by_equations(goal: Goal) -> Iterator[str]:
    """Tactics for an equation, each for the whole goal."""
    if goal.relation.has(sp.pi) and goal.relation.has(sp.sin, sp.cos) and _vanishes(_without_periods(goal)):
        yield "whole_periods; rational"
    if goal.relation.has(sp.sin) and goal.relation.has(sp.cos) and _vanishes(_by_sines(goal)):
        yield "squared_cosines; rational"
    if lines := list(_exponentials(goal)):
        yield "; ".join([*lines, "rational"])
    yield from _by_one(goal)
    yield from _by_roots(goal)


def _vanishes(expression: sp.Expr) -> bool:
    return sp.expand(sp.fraction(sp.together(expression))[0]) == 0


def _without_periods(goal: Goal) -> sp.Expr:
    """The difference of the sides, whose waves SymPy takes whole periods from once their arguments are sums."""
    gap = goal.relation.left - goal.relation.right
    return gap.replace(lambda part: isinstance(part, sp.sin | sp.cos), lambda part: part.func(sp.expand(part.args[0])))


def _by_sines(goal: Goal) -> sp.Expr:
    """The difference of the sides, with every square of a cosine by the one of the sine."""

    def change(power: sp.Pow) -> sp.Expr:
        even, odd = divmod(power.exp, 2)
        return (1 - sp.sin(power.base.args[0]) ** 2) ** even * power.base**odd

    gap = goal.relation.left - goal.relation.right
    return gap.replace(lambda part: isinstance(part, sp.Pow) and isinstance(part.base, sp.cos) and part.exp.is_Integer
                       and part.exp > 1, change)  # fmt: skip


def _roots(goal: Goal) -> tuple[dict[sp.Expr, sp.Dummy], dict[sp.Basic, sp.Expr]]:
    """A symbol for each root, by what it is of, and the powers by them.

    As expressions roots would come to be written in another way than they stand in the claim.
    """
    powers = [part for part in goal.atoms(sp.Pow) if part.exp.is_Rational and part.exp.q == 2]
    stands = {base: sp.Dummy() for base in dict.fromkeys(part.base for part in powers)}
    return stands, {part: stands[part.base] ** part.exp.p for part in powers}


def _exponentials(goal: Goal) -> Iterator[str]:
    """Every exponential as a whole power of one of them."""
    found = sorted(
        goal.relation.left.atoms(sp.exp) | goal.relation.right.atoms(sp.exp),
        key=lambda part: (part.args[0].could_extract_minus_sign(), sp.default_sort_key(part)),
    )
    for small in found:
        times = {large: sp.cancel(large.args[0] / small.args[0]) for large in found if large != small}
        if not times or not all(number.is_Integer for number in times.values()):
            continue
        base = sp.Dummy(positive=True)
        gap = goal.relation.left - goal.relation.right
        if _vanishes(gap.xreplace({small: base, **{large: base**number for large, number in times.items()}})):
            for large, number in times.items():
                power = f"({goal.text(small)} ^ {abs(number)})"
                yield f"power_as {goal.text(large)} {power if number > 0 else f'(/ {power})'}"
        return


def _by_one(goal: Goal) -> Iterator[str]:
    """By one of the equations that are known, solved for a symbol."""
    _, there = _roots(goal)
    gap = (goal.relation.left - goal.relation.right).xreplace(there)
    for item in goal.known:
        for symbol, value in ((item.left, item.right), (item.right, item.left)):
            solved = item.sign == "=" and symbol.is_Symbol and gap.has(symbol) and not value.has(symbol)
            if solved and _vanishes(gap.xreplace({symbol: value.xreplace(there)})):
                yield f"replace_by {goal.text(symbol)} {goal.text(value)}; rational"


def _by_roots(goal: Goal) -> Iterator[str]:
    """The difference as multiples of what squares of roots are less what they are of."""
    stands, there = _roots(goal)
    names = {**goal.names, **{symbol: goal.text(sp.sqrt(base)) for base, symbol in stands.items()}}
    gap, lines = (goal.relation.left - goal.relation.right).xreplace(there), list[str]()
    for item in goal.known:
        symbol, value = item.left, item.right
        if item.sign == "=" and symbol.is_Symbol and gap.has(symbol) and not value.has(symbol):
            lines.append(f"replace_by {goal.text(symbol)} {goal.text(value)}")
            gap = gap.xreplace({symbol: value.xreplace(there)})
    top, bottom = sp.fraction(sp.together(gap))
    if not stands or bottom.has(*stands.values()):
        return
    parts, squared = list[str](), list[str]()
    for base, symbol in stands.items():
        quotient, top = sp.div(sp.expand(top), symbol**2 - base, symbol)
        if quotient != 0:
            text, below = names[symbol], goal.text(base)
            parts.append(f"{term(sp.cancel(quotient / bottom), names)} * ({text} * {text} - {below})")
            squared.append(f"squared_root {below}")
    if parts and _vanishes(top):
        yield "; ".join([*lines, f"zero_as ({' + '.join(parts)})", *squared, "is_zero"])
