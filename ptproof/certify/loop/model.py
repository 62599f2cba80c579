"""W and its rate as forms, ready to be bounded on boxes, with a centred form of what is largest in them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from flint import acb, arb

from ptproof.balls.around import Around
from ptproof.balls.arrays import Array, Intervals
from ptproof.balls.rounding import up
from ptproof.certify.loop.boxes import Boxes
from ptproof.certify.loop.jets import Jets
from ptproof.certify.loop.levels import Indices
from ptproof.certify.loop.lyapunov import Lyapunov
from ptproof.certify.loop.polynomials import Polynomial, by_slow, scaled
from ptproof.certify.loop.ranges import Columns, Form

_SLACK = 2.0**-44


@dataclass(frozen=True, eq=False)
class Model:
    """W and its rate as forms.

    Attributes
    ----------
    jets
        What the letters are.
    function, function_columns
        W, and the products of letters that occur in it.
    columns, function_rest, rate_rest, manifold
        Products, W − V, dW/dτ without its main part, and ρ, over them.
    parts, part_columns
        The main part of dW/dτ with its derivatives in y₁ and y₂, then V with its own.
    reach
        A float not below δ.
    weight
        λ.
    typical
        About how large −(dW/dτ)/W is; any positive number would do.
    """

    jets: Jets
    function: Form
    function_columns: Columns
    columns: Columns
    function_rest: Form
    rate_rest: Form
    manifold: Form
    parts: tuple[Form, ...]
    part_columns: Columns
    reach: float
    weight: float
    typical: float

    @staticmethod
    def of(found: Lyapunov, delta: arb, weight: float, typical: float) -> Model:
        """From W and its rate, with the number δ put in."""
        manifold, jets = found.flow.manifold, found.flow.jets
        rest = Columns.of(found.function_rest, found.rate_rest, manifold)
        alone = Columns.of(found.function)
        parts: list[Polynomial] = []
        for part in (found.main, found.start):
            parts += [part, *(scaled(acb(1), by_slow(part, axis, jets.derivative)) for axis in (0, 1))]
        few = Columns.of(*parts)
        function_rest, rate_rest, shape = (
            Form.of(part, delta, rest) for part in (found.function_rest, found.rate_rest, manifold)
        )
        return Model(
            jets, Form.of(found.function, delta, alone), alone, rest, function_rest, rate_rest, shape,
            tuple(Form.of(part, delta, few) for part in parts), few, up(delta), weight, typical,
        )  # fmt: skip

    def values(self, columns: Columns, boxes: Boxes, time: Intervals) -> Around:
        """The products of letters on boxes."""
        found = self.jets.enclosures(columns.letters, boxes.sides(), time, self.reach)
        return columns.values(found, len(boxes))

    def centred(self, boxes: Boxes, time: Intervals) -> Centred:
        """The main part and V by their values at the middles and their derivatives on the boxes."""
        there = self.values(self.part_columns, Boxes(boxes.first, boxes.second, 0.0), time)
        around = self.values(self.part_columns, boxes, time)
        main, start = (self.parts[i].alone(there) for i in (0, 3))
        slopes = tuple(self.parts[i].alone(around) for i in (1, 2, 4, 5))
        return Centred(main, start, slopes[:2], slopes[2:], boxes.half)


@dataclass(frozen=True, eq=False)
class Centred:
    """Mean value forms on boxes of half side ``half``: of the main part of the rate, and of V."""

    main: Around
    start: Around
    main_slopes: tuple[Around, ...]
    start_slopes: tuple[Around, ...]
    half: float

    @property
    def _reach(self) -> Array:
        size = sum(np.abs(slope.middle) + slope.radius for slope in self.start_slopes)
        return np.asarray((self.start.radius + self.half * size) * (1 + _SLACK) + np.abs(self.start.middle) * _SLACK)

    @property
    def low(self) -> Array:
        """V, from below."""
        return np.asarray(self.start.middle - self._reach)

    @property
    def high(self) -> Array:
        """V, from above."""
        return np.asarray(self.start.middle + self._reach)

    def slopes(self, unit: float) -> Indices:
        """The κ, in units, for which main + κV varies least across the levels of V."""
        along = sum(a.middle * b.middle for a, b in zip(self.main_slopes, self.start_slopes, strict=True))
        steep = sum(b.middle**2 for b in self.start_slopes)
        with np.errstate(all="ignore"):
            found = np.nan_to_num(np.rint(-along / steep / unit), nan=0.0, posinf=0.0, neginf=0.0)
        return np.clip(found, -1000, 1000).astype(np.intp)

    def combined(self, kappa: Array) -> Array:
        """An upper bound of main + κV."""
        middle = self.main.middle + kappa * self.start.middle
        radius = self.main.radius + np.abs(kappa) * self.start.radius
        size = np.abs(self.main.middle) + np.abs(kappa * self.start.middle)
        for a, b in zip(self.main_slopes, self.start_slopes, strict=True):
            slope = np.abs(a.middle + kappa * b.middle) + a.radius + np.abs(kappa) * b.radius
            slope += (np.abs(a.middle) + np.abs(kappa * b.middle)) * _SLACK
            radius += self.half * slope
        return np.asarray(middle + radius + (size + radius) * _SLACK)
