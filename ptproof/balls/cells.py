"""Parts of a shell around a point, with what is known of a field there: computed when asked for, and once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import sympy as sp

from ptproof.balls.ball import BALLS, ball_from, interval
from ptproof.balls.boxes import centre
from ptproof.balls.cube import Box
from ptproof.balls.tape import Undefined, compile_tape
from ptproof.system import gradient


@dataclass(frozen=True)
class Middle:
    """A point r·u = x of a shell, as a box, with the gradient there, None where the field has no value."""

    box: Box
    r: Any
    u: list[Any]
    x: list[Any]
    gradient: list[Any] | None


@dataclass(frozen=True)
class Over:
    """Enclosures over all of a cell: x = r·u, the gradient and the Hessian."""

    r: Any
    u: list[Any]
    x: list[Any]
    gradient: list[Any]
    hessian: list[list[Any]]


class FieldOnCells:
    """The derivatives of a field, ready to be enclosed at ``source`` + x, at the present precision.

    The field itself is enclosed beside its derivatives, which may be smooth where it jumps.

    Raises
    ------
    Undefined
        If the field or a derivative has no enclosure.
    """

    def __init__(self, variables: Sequence[sp.Symbol], expression: sp.Expr, source: Sequence[sp.Expr]) -> None:
        slope, second = gradient(expression, variables), list(sp.hessian(expression, variables))
        self._n = len(variables)
        try:
            self._slope = compile_tape([*slope, expression], variables)
            self._both = compile_tape([*slope, *second, expression], variables)
            self._hessian = compile_tape([*second, expression], variables)
        except Undefined as error:
            raise Undefined(f"a field without enclosures ({error})") from None
        self._source = [ball_from(value) for value in source]

    def gradient(self, x: Sequence[Any]) -> list[Any]:
        """∇F, or :class:`Undefined`."""
        return self._slope.run(self._at(x), BALLS)[: self._n]

    def both(self, x: Sequence[Any]) -> tuple[list[Any], list[list[Any]]]:
        """∇F and the Hessian, or :class:`Undefined`."""
        values = self._both.run(self._at(x), BALLS)
        return values[: self._n], self._square(values[self._n :])

    def hessian(self, x: Sequence[Any]) -> list[list[Any]]:
        """The Hessian, or :class:`Undefined`."""
        return self._square(self._hessian.run(self._at(x), BALLS))

    def _at(self, x: Sequence[Any]) -> list[Any]:
        return [c + xi for c, xi in zip(self._source, x, strict=True)]

    def _square(self, entries: list[Any]) -> list[list[Any]]:
        n = self._n
        return [entries[i : i + n] for i in range(0, n * n, n)]


@dataclass(frozen=True)
class Cell:
    """A part of a shell; everything about it is computed at the precision of whoever asks first."""

    field: FieldOnCells
    box: Box

    @cached_property
    def u(self) -> list[Any]:
        """The unit vectors of the cell."""
        return self.box.direction()

    @cached_property
    def middle(self) -> Middle:
        """The point in the middle; its radius is positive also where the cell begins at the source."""
        radius, *rest = centre(self.box.sides)
        low, high = self.box.sides[0]
        box = self.box.at((high if low.is_zero() else radius, *rest))
        r, u = box.sides[0][0], box.direction()
        x = [r * ui for ui in u]
        try:
            return Middle(box, r, u, x, self.field.gradient(x))
        except Undefined:
            return Middle(box, r, u, x, None)

    @cached_property
    def over(self) -> Over | None:
        """What the cell holds; None where it begins at the source or the field has no value."""
        low, high = self.box.sides[0]
        if not low > 0:
            return None
        r = interval(low, high)
        x = [r * ui for ui in self.u]
        try:
            return Over(r, self.u, x, *self.field.both(x))
        except Undefined:
            return None

    @cached_property
    def hessian(self) -> list[list[Any]] | None:
        """The Hessian on the segments from the source to the cell; None where the field has no value."""
        r = interval(0, self.box.sides[0][1])
        try:
            return self.field.hessian([r * ui for ui in self.u])
        except Undefined:
            return None

    @cached_property
    def halves(self) -> tuple[Cell, Cell]:
        """Its two halves along the side that ranges most widely."""
        first, second = self.box.split(self.box.widest())
        return Cell(self.field, first), Cell(self.field, second)
