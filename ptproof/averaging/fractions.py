"""A normal form of zero for long sums: polynomials over products of denominators, modulo sin² + cos² = 1 and roots.

Not the algebra in which averages are expanded (:mod:`ptproof.averaging.ring`): what that finds is checked with this.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeVar

import sympy as sp
from flint import Ordering, fmpq, fmpq_mpoly_ctx

from ptproof.averaging.refusal import AveragingUndecided

Polynomial = Any
Answer = TypeVar("Answer")
Below = tuple[tuple[int, int], ...]  # (number of the denominator, its power)
Sum = dict[Below, Polynomial]


class Full(Exception):
    """More letters were met than there is room for; the same again with more."""


class Finer(Exception):
    """A part of an angle or an exponent was met that is no multiple of those before; the same again, finer."""


def reading(work: Callable[[Fractions], Answer], most: int = 1536) -> Answer:
    """``work`` with an algebra that has room for all its letters, and units of which all angles are multiples.

    Raises
    ------
    AveragingUndecided
        If it takes more than ``most`` letters.
    """
    room, units = 96, dict[sp.Expr, int]()
    while True:
        try:
            return work(Fractions(room, units))
        except Finer:
            continue
        except Full:
            room *= 4
            if room > most:
                raise AveragingUndecided(f"more than {most} different functions") from None


class Fractions:
    """Reads expressions as sums of polynomials over denominators.

    >>> x, k = sp.symbols("x k", real=True)
    >>> algebra = Fractions()
    >>> algebra.vanishes(map(algebra.read, [sp.sin(2 * x) / (1 + k**2), -2 * sp.sin(x) * sp.cos(x) / (1 + k**2)]))
    True
    """

    def __init__(self, room: int = 96, units: dict[sp.Expr, int] | None = None) -> None:
        # {a: q}: multiples of a in angles and exponents are multiples of a/q.
        self._units: dict[sp.Expr, int] = {} if units is None else units
        self._context = fmpq_mpoly_ctx.get([f"t{i}" for i in range(room)], Ordering.lex)
        self._letters = self._context.gens()
        self._known: dict[sp.Expr, Polynomial] = {}
        self._meanings: list[sp.Expr] = []
        self._relations: list[Polynomial] = []
        self._denominators: list[Polynomial] = []
        self._read: dict[sp.Expr, Sum] = {}
        self._slopes: dict[tuple[int, sp.Symbol], Sum] = {}

    def vanishes(self, sums: Iterable[Sum]) -> bool:
        """Whether the total has the normal form 0; True is a proof wherever all of it is defined."""
        total: Sum = {}
        for entry in sums:
            _add(total, entry)
        return bool(self._numerator(total)[0] == 0)

    def simplest(self, value: Sum) -> Sum:
        """The same without the terms that vanish by the relations."""
        reduced = {below: self._reduced(part) for below, part in value.items()}
        return {below: part for below, part in reduced.items() if part != 0}

    def letters(self, value: Sum) -> set[sp.Expr]:
        """What stands in the sum."""
        polynomials = [*value.values(), *(self._denominators[index] for below in value for index, _ in below)]
        return {
            self._meanings[place] for part in polynomials for place, degree in enumerate(part.degrees()) if degree > 0
        }

    def expression(self, value: Sum) -> sp.Expr:
        """The sum as a SymPy expression."""
        return sp.Add(
            *(
                self._terms(part) / sp.Mul(*(self._terms(self._denominators[index]) ** power for index, power in below))
                for below, part in value.items()
            )
        )

    def _terms(self, part: Polynomial) -> sp.Expr:
        terms = []
        for exponents, number in part.terms():
            powers = (self._meanings[i] ** int(power) for i, power in enumerate(exponents) if power)
            terms.append(sp.Mul(sp.Rational(int(number.p), int(number.q)), *powers))
        return sp.Add(*terms)

    def _constant(self, value: Any) -> Polynomial:
        return self._context.constant(value)

    def read(self, expression: sp.Expr) -> Sum:
        """The expression as a sum of fractions."""
        if expression not in self._read:
            self._read[expression] = self._reading(expression)
        return self._read[expression]

    def _reading(self, expression: sp.Expr) -> Sum:
        if expression.is_Rational:
            return {(): self._constant(fmpq(int(expression.p), int(expression.q)))} if expression != 0 else {}
        if expression.is_Add:
            total: Sum = {}
            for term in expression.args:
                _add(total, self.read(term))
            return total
        if expression.is_Mul:
            result: Sum = {(): self._constant(1)}
            for factor in expression.args:
                result = self.product(result, self.read(factor))
            return result
        if expression.is_Pow and expression.exp.is_Rational:
            return self._power(expression.base, expression.exp)
        if isinstance(expression, sp.sin | sp.cos):
            cosine, sine = self._angle(expression.args[0])
            return {(): sine if isinstance(expression, sp.sin) else cosine}
        if isinstance(expression, sp.exp):
            return self._exponential(expression.args[0])
        return {(): self._letter(expression)}

    def _exponential(self, argument: sp.Expr) -> Sum:
        """e^argument as powers of one letter for each term, its numerical factor left out."""
        result: Sum = {(): self._constant(1)}
        for term in sp.Add.make_args(sp.expand(argument)):
            count, part = self._part(term)
            power: Sum = {(): self._letter(sp.exp(part)) ** abs(count)}
            result = self.product(result, power if count >= 0 else self._inverse(power))
        return result

    def _part(self, term: sp.Expr) -> tuple[int, sp.Expr]:
        """(n, a) with ``term`` = n a, where a is the same for all rational multiples of it."""
        number, rest = term.as_coeff_Mul()
        unit = self._units.setdefault(rest, int(number.q))
        if unit % number.q:
            self._units[rest] = int(sp.ilcm(unit, number.q))
            raise Finer
        return int(number * unit), rest / unit

    def _letter(self, meaning: sp.Expr) -> Polynomial:
        if meaning not in self._known:
            if len(self._known) == len(self._letters):
                raise Full
            self._known[meaning] = self._letters[len(self._known)]
            self._meanings.append(meaning)
        return self._known[meaning]

    def derivative(self, value: Sum, symbol: sp.Symbol) -> Sum:
        """∂value/∂symbol; of each letter it is what SymPy says."""
        result: Sum = {}
        for below, part in value.items():
            for place, slope in self._moving(part, symbol):
                _add(result, self.product({below: part.derivative(place)}, slope))
            for index, power in below:
                bottom = self._denominators[index]
                raised = tuple((i, p + (i == index)) for i, p in below)
                for place, slope in self._moving(bottom, symbol):
                    _add(result, self.product({raised: -power * part * bottom.derivative(place)}, slope))
        return result

    def _moving(self, part: Polynomial, symbol: sp.Symbol) -> Iterator[tuple[int, Sum]]:
        """The letters of a polynomial that depend on the symbol, with their derivatives."""
        for place, degree in enumerate(part.degrees()):
            if degree > 0:
                if (place, symbol) not in self._slopes:
                    self._slopes[place, symbol] = self.read(sp.diff(self._meanings[place], symbol))
                if slope := self._slopes[place, symbol]:
                    yield place, slope

    def product(self, first: Sum, second: Sum) -> Sum:
        result: Sum = {}
        for (below, value), (other, factor) in itertools.product(first.items(), second.items()):
            powers = dict(below)
            for index, power in other:
                powers[index] = powers.get(index, 0) + power
            _add(result, {tuple(sorted(powers.items())): self._reduced(value * factor)})
        return result

    def _reduced(self, value: Polynomial) -> Polynomial:
        for relation in self._relations:
            if value != 0:
                value = divmod(value, relation)[1]
        return value

    def _power(self, base: sp.Expr, exponent: sp.Rational) -> Sum:
        value = self.read(base)
        if exponent.q != 1:
            known = len(self._known)
            root = self._letter(base ** sp.Rational(1, exponent.q))
            if len(self._known) > known:
                above, below = self._numerator(value)
                self._relations.append(root**exponent.q * below - above)
            value = {(): root}
        result: Sum = {(): self._constant(1)}
        for _ in range(abs(int(exponent.p))):
            result = self.product(result, value)
        return self._inverse(result) if exponent.p < 0 else result

    def _inverse(self, value: Sum) -> Sum:
        above, below = self._numerator(value)
        if above == 0:
            raise AveragingUndecided("a denominator vanishes identically")
        content, factors = above.factor()
        powers: dict[int, int] = {}
        for factor, power in factors:
            if factor not in self._denominators:
                self._denominators.append(factor)
            powers[self._denominators.index(factor)] = int(power)
        return {tuple(sorted(powers.items())): below * (1 / fmpq(content))}

    def _numerator(self, value: Sum) -> tuple[Polynomial, Polynomial]:
        """Numerator and denominator of the sum, brought together."""
        highest: dict[int, int] = {}
        for below in value:
            for index, power in below:
                highest[index] = max(power, highest.get(index, 0))
        total, bottom = self._constant(0), self._constant(1)
        for index, power in highest.items():
            bottom *= self._denominators[index] ** power
        for below, part in value.items():
            powers = dict(below)
            for index, power in highest.items():
                part *= self._denominators[index] ** (power - powers.get(index, 0))
            total += self._reduced(part)
        return self._reduced(total), bottom

    def _angle(self, argument: sp.Expr) -> tuple[Polynomial, Polynomial]:
        """(cos, sin) of a sum, from those of its terms."""
        cosine, sine = self._constant(1), self._constant(0)
        for term in sp.Add.make_args(sp.expand(argument)):
            c, s = self._multiple(*self._part(term))
            cosine, sine = self._reduced(cosine * c - sine * s), self._reduced(sine * c + cosine * s)
        return cosine, sine

    def _multiple(self, count: int, angle: sp.Expr) -> tuple[Polynomial, Polynomial]:
        known = len(self._known)
        own_sine, own_cosine = self._letter(sp.sin(angle)), self._letter(sp.cos(angle))
        if len(self._known) > known:
            self._relations.append(own_sine**2 + own_cosine**2 - 1)
        cosine, sine = self._constant(1), self._constant(0)
        for _ in range(abs(count)):
            cosine, sine = (
                self._reduced(cosine * own_cosine - sine * own_sine),
                self._reduced(sine * own_cosine + cosine * own_sine),
            )
        return cosine, sine if count >= 0 else -sine


def _add(result: Sum, more: Sum) -> None:
    for below, value in more.items():
        result[below] = result[below] + value if below in result else value


def total(*sums: Sum) -> Sum:
    """The sum of sums."""
    result: Sum = {}
    for entry in sums:
        _add(result, entry)
    return result
