"""Certified upper envelopes of the radial rate u·M∇F/r, shell by shell in the distance r from a critical point.

With x = x* + r·u, ‖u‖ = 1, the distance of a solution of dx/ds = w·f + M∇F, M = wE + (k/2)I, satisfies
dr/ds = w·u·f + u·M∇F. For each shell r ∈ [b_j, b_(j+1)] and each weight w of a grid, branch and bound over the shell
encloses the largest u·M∇F/r. As a supremum of functions that are affine in w it is convex in w, so that chords between
grid weights are upper bounds too. Near the source ∇F is written by the Hessian on the segment from the source,
∇F(x)/r = (mean of H over the segment)·u, which loses nothing where the quotient of two balls would.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache, reduce
from operator import add, mul
from typing import Any, TypeAlias

import sympy as sp
from flint import arb

from ptproof.balls.ball import ball_from, interval, precision
from ptproof.balls.cells import Cell, FieldOnCells, Over
from ptproof.balls.cube import Box, Face, reduced_faces, shell
from ptproof.balls.rounding import down, up
from ptproof.balls.search import Look, Search
from ptproof.balls.tape import Undefined, switching_part
from ptproof.errors import InputError
from ptproof.system import gradient

BITS = 64
_RATIO = 1.06  # of the radii that bound a shell
_NEAR = 24  # shells from which on the Hessian form is used too
_DEEPEST = 160  # shells below the first radius; the ball inside is one last cell
_PIECES = 300
_TOLERANCE = 0.02  # of the largest rate of a shell, or of this fraction of any rate there
_SMALL = 0.1
_KEPT = 4  # shells whose cells are kept for the next weight

_Matrix: TypeAlias = list[list[Any]]


@dataclass
class RadialEnvelope:
    """Upper bounds G of u·(wE + (k/2)I)∇F/r on shells around the source, computed when asked for.

    Parameters
    ----------
    variables, expression, source
        The field F over n coordinates, and a point at which its gradient vanishes, which is the caller's to show.
    k
        The gain.
    matrix
        E (n × n), or None for zero.
    radius
        The first radius: shells lie below and above it. A float, which is exact.
    weights
        Increasing grid of w = dt/dτ in (0, 1], exact floats.

    Raises
    ------
    Undefined
        If the field is not twice continuously differentiable in closed form: the mean values need that.
    """

    variables: tuple[sp.Symbol, ...]
    expression: sp.Expr
    source: tuple[sp.Expr, ...]
    k: sp.Expr
    matrix: sp.ImmutableDenseMatrix | None
    radius: float
    weights: tuple[float, ...]
    evaluations: int = 0
    _cells: dict[tuple[int, int], float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if (found := switching_part(self.expression, self.variables)) is not None:
            raise Undefined(f"a field with {found.func.__name__}, which is not smooth in closed form")
        n = self.dimension
        with precision(BITS):
            self._field = FieldOnCells(self.variables, self.expression, self.source)
            half = ball_from(self.k) / 2
            entries = [
                [ball_from(self.matrix[i, j] if self.matrix is not None else 0) for j in range(n)] for i in range(n)
            ]
            self._maps = [
                [[arb(w) * entries[i][j] + (half if i == j else 0) for j in range(n)] for i in range(n)]
                for w in self.weights
            ]  # fmt: skip
        self._shells = lru_cache(maxsize=_KEPT)(self._parts)

    @cached_property
    def _faces(self) -> tuple[Face, ...]:
        """Directions that suffice for every weight: the symmetries of the field and of its rate along E and alone."""
        y = [sp.Dummy(f"y{i}", real=True) for i in range(self.dimension)]
        share, value = sp.symbols("share value", cls=sp.Dummy, real=True)
        E = self.matrix if self.matrix is not None else sp.zeros(self.dimension)
        moved = {x: c + yi for x, c, yi in zip(self.variables, self.source, y, strict=True)}
        slope = sp.Matrix(gradient(self.expression, self.variables))
        rate = sp.Matrix([y]) * (sp.eye(self.dimension) + share * E) * slope.subs(moved, simultaneous=True)
        return reduced_faces(rate[0] + value * self.expression.subs(moved, simultaneous=True), y)

    @property
    def dimension(self) -> int:
        """The number n of coordinates."""
        return len(self.variables)

    @property
    def enclosed(self) -> int:
        """The number of pairs of a shell and a weight enclosed so far."""
        return len(self._cells)

    def boundary(self, index: int) -> float:
        """b_index, the lower radius of the shell ``index``; 0 for the last ball inside."""
        return 0.0 if index <= -_DEEPEST else self.radius * _RATIO**index

    def shell(self, r: float) -> int:
        """The index of a shell with b_index ≤ r ≤ b_(index + 1)."""
        ratio = r / self.radius
        if ratio == 0:  # which may also be too small for a float
            return -_DEEPEST
        index = max(-_DEEPEST, math.floor(math.log(ratio) / math.log(_RATIO)))
        while index > -_DEEPEST and self.boundary(index) > r:
            index -= 1
        while self.boundary(index + 1) < r:
            index += 1
        return index

    def rate(self, index: int, low: float, high: float) -> float:
        """An upper bound of u·M∇F/r on the shell for every w in [low, high]; inf where the field has no value."""
        if len(self.weights) == 1:
            return self._column(index, 0)
        return max(self._chord(index, low), self._chord(index, high))

    def _chord(self, index: int, w: float) -> float:
        grid = self.weights
        if not grid[0] <= w <= grid[-1]:
            raise InputError(f"the weight {w} lies outside the grid")
        if w in grid:
            return self._column(index, grid.index(w))
        i = next(i for i in range(1, len(grid)) if w <= grid[i])
        first, second = self._column(index, i - 1), self._column(index, i)
        if math.inf in (first, second):
            return math.inf
        with precision(BITS):
            share = (arb(w) - arb(grid[i - 1])) / (arb(grid[i]) - arb(grid[i - 1]))
            return up(arb(first) * (1 - share) + arb(second) * share)

    def _column(self, index: int, column: int) -> float:
        if (index, column) not in self._cells:
            with precision(BITS):
                self._cells[index, column] = self._enclose(index, self._maps[column])
        return self._cells[index, column]

    def _enclose(self, index: int, M: _Matrix) -> float:
        """Branch and bound over the shell, until the largest rate is known closely enough."""
        finer = max(1, self.dimension - 1)
        near = index <= -_NEAR or self.boundary(index) == 0 or self.dimension > 2
        parts, scale, turning = self._shells(index), 0.0, _transposed(M)

        def look(cell: Cell, best: float) -> Look[Cell, Box]:
            nonlocal scale
            bound = self._at_most(cell, near, M, turning)
            if search.looks < len(parts) and math.isfinite(bound):
                scale = max(scale, abs(bound))
            there = cell.middle
            sure = -math.inf if there.gradient is None else down(_pair(there.u, turning, there.gradient) / there.r)
            return Look(bound, False, lambda: cell.halves, sure, there.box)

        def enough() -> bool:
            return search.upper <= search.best + _TOLERANCE * finer * max(abs(search.best), _SMALL * scale)

        search: Search[Cell, Box] = Search(look, parts)
        search.run(enough, most=_PIECES * finer**2)
        return search.upper

    def _parts(self, index: int) -> list[Cell]:
        """Cells that cover the shell, but for directions that a symmetry leads to others."""
        low, high = arb(self.boundary(index)), arb(self.boundary(index + 1))
        return [Cell(self._field, box) for box in shell(self._faces, low, high, 4)]

    def _at_most(self, cell: Cell, near: bool, M: _Matrix, turning: _Matrix) -> float:
        """An upper bound of u·M∇F/r on the cell: the least of three enclosures; inf where the field has no value."""
        n, there = self.dimension, cell.middle
        self.evaluations += 1
        result = math.inf
        if (over := cell.over) is not None:
            turned = _apply(turning, over.u)
            result = up(_dot(turned, over.gradient) / over.r)
            if there.gradient is not None:
                centred = _pair(there.u, turning, there.gradient) / there.r
                result = min(result, up(centred + _mean_value(cell, over, M, turned)))
        if near and (H := cell.hessian) is not None:
            A = [_apply(H, row) for row in M]  # H is symmetric
            common = sum((A[i][i].mid() for i in range(n)), arb(0)) / n  # u·u = 1 takes it out exactly
            for i in range(n):
                A[i][i] = A[i][i] - common
            result = min(result, up(common + _pair(cell.u, _transposed(A), cell.u)))
        return result


def _mean_value(cell: Cell, over: Over, M: _Matrix, turned: list[Any]) -> Any:
    """∇φ·(x − m) for φ(x) = x·M∇F/‖x‖² and the middle m of the cell; ``turned`` is Mᵀu."""
    there, (low, high) = cell.middle, cell.box.sides[0]
    # A chord of the box keeps its directions, a convex cone, but comes closer to the source than its ends.
    nearest = (low * _dot(over.u, there.u)).lower()
    if not nearest > 0:
        return arb(math.inf)
    r = interval(nearest, high)
    radial = 2 * (_dot(turned, over.gradient) / r)
    forward, curved = _apply(M, over.gradient), _apply(over.hessian, turned)
    slope = [(forward[j] / r + curved[j] - radial * over.u[j]) / r for j in range(len(turned))]
    return _dot(slope, [a - b for a, b in zip(over.x, there.x, strict=True)])


def _dot(left: Sequence[Any], right: Sequence[Any]) -> Any:
    return reduce(add, map(mul, left, right))


def _apply(M: _Matrix, v: Sequence[Any]) -> list[Any]:
    return [_dot(row, v) for row in M]


def _transposed(M: _Matrix) -> _Matrix:
    return [list(column) for column in zip(*M, strict=True)]


def _pair(u: Sequence[Any], turning: _Matrix, g: Sequence[Any]) -> Any:
    """u·M·g, by (Mᵀu)·g with Mᵀ = ``turning``."""
    return _dot(_apply(turning, u), g)
