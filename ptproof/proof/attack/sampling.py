"""Points at which every assumption holds: exact values, the awkward ones among them, and concrete functions."""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

import sympy as sp

from ptproof.proof.attack.elementary import fits
from ptproof.proof.attack.evaluator import Evaluator
from ptproof.proof.attack.fields import Range
from ptproof.proof.attack.functions import START, Concrete, Maker
from ptproof.proof.attack.isolation import Isolated
from ptproof.proof.attack.kinds import fits_kind, holds
from ptproof.proof.attack.numbers import NotReal, Number, Undefined, Unsure, exact
from ptproof.proof.attack.preparation import Bound, Prepared
from ptproof.proof.attack.quantified import satisfied
from ptproof.proof.attack.scope import Inadmissible, Scope, Work
from ptproof.proof.attack.tree import tree
from ptproof.proof.attack.values import Drawer
from ptproof.proof.statement import ForAll

MISSES = (Unsure, Undefined, NotReal, Inadmissible, OverflowError, ZeroDivisionError, ValueError, RecursionError)
_SWEEPS = 5
_LIMIT = 200_000  # nodes that are evaluated at most, also within one point
_POOL = 15  # functions for each undefined one
_ROUNDS = 3  # of these, before others are drawn


@dataclass(frozen=True)
class Point:
    """Exact values of the free symbols, some of them by an expression in the others, and concrete functions.

    ``open`` are the quantified assumptions of which it has to be looked up whether they hold for these functions: the
    others do by how the functions were made.
    """

    values: Mapping[Any, Fraction]
    defined: tuple[tuple[Any, sp.Expr], ...] = ()
    functions: Mapping[Any, Concrete] = field(default_factory=dict)
    open: tuple[ForAll, ...] = ()
    work: Work = field(default_factory=Work, compare=False)
    made: dict[int, Evaluator] = field(default_factory=dict, compare=False, repr=False)

    def changed(self, atom: Any, value: Fraction) -> Point:
        """The point with another value of one symbol."""
        return replace(self, values={**self.values, atom: value}, made={})

    def evaluator(self, digits: int) -> Evaluator:
        """An evaluator at this point; raises what evaluating a value that is defined may raise."""
        if digits in self.made:
            return self.made[digits]
        evaluator = Evaluator(digits, self.functions, self.work)
        evaluator.point = Scope.of({atom: exact(value) for atom, value in self.values.items()})
        for atom, expression in self.defined:
            value = evaluator.number(expression, evaluator.point)
            if not fits(atom, value, evaluator.calculus):
                raise Inadmissible(f"{atom} is {value}")
            evaluator.point = evaluator.point.joined(atom, value)
        self.made[digits] = evaluator
        return evaluator


