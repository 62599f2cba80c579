"""Points at which every assumption holds: exact values, the awkward ones among them, and concrete functions."""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import sympy as sp

from ptproof.proof.attack.concrete import Concrete
from ptproof.proof.attack.declared import UNTESTED
from ptproof.proof.attack.elementary import meets
from ptproof.proof.attack.evaluator import Evaluator
from ptproof.proof.attack.fields import Range
from ptproof.proof.attack.functions import START, Maker
from ptproof.proof.attack.isolation import Isolated
from ptproof.proof.attack.kinds import fits_kind
from ptproof.proof.attack.numbers import Exact, NotReal, Number, Undefined, Unsure
from ptproof.proof.attack.preparation import Bound, Prepared
from ptproof.proof.attack.quantified import Everywhere, everywhere, satisfied
from ptproof.proof.attack.scope import Inadmissible, Scope, Work
from ptproof.proof.attack.settings import Setting
from ptproof.proof.attack.tree import Name, Node, named, tree
from ptproof.proof.attack.values import Drawer
from ptproof.proof.statement import ForAll

MISSES = (Unsure, Undefined, NotReal, Inadmissible, OverflowError, ZeroDivisionError, ValueError, RecursionError)
_SWEEPS = 5
_LIMIT = 200_000  # nodes that are evaluated at most, also within one point
_POOL = 15  # functions for each undefined one
_ROUNDS = 3  # of these, before others are drawn
_STARTS = (Exact(1), Exact(1, 3), Exact(5), Exact(1, 50))  # of a constant of integration


@dataclass(frozen=True)
class Point:
    """Exact values of the free symbols, some of them by an expression in the others, and concrete functions.

    ``open`` are the quantified assumptions of which it has to be looked up whether they hold for these functions: the
    others do by how the functions were made.
    """

    values: Mapping[Node, Exact]
    defined: tuple[tuple[Node, Node], ...] = ()
    functions: Mapping[Name, Concrete] = field(default_factory=dict)
    open: tuple[Everywhere, ...] = ()
    work: Work = field(default_factory=Work, compare=False)
    made: dict[int, Evaluator] = field(default_factory=dict, compare=False, repr=False)

    @property
    def by_function(self) -> dict[Any, Concrete]:
        """The concrete functions, by the undefined ones as SymPy has them."""
        return {name.function: concrete for name, concrete in self.functions.items()}

    def changed(self, atom: Node, value: Exact) -> Point:
        """The point with another value of one symbol."""
        return Point({**self.values, atom: value}, self.defined, self.functions, self.open, self.work)

    def evaluator(self, digits: int) -> Evaluator:
        """An evaluator at this point; raises what evaluating a value that is defined may raise."""
        if digits in self.made:
            return self.made[digits]
        evaluator = Evaluator(digits, self.functions, self.work)
        evaluator.point = Scope.of(dict(self.values))
        for atom, body in self.defined:
            value = evaluator.plain(body, evaluator.point)
            if not meets(atom.asked, value, evaluator.calculus):
                raise Inadmissible(f"{atom.expression} is {value}")
            evaluator.point = evaluator.point.joined(atom, value)
        self.made[digits] = evaluator
        return evaluator


class _Opening(NamedTuple):
    """Functions and letters that belong together, and what has still to be looked up then."""

    open: tuple[Everywhere, ...]
    functions: Mapping[Name, Concrete] = {}
    letters: Mapping[Node, Node] = {}
    ranges: tuple[tuple[Node, Range], ...] = ()


