"""An enclosed run as a value: pieces of time with a proved tube around a polynomial each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import flint
from flint import arb

from ptproof.balls.ball import ball_from, interval
from ptproof.balls.pieces import Piece
from ptproof.balls.rounding import down, up
from ptproof.certify.trajectory.march import Switch
from ptproof.errors import InputError
from ptproof.proof.verdict import Verdict
from ptproof.reading.expressions import parse

METHOD = "Radau collocation, its defect in ball arithmetic, comparison along slow and fast directions, Lohner's frames"
Interval = tuple[float, float]


@dataclass(frozen=True)
class Enclosure:
    """A run that is enclosed: there is exactly one solution from each initial value, and it lies where this says.

    Attributes
    ----------
    verdict, detail
        ``proved`` where the run is enclosed to its end, at each of the times to the width that was asked for; else
        ``undecided``, with the reason. What is listed is proved in either case.
    states
        The states' names.
    time
        The name of the time in which the run is enclosed.
    times
        Instants (m), increasing, from the start to where the enclosure ends.
    lower, upper
        For each instant the bounds of each state (m × n), rounded outwards.
    pieces
        The steps, of which :meth:`at` and :meth:`over` make use.
    switches
        The spans of time in which a Max, Min or Abs of the right-hand side changes its branch.
    bits, seconds
        The precision, and the wall time.

    Examples
    --------
    >>> import ptproof
    >>> run = ptproof.enclose("vanishing", "asymptotic", until="0.01")
    >>> low, high = run.at("0.005")["x1"]
    >>> str(run.verdict), low < high < low + 1e-6
    ('proved', True)
    """

    verdict: Verdict
    detail: str
    states: tuple[str, ...]
    time: str
    times: tuple[float, ...]
    lower: tuple[tuple[float, ...], ...]
    upper: tuple[tuple[float, ...], ...]
    pieces: tuple[Piece, ...]
    switches: tuple[Switch, ...]
    bits: int
    seconds: float

    @cached_property
    def width(self) -> float:
        """The largest width of any state at any of the times."""
        gaps = (
            high - low for rows in zip(self.lower, self.upper, strict=True) for low, high in zip(*rows, strict=True)
        )
        return max(gaps)

    @property
    def steps(self) -> int:
        """How many steps it took."""
        return len(self.pieces)

    @property
    def final(self) -> Mapping[str, Interval]:
        """Where each state is at the last instant."""
        return dict(zip(self.states, zip(self.lower[-1], self.upper[-1], strict=True), strict=True))

    def at(self, time: Any) -> Mapping[str, Interval]:
        """Where each state is at an instant: a number, or text, which is exact."""
        return {name: (down(ball), up(ball)) for name, ball in self.balls(time, time).items()}

    def over(self, start: Any, end: Any) -> Mapping[str, Interval]:
        """Where each state is during a span of time."""
        return {name: (down(ball), up(ball)) for name, ball in self.balls(start, end).items()}

    def balls(self, start: Any, end: Any) -> Mapping[str, arb]:
        """The same in balls."""
        with flint.ctx.workprec(self.bits):
            span = interval(self._instant(start), self._instant(end))
            found: list[arb] | None = None
            for piece in self._touched(span):
                sides = piece.at(span)
                found = sides if found is None else [a.union(b) for a, b in zip(found, sides, strict=True)]
            assert found is not None
            return dict(zip(self.states, found, strict=True))

    def covering(self, start: Any, end: Any) -> list[Mapping[str, arb]]:
        """Boxes, one a step, that hold the run from ``start`` to ``end`` between them."""
        with flint.ctx.workprec(self.bits):
            span = interval(self._instant(start), self._instant(end))
            return [dict(zip(self.states, piece.at(span), strict=True)) for piece in self._touched(span)]

    def _instant(self, time: Any) -> arb:
        if isinstance(time, float):
            return arb(time)
        return ball_from(parse(time, where="time") if isinstance(time, str) else time)

    def _touched(self, span: arb) -> list[Piece]:
        first, last = self.pieces[0].start, self.pieces[-1].start + self.pieces[-1].length
        if span.lower() < first or span.upper() > last:
            raise InputError(
                f"{self.time}: from {self.times[0]:.6g} to {self.times[-1]:.6g} is enclosed, not all of {span.str(6)}"
            )
        return [piece for piece in self.pieces if not (piece.start > span or piece.start + piece.length < span)]

    def to_json(self) -> dict[str, Any]:
        """The whole as data."""
        return {
            "verdict": str(self.verdict), "detail": self.detail, "time": self.time, "states": list(self.states),
            "times": list(self.times), "lower": [list(row) for row in self.lower],
            "upper": [list(row) for row in self.upper], "width": self.width, "steps": self.steps, "method": METHOD,
            "switches": [[down(item.start), up(item.end)] for item in self.switches],
            "seconds": round(self.seconds, 3),
        }  # fmt: skip

    def __repr__(self) -> str:
        return (
            f"Enclosure({self.verdict}: {', '.join(self.states)} to {self.time} = {self.times[-1]:.6g} in {self.steps} "
            f"steps, width {self.width:.2g})"
        )
