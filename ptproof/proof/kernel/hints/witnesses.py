"""Witnesses for "there is": numbers that pass on samples, or a place between the bounds that linear relations set."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace

import sympy as sp

from ptproof.proof.kernel.declared import of_symbol
from ptproof.proof.kernel.names import Names
from ptproof.proof.kernel.obligations import Part
from ptproof.proof.kernel.terms import term
from ptproof.proof.statement import Exists, Relation, plain

_NUMBERS = tuple(sp.Integer(2) ** power for power in range(-4, 7))
_SAMPLES = 300
_SEED = 1


def witnesses(exists: Exists, known: Sequence[Relation]) -> dict[sp.Symbol, sp.Expr] | None:
    """A value for every variable, or None. It is a hint: Coq shows the body for it."""
    parts = [part.standard() for part in plain(exists.body)]
    if exists.over:
        found = {symbol: _number(symbol, exists, parts) for symbol in exists.variables}
        return None if None in found.values() else {s: value for s, value in found.items() if value is not None}
    if len(exists.variables) != 1:
        return None
    (symbol,) = exists.variables
    return {symbol: _between(symbol, parts, known)}


def shown_for(
    part: Part, exists: Exists, values: Mapping[sp.Basic, sp.Expr], names: Names, leaf: Callable[[Part], str]
) -> str:  # fmt: skip
    """The tactics that put the values in and show the part for them."""
    steps: list[str] = []
    for symbol in exists.variables:
        positive = leaf(Part("", Relation(sp.S.Zero, "<", values[symbol])))
        kinds = f"; split; [> solve [ first [ sign | {positive} ] ] | ]" * len(of_symbol(symbol, names[symbol]))
        steps.append(f"exists {term(values[symbol], names)}{kinds}")
    put = (item.relation and item.relation.map(lambda side: side.xreplace(values)) for item in part.body)
    leaves = [leaf(replace(item, relation=relation)) for item, relation in zip(part.body, put, strict=True)]
    intro = f"intros {' '.join(names[symbol] for symbol in exists.over)}; " if exists.over else ""
    return f"{'; '.join(steps)}; {intro}intros; facts; simple_values; pieces; [> {' | '.join(leaves)} ]"


def _number(symbol: sp.Symbol, exists: Exists, parts: Sequence[Relation]) -> sp.Expr | None:
    """The middle one of the numbers for which what speaks of this variable only holds at every sample."""
    own = [part for part in parts if symbol in part.free_symbols]
    if any(part.free_symbols - {symbol, *exists.over} for part in own):
        return None
    gaps = [sp.lambdify([symbol, *exists.over], part.right - part.left, "math") for part in own]
    points = list(_points(exists.over))

    def passes(number: sp.Expr) -> bool:
        return all(
            gap(float(number), *point) >= -1e-9 * (1 + math.hypot(*point)) ** 4 for gap in gaps for point in points
        )

    good = [number for number in _NUMBERS if passes(number)]
    return good[len(good) // 2] if good else None


def _points(over: Sequence[sp.Symbol]) -> Iterable[tuple[float, ...]]:
    chance = random.Random(_SEED)
    for _ in range(_SAMPLES):
        scale = 10 ** chance.uniform(-3, 2)
        values = [chance.uniform(-1, 1) * scale for _ in over]
        yield tuple(abs(value) if s.is_nonnegative else value for s, value in zip(over, values, strict=True))


def _between(symbol: sp.Symbol, parts: Sequence[Relation], known: Sequence[Relation]) -> sp.Expr:
    """Above the lower bound by half of the room that the others leave."""
    lower: list[sp.Expr] = [sp.Integer(0)] if symbol.is_nonnegative else []
    others: list[tuple[sp.Expr, sp.Expr]] = []
    for part in parts:
        gap = sp.expand(part.right - part.left)
        slope = gap.coeff(symbol)
        rest = sp.expand(gap - slope * symbol)
        if slope == 0 or rest.has(symbol):
            continue
        if slope.is_positive:
            lower.append(sp.factor(-rest / slope))
        else:
            others.append((slope, _shortest(rest, known)))
    start = sp.Max(*lower) if lower else sp.Integer(0)
    rooms = [_room(slope, sp.expand(rest + slope * start)) for slope, rest in others]
    return start + (sp.Min(*rooms) / 2 if rooms else sp.Integer(1))


def _room(slope: sp.Expr, rest: sp.Expr) -> sp.Expr:
    """How far the variable may go while rest + slope s stays positive."""
    return sp.factor(-rest / slope) if slope.is_negative else rest / (sp.Abs(slope) + 1)


def _shortest(expression: sp.Expr, known: Sequence[Relation]) -> sp.Expr:
    """The expression up to what equations say, as short as it gets."""
    gaps = [item.left - item.right for item in known if item.sign == "="]
    forms = [expression, *(sp.expand(expression + sign * gap) for gap in gaps for sign in (1, -1))]
    return min(forms, key=sp.count_ops)
