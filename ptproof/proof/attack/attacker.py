"""Attacking a goal: points that its assumptions allow, and a relation that fails, or has no value, at one of them."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.attack.evaluator import Evaluator
from ptproof.proof.attack.exact import exact_values
from ptproof.proof.attack.kinds import holds
from ptproof.proof.attack.limiting import Grows
from ptproof.proof.attack.magnitudes import size, spread
from ptproof.proof.attack.numbers import NotReal, Undefined, Unsure, undisturbed
from ptproof.proof.attack.preparation import Prepared, prepared
from ptproof.proof.attack.quantified import satisfied
from ptproof.proof.attack.roughness import rough
from ptproof.proof.attack.sampling import MISSES, Point, Sampler
from ptproof.proof.attack.worth import text
from ptproof.proof.claim import Goal
from ptproof.proof.statement import Exists, Prose, Relation, Runs, Smooth, expressions_of

FAILS = "the relation fails"
UNDEFINED = "a side is undefined"
NOT_REAL = "a side is not real"
POINTS = 40
_MISSES_IN_A_ROW = 300
_WORK = 36_000  # evaluated nodes: about a third of a second
_SMOOTH_POINTS = 8
_CONFIRMING = 400_000  # evaluated nodes more, for a suspected failure
_FEW = 12  # points, with which a fourth of the work is enough
_INFINITE = (sp.oo, -sp.oo)
_DIGITS = (50, 100, 200)


@dataclass(frozen=True)
class Hit:
    """A point that the declarations and assumptions allow, at which the claim does not hold.

    Attributes
    ----------
    values
        Each symbol, or applied undefined function, and its exact value there.
    part
        The relation that does not hold.
    left, right
        The two sides there as decimal text; empty where a side has no value.
    what
        "the relation fails", "a side is undefined" or "a side is not real".
    """

    values: Mapping[Any, Any]
    part: Relation | Smooth
    left: str
    right: str
    what: str

    def __str__(self) -> str:
        where = ", ".join(f"{key} = {value}" for key, value in self.values.items())
        sides = f" ({self.left} against {self.right})" if self.left else ""
        return f"{self.what}: {self.part} at {where}{sides}"


@dataclass(frozen=True)
class Attack:
    """What an attack came to: at how many points the claim was evaluated, of how many tried, and what was hit."""

    points: int
    tried: int
    hit: Hit | None
    detail: str


def attack(goal: Goal, *, seed: int = 0, points: int = POINTS, seconds: float = math.inf) -> Attack:
    """Try the goal at up to ``points`` points that its assumptions allow, for at most about ``seconds``.

    Without a limit of time the work is limited: the same points are tried on every machine. Of 171 mutants that were
    hit within 60 points, none was hit after the fortieth, and of 237 that were hit at all, 95 in a hundred were before
    a sixth of the work was done.

    A hit is certain: all assumptions hold there, and at 50, 100 and 200 digits the two sides are apart by more than
    the error, or one of them has no real value. No hit proves nothing.
    """
    match goal.statement:
        case Prose():
            return Attack(0, 0, None, "not attacked: a statement in words")
        case Exists():
            return Attack(0, 0, None, "not attacked: no choice can be shown to be the wrong one by trying")
        case Runs() as said:
            from ptproof.proof.attack.runs import tried  # NumPy, which most small derivations do without

            found = tried(said, seed, seconds)
            hit = found.failure and Hit(*found.failure, FAILS)
            return Attack(found.runs, found.runs, hit, str(hit or f"attacked on {found.runs} runs in floats"))
    with undisturbed():
        return _attacked(goal, prepared(goal), seed, points, time.process_time() + seconds)


def _attacked(goal: Goal, ready: Prepared, seed: int, points: int, end: float) -> Attack:
    count, tried = 0, 0
    if ready.smooth:
        points = min(points, _SMOOTH_POINTS)
    for point in _candidates(ready, goal, seed, end):
        tried += 1
        if point is None:
            continue
        evaluated, hit = _at(goal, ready, point)
        count += evaluated
        if hit is not None:
            return Attack(count, tried, hit, str(hit))
        if count >= points or (evaluated and not ready.atoms and not ready.functions):
            break
    return Attack(count, tried, None, f"attacked at {count} points")


def points_of(
    goal: Goal, *, seed: int = 0, points: int = POINTS, seconds: float = math.inf
) -> Iterator[dict[Any, Any]]:
    """Points that the declarations and assumptions of the goal allow, with exact values; the same ones for a seed."""
    ready = prepared(goal)
    found = 0
    for point in _candidates(ready, goal, seed, time.process_time() + seconds):
        with undisturbed():
            confirmed = point is not None and _confirmed(ready, point)
        if point is not None and confirmed:
            yield exact_values(ready, point)
            found += 1
            if found >= points:
                return


def _candidates(ready: Prepared, goal: Goal, seed: int, end: float) -> Iterator[Point | None]:
    """Points and misses, until the work is done: the same number of them on every machine, where ``end`` is not met."""
    misses, found = 0, 0
    sampler = Sampler(ready, goal.id, seed)
    for point in sampler.points():
        yield point
        misses, found = (misses + 1, found) if point is None else (0, found + 1)
        enough = _WORK if found < _FEW else _WORK / 4
        if misses > _MISSES_IN_A_ROW or sampler.work.steps > enough or (end < math.inf and time.process_time() > end):
            return


def _at(goal: Goal, ready: Prepared, point: Point) -> tuple[bool, Hit | None]:
    """Whether every part could be evaluated at the point, and what is hit there."""
    if isinstance(goal.statement, Smooth):
        return _smooth_at(goal.statement, ready, point)
    suspects, complete = [], True
    try:
        evaluator = point.evaluator(_DIGITS[0])
    except MISSES:
        return False, None
    for part in ready.parts:
        found = _outcome(part, evaluator)
        if found is None:
            complete = False
        elif found:
            suspects.append(part)
    for part in suspects:
        hit = _confirmed_hit(goal, ready, point, part)
        if hit is not None:
            return True, hit
    return complete and not suspects, None


def _smooth_at(statement: Smooth, ready: Prepared, point: Point) -> tuple[bool, Hit | None]:
    try:
        found = rough(statement, ready, point, _DIGITS[0])
        if found and _confirmed(ready, point):
            again = [rough(statement, ready, point, digits) for digits in _DIGITS[1:]]
            if all(item == found for item in again):
                return True, Hit(exact_values(ready, point), statement, "", "", f"{FAILS}: {found}")
    except MISSES:
        return False, None
    return not found, None


def _outcome(part: Relation, evaluator: Evaluator) -> str | None:
    """What is wrong with the relation at the point: nothing (an empty text), one of three things, or not known."""
    try:
        return "" if _relation_holds(part, evaluator) else FAILS
    except Undefined:
        return UNDEFINED
    except NotReal:
        return NOT_REAL
    except Grows:
        return None
    except MISSES:
        return "" if _agree(part, evaluator) else None


def _agree(part: Relation, evaluator: Evaluator) -> bool:
    """Whether two sides that cannot be told apart are known well, as where an integral or a limit was approached."""
    numbers = evaluator.calculus.numbers
    try:
        apart = numbers.ball(
            numbers.sub(*(evaluator.number(side, evaluator.point) for side in (part.left, part.right)))
        )
    except MISSES:
        return False
    return size(apart) <= spread(apart) + 1 and spread(apart) < -15


def _relation_holds(part: Relation, evaluator: Evaluator) -> bool:
    """Whether it holds; a limit that grows beyond all bounds counts as infinite."""
    if not any(side is end for side in (part.left, part.right) for end in _INFINITE):
        try:
            return holds(part, evaluator)
        except Grows:
            return False
    if any(part.right is end for end in _INFINITE) and part.left.func.__name__ == "Limit" and part.sign == "=":
        try:
            evaluator.number(part.left, evaluator.point)
        except Grows as limit:
            return (part.right is sp.oo) == (limit.sign > 0)
        return False
    raise Unsure("infinite sides are compared for limits only")


def _confirmed(ready: Prepared, point: Point) -> bool:
    """Whether all assumptions hold at the point at every precision, on dense grids."""
    if not _trusted(ready, point):
        return False
    try:
        for digits in _DIGITS:
            evaluator = point.evaluator(digits)
            if not all(bound.sides.hold(evaluator, evaluator.point) for bound in ready.bounds):
                return False
            if not satisfied(point.open, evaluator, dense=digits == _DIGITS[0]):
                return False
    except MISSES:
        return False
    return _consistent(ready, point)


def _trusted(ready: Prepared, point: Point) -> bool:
    """Whether the functions are such that a grid can tell whether an assumption over several variables holds.

    Over one variable the places between those of the grid are looked at too; over several only functions that were
    made to satisfy such an assumption count, and one that speaks of numbers only is never certain to hold. What holds
    by how the functions were made is not asked.
    """
    made = dict.fromkeys(ready.defined) | dict.fromkeys(ready.solutions)
    several = [one.item for one in point.open if len(one.variables) > 1]
    found = [{node.func for e in expressions_of([item]) for node in e.atoms(AppliedUndef)} for item in several]
    inside: set[Any] = set().union(*found)
    if not all(found):
        return False
    drawn = ((name.function, concrete) for name, concrete in point.functions.items())
    return all((function, concrete) in made for function, concrete in drawn if function in inside)


def _consistent(ready: Prepared, point: Point) -> bool:
    """Whether a function that got values at several arguments got the same one at equal arguments."""
    evaluator = point.evaluator(_DIGITS[1])
    numbers = evaluator.calculus.numbers
    pinned = [atom for atom in ready.atoms if not atom.is_Symbol]
    try:
        for i, first in enumerate(pinned):
            for second in pinned[:i]:
                if first.func != second.func:
                    continue
                pairs = zip((*first.args, first), (*second.args, second), strict=True)
                signs = [
                    numbers.sign(numbers.sub(*(evaluator.number(side, evaluator.point) for side in pair)))
                    for pair in pairs
                ]
                if not any(signs[:-1]) and signs[-1]:
                    return False
    except MISSES:
        return False
    return True


def _confirmed_hit(goal: Goal, ready: Prepared, point: Point, part: Relation) -> Hit | None:
    point.work.limit += _CONFIRMING
    if not _confirmed(ready, point):
        return None
    found = {_outcome(part, point.evaluator(digits)) for digits in _DIGITS}
    if len(found) != 1 or not (what := found.pop()):
        return None
    if what != FAILS and goal.where_defined:
        return None
    left, right = _sides(part, point.evaluator(_DIGITS[1]))
    return Hit(exact_values(ready, point), part, left, right, what)


def _sides(part: Relation, evaluator: Evaluator) -> tuple[str, str]:
    try:
        return (
            text(evaluator.number(part.left, evaluator.point)),
            text(evaluator.number(part.right, evaluator.point)),
        )
    except MISSES:
        return "", ""