class Sampler:
    """Draws admissible points of a prepared goal, in an order that the seed decides."""

    def __init__(self, goal: Prepared, id: str, seed: int) -> None:
        self.goal = goal
        self.seed = seed
        self.random = random.Random(f"{id}:{seed}")
        self.start = tree(START)
        self.drawer = Drawer(tuple(map(tree, goal.atoms)), self.random, moderate=_needs_moderation(goal))
        self.makers = [(named(node.func), Maker(node, goal.atoms)) for node in goal.functions]
        self.solutions = [(named(function), concrete) for function, concrete in goal.solutions]
        self.defined = {named(function): concrete for function, concrete in goal.defined}
        self.limited = [(named(function), draw) for function, draw in goal.limited]
        self.ends: dict[Node, list[tuple[Isolated, str]]] = {}
        for bound in goal.bounds:
            for one in bound.isolated:
                self.ends.setdefault(one.letter, []).append((one, bound.relation.sign))
        self.bounds = [(bound, sorted(bound.isolated, key=lambda one: not one.plain)) for bound in goal.bounds]
        self.kinds = [atom for atom in self.drawer.atoms if atom.tests != UNTESTED]
        self.openings = [_Opening(_open(goal, frozenset())), *(_opening(goal, setting) for setting in goal.settings)]
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
        functions: dict[Name, Concrete] = {}
        if self.solutions and generator.random() < 0.75:
            functions.update(_without_circles(generator.sample(self.solutions, len(self.solutions))))
        opening, letters = self.openings[0], {}
        if self.goal.settings and generator.random() < 0.9:
            opening = self.openings[1 + generator.choice(range(len(self.goal.settings)))]
            functions.update(opening.functions)
            letters = dict(opening.letters)
            letters.update({letter: tree(self._within_range(interval)) for letter, interval in opening.ranges})
        functions.update(self.defined)
        functions.update({function: draw(self.random) for function, draw in self.limited})
        others = {
            function: functions.get(function) or maker.drawn(f"{self.seed}:{again // _ROUNDS}:{k}", number)
            for k, (function, maker) in enumerate(self.makers)
        }
        found = self._definitions(letters)
        values = self.drawer.values(self.attempt, found)
        values[self.start] = generator.choice(_STARTS)
        return Point(values, _ordered(found), others | functions, opening.open, self.work)

    def _within_range(self, interval: Range) -> sp.Rational:
        """A value of a letter for which a field satisfies its assumptions: mostly the best one."""
        share = self.random.choice((sp.S.One, sp.S.One, sp.S.One, sp.Rational(2, 3), sp.Rational(1, 3)))
        if interval.high is None:
            return interval.low / share
        return share * interval.high + (1 - share) * (interval.low or 0)

    def _definitions(self, found: dict[Node, Node]) -> dict[Node, Node]:
        """Letters that a field or equalities give, and some that are put at the end of an inequality."""
        bounds = list(self.bounds)
        self.random.shuffle(bounds)
        bounds.sort(key=lambda pair: pair[0].relation.sign != "=")
        for bound, choices in bounds:
            sign = bound.relation.sign
            if sign in ("<", ">", "!=") or (sign != "=" and self.random.random() < 0.55):
                continue
            for one in choices:
                if one.letter not in found and not _reaches(one.end, one.letter, found):
                    found[one.letter] = one.end
                    break
            if bound.roots:
                letter, root = self.random.choice(bound.roots)
                if letter not in found and not _reaches(root, letter, found):
                    found[letter] = root
        if self.goal.special and self.attempt % 3 == 1:
            special = self.random.choice(self.goal.special)
            if special.letter not in found and not _reaches(special.end, special.letter, found):
                found[special.letter] = special.end
        return found

    def _settled(self, point: Point) -> Point | None:
        """The point, changed where an assumption does not hold there; None if that does not help."""
        if not all(fits_kind(atom, point.values[atom]) for atom in self.kinds if atom in point.values):
            return None
        for _ in range(_SWEEPS):
            evaluator = point.evaluator(50)
            broken = [bound for bound in self.goal.bounds if not bound.sides.hold(evaluator, evaluator.point)]
            if not broken:
                return point if satisfied(point.open, evaluator, dense=False) else None
            changed = self._repaired(point, broken, evaluator)
            if changed is None:
                return None
            point = changed
        return None

    def _repaired(self, point: Point, broken: list[Bound], evaluator: Evaluator) -> Point | None:
        bound = self.random.choice(broken)
        atoms = [one.letter for one in bound.isolated if one.letter in point.values]
        self.random.shuffle(atoms)
        for atom in atoms:
            value = self._within(atom, evaluator)
            if value is not None:
                return point.changed(atom, value)
        return self._tried(point, bound, [atom for atom in bound.atoms if atom in point.values])

    def _within(self, atom: Node, evaluator: Evaluator) -> Exact | None:
        """A value of the atom between all the ends that assumptions give it."""
        low: Number | None = None
        high: Number | None = None
        numbers, strict = evaluator.calculus.numbers, False
        for one, said in self.ends.get(atom, ()):
            if said == "!=":
                continue
            end = evaluator.plain(one.end, evaluator.point)
            sign = numbers.sign(evaluator.plain(one.divisor, evaluator.point))
            strict = strict or said in ("<", ">")
            upper = (said in ("<", "<=")) == (sign > 0)
            if (upper or said == "=") and (high is None or numbers.sign(numbers.sub(end, high)) < 0):
                high = end
            if (not upper or said == "=") and (low is None or numbers.sign(numbers.sub(end, low)) > 0):
                low = end
        return self.drawer.between(atom, low, high, strict)

    def _tried(self, point: Point, bound: Bound, atoms: list[Node]) -> Point | None:
        """The first of some other values of one atom at which the assumption holds."""
        for atom in self.random.sample(atoms, min(3, len(atoms))):
            for value in self.drawer.others(atom, point.values[atom]):
                changed = point.changed(atom, value)
                try:
                    evaluator = changed.evaluator(50)
                    if bound.sides.hold(evaluator, evaluator.point):
                        return changed
                except MISSES:
                    continue
        return None