class Sampler:
    """Draws admissible points of a prepared goal, in an order that the seed decides."""

    def __init__(self, goal: Prepared, id: str, seed: int) -> None:
        self.goal = goal
        self.seed = seed
        self.random = random.Random(f"{id}:{seed}")
        self.drawer = Drawer(goal.atoms, goal.parts, self.random, moderate=_needs_moderation(goal))
        self.makers = [(node.func, Maker(node, goal.atoms)) for node in goal.functions]
        self.ends: dict[Any, list[tuple[Isolated, str]]] = {}
        for bound in goal.bounds:
            for one in bound.isolated:
                self.ends.setdefault(one.atom, []).append((one, bound.relation.sign))
        self.openings = [_open(goal, frozenset()), *(_open(goal, setting.items) for setting in goal.settings)]
        self.attempt = 0
        self.work = Work(limit=_LIMIT)

    def points(self) -> Iterator[Point | None]:
        """Points that are admissible, and None for each attempt that led to none."""
        while True:
            try:
                point = self._settled(self._draw())
            except MISSES:
                point = None
            self.attempt += 1
            yield point

    def _draw(self) -> Point:
        generator = self.random
        again, number = divmod(self.attempt, _POOL)
        functions = {
            function: maker.drawn(f"{self.seed}:{again // _ROUNDS}:{k}", number)
            for k, (function, maker) in enumerate(self.makers)
        }
        if self.goal.solutions and generator.random() < 0.75:
            functions.update(_without_circles(generator.sample(self.goal.solutions, len(self.goal.solutions))))
        opening, letters = self.openings[0], {}
        if self.goal.settings and generator.random() < 0.9:
            number = generator.choice(range(len(self.goal.settings)))
            opening, setting = self.openings[1 + number], self.goal.settings[number]
            functions.update(setting.functions)
            letters = dict(setting.letters)
            letters.update({letter: self._within_range(interval) for letter, interval in setting.ranges})
        functions.update(self.goal.defined)
        functions.update({function: draw(self.random) for function, draw in self.goal.limited})
        defined, taken = self._definitions(letters)
        values = self.drawer.values(self.attempt, taken)
        values[START] = generator.choice((Fraction(1), Fraction(1, 3), Fraction(5), Fraction(1, 50)))
        return Point(values, defined, functions, opening, self.work)

    def _within_range(self, interval: Range) -> sp.Rational:
        """A value of a letter for which a field satisfies its assumptions: mostly the best one."""
        share = self.random.choice((sp.S.One, sp.S.One, sp.S.One, sp.Rational(2, 3), sp.Rational(1, 3)))
        if interval.high is None:
            return interval.low / share
        return share * interval.high + (1 - share) * (interval.low or 0)

    def _definitions(self, letters: Mapping[Any, sp.Expr]) -> tuple[tuple[tuple[Any, sp.Expr], ...], set[Any]]:
        """Symbols that a field or equalities give, and some that are put at the end of an inequality."""
        found: dict[Any, sp.Expr] = dict(letters)
        bounds = list(self.goal.bounds)
        self.random.shuffle(bounds)
        bounds.sort(key=lambda bound: bound.relation.sign != "=")
        for bound in bounds:
            sign = bound.relation.sign
            if sign in ("<", ">", "!=") or (sign != "=" and self.random.random() < 0.55):
                continue
            choices = [one for one in bound.isolated if one.atom not in found]
            choices.sort(key=lambda one: not one.plain)
            for one in choices:
                if not _reaches(one.bound, one.atom, found):
                    found[one.atom] = one.bound
                    break
            if bound.roots:
                atom, root = self.random.choice(bound.roots)
                if atom not in found and not _reaches(root, atom, found):
                    found[atom] = root
        if self.goal.special and self.attempt % 3 == 1:
            special = self.random.choice(self.goal.special)
            atom, value = special.atom, special.bound
            if atom not in found and not _reaches(value, atom, found):
                found[atom] = value
        return _ordered(found), set(found)

    def _settled(self, point: Point) -> Point | None:
        """The point, changed where an assumption does not hold there; None if that does not help."""
        if not all(fits_kind(atom, value) for atom, value in point.values.items() if atom is not START):
            return None
        for _ in range(_SWEEPS):
            evaluator = point.evaluator(50)
            broken = [bound for bound in self.goal.bounds if not holds(bound.relation, evaluator)]
            if not broken:
                return point if satisfied(point.open, evaluator, dense=False) else None
            changed = self._repaired(point, broken, evaluator)
            if changed is None:
                return None
            point = changed
        return None

    def _repaired(self, point: Point, broken: list[Bound], evaluator: Evaluator) -> Point | None:
        bound = self.random.choice(broken)
        atoms = [one.atom for one in bound.isolated if one.atom in point.values]
        self.random.shuffle(atoms)
        for atom in atoms:
            value = self._within(atom, evaluator)
            if value is not None:
                return point.changed(atom, value)
        rest = sorted((atom for atom in bound.atoms if atom in point.values), key=str)
        return self._tried(point, bound, rest)

    def _within(self, atom: Any, evaluator: Evaluator) -> Fraction | None:
        """A value of the atom between all the ends that assumptions give it."""
        low: Number | None = None
        high: Number | None = None
        numbers, strict = evaluator.calculus.numbers, False
        for one, said in self.ends.get(atom, ()):
            if said == "!=":
                continue
            end = evaluator.number(one.bound, evaluator.point)
            sign = numbers.sign(evaluator.number(one.factor, evaluator.point))
            strict = strict or said in ("<", ">")
            upper = (said in ("<", "<=")) == (sign > 0)
            if (upper or said == "=") and (high is None or numbers.sign(numbers.sub(end, high)) < 0):
                high = end
            if (not upper or said == "=") and (low is None or numbers.sign(numbers.sub(end, low)) > 0):
                low = end
        return self.drawer.between(atom, low, high, strict)

    def _tried(self, point: Point, bound: Bound, atoms: list[Any]) -> Point | None:
        """The first of some other values of one atom at which the assumption holds."""
        for atom in self.random.sample(atoms, min(3, len(atoms))):
            for value in self.drawer.others(atom, point.values[atom]):
                changed = point.changed(atom, value)
                try:
                    if holds(bound.relation, changed.evaluator(50)):
                        return changed
                except MISSES:
                    continue
        return None


def _open(goal: Prepared, settled: frozenset[ForAll]) -> tuple[ForAll, ...]:
    """The quantified assumptions that hold neither by definition nor with what is ``settled``."""
    return tuple(item for item in goal.quantified if item not in goal.definitions and item not in settled)


def _without_circles(solutions: list[tuple[Any, Concrete]]) -> dict[Any, Concrete]:
    """One function each, none of which is defined through itself."""
    found: dict[Any, Concrete] = {}

    def through(function: Any, seen: set[Any]) -> set[Any]:
        if function in found and function not in seen:
            for other in found[function].inside:
                seen |= {function} | through(other, seen | {function}) | {other}
        return seen

    for function, concrete in solutions:
        if function not in found:
            inside = concrete.inside
            if function not in inside.union(*(through(other, set()) for other in inside)):
                found[function] = concrete
    return found


def _reaches(expression: sp.Expr, atom: Any, found: Mapping[Any, sp.Expr]) -> bool:
    """Whether the expression depends on the atom, also through what was defined before."""
    inside = tree(expression).letters
    if tree(atom) in inside:
        return True
    return any(tree(other) in inside and _reaches(inner, atom, found) for other, inner in found.items())


def _ordered(found: Mapping[Any, sp.Expr]) -> tuple[tuple[Any, sp.Expr], ...]:
    """Each definition after those that it depends on."""
    rest, order = {tree(atom): tree(body) for atom, body in found.items()}, []
    while rest:
        atom = next(one for one, body in rest.items() if not body.letters & (rest.keys() - {one}))
        order.append((atom.expression, rest.pop(atom).expression))
    return tuple(order)


def _needs_moderation(goal: Prepared) -> bool:
    """Limits and integrals, and "for all" without an end, are looked at up to some size: the values must fit that."""
    return bool(goal.quantified) or goal.smooth or any(part.has(sp.Limit, sp.Integral) for part in goal.parts)
