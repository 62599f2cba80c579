"""Real inequalities by z3: a statement follows if its negation is unsatisfiable.

Whatever is not arithmetic becomes a generator (:mod:`ptproof.proof.algebra`), an unknown real number about
which only a few safe facts are told: its sign, sin² + cos² = 1, (√b)² = b, |x|² = x². A proof for all values
of the generators is a proof for the values that they have; a counterexample is only a candidate.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import sympy as sp

from ptproof.proof.algebra import Generators, NotAlgebraic
from ptproof.proof.claim import Goal, engine
from ptproof.proof.definedness import Obligation, domain_of
from ptproof.proof.engines.terms import (
    asked,
    comparison_term,
    implication_term,
    known_of,
    known_of_value,
    library,
    solver_by,
    term,
)
from ptproof.proof.facts import Fact, is_said, usable
from ptproof.proof.statement import Implication, Relation, free_symbols, relations_of, undefined_functions
from ptproof.proof.verdict import Evidence, Verdict

SECONDS = 20.0
_SECONDS_TO_CONTRADICT = 0.5
# Far more than it takes where it is enough, so that a busy machine does not change the verdict.
_SECONDS_TOLD = 4.0
_SECONDS_ALONE = 0.1  # most of what follows without facts does so in a twentieth of a second
_SECONDS_TO_BE_DEFINED = 5.0
_ABSURD = Relation(sp.S.One, "<", sp.S.Zero)


@dataclass(frozen=True)
class Answer:
    """Whether something is shown, and how, or what was tried."""

    shown: bool
    how: str


@engine
def reals(goal: Goal, *lemmas: Fact, seconds: float | None = None) -> Evidence:
    """Show the goal's relations from its assumptions, the claims that it uses, and the ``lemmas``."""
    # The limits that the goal uses say nothing to z3.
    facts = [fact for fact in usable(goal, (*goal.facts, *lemmas)) if not _speaks_of_limits(fact)]
    parts = relations_of(goal.statement)
    for part in parts:
        answer = follows(part, goal.relations, facts, seconds=seconds, where_defined=goal.where_defined)
        if not answer.shown:
            return Evidence("z3", Verdict.UNDECIDED, f"{part}: {answer.how}")
    names = sorted({fact.source for fact in facts if fact.source})
    told = f" with {', '.join(names)}" if names else ""
    detail = f"the negation is unsatisfiable over the reals{told}"
    if len(parts) > 1:
        detail += f" ({len(parts)} parts)"
    return Evidence("z3", Verdict.PROVED, detail, facts=lemmas)


def contradictory(assumptions: Sequence[Relation]) -> bool:
    """Whether the assumptions are shown to contradict each other, so that everything follows from them."""
    return bool(assumptions) and _follows(_ABSURD, assumptions, (), _SECONDS_TO_CONTRADICT).shown


def _speaks_of_limits(fact: Implication) -> bool:
    return any(part.has(sp.Limit) for part in (*fact.hypotheses, fact.conclusion))


def follows(
    conclusion: Relation,
    assumptions: Sequence[Relation],
    facts: Sequence[Implication] = (),
    *,
    seconds: float | None = None,
    where_defined: bool = False,
) -> Answer:
    """Whether ``conclusion`` is shown to follow over the reals: that both sides are defined, and that it holds.

    It is tried without the facts first: fewer powers and products make an easier problem. With ``where_defined`` it
    may be undefined somewhere, and has to hold elsewhere.
    """
    seconds = SECONDS if seconds is None else seconds
    known = list(assumptions)
    needs = list(domain_of(conclusion))
    if where_defined:
        known += [_relation(need) for need in needs if need.necessary and not need.given]
    elif not (defined := are_met(needs, known, facts, seconds=min(seconds, _SECONDS_TO_BE_DEFINED))).shown:
        return defined
    return _shown(conclusion, known, facts, seconds)


