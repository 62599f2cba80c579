"""The letters of a problem: the partial derivatives of its field and drift around the source, and their enclosures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import comb, factorial

import numpy as np
import sympy as sp
from flint import acb

from ptproof.balls.arrays import Intervals, run
from ptproof.balls.tape import Tape, compile_tape
from ptproof.certify.loop.polynomials import Letter, Polynomial, by_slow, product, scaled, term, total

ONE = acb(1)
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
    _tapes: dict[tuple[Letter, ...], Tape] = field(default_factory=dict, compare=False, repr=False)

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

    def enclosures(
        self, letters: Sequence[Letter], box: tuple[Intervals, Intervals], time: Intervals, reach: float
    ) -> dict[Letter, Intervals]:
        """What the letters are on boxes: each an :class:`Intervals` over all boxes.

        ``reach`` is a float not below δ: rests are bounded on the boxes made larger by it.
        """
        plain = tuple(letter for letter in letters if not letter.name.startswith(REST))
        found = self._values(plain, (*box, time))
        rests = [letter for letter in letters if letter.name.startswith(REST)]
        if rests:
            wide = tuple(side.widened(reach) for side in box)
            found |= {letter: self._rest(letter, (*wide, time)) for letter in rests}
        return found

    def _values(self, letters: tuple[Letter, ...], values: Sequence[Intervals]) -> dict[Letter, Intervals]:
        if letters not in self._tapes:
            symbols = (*self.position, self.time)
            self._tapes[letters] = compile_tape([self.expression(letter) for letter in letters], symbols)
        return dict(zip(letters, run(self._tapes[letters], values), strict=True))

    def _rest(self, letter: Letter, values: Sequence[Intervals]) -> Intervals:
        """Lagrange: (n·∇)^(K+1) a/(K + 1)! on the way, at most Σ binomial · |partial derivative| / (K + 1)!."""
        _, name, degree = letter.name.split()
        order = int(degree) + 1
        parts = {i: Letter(name, letter.first + i, letter.second + order - i) for i in range(order + 1)}
        found = self._values(tuple(parts.values()), values)
        sizes = [found[part].magnitude() * (comb(order, i) / factorial(order)) for i, part in parts.items()]
        bound = np.sum(np.broadcast_arrays(*sizes), axis=0) * (1 + 1e-12)
        return Intervals(-bound, bound)
