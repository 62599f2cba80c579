"""What a step of an enclosure is made from, and what it gives: regions, a right-hand side, a proposal, a piece."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import flint
import numpy as np
import sympy as sp
from flint import arb, arb_mat

from ptproof.balls.ball import interval
from ptproof.balls.matrices import (
    Vector,
    floats,
    identity,
    inverse,
    magnitudes,
    matrix,
    times,
)  # fmt: skip
from ptproof.balls.polynomials import largest, spectra
from ptproof.balls.tape import Tape, Undefined, compile_tape, switching_part


@dataclass(frozen=True)
class VectorField:
    """A smooth right-hand side made ready: its rates, their derivatives in the state, and the guards of its domain.

    ``tape`` takes the time and n states; its outputs are n rates, the entries of the Jacobian at ``places`` (the
    others are zero), and the guards, which must not become negative: where one does, another right-hand side holds.
    """

    tape: Tape
    dimension: int
    places: tuple[tuple[int, int], ...]
    guards: int = 0

    @staticmethod
    def of(
        time: sp.Symbol, state: Sequence[sp.Symbol], rates: Sequence[sp.Expr], guards: Sequence[sp.Expr] = ()
    ) -> VectorField:
        """From expressions; raises :class:`Undefined` for what has no enclosure or may jump or bend."""
        moving = (time, *state)
        for entry in (*rates, *guards):
            if (part := switching_part(entry, moving)) is not None:
                raise Undefined(f"{part} may jump or bend")
        slopes = {(i, j): sp.diff(rate, x) for i, rate in enumerate(rates) for j, x in enumerate(state)}
        slopes = {place: slope for place, slope in slopes.items() if slope != 0}
        tape = compile_tape([*rates, *slopes.values(), *guards], moving)
        return VectorField(tape, len(rates), tuple(slopes), len(guards))


@dataclass(frozen=True)
class Proposal:
    """What a method without guarantees found for one step, over s from −1 to 1; any numbers are allowed.

    Attributes
    ----------
    path
        Coefficients of powers of s (n rows) of a polynomial near the solution from the centre of the region.
    spread
        Coefficients (n × n each) of a matrix of polynomials near the derivative of the solution by its start.
        Directions that die out within the step are better left out of it.
    basis
        The coordinates (columns, n × n) in which what is left is compared; they should tell fast from slow.
    metric
        The coordinates in which the frame of the next region is orthogonal; they should change little between steps.
    """

    path: arb_mat
    spread: tuple[arb_mat, ...]
    basis: arb_mat
    metric: arb_mat


@dataclass(frozen=True)
class Piece:
    """A step of an enclosure: for t in [start, start + length], |xᵢ(t) − pathᵢ(s)| <= errorsᵢ, s from −1 to 1.

    ``added`` is what the step itself has added to the errors of each state.
    """

    start: arb
    length: arb
    path: arb_mat
    errors: tuple[arb, ...]
    added: tuple[arb, ...]

    @property
    def hull(self) -> list[arb]:
        """A ball for each state that holds it over the whole step."""
        return hull(self.path, self.errors)

    def at(self, time: arb) -> list[arb]:
        """A ball for each state at every instant in ``time`` that lies in the step."""
        s = (2 * (time - self.start) / self.length - 1).intersection(interval(-1, 1))
        rows = map(flint.arb_poly, self.path.tolist())
        return [row(s) + arb(0, error) for row, error in zip(rows, self.errors, strict=True)]


def hull(path: arb_mat, errors: Sequence[arb]) -> list[arb]:
    """A ball for each row of the path that holds it for all s from −1 to 1, and what lies within the errors."""
    rows = zip(spectra(path).tolist(), errors, strict=True)
    return [row[0] + arb(0, largest(row[1:]) + error) for row, error in rows]


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
