"""Fields with motions in them: functions and letters that belong together, drawn at once."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.attack.concrete import Concrete
from ptproof.proof.attack.fields import Field, Range, fields
from ptproof.proof.attack.functions import solutions
from ptproof.proof.attack.pushed import pushes
from ptproof.proof.attack.putting import concretely
from ptproof.proof.attack.trajectories import Motion, drifts, is_equation, motions
from ptproof.proof.statement import ForAll

_FIELDS = 4  # that are looked at


@dataclass(frozen=True)
class Setting:
    """A field with a motion in it: functions and letters that belong together, and the assumptions that then hold."""

    functions: tuple[tuple[Any, Concrete], ...]
    letters: tuple[tuple[Any, sp.Expr], ...]
    ranges: tuple[tuple[Any, Range], ...]
    items: frozenset[ForAll]


@lru_cache(maxsize=64)
def settings(
    quantified: tuple[ForAll, ...], used: frozenset[ForAll], given: tuple[tuple[Any, Concrete], ...]
) -> tuple[Setting, ...]:
    """Each field that is found, with each motion in it."""
    defined = dict(given)
    found = []
    rest = tuple(item for item in quantified if item not in used)
    ends = list(itertools.chain.from_iterable(solutions(item) for item in rest if len(item.variables) == 1))
    ends = [(function, concrete) for function, concrete in ends if concrete.body.is_Symbol]
    system = tuple(item for item in rest if is_equation(item))
    for k, field in enumerate(fields(rest, ends)[:_FIELDS]):
        every = (
            ({**dict(field.functions), **others}, zeros)
            for others in drifts(system, {**defined, **dict(field.functions)})
            for zeros in _zeros(system, {**defined, **dict(field.functions), **others})
        )
        choices = list(itertools.islice(every, k + 1 if k else None))  # all of them in the first field, else one
        for functions, zeros in choices[k % len(choices) :][: 1 if k else None]:
            letters = {**dict(field.letters), **zeros}
            for motion in motions(system, {**defined, **functions}, letters) if system else [Motion(())]:
                found.append(_setting(field, functions, letters, motion, field.items))
    pushed = _bounds_of_drifts(rest, system)
    for field in fields([item for item in rest if item not in pushed], ends)[:2] if pushed else ():
        functions, letters = dict(ends) | dict(field.functions), dict(field.letters)
        for motion in pushes(system, pushed, {**defined, **functions}, letters):
            found.append(_setting(field, functions, letters, motion, field.items | frozenset(pushed)))
    return tuple(found)


def _zeros(system: Iterable[ForAll], functions: Mapping[Any, Concrete]) -> list[dict[Any, sp.Expr]]:
    """Nothing, and 0 for all letters that may be any number and stand in the rates, but not in the times."""
    rates = [concretely(item.relation.right, functions) for item in system]
    times = {letter for item in system for part in item.domain for letter in part.free_symbols}
    signless = {
        letter for rate in rates for letter in rate.free_symbols - times
        if letter.is_real and letter.is_nonnegative is None and letter.is_nonpositive is None
    }  # fmt: skip
    return [{}, dict.fromkeys(sorted(signless, key=str), sp.S.Zero)] if signless else [{}]


def _setting(
    field: Field, functions: Mapping[Any, Concrete], letters: Mapping[Any, sp.Expr], motion: Motion,
    items: frozenset[ForAll],
) -> Setting:  # fmt: skip
    letters = {**letters, **dict(motion.letters)}
    made = {**functions, **dict(motion.functions)}
    return Setting(tuple(made.items()), tuple(letters.items()), field.ranges, items)


def _bounds_of_drifts(items: Iterable[ForAll], system: Iterable[ForAll]) -> list[ForAll]:
    """The assumptions on several variables about functions that stand in the rates of a system, and not in a slope."""
    inside = {node.func for item in system for node in item.relation.right.atoms(AppliedUndef)}
    sloped = {
        node.func for item in items for side in (item.relation.left, item.relation.right)
        for rate in side.atoms(sp.Derivative) for node in rate.atoms(AppliedUndef)
    }  # fmt: skip
    return [
        item for item in items if len(item.variables) > 1
        and any(item.relation.has(function) for function in inside - sloped)
    ]  # fmt: skip
