"""What of all that is known a goal needs: an unsatisfiable core of z3's, which is a hint and no more."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

from ptproof.proof.algebra import NotAlgebraic
from ptproof.proof.engines.reals import Problem
from ptproof.proof.engines.terms import asked, library, solver_by
from ptproof.proof.statement import Relation

_MILLISECONDS = 3000
_MILLISECONDS_TO_SPARE = 400  # for leaving out one more


def needed(
    goal: Relation, known: Sequence[Relation], milliseconds: int = _MILLISECONDS
) -> tuple[Relation, ...] | None:  # fmt: skip
    """Few of the ``known`` relations from which the goal follows; None if that is not found in time.

    The goal and what is known may speak of anything that z3 takes for a real number.
    """
    return _needed(goal, tuple(dict.fromkeys(item for item in known if can_be_told(item))), milliseconds)


@lru_cache(maxsize=1024)
def _needed(goal: Relation, known: tuple[Relation, ...], milliseconds: int) -> tuple[Relation, ...] | None:
    try:
        problem = Problem(goal, known, ())
    except NotAlgebraic:
        return None
    return asked(lambda: _core(problem, known, milliseconds))


@lru_cache(maxsize=4096)
def can_be_told(item: Relation) -> bool:
    """Whether z3 can be told of the relation."""
    try:
        Problem(item, (), ())
    except NotAlgebraic:
        return False
    return True


def _core(problem: Problem, known: Sequence[Relation], milliseconds: int) -> tuple[Relation, ...] | None:
    """Without what is known of roots first: often it is not needed, and the problem is much simpler."""
    for opaque in (True, False) if problem.generators.relations else (False,):
        said = list(problem.assertions(opaque))
        if (found := _core_of(said, len(known), milliseconds)) is not None:
            return tuple(known[number] for number in found)
    return None


def _core_of(said: Sequence[Any], count: int, milliseconds: int) -> list[int] | None:
    """Numbers below ``count`` of what has to be said for a contradiction."""
    z3, solver = library(), solver_by("default")
    marks = [z3.Bool(f"needed!{number}") for number in range(len(said))]
    solver.add(*(z3.Implies(mark, item) for mark, item in zip(marks, said, strict=True)))
    solver.set("timeout", milliseconds)
    match solver.check(*marks):
        case z3.sat:
            return None
        case z3.unknown:
            return _few_of(said, count, milliseconds)

    def core() -> list[int]:
        found = {mark.decl().name() for mark in solver.unsat_core()}
        return [number for number, mark in enumerate(marks) if mark.decl().name() in found]

    left = core()
    solver.set("timeout", min(milliseconds, _MILLISECONDS_TO_SPARE))
    # The first ones are what is known, in its order; the others are what is known of generators.
    for number in [number for number in reversed(left) if number < count]:
        fewer = [other for other in left if other != number]
        if number in left and solver.check(*(marks[other] for other in fewer)) == z3.unsat:
            left = core()
    return [number for number in left if number < count]


def _few_of(said: Sequence[Any], count: int, milliseconds: int) -> list[int] | None:
    """The same by the strategy for polynomials, which knows no cores: one after the other is left out."""

    def contradicts(numbers: Sequence[int], most: int) -> bool:
        solver = solver_by("qfnra-nlsat")
        solver.set("timeout", most)
        solver.add(*(said[number] for number in numbers))
        return bool(solver.check() == library().unsat)

    left = list(range(len(said)))
    if not contradicts(left, milliseconds):
        return None
    for number in reversed(range(count)):
        fewer = [other for other in left if other != number]
        if contradicts(fewer, min(milliseconds, _MILLISECONDS_TO_SPARE)):
            left = fewer
    return [number for number in left if number < count]
