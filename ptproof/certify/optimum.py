"""Extreme values of a quotient over a domain, by branch and bound with certified bounds on both sides."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from ptproof.balls.boxes import centre, is_tiny, widest
from ptproof.balls.cube import Box
from ptproof.balls.rounding import down, up
from ptproof.balls.search import Look, Search
from ptproof.balls.tape import Undefined
from ptproof.certify.certificate import Range
from ptproof.certify.evaluator import Evaluator, Goal, Place
from ptproof.certify.quotients import Quotients


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
