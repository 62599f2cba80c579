"""Values that are worth a try: awkward ones, equal ones, ones at which something vanishes, and random ones."""

from __future__ import annotations

import random
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Any

from ptproof.proof.attack.kinds import fits_kind
from ptproof.proof.attack.magnitudes import size
from ptproof.proof.attack.numbers import ONE, ZERO, Ball, Exact, Number, Unsure, exact, fraction
from ptproof.proof.attack.tree import Node

_PLAIN = ("1", "2", "0", "1/2", "-1", "3", "-2", "-1/2", "3/2", "5")
_SMALL = ("1/1000", "1/1000000000", "1/1000000000000000000000000000000", "-1/1000000000")
_LARGE = ("10", "100", "1000000", "100000000000000000000", "-1000000")
_HALVES = ("5/2", "-3/2", "1/3", "-2/3", "7/4", "9/10", "11/10")
AWKWARD = tuple(exact(Fraction(text)) for text in (*_PLAIN, *_HALVES, *_LARGE, *_SMALL))
MODERATE = tuple(exact(Fraction(text)) for text in (*_PLAIN, *_HALVES, "10", "1/10"))
_FACTORS = tuple(Exact(*ratio) for ratio in ((1, 2), (2, 1), (1, 10), (10, 1), (-1, 1)))
_SHARES = tuple(Exact(*ratio) for ratio in ((1, 2), (1, 3), (9, 10), (1, 1000), (999, 1000)))
_STEPS = tuple(Exact(*ratio) for ratio in ((1, 1), (1, 2), (3, 1), (1, 1000), (20, 1)))
_LONGEST = 400  # bits


class Drawer:
    """Draws values of atoms: first all equal, then one awkward among plain ones, two equal ones, and anything."""

    def __init__(self, atoms: Sequence[Node], generator: random.Random, moderate: bool) -> None:
        self.atoms = tuple(atoms)
        self.random = generator
        self.moderate = moderate
        self.whole = {atom: bool(atom.expression.is_integer) for atom in self.atoms}
        self.signs = {atom: _signs(atom.expression) for atom in self.atoms}
        self.choices = {atom: self._choices(atom) for atom in self.atoms}

    def _choices(self, atom: Node) -> list[Exact]:
        pool = MODERATE if self.moderate else AWKWARD
        whole = [Exact(n) for n in (1, 2, 3, 4, 5, 7, 0, -1, -2, -3)]
        return [value for value in (whole if self.whole[atom] else pool) if fits_kind(atom, value)]

    def values(self, attempt: int, taken: Mapping[Node, Any]) -> dict[Node, Exact]:
        """One assignment of every atom that is not ``taken``."""
        free = [atom for atom in self.atoms if atom not in taken]
        if attempt < 10:
            same = AWKWARD[attempt] if not self.moderate else MODERATE[attempt]
            return {atom: self._nearest(atom, same) for atom in free}
        style = attempt % 5
        if style == 0:
            return {atom: self._any(atom) for atom in free}
        values = {atom: self._generic(atom) for atom in free}
        if style in (1, 2) and free:
            for atom in self.random.sample(free, min(len(free), style)):
                values[atom] = self._any(atom)
        if style == 3 and len(free) > 1:
            first, second = self.random.sample(free, 2)
            values[second] = self._nearest(second, values[first])
        return values

    def _nearest(self, atom: Node, value: Exact) -> Exact:
        for candidate in (value, abs(value), -value, ONE):
            if fits_kind(atom, candidate):
                return candidate
        return self._generic(atom)

    def _any(self, atom: Node) -> Exact:
        return self.random.choice(self.choices[atom]) if self.choices[atom] else self._generic(atom)

    def _generic(self, atom: Node) -> Exact:
        """A rational of ordinary size, of the declared kind."""
        if self.whole[atom]:
            return self._any_whole(atom)
        top, below = self.random.randint(1, 40), self.random.choice((1, 2, 3, 4, 5, 7, 10, 11))
        signs = self.signs[atom]
        return Exact(top * (signs[0] if len(signs) == 1 else self.random.choice(signs)), below)

    def _any_whole(self, atom: Node) -> Exact:
        return self.random.choice(self.choices[atom]) if self.choices[atom] else ONE

    def between(self, atom: Node, low: Number | None, high: Number | None, strict: bool) -> Exact | None:
        """A value of the kind of the atom between two ends, at an end where that is exact and allowed."""
        candidates: list[Exact] = []
        if not strict and self.random.random() < 0.4:
            candidates += [end for end in (low, high) if type(end) is Exact]
        a, b = (None if end is None else _rational(end) for end in (low, high))
        if a is not None and b is not None:
            if a > b:
                return None
            width = b - a
            candidates += [a + width * share for share in self._shuffled(_SHARES)]
        elif a is not None:
            candidates += [a + step for step in self._shuffled(_STEPS)] + ([2 * a] if a > 0 else [])
        elif b is not None:
            candidates += [b - step for step in self._shuffled(_STEPS)] + [b / 2, b / 100]
        if self.whole[atom]:
            candidates = [Exact(round(fraction(value))) for value in candidates]
        within = (v for v in candidates if (a is None or v >= a) and (b is None or v <= b))
        return next((value for value in within if fits_kind(atom, value)), None)

    def _shuffled(self, values: Sequence[Exact]) -> list[Exact]:
        found = list(values)
        self.random.shuffle(found)
        return found

    def others(self, atom: Node, value: Exact) -> Iterable[Exact]:
        """Other values of an atom, small and large."""
        scaled = [value * factor for factor in _FACTORS]
        chosen = self.random.sample(self.choices[atom], min(6, len(self.choices[atom])))
        return [candidate for candidate in (*scaled, *chosen) if candidate != value and fits_kind(atom, candidate)]


def _signs(atom: Any) -> tuple[int, ...]:
    """Of ordinary values, in the order in which they are drawn."""
    if atom.is_positive or atom.is_nonnegative:
        return (1,)
    return (-1,) if atom.is_negative or atom.is_nonpositive else (1, -1)


def _rational(end: Number) -> Exact:
    """A rational close to the end, of a length that is fit for further work."""
    if type(end) is not Ball:
        return end
    bits = size(end)
    if bits > _LONGEST:
        raise Unsure("an end is too large for further work")
    if bits < -_LONGEST:
        return ZERO
    mantissa, exponent = end.mid().man_exp()
    return exact((int(mantissa) * Fraction(2) ** int(exponent)).limit_denominator(10**24))
