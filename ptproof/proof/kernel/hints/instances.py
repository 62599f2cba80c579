"""Assumptions for all values, taken at the values that the rest of a claim speaks of."""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.kernel.declared import of_symbol
from ptproof.proof.kernel.hints.ground import Ground, calls, written
from ptproof.proof.kernel.hints.reduced import BINDERS
from ptproof.proof.kernel.obligations import Part
from ptproof.proof.kernel.terms import NoTranslation, term
from ptproof.proof.kernel.theorem import Proposition
from ptproof.proof.statement import ForAll, Relation

_ROUNDS = 3
_MOST = 14
_MOST_OF_ONE = 4
Values = Mapping[sp.Symbol, sp.Expr]
Called = tuple[AppliedUndef, tuple[int, ...]]
Shown = Callable[[Relation], Iterator[str]]


@dataclass(frozen=True)
class Instance:
    """The assumption ``part`` at ``values``: ``relations`` before the values are put in."""

    part: Part
    values: Values
    relations: tuple[Relation, ...]

    def plain(self) -> Iterator[Relation]:
        """The relations with the values in them, where nothing is bound."""
        for relation in self.relations:
            if not relation.has(*BINDERS):
                yield relation.map(lambda side: side.xreplace(dict(self.values)))


def instances(said: Proposition, known: Sequence[Relation]) -> list[Instance]:
    """Those at the calls of unknown functions in the conclusions, in what is known, and in other instances."""
    every = [(part, part.for_all) for part in said.premises if part.for_all is not None]
    spoken = [part.relation for part in said.conclusions if part.relation is not None]
    bases = [Relation(part.base, ">", sp.S.Zero) for part in said.conclusions if part.base is not None]
    targets = list(dict.fromkeys(_called([*spoken, *known])))
    found: dict[tuple[str, tuple[sp.Expr, ...]], Instance] = {}
    for _ in range(_ROUNDS):
        before = len(found)
        for part, for_all in every:
            for values in (*_matches(for_all, targets), *_said_at(for_all, [*spoken, *bases])):
                key = part.text, tuple(values.values())
                if key in found or sum(text == part.text for text, _ in found) >= _MOST_OF_ONE or len(found) >= _MOST:
                    continue
                found[key] = Instance(part, values, tuple(for_all.relation.components()))
        targets = list(dict.fromkeys([*targets, *(
            item for instance in found.values() for item in _called(instance.relations, instance.values)
        )]))  # fmt: skip
        if len(found) == before:
            break
    return list(found.values())


def lines(found: Sequence[Instance], said: Proposition, given: Mapping[str, str], shown: Shown) -> Iterator[str]:
    """For Coq. ``given`` are the names of hypotheses by their texts; ``shown`` says how a premise may be proved."""
    for number, instance in enumerate(found):
        name = f"instance_{number}"
        values = dict(instance.values)
        with contextlib.suppress(NoTranslation):
            places = " ".join(term(value, said.names) for value in values.values())
            steps = [f"pose proof ({given[instance.part.text]} {places}) as {name}", f"cbv beta in {name}"]
            steps += [f"premise {name} ltac:(fail)" for variable in values for _ in of_symbol(variable, "x")]
            for part in instance.part.body:
                hints: list[str] = []
                if part.relation is not None:
                    left, right = (side.xreplace(values) for side in (part.relation.left, part.relation.right))
                    with contextlib.suppress(NoTranslation, sp.PolynomialError):
                        hints = [f"solve [ {hint} ]" for hint in shown(Relation(left, part.relation.sign, right))]
                steps.append(f"premise {name} ltac:(first [ {' | '.join([*hints, 'fail'])} ])")
            # As the hints write it, with the values among what it says.
            ground = Ground.over(said.names)
            again = [written(item, ground.full) for item in at_values(instance, ground)]
            steps.append(f"last_of {name}")
            steps += [f"try (assert ({text}) by as_said {name}; clear {name})" for text in again[:1]]
            yield f"try ({'; '.join(steps)})"


def at_values(instance: Instance, ground: Ground) -> Iterator[Relation]:
    """What the instance says, without unknown functions."""
    with contextlib.suppress(NoTranslation):
        at = {variable: ground(value) for variable, value in instance.values.items()}
        for relation in instance.relations:
            yield relation.map(lambda side, at=at: ground(side, at))  # type: ignore[misc]


def _called(relations: Sequence[Relation], values: Values | None = None) -> Iterator[Called]:
    for relation in relations:
        for side in (relation.left, relation.right):
            yield from calls(side, values)


def _matches(for_all: ForAll, targets: Sequence[Called]) -> Iterator[dict[sp.Symbol, sp.Expr]]:
    """Values of the bound variables for which calls in the assumption become some of the targets."""
    patterns = list(dict.fromkeys(_called(list(for_all.relation.components()))))
    bound = set(for_all.variables)
    ways: list[dict[sp.Symbol, sp.Expr]] = []
    for (pattern, slots), (target, own) in itertools.product(patterns, targets):
        if slots == own and (values := _unified(pattern, target, {}, bound)):
            ways.append(values)
    whole = [way for way in ways if set(way) == bound]
    parts = [way for way in ways if set(way) != bound]
    for first, second in itertools.product(parts, parts):
        if set(first) | set(second) == bound and not set(first) & set(second):
            whole.append({**first, **second})
    seen = set()
    for way in whole:
        ordered = {variable: way[variable] for variable in for_all.variables}
        if (key := tuple(ordered.values())) not in seen:
            seen.add(key)
            yield ordered


def _said_at(for_all: ForAll, wanted: Sequence[Relation]) -> Iterator[dict[sp.Symbol, sp.Expr]]:
    """Values at which the assumption says what is wanted."""
    (variable, *others), (said, *more) = for_all.variables, for_all.relation.components()
    if others or more:
        return
    for item in wanted:
        for symbol in sorted(item.free_symbols, key=lambda symbol: symbol.name):
            if said.map(lambda side, symbol=symbol: side.xreplace({variable: symbol})) == item:  # type: ignore[misc]
                yield {variable: symbol}


def _unified(
    pattern: sp.Basic, target: sp.Basic, values: dict[sp.Symbol, sp.Expr], bound: set[sp.Symbol]
) -> dict[sp.Symbol, sp.Expr] | None:  # fmt: skip
    """The values of bound variables that make the pattern the target; only calls are looked into."""
    if pattern in bound:
        if values.setdefault(pattern, target) != target:
            return None
        return values
    if not pattern.free_symbols & bound:
        return values if pattern == target else None
    if not isinstance(pattern, AppliedUndef) or pattern.func != target.func or len(pattern.args) != len(target.args):
        return None
    for own, other in zip(pattern.args, target.args, strict=True):
        if _unified(own, other, values, bound) is None:
            return None
    return values
