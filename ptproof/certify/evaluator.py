"""Certified bounds and values of a quotient by whichever form is sharpest, and extreme values by branch and bound."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

from flint import arb

from ptproof.balls.ball import BALLS, ball_from
from ptproof.balls.boxes import Side, centre, is_tiny, widest
from ptproof.balls.cube import Box
from ptproof.balls.jet import Bound, upper_bound
from ptproof.balls.rounding import down, up
from ptproof.balls.search import Look, Search
from ptproof.balls.tape import Undefined
from ptproof.certify.certificate import Range
from ptproof.certify.domain import Domain
from ptproof.certify.quotients import Function, Quotients


@dataclass(frozen=True)
class Goal:
    """What is sought: the supremum or the infimum of the value quotient or of the squared slope quotient."""

    slope: bool
    largest: bool


@dataclass(frozen=True)
class Place:
    """A point of the domain in the coordinates of a box; t = 0 stands for the limit there."""

    box: Box
    point: tuple[arb, ...]

    @property
    def is_limit(self) -> bool:
        """Whether it is the source or infinity, approached in one direction."""
        return bool(self.point[0].is_zero())

    def direction(self) -> list[float]:
        """The direction y/‖y‖."""
        u = [float(entry) for entry in self.box.face.cube_point(self.point[1:])]
        size = math.sqrt(sum(entry * entry for entry in u))
        return [entry / size for entry in u]

    def offset(self) -> list[float]:
        """y = x − x* in floating-point numbers; not for a limit at infinity."""
        t = float(self.point[0])
        radius = 1 / t if self.box.outer else t
        return [radius * entry for entry in self.direction()]


def start_boxes(quotients: Quotients, domain: Domain) -> Iterator[Box]:
    """Boxes that cover ``domain``, up to the symmetries of the field."""
    radial: list[tuple[bool, Side]] = []
    inner, one = ball_from(domain.inner), arb(1)
    outer = None if domain.outer is None else ball_from(domain.outer)
    if outer is not None and (quotients.is_polynomial or not outer > 1):
        radial.append((False, (inner, outer)))
    else:
        if inner < 1:
            radial.append((False, (inner, one)))
        far = arb(0) if outer is None else 1 / outer
        radial.append((True, (far, one if inner < 1 else 1 / inner)))
    for face in quotients.faces:
        sides = tuple((arb(low), arb(high)) for low, high in face.sides)
        for chart, side in radial:
            yield Box(face, chart, (side, *sides))


class Evaluator:
    """Certified bounds of ± a quotient on boxes, and certified values at points."""

    def __init__(self, quotients: Quotients, goal: Goal) -> None:
        self.quotients, self.goal = quotients, goal
        self.sign = 1 if goal.largest else -1

    def value(self, box: Box, point: Sequence[arb]) -> arb:
        """± the quotient at a point of ``box``, or its limit where t = 0."""
        if not point[0].is_zero():
            function = self.quotients.direct(box.face, box.outer, self.goal.slope)
            return self.sign * function(point, BALLS)
        here = box.at(point)
        main = self.quotients.leading(box.face, box.outer, self.goal.slope)(point, BALLS)
        return self.sign * (main + self.quotients.remainder(here, self.goal.slope))

    def bound(self, box: Box, enough: float) -> Bound:
        """An upper bound of ± the quotient; further forms are tried only if the first are above ``enough``."""
        low, high = box.sides[0]
        whole = self.quotients.is_polynomial
        forms: list[Callable[[Box], Bound]] = []
        if low > 0:
            forms.append(partial(self._direct, rest=True))
            if not (whole or self.quotients.polynomial.is_zero):
                forms.append(partial(self._direct, rest=False))
        if low.is_zero() or box.outer or high < 2:
            first = low.is_zero() or (not box.outer and (whole or high > 4 * low or high < 0.1))
            forms.insert(0 if first else len(forms), self._series)
        best: Bound | None = None
        for form in forms:
            if form == self._series and best is not None and box.outer and not high > 2 * low:
                break  # bounds on growth serve where the radius ranges over more than a factor
            try:
                found = form(box)
            except Undefined:
                continue
            if best is None or found.upper < best.upper:
                best = found
            if best.upper < enough:
                break
        if best is None:
            raise Undefined("no form of the quotient has a finite value there")
        return best

    def _direct(self, box: Box, rest: bool) -> Bound:
        """By the defining form, together with what is not polynomial or with that apart."""
        function = self.quotients.direct(box.face, box.outer, self.goal.slope, rest=rest)
        return self._with_tail(function, arb(0) if rest else self.quotients.direct_rest(box, self.goal.slope), box)

    def _series(self, box: Box) -> Bound:
        function = self.quotients.leading(box.face, box.outer, self.goal.slope)
        return self._with_tail(function, self.quotients.remainder(box, self.goal.slope), box)

    def _with_tail(self, function: Function, missing: arb, box: Box) -> Bound:
        main = upper_bound(lambda values, arithmetic: self.sign * function(values, arithmetic), box.sides)
        tail = self.sign * missing
        if tail.is_zero():
            return main
        split = main.split
        if split is None or main.value is None or tail.upper() > (main.upper - main.value).abs_upper():
            split = box.widest()
        return Bound((main.upper + tail).upper(), main.point, split)


class Extremum:
    """The supremum or infimum of a quotient over ``boxes``, enclosed ever more narrowly until ``rtol`` is reached.

    The bounds are rigorous at any time, finished or not.
    """

    def __init__(self, quotients: Quotients, goal: Goal, boxes: Sequence[Box], rtol: float) -> None:
        self.evaluator, self.goal, self.rtol = Evaluator(quotients, goal), goal, rtol
        self.search = Search(self._look, reversed(boxes))
        self._next_question = 64

    @property
    def place(self) -> Place | None:
        """Where the best value was found."""
        return self.search.point

    @property
    def stuck(self) -> Place | None:
        """Where no enclosure exists at all."""
        box = self.search.stuck
        return None if box is None else Place(box, centre(box.sides))

    @property
    def finished(self) -> bool:
        """Whether the wanted width has been reached."""
        return self.place is not None and self.search.open_upper <= self._accepted(self.search.best)

    def run(
        self, deadline: float, stop: Callable[[Place, float], bool] | None = None, max_boxes: int = 400_000
    ) -> None:
        """Work until the width is reached, the time is over, or ``stop`` says so.

        ``stop(place, best value)`` is asked now and then, and when a smallest value has turned out not positive.
        """
        search = self.search

        def enough() -> bool:
            if self.finished:
                return True
            passed = self.place is not None and not self.goal.largest and search.best >= 0
            if stop is None or self.place is None or not (passed or search.looks >= self._next_question):
                return False
            self._next_question = 3 * search.looks
            return stop(self.place, search.best) or passed

        search.run(enough, deadline=deadline, most=max_boxes)

    def range(self) -> Range:
        """The constant that this value is, or whose square: what is known of it now."""
        lower, upper = self.search.best, self.search.upper
        if not self.goal.largest:
            lower, upper = -upper, -lower
        if self.goal.slope:
            lower = math.nextafter(math.sqrt(lower), 0.0) if lower > 0 else 0.0
            upper = math.nextafter(math.sqrt(upper), math.inf) if upper > 0 else 0.0
        return Range(lower if math.isfinite(lower) else None, upper if math.isfinite(upper) else None)

    def _accepted(self, best: float) -> float:
        """What is not above this needs no further look."""
        return best + self.rtol * abs(best) if math.isfinite(best) else -math.inf

    def _look(self, box: Box, best: float) -> Look[Box, Place]:
        try:
            bound = self.evaluator.bound(box, self._accepted(best))
            upper, split, point, known = up(bound.upper), bound.split, bound.point, bound.value
        except Undefined:
            upper, split, point, known = math.inf, None, centre(box.sides), None
        if upper <= best:
            return Look(upper, settled=True)
        try:
            value = down(self.evaluator.value(box, point) if known is None else known)
        except Undefined:
            value = -math.inf
        settled = upper <= self._accepted(max(best, value))
        if split is None and not (upper == math.inf and is_tiny(box.sides)):
            split = widest(box.sides)
        halves = None if split is None else lambda: box.split(split)
        return Look(upper, settled, halves, value, Place(box, point))
