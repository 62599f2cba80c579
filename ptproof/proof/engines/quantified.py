"""Assumptions for all values of a variable: when one follows from others, and a used claim at other values.

``specialise`` is how a proof uses a claim whose assumptions are quantified, such as a differential inequality
on an interval: its symbols and functions are given values, and every quantified assumption of it has to follow
from the goal's own assumptions. What is left, its plain assumptions, z3 discharges.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any, TypeAlias

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof import steps
from ptproof.proof.claim import Claim, Goal
from ptproof.proof.declarations import SAYS, like
from ptproof.proof.engines.reals import Answer, are_met, follows
from ptproof.proof.facts import Fact, guarded, resting_on, usable
from ptproof.proof.statement import (
    Exists,
    ForAll,
    Implication,
    Prose,
    Relation,
    Runs,
    Smooth,
    free_symbols,
    gt,
    plain,
    relations_of,
)
from ptproof.proof.substitution import NotOfKind, Substitution

Point: TypeAlias = sp.Expr | tuple[sp.Expr, ...]
Along: TypeAlias = Callable[[Goal, Any], Sequence[Fact]]
_SECONDS = 4.0


def at_point(
    quantified: ForAll, point: Point, known: Sequence[Relation], facts: Sequence[Implication] = ()
) -> Relation | None:
    """What an assumption for all values of its variables says at ``point``, if that is shown to be in its domain.

    ``point`` is an expression, or one for each variable.
    """
    values = tuple(point) if isinstance(point, tuple | sp.Tuple) else (point,)
    if len(quantified.variables) != len(values):
        return None
    try:
        there = Substitution(dict(zip(quantified.variables, values, strict=True)), shown_sign(known, facts))
    except NotOfKind:
        return None
    if not are_met(there.domain, known, facts, seconds=_SECONDS).shown:
        return None
    domain = map(there.relation, quantified.domain)
    if not all(part in known or follows(part, known, facts, seconds=_SECONDS).shown for part in domain):
        return None
    return there.relation(quantified.relation)


def instances(goal: Goal, *points: Point) -> list[Fact]:
    """The goal's quantified assumptions at these points, where they are shown to be in the domain, as facts.

    A point of an assumption on several variables is a tuple.
    """
    known = goal.relations
    for point in points:
        steps.note(steps.At(tuple(point) if isinstance(point, tuple | sp.Tuple) else (point,)))
    found = (at_point(item, sp.sympify(point), known) for item in goal.assumptions if isinstance(item, ForAll)
             for point in points)  # fmt: skip
    return [resting_on(goal, Implication((), relation)) for relation in found if relation is not None]


def entailed(needed: ForAll, goal: Goal, facts: Sequence[Fact] = (), along: Along | None = None) -> Answer:
    """Whether ``needed`` follows from the goal's assumptions: shown at one arbitrary value of each of its variables.

    Quantified assumptions are used at that same value, where it is in their domain. ``along`` gives facts about it: it
    gets the goal that has, in addition, the value in the domain of ``needed``, and the value, a tuple for several
    variables.
    """
    if needed in goal.assumptions:
        steps.note(steps.Anywhere())
        return Answer(True, "it is assumed")
    # Fresh symbols: nothing that is assumed about a free symbol of the same name may be used.
    said_here = [part for fact in facts for part in (*fact.says.hypotheses, fact.says.conclusion)]
    taken = free_symbols([needed, goal.statement, *goal.assumptions, *said_here])
    values = {variable: _arbitrary(variable, taken) for variable in needed.variables}
    point = sp.Tuple(*values.values()) if len(values) > 1 else next(iter(values.values()))
    there = Substitution(values)
    inside = replace(goal, assumptions=(*goal.assumptions, *map(there.relation, needed.domain)))
    with steps.noting() as noted:
        said = usable(inside, [*facts, *(along(inside, point) if along else ())])
    steps.note(steps.Anywhere(tuple(values.values()), tuple(noted)))
    known = list(inside.relations)
    for item in goal.assumptions:
        if isinstance(item, ForAll):
            here = at_point(item, point, known, said)
            if here is not None:
                known.append(here)
    return follows(there.relation(needed.relation), known, said, seconds=_SECONDS)


def _arbitrary(variable: sp.Symbol, taken: Collection[sp.Symbol]) -> sp.Symbol:
    """A symbol of the variable's kind about which nothing is said yet; the same one where it can be.

    What a proof asks about an arbitrary value is then the question of another proof, and is answered once.
    """
    return next(letter for number in itertools.count() if (letter := _like(variable, number)) not in taken)


@lru_cache(maxsize=1024)
def _like(variable: sp.Symbol, number: int) -> sp.Symbol:
    return like(variable)


def specialise(
    goal: Goal, used: Claim, values: Mapping[Any, Any], facts: Sequence[Fact] = (), *, along: Along | None = None
) -> list[Fact]:
    """The statement of a claim that the goal uses, with ``values`` for its symbols and functions, as facts.

    A key is a symbol, or an undefined function applied to symbols, whose value is an expression in them. What the
    values need in order to be defined is among the hypotheses. ``along`` helps to show the quantified assumptions of
    the claim: as in :func:`entailed`.

    Raises
    ------
    InputError
        If the goal does not use the claim, a value is not known to be what its symbol stands for, or a
        quantified assumption of the claim does not follow from the goal's assumptions.
    """
    if used.content not in {other.content for other in goal.uses}:
        raise InputError(f"{goal.id}: {used.id} is specialised, but is not among the claims used")
    if isinstance(used.statement, Prose | Smooth | Exists | Runs):
        raise InputError(f"{goal.id}: {used.id} is not a conjunction of relations")
    known, said = goal.relations, usable(goal, facts)
    try:
        there = Substitution(values, shown_sign(known, said))
        quantified = [there.quantified(item) for item in used.assumptions if isinstance(item, ForAll)]
    except InputError as error:
        raise InputError(f"{goal.id}: {used.id} is specialised, but {error}") from error
    with steps.noting() as assumed:
        for item in quantified:
            answer = entailed(item, goal, facts, along)
            if not answer.shown:
                raise InputError(f"{goal.id}: what {used.id} assumes does not follow: {item} ({answer.how})")
    steps.put(used.content, there.values, assumed)
    hypotheses = [there.relation(part) for part in plain(used.assumptions)]
    for need in there.domain:
        if need.given or need.relation is None:
            raise InputError(f"{goal.id}: nothing shows where the values put into {used.id} are defined: {need}")
        hypotheses.append(need.relation)
    # What is shown along an arbitrary value may rest on any claim that the goal uses.
    claims = [used.content] if along is None else [other.content for other in goal.uses]
    found = []
    for part in relations_of(used.statement):
        says = Implication(tuple(hypotheses), there.relation(part), source=used.id)
        if (limited := guarded(says) if used.where_defined else says) is not None:
            found.append(resting_on(goal, limited, claims, *facts))
    return found


def shown_sign(known: Sequence[Relation], facts: Sequence[Implication] = ()) -> Callable[[sp.Expr, str], bool]:
    """Who asks whether a value is positive, negative, … is answered by what is known of its powers, and by z3."""

    def has_sign(value: sp.Expr, sign: str) -> bool:
        if getattr(mask_positive(value, known, facts), f"is_{sign}"):
            return True
        return follows(Relation(value, SAYS[sign], sp.S.Zero), known, facts, seconds=_SECONDS).shown

    return has_sign


def mask_positive(value: sp.Expr, known: Sequence[Relation], facts: Sequence[Implication] = ()) -> sp.Expr:
    """The value with each base of a power that is shown positive replaced by a positive symbol, from inside out."""
    refused: set[sp.Expr] = set()
    while True:
        bases = {node.base for node in value.atoms(sp.Pow) if node.base.is_positive is None and node.base.is_real}
        for base in sorted(bases - refused, key=sp.count_ops):
            if follows(gt(base, 0), known, facts, seconds=_SECONDS).shown:
                symbol = _positive(base)
                powers = [node for node in value.atoms(sp.Pow) if node.base == base]
                value = value.xreplace({node: symbol**node.exp for node in powers})
                break
            refused.add(base)
        else:
            return value


@lru_cache(maxsize=1024)
def _positive(base: sp.Expr) -> sp.Symbol:
    return sp.Dummy("positive", positive=True)
