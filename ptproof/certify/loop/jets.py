"""The letters of a problem: the partial derivatives of its field and drift around the source, and their enclosures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import comb, factorial
from typing import TypeAlias

import numpy as np
import sympy as sp
from flint import acb

from ptproof.balls.arrays import Array, Intervals, run
from ptproof.balls.linear import Linear, around
from ptproof.balls.tape import Tape, compile_tape
from ptproof.certify.loop.boxes import Boxes
from ptproof.certify.loop.polynomials import Letter, Polynomial, by_slow, product, scaled, term, total

ONE = acb(1)
_SLACK = 2.0**-44
_Step: TypeAlias = tuple[int, int, int]  # how often a function is differentiated in y₁, y₂, t
_STAY: _Step = (0, 0, 0)
FIELD, FIRST, SECOND, CLOCK, REST, DISTANCE = "F", "d1", "d2", "h", "R", "V"
"""The field F(x* + y) − F(x*), the drift's two entries, the clock's factor h = dt/dτ, and rests of Taylor polynomials.

The rest of F₁, say, of order K has the letter ``R F`` with one derivative in the first coordinate.
"""


class Unresolved(ArithmeticError):
    """A rest has no derivative: it may not enter W."""


@dataclass(frozen=True)
class Jets:
    """The letters over (y₁, y₂, t): what each stands for.

    Attributes
    ----------
    position, time
        The symbols y₁, y₂ (the position minus the source) and t.
    expressions
        By name what a letter without derivatives stands for, among FIELD, FIRST, SECOND and CLOCK.
    factor
        dt/dτ as an expression in t, so that d/dτ = factor · d/dt.
    order
        K: the Taylor polynomials in δ of the field's gradient have the degree K, those of the drift K − 1.
    """

    position: tuple[sp.Symbol, sp.Symbol]
    time: sp.Symbol
    expressions: Mapping[str, sp.Expr]
    factor: sp.Expr
    order: int
    _known: dict[Letter, sp.Expr] = field(default_factory=dict, compare=False, repr=False)
    _moved: dict[tuple[Letter, int], sp.Expr] = field(default_factory=dict, compare=False, repr=False)
    _tapes: dict[tuple[tuple[Letter, int], ...], Tape] = field(default_factory=dict, compare=False, repr=False)

    def expression(self, letter: Letter) -> sp.Expr:
        """The expression of a letter that is no rest, in (y₁, y₂, t)."""
        if letter not in self._known:
            name, i, j, late = letter
            if late:
                before = self.expression(letter._replace(late=late - 1))
                value = sp.expand(self.factor * before.diff(self.time))
            elif i or j:
                axis = 0 if i else 1
                before = self.expression(Letter(name, i - 1, j) if i else Letter(name, i, j - 1))
                value = before.diff(self.position[axis])
            else:
                value = self.expressions[name]
            self._known[letter] = sp.sympify(value)
        return self._known[letter]

    def derivative(self, letter: Letter, axis: int) -> Letter | None:
        """The letter of a partial derivative, None where it is identically zero."""
        if letter.name.startswith(REST):
            raise Unresolved(f"{letter} has no derivative")
        name, i, j, late = letter
        new = (Letter(name, i + 1, j, late), Letter(name, i, j + 1, late), Letter(name, i, j, late + 1))[axis]
        if (name == CLOCK and axis < 2) or (name in (FIELD, DISTANCE) and axis == 2):
            return None
        return None if self.expression(new) == 0 else new

    def moved(self, letter: Letter, degree: int, around: tuple[Polynomial, Polynomial]) -> Polynomial:
        """The letter at y + δn as a Taylor polynomial in δ of ``degree`` at most, and the letter of its rest.

        ``around`` is n, a unit vector that turns with the heading.
        """
        last: Polynomial = term(ONE, letter)
        parts = [last]
        for j in range(1, degree + 2):
            along = [product(n, by_slow(last, axis, self.derivative)) for axis, n in enumerate(around)]
            last = scaled(ONE / j, total(*along), grade=1)
            if not last:
                return total(*parts)
            if j <= degree:
                parts.append(last)
        rest = Letter(f"{REST} {letter.name} {degree}", letter.first, letter.second)
        return total(*parts, term(ONE, rest, grade=degree + 1))

    def linear(self, letters: Sequence[Letter], boxes: Boxes, time: Intervals, reach: float) -> Linear:
        """What the letters are on boxes and a stretch of ``time``: linear forms in y₁, y₂, and in t if need be.

        It is letters × boxes. ``reach`` is a float not below δ: rests are bounded on the boxes made larger by it.
        """
        plain = [letter for letter in letters if not letter.name.startswith(REST)]
        middle = np.asarray(0.5 * time.low + 0.5 * time.high)
        late = np.asarray(np.maximum(time.high - middle, middle - time.low) * (1 + 1e-15) + 1e-300)
        moving = any(self.expression(letter).has(self.time) for letter in plain)
        halves = (boxes.half, boxes.half, float(late))[: 3 if moving else 2]
        at = tuple(Intervals.point(value) for value in (*boxes.middles, middle))
        ones = [(1, 0, 0), (0, 1, 0), (0, 0, 1)][: len(halves)]
        pairs = [(i, j) for i in range(len(halves)) for j in range(i, len(halves))]
        first = self._partial([(letter, step) for letter in plain for step in (_STAY, *ones)], at)
        second = self._partial(
            [(letter, _sum(ones[i], ones[j])) for letter in plain for i, j in pairs], (*boxes.sides(), time)
        )
        wide = tuple(side.widened(reach) for side in boxes.sides())
        shape = len(letters), len(boxes)
        found = Linear(np.zeros(shape), np.zeros((len(halves), *shape)), np.zeros(shape))
        for row, letter in enumerate(letters):
            if letter.name.startswith(REST):
                found.radius[row] = self._rest(letter, (*wide, time))
                continue
            found.middle[row], found.radius[row] = around(first[letter, _STAY])
            for axis, half in enumerate(halves):
                slope, off = around(first[letter, ones[axis]])
                found.slopes[axis, row] = slope * half
                found.radius[row] += (off + np.abs(slope) * _SLACK) * half
            for i, j in pairs:
                size = second[letter, _sum(ones[i], ones[j])].magnitude()
                found.radius[row] += size * (halves[i] * halves[j] * (0.5 if i == j else 1.0))
        return Linear(found.middle, found.slopes, found.radius * (1 + _SLACK))

    def _partial(
        self, wanted: Sequence[tuple[Letter, _Step]], values: Sequence[Intervals]
    ) -> dict[tuple[Letter, _Step], Intervals]:
        """Partial derivatives of letters in (y₁, y₂, t)."""
        named = {
            (letter, step): (letter._replace(first=letter.first + step[0], second=letter.second + step[1]), step[2])
            for letter, step in wanted
        }
        asked = tuple(sorted({name for name in named.values() if self._derived(name) != 0}))
        if asked not in self._tapes:
            symbols = (*self.position, self.time)
            self._tapes[asked] = compile_tape([self._derived(name) for name in asked], symbols)
        known = dict(zip(asked, run(self._tapes[asked], values), strict=True))
        nothing = Intervals.point(0.0)
        return {item: known.get(name, nothing) for item, name in named.items()}

    def _derived(self, name: tuple[Letter, int]) -> sp.Expr:
        """The expression of a letter, differentiated in t."""
        if name not in self._moved:
            letter, times = name
            self._moved[name] = self._derived((letter, times - 1)).diff(self.time) if times else self.expression(letter)
        return self._moved[name]

    def _rest(self, letter: Letter, values: Sequence[Intervals]) -> Array:
        """Lagrange: (n·∇)^(K+1) a/(K + 1)! on the way, at most Σ binomial · |partial derivative| / (K + 1)!."""
        _, name, degree = letter.name.split()
        order = int(degree) + 1
        steps = [(i, order - i, 0) for i in range(order + 1)]
        parent = Letter(name, letter.first, letter.second)
        found = self._partial([(parent, step) for step in steps], values)
        sizes = [found[parent, step].magnitude() * (comb(order, step[0]) / factorial(order)) for step in steps]
        return np.asarray(np.sum(np.broadcast_arrays(*sizes), axis=0) * (1 + 1e-12))


def _sum(left: _Step, right: _Step) -> _Step:
    return left[0] + right[0], left[1] + right[1], left[2] + right[2]
