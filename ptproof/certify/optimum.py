"""Extreme values of a quotient over a domain, by branch and bound with certified bounds on both sides."""

from __future__ import annotations

import heapq
import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import count

from flint import arb

from ptproof.balls.cube import Box
from ptproof.balls.jet import middle
from ptproof.balls.tape import Undefined
from ptproof.certify.evaluator import Evaluator, Goal, Place, is_tiny, widest
from ptproof.certify.quotients import Quotients


def down(ball: arb) -> float:
    """A float that is not above any value in ``ball``."""
    return _outward(ball.lower(), -math.inf)


def up(ball: arb) -> float:
    """A float that is not below any value in ``ball``."""
    return _outward(ball.upper(), math.inf)


def _outward(ball: arb, towards: float) -> float:
    value = float(ball)
    if math.isnan(value):
        return towards
    if value == 0 and ball.is_zero():
        return 0.0
    return math.nextafter(math.nextafter(value, towards), towards)


@dataclass(frozen=True)
class Optimum:
    """The extreme value lies in [lower, upper]; ``place`` is where the best value was found.

    ``finished`` says that the wanted width has been reached, ``stuck`` where no enclosure exists at all.
    """

    lower: float
    upper: float
    place: Place | None
    finished: bool
    boxes: int
    stuck: Place | None = None


class Extremum:
    """The supremum or infimum of a quotient over ``boxes``, enclosed ever more narrowly until ``rtol`` is reached.

    The bounds are rigorous at any time, finished or not.
    """

    def __init__(self, quotients: Quotients, goal: Goal, boxes: Sequence[Box], rtol: float) -> None:
        self.evaluator, self.goal, self.rtol = Evaluator(quotients, goal), goal, rtol
        self.best = self.ceiling = -math.inf
        self.place: Place | None = None
        self.stuck: Place | None = None
        self.boxes = 0
        self.ticket = count()
        self.heap: list[tuple[float, int, Box, int | None]] = []
        self.waiting = list(boxes)
        self.next_question = 64

    @property
    def finished(self) -> bool:
        """Whether the wanted width has been reached."""
        return not self.waiting and self.place is not None and self.top() <= self.accept()

    def top(self) -> float:
        """The largest bound of a box that is still open."""
        return -self.heap[0][0] if self.heap else -math.inf

    def run(
        self, deadline: float, stop: Callable[[Place, float], bool] | None = None, max_boxes: int = 400_000
    ) -> bool:
        """Work until the width is reached, the time is over, or ``stop`` says so; returns whether ``stop`` did.

        ``stop(place, best value)`` is asked now and then, and when a smallest value has turned out not positive.
        """
        while self.waiting:
            self.add(self.waiting.pop())
        while not self.finished and self.heap and self.boxes < max_boxes and time.perf_counter() < deadline:
            passed = self.place is not None and not self.goal.largest and self.best >= 0
            if stop is not None and self.place is not None and (passed or self.boxes >= self.next_question):
                self.next_question = 3 * self.boxes
                if stop(self.place, self.best):
                    return True
                if passed:
                    return False
            entry = heapq.heappop(self.heap)
            negative, _, box, split = entry
            if split is None:
                split = widest(box)
            if split is None or (negative == -math.inf and is_tiny(box)):
                heapq.heappush(self.heap, entry)
                self.stuck = Place(box, tuple(middle(side) for side in box.sides))
                return False
            for half in box.split(split):
                self.add(half)
        return False

    def optimum(self) -> Optimum:
        """What is known now."""
        ceiling = math.inf if self.waiting else max(self.ceiling, self.best, self.top())
        lower, upper = (self.best, ceiling) if self.goal.largest else (-ceiling, -self.best)
        return Optimum(lower, upper, self.place, self.finished, self.boxes, self.stuck)

    def accept(self) -> float:
        """What is not above this needs no further look."""
        return self.best + self.rtol * abs(self.best) if math.isfinite(self.best) else -math.inf

    def add(self, box: Box) -> None:
        self.boxes += 1
        try:
            bound = self.evaluator.bound(box, self.accept())
            upper, split, point, known = up(bound.upper), bound.split, bound.point, bound.value
        except Undefined:
            upper, split, known = math.inf, widest(box), None
            point = tuple(side[0] if side[0] is side[1] else middle(side) for side in box.sides)
        if upper <= self.best:
            self.ceiling = max(self.ceiling, upper)
            return
        try:
            value = down(self.evaluator.value(box, point) if known is None else known)
        except Undefined:
            value = -math.inf
        if value > self.best:
            self.best, self.place = value, Place(box, point)
        if upper <= self.accept():
            self.ceiling = max(self.ceiling, upper)
        else:
            heapq.heappush(self.heap, (-upper, next(self.ticket), box, split))