def _shown(conclusion: Relation, known: Sequence[Relation], facts: Sequence[Implication], seconds: float) -> Answer:
    """Without the facts for a short time, then with them."""
    alone = _follows(conclusion, known, (), min(seconds / 8, _SECONDS_ALONE) if facts else seconds)
    if alone.shown or not facts:
        return alone
    together = _follows(conclusion, known, facts, seconds)
    # What facts make no easier may only have needed longer.
    return together if together.shown or "no answer" not in alone.how else _follows(conclusion, known, (), seconds)


def are_met(
    needs: Sequence[Obligation], assumptions: Sequence[Relation], facts: Sequence[Implication] = (), *,
    seconds: float | None = None,
) -> Answer:  # fmt: skip
    """Whether everything that an expression needs in order to be defined is shown to follow, one after the other."""
    known = list(assumptions)
    for need in needs:
        if need.relation is None:
            return Answer(False, str(need))
        given = [*known, *need.given]
        if need.settled or need.relation in given or is_said(need.relation, facts):
            continue
        answer = _shown(need.relation, given, facts, seconds or SECONDS)
        if not answer.shown:
            return Answer(False, f"{need} is not shown, without which {need.node} is not defined: {answer.how}")
        if not need.given:
            known.append(need.relation)
    return Answer(True, ", ".join(dict.fromkeys(map(str, needs))))


def _follows(
    conclusion: Relation, assumptions: Sequence[Relation], facts: Sequence[Implication], seconds: float
) -> Answer:
    """What z3 says; a third of the questions about a claim are asked more than once, of its parts and their domains."""
    return _answered(conclusion, tuple(dict.fromkeys(assumptions)), tuple(facts), seconds)


@lru_cache(maxsize=4096)
def _answered(
    conclusion: Relation, assumptions: tuple[Relation, ...], facts: tuple[Implication, ...], seconds: float
) -> Answer:
    try:
        problem = Problem(conclusion, assumptions, facts)
    except NotAlgebraic as error:
        return Answer(False, str(error))
    return asked(lambda: _asked(problem, bool(facts), seconds))


def _asked(problem: Problem, told_facts: bool, seconds: float) -> Answer:
    z3, tried = library(), []
    # What the facts say may be enough, whatever the roots in them are roots of.
    told, most = bool(problem.generators.relations and told_facts), int(1000 * min(seconds / 5, _SECONDS_TOLD))
    if told and problem.solver("qfnra-nlsat", most, opaque=True).check() == z3.unsat:
        return Answer(True, "z3 (qfnra-nlsat)")
    # z3's own choice comes to nlsat in most cases, after probing and other attempts that cost as much as the answer:
    # it comes second, and is not worth it before the facts are told.
    for tactic in ("qfnra-nlsat", "default") if seconds > _SECONDS_ALONE else ("qfnra-nlsat",):
        context = problem.solver(tactic, int(500 * seconds))
        answer = context.check()
        if answer == z3.unsat:
            return Answer(True, f"z3 ({tactic})")
        if answer == z3.sat:
            return Answer(False, f"z3 ({tactic}) finds values of the generators that satisfy the negation")
        tried.append(f"{tactic}: {context.reason_unknown()}")
    return Answer(False, f"z3 gave no answer in {seconds:g} s ({'; '.join(tried)})")


