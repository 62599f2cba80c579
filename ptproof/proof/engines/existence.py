"""Existence by a named value, and its refutation by values that defeat every choice."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import sympy as sp

from ptproof.proof.claim import Goal, admissible, engine
from ptproof.proof.engines.reals import follows, reals
from ptproof.proof.statement import All, Exists, Implication, Relation
from ptproof.proof.substitution import substitute_in
from ptproof.proof.verdict import Evidence, Verdict, Witness


@engine
def exists_by(goal: Goal, choice: Mapping[sp.Symbol, Any], *lemmas: Implication) -> Evidence:
    """Show "there is …" by values, which may depend on the universal symbols; the rest is a real inequality."""
    statement = goal.statement
    if not isinstance(statement, Exists) or set(choice) != set(statement.variables):
        return Evidence("existence", Verdict.UNDECIDED, "the values given are not for the variables that exist")
    for symbol, value in choice.items():
        if sp.sympify(value).free_symbols & set(statement.over):
            return Evidence("existence", Verdict.UNDECIDED, f"the value of {symbol} depends on what comes after it")
        if not admissible(symbol, value):
            return Evidence("existence", Verdict.UNDECIDED, f"{value} is not known to be what {symbol} may be")
    body = All(tuple(substitute_in(part, choice) for part in statement.body))
    shown = reals(replace(goal, statement=body), *lemmas)
    named = ", ".join(f"{symbol} = {value}" for symbol, value in choice.items())
    return Evidence("existence", shown.verdict, f"with {named}: {shown.detail}")


@engine
def defeats_every_choice(goal: Goal, values: Mapping[sp.Symbol, Any], lemmas: Sequence[Implication] = ()) -> Evidence:
    """Refute "there is A such that … for all x" by an x that depends on A and breaks the body for every A.

    One relation of the body is shown to fail for all values of A that its declaration allows. Assumptions about x
    restrict the x that count, so they are shown to hold for this one.
    """

    def undecided(detail: str) -> Evidence:
        return Evidence("counterexample family", Verdict.UNDECIDED, detail)

    statement = goal.statement
    if not isinstance(statement, Exists) or set(values) != set(statement.over):
        return undecided("values are needed for exactly the symbols after it")
    for symbol, value in values.items():
        if not admissible(symbol, value):
            return undecided(f"{value} is not known to be what {symbol} may be")
    facts = [*goal.facts, *lemmas]
    # What is assumed of a letter outside says nothing of the A that is asked for.
    outside, _ = _split(goal.relations, set(statement.variables))
    given, about_these = _split(outside, set(statement.over))
    for assumption in about_these:
        inside = follows(substitute_in(assumption, values), given, facts)
        if not inside.shown:
            return undecided(f"the values are not shown to satisfy {assumption}: {inside.how}")
    tried = []
    for part in statement.body:
        there = substitute_in(part, values)
        fails = follows(there.negation(), given, facts)
        if fails.shown:
            witness = Witness(_family(statement, values), str(there.left), str(there.right))
            detail = f"for every {', '.join(map(str, statement.variables))}: {there.negation()} ({fails.how})"
            return Evidence("counterexample family", Verdict.REFUTED, detail, witness=witness)
        tried.append(f"{there}: {fails.how}")
    return undecided("; ".join(tried))


def _split(relations: Sequence[Relation], symbols: set[sp.Symbol]) -> tuple[list[Relation], list[Relation]]:
    """The relations without and with any of the symbols."""
    about = [item for item in relations if item.free_symbols & symbols]
    return [item for item in relations if item not in about], about


def _family(statement: Exists, values: Mapping[sp.Symbol, Any]) -> dict[str, str]:
    return {str(symbol): "any" for symbol in statement.variables} | {str(s): str(v) for s, v in values.items()}
