"""Existence by a named value, and its refutation by values that defeat every choice."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import sympy as sp

from ptproof.proof import steps
from ptproof.proof.claim import Goal, engine
from ptproof.proof.engines.quantified import shown_sign
from ptproof.proof.engines.reals import are_met, follows, reals
from ptproof.proof.engines.witnesses import satisfiable
from ptproof.proof.facts import Fact, usable
from ptproof.proof.statement import All, Exists, Relation
from ptproof.proof.substitution import NotOfKind, Substitution
from ptproof.proof.verdict import Evidence, Verdict, Witness


@engine
def exists_by(goal: Goal, choice: Mapping[sp.Symbol, Any], *lemmas: Fact) -> Evidence:
    """Show "there is …" by values, which may depend on the universal symbols; the rest is a real inequality."""
    undecided = partial(Evidence, "existence", Verdict.UNDECIDED)
    statement = goal.statement
    if not isinstance(statement, Exists) or set(choice) != set(statement.variables):
        return undecided("the values given are not for the variables that exist")
    steps.note(steps.Chosen(tuple((symbol, sp.sympify(value)) for symbol, value in choice.items())))
    later = {*statement.over, *statement.variables}
    for symbol, value in choice.items():
        if sp.sympify(value).free_symbols & later:
            return undecided(f"the value of {symbol} depends on what comes after it")
    outside, _ = _split(goal.relations, later)
    try:
        chosen = Substitution(choice, shown_sign(outside))
    except NotOfKind as error:
        return undecided(str(error))
    defined = are_met(chosen.domain, outside, usable(goal, lemmas))
    if not defined.shown:
        return undecided(defined.how)
    body = All(tuple(map(chosen.relation, statement.body)))
    shown = reals(replace(goal, statement=body), *lemmas)
    named = ", ".join(f"{symbol} = {value}" for symbol, value in choice.items())
    return Evidence("existence", shown.verdict, f"with {named}: {shown.detail}")


@engine
def defeats_every_choice(goal: Goal, values: Mapping[sp.Symbol, Any], lemmas: Sequence[Fact] = ()) -> Evidence:
    """Refute "there is A such that … for all x" by an x that depends on A and breaks the body for every A.

    One relation of the body is shown to fail for all values of A that its declaration allows. Assumptions about x
    restrict the x that count, so they are shown to hold for this one; what is assumed of the rest has to hold
    somewhere, at exact values that are named.
    """
    undecided = partial(Evidence, "counterexample family", Verdict.UNDECIDED)
    statement = goal.statement
    if not isinstance(statement, Exists) or set(values) != set(statement.over):
        return undecided("values are needed for exactly the symbols after it")
    facts = usable(goal, (*goal.facts, *lemmas))
    # What is assumed of a letter outside says nothing of the A that is asked for.
    outside, _ = _split(goal.relations, set(statement.variables))
    given, about_these = _split(outside, set(statement.over))
    if not satisfiable(given):
        return undecided("no values are known that satisfy what is assumed, without which nothing is defeated")
    try:
        there = Substitution(values, shown_sign(given, facts))
    except NotOfKind as error:
        return undecided(str(error))
    inside = are_met(there.domain, given, facts)
    if not inside.shown:
        return undecided(inside.how)
    for assumption in about_these:
        inside = follows(there.relation(assumption), given, facts)
        if not inside.shown:
            return undecided(f"the values are not shown to satisfy {assumption}: {inside.how}")
    tried = []
    for part in map(there.relation, statement.body):
        fails = follows(part.negation(), given, facts)
        if fails.shown:
            family = dict.fromkeys(map(str, statement.variables), "any") | {str(s): str(v) for s, v in values.items()}
            witness = Witness(family, str(part.left), str(part.right))
            detail = f"for every {', '.join(map(str, statement.variables))}: {part.negation()} ({fails.how})"
            return Evidence("counterexample family", Verdict.REFUTED, detail, witness=witness)
        tried.append(f"{part}: {fails.how}")
    return undecided("; ".join(tried))


def _split(relations: Sequence[Relation], symbols: set[sp.Symbol]) -> tuple[list[Relation], list[Relation]]:
    """The relations without and with any of the symbols."""
    about = [item for item in relations if item.free_symbols & symbols]
    return [item for item in relations if item not in about], about
