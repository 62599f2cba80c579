"""A goal by contradiction: what z3 needs of all that is known, and products that cannot hold with the goal's negation.

z3 and a linear program say what to look at; Coq multiplies out what they point to.
"""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.algebra import NotAlgebraic
from ptproof.proof.definedness import domain_of
from ptproof.proof.kernel.hints.aligned import aligned
from ptproof.proof.kernel.hints.bases import by_zero, lettered, signs_of_bases
from ptproof.proof.kernel.hints.bounded import bounded, settled
from ptproof.proof.kernel.hints.cases import split
from ptproof.proof.kernel.hints.contradictions import refuted
from ptproof.proof.kernel.hints.enclosed import of_exponentials, of_powers, of_waves
from ptproof.proof.kernel.hints.exponents import by_one_power
from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.ground import Ground
from ptproof.proof.kernel.hints.masks import bottoms, hidden, masked, opaque, put_in
from ptproof.proof.kernel.hints.needed import can_be_told, needed
from ptproof.proof.kernel.hints.ordered import letters_in_order, ordered
from ptproof.proof.kernel.hints.positivstellensatz import SECONDS
from ptproof.proof.kernel.hints.slack import slackened
from ptproof.proof.kernel.hints.told import text_of
from ptproof.proof.kernel.terms import NoTranslation
from ptproof.proof.statement import Relation

_MOST_CASES = 2


def by_refutation(goal: Goal) -> Iterator[str]:
    """Tactics for the goal from what it needs alone, if that is found."""
    match goal.relation:
        case Relation(value, "!=", sp.S.Zero):
            signs = (
                (Relation(sp.S.Zero, "<", value), "Rgt_not_eq; red"),
                (Relation(value, "<", sp.S.Zero), "Rlt_not_eq"),
            )
            found = (
                f"apply {way}; {line}"
                for item, way in signs
                for line in _refuted_from_few(replace(goal, relation=item))
            )
            yield from itertools.islice(found, 1)
        case Relation(left, "<=" | ">=", right) if left == right or sp.expand(left - right) == 0:
            yield "first [ apply Rle_refl | apply Rge_refl | apply Req_le; rational | apply Req_ge; rational ]"
        case Relation(_, "<=" | "<" | ">=" | ">", _):
            yield from _refuted_from_few(goal)


def _refuted_from_few(goal: Goal, deeper: bool = True) -> Iterator[str]:
    """Tactics for the goal, ``deeper`` also for that what stands below a line is positive."""
    goal, equal = _with_equations(goal)
    known, bounds = _with_domains(goal), list[tuple[str, list[Relation]]]()
    if (core := _core(goal, known)) is None and (bounds := [*of_waves(goal), *of_powers(goal), *of_exponentials(goal)]):
        known += [item for _, facts in bounds for item in facts]
        core = _core(goal, known)
    if core is None:
        return
    facts, below = [*core, *signs_of_bases((goal.relation, *core), known)], list[str]()
    for bottom in dict.fromkeys(bottoms(Goal(goal.relation, core, goal.names))):
        if bottom.is_positive:
            continue
        positive = Relation(sp.S.Zero, "<", bottom)
        reasons = needed(positive, known) or ()
        if deeper and not all(map(_is_linear, reasons)):
            found = _refuted_from_few(replace(goal, relation=positive, known=reasons), deeper=False)
            below += [f"assert ({text_of(positive, goal.names)}) by (solve [ {line} ])" for line in found]
        facts += reasons
    facts = list(dict.fromkeys(facts))
    letters, focused = opaque(Goal(goal.relation, tuple(facts), goal.names))
    if inner := _by_branches(focused, _MOST_CASES, deeper):
        said = "".join(f"({text_of(item, goal.names)}) -> " for item in facts)
        lines = [line for line, found in bounds if any(item in facts for item in found)]
        lines += [f"assert ({text_of(item, goal.names)}) by lra" for item in equal if item in facts]
        yield "; ".join([*lines, f"only_from ({said}True)", *below, *letters, inner])


def _with_equations(goal: Goal) -> tuple[Goal, list[Relation]]:
    """The goal with an equation in the place of two inequalities, and these equations."""
    known = [item.standard() for item in goal.known]
    found: dict[Relation, Relation] = {}
    for item in known:
        if item.sign == "<=":
            for other in (Relation(item.right, "<=", item.left), Relation(-item.left, "<=", -item.right)):
                if other in known and other not in found:
                    found |= {item: Relation(item.left, "=", item.right)} | ({} if other == item else {other: item})
    equal = [item for item in found.values() if item.sign == "="]
    kept = (item for item, standard in zip(goal.known, known, strict=True) if standard not in found)
    return replace(goal, known=(*kept, *equal)), equal