def _open(goal: Prepared, settled: frozenset[ForAll]) -> tuple[Everywhere, ...]:
    """The quantified assumptions that hold neither by definition nor with what is ``settled``."""
    return tuple(everywhere(item) for item in goal.quantified if item not in goal.definitions and item not in settled)


def _opening(goal: Prepared, setting: Setting) -> _Opening:
    return _Opening(
        _open(goal, setting.items),
        {named(function): concrete for function, concrete in setting.functions},
        {tree(letter): tree(value) for letter, value in setting.letters},
        tuple((tree(letter), interval) for letter, interval in setting.ranges),
    )


def _without_circles(solutions: list[tuple[Name, Concrete]]) -> dict[Name, Concrete]:
    """One function each, none of which is defined through itself."""
    found: dict[Name, Concrete] = {}

    def through(function: Name, seen: set[Name]) -> set[Name]:
        if function in found and function not in seen:
            for other in found[function].through:
                seen |= {function} | through(other, seen | {function}) | {other}
        return seen

    for function, concrete in solutions:
        if function not in found:
            inside = concrete.through
            if function not in inside.union(*(through(other, set()) for other in inside)):
                found[function] = concrete
    return found


def _reaches(body: Node, atom: Node, found: Mapping[Node, Node]) -> bool:
    """Whether an expression depends on the atom, also through what was defined before."""
    inside = body.letters
    if atom in inside:
        return True
    return any(other in inside and _reaches(inner, atom, found) for other, inner in found.items())


def _ordered(found: Mapping[Node, Node]) -> tuple[tuple[Node, Node], ...]:
    """Each definition after those that it depends on."""
    rest, order = dict(found), []
    while rest:
        atom = next(
            one for one, body in rest.items() if not any(other in body.letters for other in rest if other is not one)
        )
        order.append((atom, rest.pop(atom)))
    return tuple(order)


def _needs_moderation(goal: Prepared) -> bool:
    """Limits and integrals, and "for all" without an end, are looked at up to some size: the values must fit that."""
    return bool(goal.quantified) or goal.smooth or any(part.has(sp.Limit, sp.Integral) for part in goal.parts)
