"""Small sets of states: a point, and a parallelepiped of errors around it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from flint import arb, arb_mat

from ptproof.balls.matrices import (
    Vector,
    floats,
    identity,
    inverse,
    magnitudes,
    matrix,
    times,
)  # fmt: skip
from ptproof.balls.tape import Undefined


@dataclass(frozen=True)
class Region:
    """All c + B·r with |rᵢ| <= ``radii``ᵢ: ``centre`` c (n exact balls), ``frame`` B (n × n, exact)."""

    centre: tuple[arb, ...]
    frame: arb_mat
    radii: tuple[arb, ...]

    @staticmethod
    def around(balls: Sequence[arb]) -> Region:
        """The box with these sides."""
        return Region(
            tuple(ball.mid() for ball in balls), identity(len(balls)), tuple(ball.rad().upper() for ball in balls)
        )

    @property
    def errors(self) -> Vector:
        """What the coordinates differ from the centre at most."""
        return times(magnitudes(self.frame), self.radii)

    @property
    def box(self) -> list[arb]:
        """The sides of the smallest box around it."""
        return [arb(c, r) for c, r in zip(self.centre, self.errors, strict=True)]

    def moved(
        self, ends: Sequence[arb], carried: arb_mat, metric: arb_mat | None, *rest: tuple[arb_mat, Sequence[arb]]
    ) -> Region:
        """A region with all ``ends`` + ``carried``·(B·r) + Σ matrix·[−radii, radii] over the ``rest``.

        In the coordinates whose axes are the columns of ``metric`` the new frame is orthogonal (Lohner): the longest
        direction is kept as it is, so that errors along it do not spill over into the others. Without a metric the
        frame is kept. Any frame would be right; only its inverse has to be enclosed.
        """
        centre = tuple(ball.mid() for ball in ends)
        image, frame = carried * self.frame, self.frame
        if metric is not None:
            inner = floats(inverse(metric) * image) * np.array([float(r) for r in self.radii])
            frame = (metric * matrix(_orthogonal(inner))).mid()
        back = inverse(frame)
        found = times(magnitudes(back * image), self.radii)
        for part, radii in (*rest, (identity(len(centre)), [ball.rad().upper() for ball in ends])):
            added = times(magnitudes(back * part), radii)
            found = [(a + b).upper() for a, b in zip(found, added, strict=True)]
        if not all(entry.is_finite() for entry in (*centre, *found)):
            raise Undefined("a region without bounds")
        return Region(centre, frame, tuple(found))


def _orthogonal(columns: np.ndarray) -> np.ndarray:
    lengths = np.linalg.norm(columns, axis=0)
    scaled = columns / max(float(lengths.max()), 1e-300)
    if not np.all(np.isfinite(scaled)):
        return np.eye(len(columns))
    return np.linalg.qr(scaled[:, np.argsort(-lengths, kind="stable")])[0]
