"""W, its rate and the filter's manifold as forms, ready to be bounded on boxes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from flint import arb

from ptproof.balls.arrays import Intervals
from ptproof.balls.rounding import up
from ptproof.certify.loop.boxes import Boxes
from ptproof.certify.loop.flow import Lyapunov
from ptproof.certify.loop.jets import Jets
from ptproof.certify.loop.levels import Indices
from ptproof.certify.loop.ranges import Columns, Form, Waves


@dataclass(frozen=True, eq=False)
class Model:
    """W and its rate as forms.

    Attributes
    ----------
    jets
        What the letters are.
    function, rate, columns
        W and dW/dτ with the same turns and powers, and the products of letters that occur in them.
    shape, manifold, few
        W and ρ, and the products that occur in these two.
    reach
        A float not below δ.
    weight
        λ.
    typical
        About how large −(dW/dτ)/W is; any positive number would do.
    """

    jets: Jets
    function: Form
    rate: Form
    columns: Columns
    shape: Form
    manifold: Form
    few: Columns
    reach: float
    weight: float
    typical: float

    @staticmethod
    def of(found: Lyapunov, delta: arb, weight: float, typical: float) -> Model:
        """From W and its rate, with the number δ put in."""
        both, alone = (found.function, found.rate), (found.function, found.flow.manifold)
        columns, few = Columns.of(*both), Columns.of(*alone)
        function, rate = (Form.of(part, delta, columns, both) for part in both)
        shape, manifold = (Form.of(part, delta, few) for part in alone)
        return Model(
            found.flow.jets, function, rate, columns, shape, manifold, few, up(delta), weight, typical
        )  # fmt: skip

    def both(self, boxes: Boxes, time: Intervals) -> tuple[Waves, Waves]:
        """W and dW/dτ on boxes."""
        values = self.columns.values(self.jets.linear(self.columns.letters, boxes, time, self.reach))
        return self.function.on(values), self.rate.on(values)

    def still(self, boxes: Boxes, time: Intervals) -> tuple[Waves, Waves]:
        """W and ρ on boxes."""
        values = self.few.values(self.jets.linear(self.few.letters, boxes, time, self.reach))
        return self.shape.on(values), self.manifold.on(values)


def across(function: Waves, rate: Waves, unit: float) -> Indices:
    """The κ, in units, for which the mean of dW/dτ + κW varies least across the levels of the mean of W."""
    steep, fall = function.mean().slopes[:2], rate.mean().slopes[:2]
    with np.errstate(all="ignore"):
        found = np.rint(-(steep * fall).sum(axis=0) / (steep**2).sum(axis=0) / unit)
    return np.clip(np.nan_to_num(found, nan=0.0, posinf=0.0, neginf=0.0), -1000, 1000).astype(np.intp)
