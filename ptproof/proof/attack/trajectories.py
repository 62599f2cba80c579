"""Concrete trajectories of a system of differential equations that a goal assumes, where one state moves alone."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.attack.concrete import Concrete
from ptproof.proof.attack.functions import VALUE, closed_forms
from ptproof.proof.attack.putting import concretely, put
from ptproof.proof.statement import ForAll


@dataclass(frozen=True)
class Motion:
    """Functions that satisfy a system together, where the letters have the values given."""

    functions: tuple[tuple[Any, Concrete], ...]
    letters: tuple[tuple[Any, sp.Expr], ...] = ()


def motions(items: Iterable[ForAll], functions: Mapping[Any, Concrete], letters: Mapping[Any, sp.Expr]) -> list[Motion]:
    """Solutions of the equations x' = rhs(s, x) among the ``items``, with these functions and letters put in.

    One state moves and the others are 0, where that satisfies their equations, maybe only if some letters that may be
    any number are 0. The constant of integration is the symbol ``START``.
    """
    rates = {state: put(concretely(rate, functions), letters) for state, rate in equations(items)}
    return list(_motions(tuple(rates.items())))


@lru_cache(maxsize=512)
def _motions(system: tuple[tuple[AppliedUndef, sp.Expr], ...]) -> tuple[Motion, ...]:
    rates, found = dict(system), []
    if any(rate.has(sp.Derivative, sp.Subs) for rate in rates.values()):
        return ()
    for moving in rates:
        rest = {other: sp.S.Zero for other in rates if other != moving}
        if not all(map(_may_vanish, rest)) or not _may_be_positive(moving):
            continue
        zeros: dict[Any, sp.Expr] = {}
        for other in rest:
            zeros.update(_at_rest(put(put(rates[other], rest), zeros)))
        if any(put(put(rates[other], rest), zeros) != 0 for other in rest):
            continue
        (time,) = moving.args
        right = put(put(rates[moving], {**rest, moving: VALUE}), zeros)
        right = sp.expand_mul(right.xreplace({sp.Abs(VALUE): VALUE}))
        right = sp.Add(*(sp.powsimp(term, combine="exp") for term in sp.Add.make_args(right)))
        if right.has(AppliedUndef, sp.Derivative, sp.Subs):
            continue
        place = sp.Symbol("_argument0", real=True)
        still = tuple((other.func, Concrete((place,), sp.S.Zero)) for other in rest)
        for form in closed_forms(right, VALUE, time, (1,)):
            moved = (moving.func, Concrete((place,), form.xreplace({time: place})))
            found.append(Motion((moved, *still), tuple(zeros.items())))
    return tuple(found)


def _at_rest(rate: sp.Expr) -> dict[Any, sp.Expr]:
    """A letter without a sign that makes the rate 0 where it is 0, if the rate is not 0 already."""
    if rate == 0:
        return {}
    letters = (letter for letter in rate.free_symbols if letter.is_real and letter.is_nonnegative is None)
    zero = (letter for letter in sorted(letters, key=str) if rate.subs(letter, 0) == 0)
    return dict.fromkeys(itertools.islice(zero, 1), sp.S.Zero)


def trajectories(items: Iterable[ForAll]) -> Iterator[tuple[Any, Concrete]]:
    """The functions of the motions that ask nothing of a letter.

    Whoever draws one of each function checks that they belong together, and that they satisfy the equations.
    """
    for motion in motions(items, {}, {}):
        if not motion.letters:
            yield from motion.functions


_SHARES = (sp.S.Zero, sp.Rational(-1, 3), sp.Rational(1, 4))


def drifts(items: Iterable[ForAll], functions: Mapping[Any, Concrete]) -> Iterator[dict[Any, Concrete]]:
    """Functions for those in the rates that have none: a multiple of the gradient of one of the ``functions``, or 0.

    The arguments that the gradient takes are the last ones.
    """
    nodes = set().union(*(rate.atoms(AppliedUndef) for _, rate in equations(items)))
    states = {state.func for state, _ in equations(items)}
    free = {node.func: len(node.args) for node in sorted(nodes, key=str) if node.func not in {*states, *functions}}
    potentials = [one for one in functions.values() if 1 < len(one.arguments) == len(free) and one.body != 0]
    for share in _SHARES if potentials and min(free.values()) >= len(free) else _SHARES[:1]:
        found = {}
        for k, (function, count) in enumerate(free.items()):
            places = tuple(sp.Symbol(f"_argument{i}", real=True) for i in range(count))
            body = sp.S.Zero
            if share:
                slope = sp.diff(potentials[0].body, potentials[0].arguments[k])
                moved = dict(zip(potentials[0].arguments, places[-len(free) :], strict=True))
                body = share * slope.subs(moved, simultaneous=True)
            found[function] = Concrete(places, body)
        yield found
        if not free:
            return


def is_equation(item: ForAll) -> bool:
    """Whether an assumption gives the rate of a function of one time."""
    return bool(list(equations([item])))


def equations(items: Iterable[ForAll]) -> Iterator[tuple[AppliedUndef, sp.Expr]]:
    """Each function of one time with its rate."""
    for item in items:
        left = item.relation.left
        if item.relation.sign != "=" or len(item.variables) != 1 or not isinstance(left, sp.Derivative):
            continue
        state = left.expr
        if (
            isinstance(state, AppliedUndef)
            and state.args == item.variables
            and left == sp.Derivative(state, state.args[0])
        ):
            yield state, item.relation.right


def _may_vanish(state: AppliedUndef) -> bool:
    return not (state.is_positive or state.is_negative or state.is_nonzero)


def _may_be_positive(state: AppliedUndef) -> bool:
    return not (state.is_negative or state.is_nonpositive or state.is_integer)
