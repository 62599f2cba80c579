"""Powers of what is not negative, but may be 0: the base gets a letter, and is 0 or positive."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import sympy as sp

from ptproof.proof.kernel.hints.goals import Goal, is_shown
from ptproof.proof.kernel.names import fresh
from ptproof.proof.statement import Relation


def lettered(goal: Goal) -> tuple[list[str], Goal]:
    """The goal with a letter for each base that is a sum, which is not negative by structure or by what is known."""
    lines: list[str] = []
    for base in dict.fromkeys(_bases(goal)):
        if base.is_Symbol or not base.is_Add or not base.has(sp.Symbol):
            continue
        name = fresh(f"base{len(lines)}", goal.names)
        letter = sp.Symbol(name, nonnegative=True)
        lines.append(f"letter_for {name} {goal.text(base)}")
        goal = goal.replaced(base, letter, {**goal.names, letter: name})
    return lines, goal


def by_zero(goal: Goal) -> tuple[str, Goal, Goal] | None:
    """The line that splits by whether a base is 0, and the goals for 0 and for a positive base."""
    base = next((item for item in _bases(goal) if item.is_Symbol and is_shown(item) and not item.is_positive), None)
    if base is None:
        return None
    name = goal.names[base]
    positive = sp.Symbol(base.name, **{**base._assumptions_orig, "positive": True})
    zero = goal.map(lambda side: side.replace(lambda part: isinstance(part, sp.Pow) and part.base == base, _nothing))
    return (
        f"zero_or_positive {name}",
        zero.replaced(base, sp.Integer(0)),
        goal.replaced(base, positive, {**goal.names, positive: name}),
    )


def signs_of_bases(relations: Iterable[Relation], known: Iterable[Relation]) -> Iterator[Relation]:
    """What is known of the signs of the bases of powers."""
    sides = sp.Tuple(*(side for item in relations for side in (item.left, item.right)))
    bases = {power.base for power in sides.atoms(sp.Pow) if not power.exp.is_Integer and not power.base.is_nonnegative}
    yield from (item for item in known if item.standard().left == 0 and item.standard().right in bases)


def _nothing(power: sp.Pow) -> sp.Expr:
    return sp.Integer(0)


def _bases(goal: Goal) -> Iterator[sp.Expr]:
    """Bases of powers that are written with rpow: of unknown exponents, and not known to be positive."""
    for power in goal.atoms(sp.Pow):
        exponent = power.exp
        if not exponent.is_Rational and not power.base.is_positive and not power.base.is_number:
            yield power.base
