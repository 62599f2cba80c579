"""Minima, maxima and absolute values out of a goal: as what they are known to be, or as letters with their bounds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import sympy as sp

from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.masks import put
from ptproof.proof.kernel.hints.needed import needed
from ptproof.proof.kernel.hints.told import text_of
from ptproof.proof.kernel.names import fresh
from ptproof.proof.statement import Relation

_MILLISECONDS = 500


def settled(goal: Goal, shown: Callable[[Goal], str]) -> tuple[list[str], Goal]:
    """The goal in which a minimum or maximum is the argument that it is known to be, if that is ``shown``."""
    lines: list[str] = []
    for part in goal.atoms(sp.Max, sp.Min):
        if len(part.args) != 2 or any(argument.has(sp.Max, sp.Min) for argument in part.args):
            continue
        first, last = sorted(part.args, key=sp.default_sort_key)  # as they are written
        for value, other in ((first, last), (last, first)):
            wanted = Relation(other, "<=", value) if isinstance(part, sp.Max) else Relation(value, "<=", other)
            # Without what speaks of it, so that the question gets smaller.
            others = tuple(item for item in goal.known if not item.has(part))
            found = needed(wanted, others, _MILLISECONDS)
            if found is None or not (tactic := shown(replace(goal, relation=wanted, known=found))):
                continue
            word = f"{'Rmax' if isinstance(part, sp.Max) else 'Rmin'}_{'left' if value == first else 'right'}"
            sides = f"{goal.text(first)} {goal.text(last)}"
            lines.append(f"rewrite ({word} {sides}) in * by (solve [ {tactic} ])")
            goal = goal.replaced(part, value)
            break
    return lines, goal


def bounded(goal: Goal) -> tuple[list[str], Goal]:
    """The goal without them: no cases are left to be looked at."""
    lines: list[str] = []
    for part in goal.atoms(sp.Max, sp.Min, sp.Abs):
        if len(part.args) > 2:
            continue
        name = fresh(f"bound{len(lines)}", goal.names)
        positive, nonnegative = bool(part.is_positive), bool(part.is_nonnegative)
        kinds = {"positive": True} if positive else {"nonnegative": True} if nonnegative else {"real": True}
        letter = sp.Symbol(name, **kinds)
        bounds = _bounds(part)
        inner = goal.with_known(*bounds).replaced(part, letter, {**goal.names, letter: name})
        if needed(inner.relation, inner.known, _MILLISECONDS) is None:
            continue
        lines.append(f"bounded_as {name} {goal.text(part)}")
        goal = inner
        there = (item.map(partial(put, {part: letter})) for item in bounds)
        lines += [f"try (assert ({text_of(item, goal.names)}) by lra)" for item in there]
    return lines, goal


def _bounds(part: sp.Expr) -> list[Relation]:
    match part:
        case sp.Abs():
            return [Relation(part.args[0], "<=", part), Relation(-part.args[0], "<=", part)]
        case sp.Max():
            return [Relation(item, "<=", part) for item in part.args]
    return [Relation(part, "<=", item) for item in part.args]
