"""Concrete functions of several variables for which assumptions "for all positions" hold exactly.

A field F is drawn as a power of the distance from the origin or as a quadratic form; other functions are 0. Whether an
assumption holds for it, and for which values of the constants in it, is decided by comparing polynomials whose terms
are numbers times even powers: no grid is believed here.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import isqrt
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.attack.concrete import Concrete
from ptproof.proof.attack.putting import concretely, put
from ptproof.proof.statement import ForAll, expressions_of

_POWERS = (1, 2, 3)
_MOST = 60  # combinations that are looked at
_FINE = 10**6


@dataclass(frozen=True)
class Range:
    """The values of a positive letter for which an assumption holds, ends included; None where there is no end."""

    low: sp.Rational | None = None
    high: sp.Rational | None = None

    def __and__(self, other: Range) -> Range:
        lows = [end for end in (self.low, other.low) if end is not None]
        highs = [end for end in (self.high, other.high) if end is not None]
        return Range(max(lows, default=None), min(highs, default=None))

    @property
    def empty(self) -> bool:
        return self.high is not None and (self.high <= 0 or (self.low is not None and self.low > self.high))


@dataclass(frozen=True)
class Field:
    """Functions for which assumptions on several variables hold, where the letters have the values given.

    Attributes
    ----------
    functions
        The functions.
    letters
        Letters with one value each.
    ranges
        Positive letters that may have any value of a range.
    items
        The assumptions that then hold.
    """

    functions: tuple[tuple[Any, Concrete], ...]
    letters: tuple[tuple[Any, sp.Expr], ...]
    ranges: tuple[tuple[Any, Range], ...]
    items: frozenset[ForAll]


def fields(items: Sequence[ForAll], ends: Iterable[tuple[Any, Concrete]]) -> list[Field]:
    """Fields for the assumptions on several variables among the ``items`` that define no function.

    ``ends`` are functions that satisfy the assumptions on one variable.
    """
    several = tuple(item for item in items if len(item.variables) > 1)
    if not several:
        return []
    inside = {node.func for item in several for e in expressions_of([item]) for node in e.atoms(AppliedUndef)}
    given = tuple({function: concrete for function, concrete in ends if function in inside}.items())
    return list(_fields(several, given, frozenset(_shaped(items))))


def _shaped(items: Iterable[ForAll]) -> Iterator[Any]:
    """The functions of which a slope, or values at several places, are spoken of."""
    sides = [side for item in items for side in (item.relation.left, item.relation.right)]
    for rate in set().union(*(side.atoms(sp.Derivative) for side in sides)):
        yield from (node.func for node in rate.atoms(AppliedUndef) if len(node.args) > 1)
    for item in items:
        nodes = item.relation.left.atoms(AppliedUndef) | item.relation.right.atoms(AppliedUndef)
        functions = [node.func for node in nodes if len(node.args) > 1]
        yield from (function for function in functions if functions.count(function) > 1)


@lru_cache(maxsize=64)
def _fields(
    several: tuple[ForAll, ...], given: tuple[tuple[Any, Concrete], ...], shaped: frozenset[Any]
) -> tuple[Field, ...]:
    sides = [side for item in several for side in (item.relation.left, item.relation.right)]
    applied = {node.func: node for side in sides for node in sorted(side.atoms(AppliedUndef), key=str)}
    letters = set().union(*(side.free_symbols for side in sides)) - {x for item in several for x in item.variables}
    whole = sorted((letter for letter in letters if letter.is_integer), key=str)
    origin = tuple((letter, sp.S.Zero) for letter in sorted(letters, key=str) if _any_real(letter))
    choices: list[list[tuple[Any, Concrete]]] = []
    for function, node in sorted(applied.items(), key=str):
        if function in dict(given):
            choices.append([(function, dict(given)[function])])
        else:
            drawn = _shapes(len(node.args)) if function in shaped else _nothing(len(node.args))
            choices.append([(function, concrete) for concrete in drawn])
    found = []
    for functions in itertools.islice(itertools.product(*choices), _MOST):
        for counts in itertools.product(_POWERS, repeat=len(whole)):
            values = (*origin, *zip(whole, map(sp.Integer, counts), strict=True))
            ranges = _all_hold(several, functions, values)
            if ranges is not None:
                found.append(Field(functions, values, tuple(ranges.items()), frozenset(several)))
                break
    return tuple(found)


def _any_real(letter: sp.Symbol) -> bool:
    return (
        bool(letter.is_real) and letter.is_positive is None and letter.is_nonnegative is None and not letter.is_integer
    )


def _shapes(count: int) -> Iterator[Concrete]:
    """Functions with their maximum 0 at the origin, and then with their minimum there."""
    places = tuple(sp.Symbol(f"_argument{i}", real=True) for i in range(count))
    square = sp.Add(*(place**2 for place in places))
    weighted = sp.Add(*((k + 1) * place**2 for k, place in enumerate(places)))
    yield from (Concrete(places, -body) for body in (square, square**2, weighted / 2, square**3, square / 3))
    yield from (Concrete(places, body) for body in (square, square**2))


def _nothing(count: int) -> list[Concrete]:
    return [Concrete(tuple(sp.Symbol(f"_argument{i}", real=True) for i in range(count)), sp.S.Zero)]


def _all_hold(
    several: Iterable[ForAll], functions: Sequence[tuple[Any, Concrete]], values: Sequence[tuple[Any, sp.Expr]]
) -> dict[Any, Range] | None:
    """The ranges of the letters for which all the assumptions hold; None where they do for none, or nobody knows."""
    ranges: dict[Any, Range] = {}
    for item in several:
        sides = (item.relation.left, item.relation.right)
        here = tuple((function, concrete) for function, concrete in functions if any(e.has(function) for e in sides))
        found = _holds(item, here, tuple((letter, value) for letter, value in values if item.relation.has(letter)))
        if found is None:
            return None
        for letter, interval in found:
            ranges[letter] = ranges.get(letter, Range()) & interval
            if ranges[letter].empty:
                return None
    return ranges


@lru_cache(maxsize=4096)
def _holds(
    item: ForAll, functions: tuple[tuple[Any, Concrete], ...], values: tuple[tuple[Any, sp.Expr], ...]
) -> tuple[tuple[Any, Range], ...] | None:
    """For which values of one letter the assumption holds for these functions at all values of its variables."""
    relation = item.relation.standard()
    if relation.sign != "<=":
        return None
    letters = {x: sp.Symbol(f"_place{i}", real=True) for i, x in enumerate(item.variables)}
    put_in: Mapping[Any, Any] = {**dict(values), **letters}
    sides = [concretely(put(side, put_in), dict(functions)) for side in (relation.left, relation.right)]
    if any(side.has(AppliedUndef, sp.Derivative, sp.Subs) for side in sides):
        return None
    places = tuple(letters.values())
    left, right = sides
    if (straight := _even(right - left, places)) is not None and all(term.is_nonnegative for term in straight.values()):
        return ()
    if not right.is_nonnegative:
        return None
    low, high = _even(left**2, places), _even(right**2, places)
    if low is None or high is None:
        return None
    if all((high.get(key, 0) - low.get(key, 0)).is_nonnegative for key in {*low, *high}):
        return ()
    return _ranges(low, high)


@lru_cache(maxsize=1024)
def _even(expression: sp.Expr, places: tuple[sp.Symbol, ...]) -> dict[tuple[int, ...], sp.Expr] | None:
    """The coefficients of a polynomial in which every term has even powers only."""
    polynomial = sp.expand(expression).as_poly(*places)
    if polynomial is None or any(n % 2 for powers, _ in polynomial.terms() for n in powers):
        return None
    return {powers: coefficient for powers, coefficient in polynomial.terms() if coefficient != 0}


def _ranges(low: Mapping[Any, sp.Expr], high: Mapping[Any, sp.Expr]) -> tuple[tuple[Any, Range], ...] | None:
    """Where ``low`` ≤ ``high`` term by term, one side of which is a power of a positive letter times numbers."""
    inside = set().union(*(term.free_symbols for term in (*low.values(), *high.values())))
    if len(inside) != 1 or not (letter := inside.pop()).is_positive:
        return None
    below, above = _with_power(low, letter), _with_power(high, letter)
    if (
        below is None
        or above is None
        or min(*low.values(), *high.values(), key=lambda t: t.subs(letter, 1)).subs(letter, 1) < 0
    ):
        return None
    (down, least), (up, most) = below, above
    if down and not up and set(low) <= set(high):
        return ((letter, Range(high=_root(min(most[key] / least[key] for key in low), down, -1))),)
    if up and not down and set(low) <= set(high):
        return ((letter, Range(low=_root(max(least[key] / most[key] for key in low), up, 1))),)
    return None


def _with_power(terms: Mapping[Any, sp.Expr], letter: sp.Symbol) -> tuple[int, dict[Any, sp.Rational]] | None:
    """The power of the letter that all terms have, and their numbers."""
    powers = {term.as_coeff_exponent(letter)[1] for term in terms.values()} or {sp.S.Zero}
    power = powers.pop()
    numbers = {key: term / letter**power for key, term in terms.items()}
    if powers or not (power.is_Integer and power >= 0) or not all(number.is_Rational for number in numbers.values()):
        return None
    return int(power), numbers


def _root(value: sp.Rational, degree: int, away: int) -> sp.Rational:
    """The root of a positive number if it is rational, else a number close to it: below it, or above."""
    exact = sp.root(value, degree)
    if exact.is_Rational:
        return exact
    if degree != 2:
        return sp.Rational(int(sp.floor(exact * _FINE)) + (away > 0), _FINE)
    whole = isqrt(int(value.p) * _FINE**2 // int(value.q))
    return sp.Rational(whole + (away > 0), _FINE)
