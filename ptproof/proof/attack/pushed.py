"""A drift that belongs to a chosen motion: the motion first, then the drift that makes it a solution.

In x' = G(s) f(θ(s), x) + rest(s, x) the motion is a power of G, and f the function of the time θ that is left for it.
It is taken if it is linear in that time, so that a bound of it is met at the ends of the time.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.attack.concrete import Concrete
from ptproof.proof.attack.functions import START, VALUE
from ptproof.proof.attack.putting import concretely, put
from ptproof.proof.attack.trajectories import Motion, equations
from ptproof.proof.statement import ForAll

_POWERS = (sp.S.Half, sp.S.One)
_ANY = (sp.S.Zero, sp.S.One)


def pushes(
    system: Iterable[ForAll], bounds: Sequence[ForAll], functions: Mapping[Any, Concrete],
    letters: Mapping[Any, sp.Expr],
) -> Iterator[Motion]:  # fmt: skip
    """Motions with the drift that belongs to each, for which the ``bounds`` of the drift hold."""
    rates = {state: put(concretely(rate, functions), letters) for state, rate in equations(system)}
    if any(rate.has(sp.Derivative, sp.Subs) for rate in rates.values()):
        return
    drifts = {node.func for rate in rates.values() for node in rate.atoms(AppliedUndef)} - {s.func for s in rates}
    for state in itertools.islice(rates, 1):
        rest = {other: sp.S.Zero for other in rates if other != state}
        moved = {**rest, state: VALUE}
        right = _expanded(put(rates[state], moved).xreplace({sp.Abs(VALUE): VALUE}))
        still = [_expanded(put(rates[other], moved)) for other in rest]
        nodes = [node for node in right.atoms(AppliedUndef) if node.func in drifts]
        if len(nodes) != 1 or any(_without_drifts(rate, drifts) != 0 for rate in still):
            continue
        (node,) = nodes
        weight = right.coeff(node)
        left = sp.expand(right - weight * node)
        if weight == 0 or left.has(node) or weight.has(VALUE):
            continue
        for power in _POWERS:
            found = _for(state, node, weight, left, power, _ends(bounds) or _ANY)
            if found is not None:
                yield from _bounded(state, node, found, drifts, bounds, functions, rest)


def _without_drifts(rate: sp.Expr, drifts: set[Any]) -> sp.Expr:
    return put(rate, {node: sp.S.Zero for node in rate.atoms(AppliedUndef) if node.func in drifts})


@lru_cache(maxsize=64)
def _expanded(expression: sp.Expr) -> sp.Expr:
    return sp.expand(expression)


@lru_cache(maxsize=256)
def _for(
    state: AppliedUndef,
    node: AppliedUndef,
    weight: sp.Expr,
    left: sp.Expr,
    power: sp.Rational,
    ends: tuple[sp.Expr, sp.Expr],
) -> tuple[sp.Expr, sp.Expr, sp.Symbol] | None:
    """The motion as a function of its time, and the drift as a function of the other time, if linear in that."""
    (time,) = state.args
    other = sp.Symbol("_argument0", real=True)
    factors = (factor.as_base_exp() for factor in sp.Mul.make_args(sp.factor(weight)))
    motion = START * sp.Mul(*(base ** (exponent * power) for base, exponent in factors))
    needed = (sp.diff(motion, time) - left.subs(VALUE, motion)) / weight
    backwards = _backwards(node.args[0], time, other)
    if backwards is None:
        return None
    low, high = ends
    middle = (low + high) / 2
    start, half = (needed.subs(time, sp.cancel(backwards.subs(other, place))) for place in (low, middle))
    drift = start + 2 * (half - start) * (other - low) / (high - low)
    return (motion, drift, other) if _agree(needed.subs(time, backwards), drift) else None


def _agree(one: sp.Expr, another: sp.Expr) -> bool:
    """Whether two expressions have the same values at a few places; that the motion is a solution is checked later."""
    letters = sorted(one.free_symbols | another.free_symbols, key=str)
    for k in (3, 7):
        numbers = {letter: sp.Rational(k * n + 2, n + k) for n, letter in enumerate(letters)}
        if one.xreplace(numbers) != another.xreplace(numbers):
            return False
    return True


@lru_cache(maxsize=64)
def _backwards(clock: sp.Expr, time: sp.Symbol, other: sp.Symbol) -> sp.Expr | None:
    """The time at which the clock, a quotient of two linear functions, shows the ``other``."""
    top, below = sp.fraction(sp.together(clock))
    linear = sp.expand(top - other * below).as_poly(time)
    if linear is None or linear.degree() != 1:
        return None
    slope, rest = linear.all_coeffs()
    return -rest / slope


def _bounded(
    state: AppliedUndef, node: AppliedUndef, found: tuple[sp.Expr, sp.Expr, sp.Symbol], drifts: set[Any],
    bounds: Sequence[ForAll], functions: Mapping[Any, Concrete], rest: Mapping[Any, sp.Expr],
) -> Iterator[Motion]:  # fmt: skip
    motion, drift, other = found
    places = tuple(sp.Symbol(f"_argument{i}", real=True) for i in range(len(node.args)))
    made = {function: Concrete(places, drift if function == node.func else sp.S.Zero) for function in drifts}
    letters: dict[Any, sp.Expr] = {}
    for item in bounds:
        size = _size(item, {**functions, **made}, drift, other)
        if size is None or size[0] in letters:
            return
        letters[size[0]] = size[1]
    place = (sp.Symbol("_argument0", real=True),)
    moving = {state.func: Concrete(place, motion.subs(state.args[0], place[0]))}
    moving |= {one.func: Concrete(place, sp.S.Zero) for one in rest}
    yield Motion(tuple({**made, **moving}.items()), tuple(letters.items()))


def _size(
    item: ForAll, functions: Mapping[Any, Concrete], drift: sp.Expr, other: sp.Symbol
) -> tuple[sp.Symbol, sp.Expr] | None:
    """The letter that bounds the drift in this assumption, and how large it has to be."""
    relation, time = item.relation.standard(), item.variables[0]
    left, right = (concretely(side, functions) for side in (relation.left, relation.right))
    moved = drift.subs(other, time)
    if relation.sign != "<=" or not right.is_Symbol or not right.is_nonnegative:
        return None
    if left**2 != moved**2 and sp.expand(left**2 - moved**2) != 0:
        return None
    size = sp.Abs(moved)
    if not moved.has(time):
        return right, size
    ends = _ends([item])
    if ends is None:
        return None
    first, last = (sp.Abs(sp.expand(moved.subs(time, end))) for end in ends)
    return right, (first + last + sp.Abs(first - last)) / 2


def _ends(items: Iterable[ForAll]) -> tuple[sp.Expr, sp.Expr] | None:
    """Between which ends the first variable of an assumption lies, if both are given."""
    for item in items:
        time = item.variables[0]
        ends = {part.sign[0]: part.right for part in item.domain if part.left == time}
        if set(ends) == {"<", ">"} and not any(end.has(*item.variables) for end in ends.values()):
            return ends[">"], ends["<"]
    return None
