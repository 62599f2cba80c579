"""The order of sums below a line, with letters for them, and of letters: there is less to multiply out."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from functools import partial

import sympy as sp

from ptproof.proof.kernel.hints.bases import signs_of_bases
from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.masks import put
from ptproof.proof.kernel.hints.needed import needed
from ptproof.proof.kernel.hints.told import text_of
from ptproof.proof.kernel.names import fresh
from ptproof.proof.statement import Relation

_MOST = 4
_MILLISECONDS = 500


def ordered(goal: Goal, shown: Callable[[Goal], Iterator[str]]) -> tuple[list[str], Goal] | None:
    """The goal with a letter for each of these sums, from as few facts as it then needs; None if it does not follow.

    ``shown`` are tactics for the signs of the sums, and for their order.
    """
    sums = [power.base for power in goal.atoms(sp.Pow) if power.base.is_Add and power.exp.is_negative]
    sums = list(dict.fromkeys(sums))
    if not 1 <= len(sums) <= _MOST:
        return None
    lines: list[str] = []
    said = [Relation(sp.S.Zero, "<", each) for each in sums]
    order = [Relation(one, "<=", other) for one, other in itertools.permutations([sp.S.One, *sums], 2)
             if needed(Relation(one, "<=", other), goal.known, _MILLISECONDS) is not None]  # fmt: skip
    for item in (*said, *order):
        tactic = next(shown(Goal(item, goal.known, goal.names)), None)
        if tactic is None or not order:
            return None
        lines.append(f"assert ({text_of(item, goal.names)}) by (solve [ {tactic} ])")
    letters, names = dict[sp.Basic, sp.Basic](), dict(goal.names)
    for each in sums:
        name = fresh(f"o{len(letters)}", names)
        letters[each] = sp.Symbol(name, positive=True)
        names[letters[each]] = names[name] = name
        lines.append(f"try (named {name} {goal.text(each)})")
    inner = goal.with_known(*order).map(partial(put, letters), names)
    if (core := needed(inner.relation, inner.known)) is None:
        return None
    facts = (*core, *signs_of_bases((inner.relation, *core), inner.known))
    return lines, Goal(inner.relation, tuple(dict.fromkeys(facts)), names)


def letters_in_order(goal: Goal, shown: Callable[[Goal], Iterator[str]]) -> tuple[list[str], Goal]:
    """The goal with the order of its letters that are not negative, as far as it follows by the tactics ``shown``."""
    there = set().union(*(item.free_symbols for item in goal.relations()))
    letters = sorted((symbol for symbol in there if symbol.is_nonnegative and not symbol.is_positive), key=str)
    lines, known = list[str](), {item.standard() for item in goal.known}
    for pair in itertools.permutations(letters, 2) if len(letters) <= _MOST else ():
        item = Relation(pair[0], "<=", pair[1])
        if item not in known and (found := needed(item, goal.known, _MILLISECONDS)) is not None:
            for tactic in shown(Goal(item, found, goal.names)):
                lines.append(f"assert ({text_of(item, goal.names)}) by (solve [ {tactic} ])")
                goal = goal.with_known(item)
    return lines, goal
