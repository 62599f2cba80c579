"""Minima, maxima and absolute values as letters with what bounds them, where no more of them is needed."""

from __future__ import annotations

import sympy as sp

from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.needed import needed
from ptproof.proof.kernel.names import fresh
from ptproof.proof.statement import Relation

_MILLISECONDS = 500


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
        inner = goal.with_known(*_bounds(part)).replaced(part, letter, {**goal.names, letter: name})
        if needed(inner.relation, inner.known, _MILLISECONDS) is None:
            continue
        lines.append(f"bounded_as {name} {goal.text(part)}")
        goal = inner
    return lines, goal


def _bounds(part: sp.Expr) -> list[Relation]:
    match part:
        case sp.Abs():
            return [Relation(part.args[0], "<=", part), Relation(-part.args[0], "<=", part)]
        case sp.Max():
            return [Relation(item, "<=", part) for item in part.args]
    return [Relation(part, "<=", item) for item in part.args]