class Problem:
    """The relations as rational functions in generators, beside what is known of the generators.

    An assumption is known to be defined; the hypotheses of a fact hold only where they are.
    """

    def __init__(self, conclusion: Relation, assumptions: Sequence[Relation], facts: Sequence[Implication]) -> None:
        spoken_of = [conclusion, *assumptions]
        values = free_symbols(spoken_of) | undefined_functions(spoken_of)
        if unknown := {value for value in values if not value.is_real}:
            names = ", ".join(sorted(map(str, unknown)))
            raise NotAlgebraic(f"not declared real: {names}")
        told = [Implication((), part) for part in assumptions]
        told += [Implication(need.given, _relation(need)) for need in _domains(assumptions) if need.necessary]
        for fact in facts:
            where = tuple(_relation(need) for need in _domains(fact.hypotheses) if not need.given)
            told.append(Implication((*fact.hypotheses, *where), fact.conclusion, fact.source))
        relations = [conclusion, *(part for fact in told for part in (*fact.hypotheses, fact.conclusion))]
        self.generators = Generators(real=True)
        prepared = self.generators.read([side for relation in relations for side in (relation.left, relation.right)])
        sides = iter([self.generators.rational(side) for side in prepared])
        read = iter([Relation(next(sides), relation.sign, next(sides)) for relation in relations])
        self.conclusion = next(read)
        self.told = [Implication(tuple(next(read) for _ in fact.hypotheses), next(read)) for fact in told]
        self.bases = {symbol: self.generators.rational(base) for symbol, base in self.generators.bases.items()}
        found = ((symbol, self.generators.choice(symbol)) for symbol in self.generators.meaning)
        self.choices = [(symbol, choice) for symbol, choice in found if choice is not None]
        self.pieces = {symbol: self.generators.pieces(symbol) for symbol in self.generators.meaning}
        self._asserted: dict[bool, list[Any]] = {}

    def solver(self, tactic: str, milliseconds: int, *, opaque: bool = False) -> Any:
        """What z3 is asked, for one of its strategies; ``opaque`` leaves out what is known of roots and angles."""
        solver = solver_by(tactic)
        solver.set("timeout", max(milliseconds, 1))
        if opaque not in self._asserted:
            self._asserted[opaque] = list(self.assertions(opaque))
        solver.add(*self._asserted[opaque])
        return solver

    def assertions(self, opaque: bool = False) -> Iterator[Any]:
        """What z3 is told: one for each of ``told``, in its order, and then what is known of the generators."""
        z3, used = library(), dict[sp.Symbol, None]()

        def number(expression: sp.Expr) -> Any:
            told, symbols = term(expression)
            used.update(symbols)
            return told

        def relation(item: Relation) -> Any:
            told, symbols = comparison_term(item)
            used.update(symbols)
            return told

        for fact in self.told:
            said, symbols = implication_term(fact)
            used.update(symbols)
            yield said
        for generator, polynomial in () if opaque else self.generators.relations:
            holds = number(polynomial) == 0
            if generator in self.bases:
                # The power of a negative base is not real; a fact that mentions it says nothing of the base's sign.
                holds = z3.Implies(number(self.bases[generator]) >= 0, holds)
            yield holds
        for generator, (operation, arguments) in self.choices:
            symbol, values = number(generator), [number(argument) for argument in arguments]
            yield z3.Or([symbol == value for value in values])
            for value in values:
                yield symbol >= value if operation is sp.Max else symbol <= value
        for symbol, pieces in self.pieces.items():
            before: list[Any] = []
            for value, condition in pieces:
                here = [z3.Not(entry) for entry in before]
                if condition is not None:
                    before.append(relation(Relation(*condition)))
                    here.append(before[-1])
                yield z3.Implies(z3.And(here), number(symbol) == number(value))
        yield z3.Not(relation(self.conclusion))
        for base, product in self.generators.split_bases():
            value = number(product)
            yield from [value == number(base)] if base.is_Rational else known_of_value(base, value)
        for symbol in used:
            yield from known_of(symbol, self.generators.meaning.get(symbol))


def _domains(relations: Sequence[Relation]) -> Iterator[Obligation]:
    """What holds wherever the relations are defined.

    Raises
    ------
    NotAlgebraic
        If a part of them is not known to be real: it would be taken for a real number here.
    """
    for relation in relations:
        for need in domain_of(relation):
            if need.relation is not None:
                yield need
            elif not isinstance(need.node, sp.Limit | sp.Integral | sp.Sum | sp.Product):
                raise NotAlgebraic(str(need))


def _relation(need: Obligation) -> Relation:
    assert need.relation is not None
    return need.relation
