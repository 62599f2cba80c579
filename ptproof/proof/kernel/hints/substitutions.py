"""Variables that an equation gives are replaced by what they are equal to."""

from __future__ import annotations

import sympy as sp

from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.statement import Relation


def substituted(goal: Goal) -> tuple[list[str], Goal]:
    """Every equation that is linear in a variable, with a number as its factor, is solved for it."""
    lines: list[str] = []
    for _ in goal.known:
        found = next((pair for item in goal.known if item.sign == "=" and (pair := _solved(item))), None)
        if found is None:
            break
        symbol, value = found
        lines.append(f"replace_by {goal.names[symbol]} {goal.text(value)}")
        roots = {part.base for part in goal.atoms(sp.Pow) if part.base == symbol and not part.exp.is_Integer}
        absolute = goal.relation.has(sp.Abs(symbol))
        goal = goal.replaced(symbol, value)
        if absolute:
            lines.append(
                f"absolute_values; try (shown_as {goal.text(goal.relation.left)} {goal.text(goal.relation.right)})"
            )
        if roots and not isinstance(sp.sqrt(value), sp.Pow) and not value.is_Symbol:
            lines.append(f"try (root_is {goal.text(value)} {goal.text(sp.sqrt(value))})")
    return lines, goal


def _solved(relation: Relation) -> tuple[sp.Symbol, sp.Expr] | None:
    symbol, value = relation.left, relation.right
    if symbol.is_Symbol and value.has(sp.exp) and not value.has(symbol) and not symbol.is_nonnegative:
        return symbol, value  # multiplied out its exponentials would not be those of the goal
    gap = sp.expand(relation.right - relation.left)
    for symbol in sorted(gap.free_symbols, key=lambda s: s.name):
        factor = gap.coeff(symbol)
        rest = sp.expand(gap - factor * symbol)
        if factor.is_Rational and factor != 0 and not rest.has(symbol):
            value = sp.factor(-rest / factor)
            # A sign that is known must not be lost.
            if not symbol.is_nonnegative or value.is_nonnegative:
                return symbol, value
    return None


def powers_back(goal: Goal) -> tuple[list[str], Goal]:
    """Where v = x^a is known, v^(1/a) is x."""
    lines: list[str] = []
    for relation in goal.known:
        for symbol, power in ((relation.left, relation.right), (relation.right, relation.left)):
            if relation.sign != "=" or not symbol.is_Symbol or not isinstance(power, sp.Pow):
                continue
            base, exponent = power.args
            for own in [part for part in goal.atoms(sp.Pow) if part.base == symbol and not part.exp.is_number]:
                if base.is_positive is None and sp.simplify(exponent * own.exp) == 1:
                    lines.append(f"power_back {' '.join(map(goal.text, (symbol, base, exponent, own.exp)))}")
                    goal = goal.replaced(own, base)
    return lines, goal
