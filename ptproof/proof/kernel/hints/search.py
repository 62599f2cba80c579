"""Hints by several steps: roots and cases are taken out of a goal, and what is left is closed in one of many ways."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Iterator, Sequence

import sympy as sp

from ptproof.proof.kernel.hints.bases import by_zero, lettered
from ptproof.proof.kernel.hints.cases import factored, split
from ptproof.proof.kernel.hints.cauchy import with_products
from ptproof.proof.kernel.hints.certificates import certificate
from ptproof.proof.kernel.hints.circular import by_circular_bounds
from ptproof.proof.kernel.hints.forms import by_form
from ptproof.proof.kernel.hints.goals import Goal, Way, one_of
from ptproof.proof.kernel.hints.halflines import by_halflines
from ptproof.proof.kernel.hints.multiples import by_multiples
from ptproof.proof.kernel.hints.roots import dominated, roots_of_facts, squared_symbols
from ptproof.proof.kernel.hints.substitutions import powers_back, substituted
from ptproof.proof.kernel.terms import NoTranslation
from ptproof.proof.statement import Relation

_MOST_CASES = 3
# For the hints of one goal with all its cases; what is found later is not tried.
_MOST_SECONDS = 20.0
_CLOSING: tuple[Way, ...] = (by_form, by_multiples, by_halflines, by_circular_bounds)


def by_steps(goal: Goal, others: Sequence[Way] = ()) -> Iterator[str]:
    """Tactics for the whole goal.

    Parameters
    ----------
    goal
        What is to be shown, and what is known.
    others
        More ways to close a goal without roots and cases.
    """
    lines: list[str] = []
    simpler = goal
    try:
        for step in (powers_back, factored, substituted, lettered):
            more, simpler = step(simpler)
            lines += more
        yield "; ".join([*lines, _cases(simpler, others, _MOST_CASES, time.thread_time() + _MOST_SECONDS)])
    except (NoTranslation, sp.PolynomialError):
        return


def _cases(goal: Goal, others: Sequence[Way], left: int, until: float) -> str:
    if left and (sides := by_zero(goal)) is not None:
        line, *both = sides
        tactics = [_cases(each, others, left - 1, until) for each in both]
        return f"{line}; [> zero_powers; {tactics[0]} | positive_powers; {tactics[1]} ]"
    found = split(goal) if left else None
    if found is None:
        return _without_cases(goal, others, until)
    line, goals = found
    return f"{line}; [> {' | '.join(f'facts; {_cases(each, others, left - 1, until)}' for each in goals)} ]"


def _without_cases(goal: Goal, others: Sequence[Way], until: float) -> str:
    if goal.relation.sign == "=":
        sides = goal.relation.left, goal.relation.right
        both = [Goal(Relation(a, "<=", b), goal.known, goal.names) for a, b in (sides, sides[::-1])]
        parts = " | ".join(_without_cases(each, others, until) for each in both)
        return f"first [ solve [ quickly; equality ] | solve [ known_values ] | between; [> {parts} ] ]"
    hints: list[str] = []
    for step in (squared_symbols, roots_of_facts, with_products):
        lines, simpler = step(goal)
        if lines:
            hints.append("; ".join([*lines, one_of(_closed(simpler, others, until))]))
    hints += [f"{line}; {one_of(_closed(simpler, others, until))}" for line, simpler in dominated(goal)]
    hints += _closed(goal, others, until)
    return one_of(hints)


def _by_chain(goal: Goal) -> Iterator[str]:
    """A chain of inequalities, where powers have unknown exponents."""
    if any(not power.exp.is_Rational for power in goal.atoms(sp.Pow)):
        yield from certificate(goal.relation, goal.known, goal.names)


def _closed(goal: Goal, others: Sequence[Way], until: float) -> Iterator[str]:
    for way in (*_CLOSING, _by_chain, *others):
        if time.thread_time() > until:
            return
        with contextlib.suppress(NoTranslation, sp.PolynomialError):
            yield from way(goal)
