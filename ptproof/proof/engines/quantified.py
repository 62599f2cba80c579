"""Assumptions for all values of a variable: when one follows from others, and a used claim at other values.

``specialise`` is how a proof uses a claim whose assumptions are quantified, such as a differential inequality
on an interval: its symbols and functions are given values, and every quantified assumption of it has to follow
from the goal's own assumptions. What is left, its plain assumptions, z3 discharges.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.errors import InputError
from ptproof.proof.claim import Goal, declared
from ptproof.proof.engines.reals import Answer, follows
from ptproof.proof.statement import (
    Assumption,
    Exists,
    ForAll,
    Implication,
    Prose,
    Relation,
    Smooth,
    ge,
    gt,
    plain,
    relations_of,
)
from ptproof.proof.substitution import substitute_in

_SECONDS = 4.0


def at_point(
    quantified: ForAll, point: sp.Expr, known: Sequence[Relation], facts: Sequence[Implication] = ()
) -> Relation | None:
    """What an assumption for all values of one variable says at ``point``, if that is shown to be in its domain."""
    if len(quantified.variables) != 1 or not _is_kind(quantified.variables[0], point, known, facts):
        return None
    there = {quantified.variables[0]: point}
    domain = [substitute_in(part, there) for part in quantified.domain]
    if not all(part in known or follows(part, known, facts, seconds=_SECONDS).shown for part in domain):
        return None
    return substitute_in(quantified.relation, there)


def instances(goal: Goal, *points: sp.Expr) -> list[Implication]:
    """The goal's quantified assumptions at these points, where they are shown to be in the domain, as facts."""
    known = goal.relations
    found = (at_point(item, sp.sympify(point), known) for item in goal.assumptions if isinstance(item, ForAll)
             and not item.relation.left.has(sp.Derivative) for point in points)  # fmt: skip
    return [Implication((), relation) for relation in found if relation is not None]


def entailed(needed: ForAll, given: Sequence[Assumption], facts: Sequence[Implication] = ()) -> Answer:
    """Whether ``needed`` follows from ``given``: shown at one arbitrary value of its variable.

    Quantified assumptions among ``given`` are used at that same value, where it is in their domain.
    """
    if needed in given:
        return Answer(True, "it is assumed")
    if len(needed.variables) != 1:
        return Answer(False, "more than one bound variable")
    (variable,) = needed.variables
    # A fresh symbol: nothing that is assumed about a free symbol of the same name may be used.
    point = sp.Dummy(variable.name, **declared(variable))
    known = [*plain(given), *(substitute_in(part, {variable: point}) for part in needed.domain)]
    for item in given:
        if isinstance(item, ForAll):
            there = at_point(item, point, known, facts)
            if there is not None:
                known.append(there)
    return follows(substitute_in(needed.relation, {variable: point}), known, facts, seconds=_SECONDS)


def specialise(
    goal: Goal, used: Any, values: Mapping[Any, Any], facts: Sequence[Implication] = ()
) -> list[Implication]:
    """The statement of a claim that the goal uses, with ``values`` for its symbols and functions, as facts.

    A key is a symbol, or an undefined function applied to symbols, whose value is an expression in them.

    Raises
    ------
    InputError
        If the goal does not use the claim, a value is not known to be what its symbol stands for, or a
        quantified assumption of the claim does not follow from the goal's assumptions.
    """
    if used not in goal.uses:
        raise InputError(f"{goal.id}: {used.id} is specialised, but is not among the claims used")
    if isinstance(used.statement, Prose | Smooth | Exists):
        raise InputError(f"{goal.id}: {used.id} is not a conjunction of relations")
    bound = {variable for item in used.assumptions if isinstance(item, ForAll) for variable in item.variables}
    known = goal.relations
    for key, value in values.items():
        free = sp.sympify(value).free_symbols - (set(key.args) if isinstance(key, AppliedUndef) else set())
        if key in bound or free & bound:
            raise InputError(f"{goal.id}: the value of {key} would be caught by a quantifier of {used.id}")
        if not _is_kind(key, sp.sympify(value), known, facts):
            raise InputError(f"{goal.id}: {value} is not known to be what {key} stands for in {used.id}")
    hypotheses = []
    for item in used.assumptions:
        if isinstance(item, Relation):
            hypotheses += [substitute_in(part, values) for part in item.components()]
            continue
        domain = tuple(substitute_in(part, values) for part in item.domain)
        there = ForAll(item.variables, substitute_in(item.relation, values), domain)
        answer = entailed(there, goal.assumptions, facts)
        if not answer.shown:
            raise InputError(f"{goal.id}: what {used.id} assumes does not follow: {there} ({answer.how})")
    parts = relations_of(used.statement)
    return [Implication(tuple(hypotheses), substitute_in(part, values), source=used.id) for part in parts]


def _is_kind(key: Any, value: sp.Expr, known: Sequence[Relation], facts: Sequence[Implication]) -> bool:
    """Whether ``value`` satisfies the declaration of ``key``, by SymPy or, for a sign, by z3."""
    if isinstance(key, sp.Symbol):
        wanted = declared(key)
    else:
        wanted = {name: True for name in ("real", "nonnegative", "positive") if getattr(key, f"is_{name}")}
    if all(getattr(value, f"is_{name}") is truth for name, truth in wanted.items()):
        return True
    masked = mask_positive(value, known, facts)
    missing = {name for name, truth in wanted.items() if getattr(masked, f"is_{name}") is not truth}
    if not missing:
        return True
    if not missing <= {"positive", "nonnegative"} or not masked.is_real:
        return False
    sign = gt(value, 0) if "positive" in missing else ge(value, 0)
    return follows(sign, known, facts, seconds=_SECONDS).shown


def mask_positive(value: sp.Expr, known: Sequence[Relation], facts: Sequence[Implication] = ()) -> sp.Expr:
    """The value with each base of a power that is shown positive replaced by a positive symbol, from inside out."""
    refused: set[sp.Expr] = set()
    while True:
        bases = {node.base for node in value.atoms(sp.Pow) if node.base.is_positive is None and node.base.is_real}
        for base in sorted(bases - refused, key=sp.count_ops):
            if follows(gt(base, 0), known, facts, seconds=_SECONDS).shown:
                symbol = sp.Dummy("positive", positive=True)
                powers = [node for node in value.atoms(sp.Pow) if node.base == base]
                value = value.xreplace({node: symbol**node.exp for node in powers})
                break
            refused.add(base)
        else:
            return value