def _ways(goal: Goal, deeper: bool) -> Iterator[tuple[list[str], Goal, float]]:
    """The goal in letters, in one way after the other, with the lines for these and how long to try."""
    if deeper and (found := ordered(goal, partial(_refuted_from_few, deeper=False))) is not None:
        yield *_in_letters(*found), SECONDS
    lines, plain = _in_letters([], goal)
    more, loose = slackened(plain)
    yield lines, plain, SECONDS / 2 if more else SECONDS
    if more:
        yield [*lines, *more], loose, SECONDS
    if deeper:
        more, there = letters_in_order(goal, partial(_refuted_from_few, deeper=False))
        if more:
            yield *_in_letters(more, there), SECONDS


def _in_letters(lines: list[str], goal: Goal) -> tuple[list[str], Goal]:
    for step in (aligned, masked, _without_functions, opaque, masked, by_one_power, lettered):
        more, goal = step(goal)
        lines = [*lines, *more]
    return lines, goal


def follows(goal: Goal) -> bool | None:
    """Whether z3 finds that the goal follows from what is known; None if it cannot be told."""
    if not can_be_told(goal.relation):
        return None
    return _core(goal, _with_domains(goal)) is not None


def _core(goal: Goal, known: Sequence[Relation]) -> tuple[Relation, ...] | None:
    """What is needed of all that is known; sums and derivatives are looked into only if they have to be."""
    seen = hidden(Goal(goal.relation, tuple(known), goal.names))
    if (core := needed(seen.relation, seen.known)) is not None:
        return tuple(item for item, masked in zip(known, seen.known, strict=True) if masked in core)
    return needed(goal.relation, known)


def _with_domains(goal: Goal) -> list[Relation]:
    """What is known, and what holds where this and the goal are defined."""
    needs = (need for item in goal.relations() for need in domain_of(item) if not need.settled and not need.given)
    return list(dict.fromkeys([*goal.known, *(need.relation for need in needs if need.relation is not None)]))


def _is_linear(item: Relation) -> bool:
    """Whether the relation is between sums of multiples of letters: Coq puts such together by itself."""
    gap = sp.expand(item.left - item.right)
    letters = gap.free_symbols
    return not letters or bool(gap.is_polynomial() and sp.Poly(gap, *letters).total_degree() <= 1)


def _without_functions(goal: Goal) -> tuple[list[str], Goal]:
    """Values of unknown functions, and of their derivatives, as numbers."""
    if not any(item.has(AppliedUndef, sp.Derivative) for item in goal.relations()):
        return [], goal
    ground = Ground.over(goal.names)
    relation = goal.relation.map(ground)
    spoken = [item for item in goal.known if item.has(AppliedUndef)]
    facts = [item.map(ground) for item in goal.known]
    again = [item.map(ground) for item in spoken]
    inner = Goal(relation, tuple(dict.fromkeys(facts)), ground.names)
    return [
        *ground.lines(),
        *(f"try (assert ({text_of(item, inner.names)}) by found_as)" for item in again),
        f"try (shown_as {inner.text(relation.left)} {inner.text(relation.right)})",
    ], inner


def _by_branches(goal: Goal, left: int, deeper: bool) -> str:
    """Without minima and the like if that will do; else one branch after the other; nothing if one fails.

    So are minima, maxima and absolute values of what would be written in another way.
    """
    for step in (partial(settled, shown=lambda inner: next(by_refutation(inner), "")), bounded):
        lines, goal = step(goal)
        if lines:
            inner = _by_branches(goal, left, deeper)
            return "; ".join([*lines, inner]) if inner else ""
    kinds = () if aligned(goal)[0] else (sp.Piecewise,)
    if left and (found := split(goal, *kinds)) is not None:
        line, goals = found
        each = [_by_branches(case, left - 1, deeper) for case in goals]
        return f"{line}; [> {' | '.join(f'facts; {tactic}' for tactic in each)} ]" if all(each) else ""
    lines, goal = put_in(goal)
    for before, there, seconds in _ways(goal, deeper):
        if inner := _by_cases(there, left, seconds):
            return "; ".join([*lines, *before, inner])
    return ""


def _by_cases(goal: Goal, left: int, seconds: float) -> str:
    """Bases of powers that may be 0, minima, maxima and absolute values one after the other; nothing if one fails."""
    if left and (sides := by_zero(goal)) is not None:
        line, zero, positive = sides
        both = [_by_cases(each, left - 1, seconds) for each in (zero, positive)]
        return f"{line}; [> zero_powers; {both[0]} | positive_powers; {both[1]} ]" if all(both) else ""
    if left and (found := split(goal)) is not None:
        line, goals = found
        each = [_by_cases(case, left - 1, seconds) for case in goals]
        return f"{line}; [> {' | '.join(f'facts; {tactic}' for tactic in each)} ]" if all(each) else ""
    with contextlib.suppress(NoTranslation, NotAlgebraic, sp.PolynomialError):
        return refuted(goal, seconds)
    return ""
