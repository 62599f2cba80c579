"""Extreme values of a quotient over a domain, by branch and bound with certified bounds on both sides."""

from __future__ import annotations

import heapq
import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import count

from flint import arb

from ptproof.certify.domain import Domain
from ptproof.certify.quotients import Box, Function, Quotients
from ptproof.proof.ball import BALLS, ball_from
from ptproof.proof.jet import Bound, Side, middle, upper_bound
from ptproof.proof.tape import Undefined

BITS = 96
TINY = 2.0**-40


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
        here = Box(box.face, box.outer, tuple((end, end) for end in point))
        main = self.quotients.leading(box.face, box.outer, self.goal.slope)(point, BALLS)
        return self.sign * (main + self.quotients.remainder(here, self.goal.slope))

    def bound(self, box: Box, enough: float) -> Bound:
        """An upper bound of ± the quotient; further forms are tried only if the first are above ``enough``."""
        low, high = box.sides[0]
        whole = self.quotients.is_polynomial
        forms: list[Callable[[Box], Bound]] = []
        if low > 0:
            forms.append(self._joint)
            if not (whole or self.quotients.polynomial.is_zero):
                forms.append(self._separate)
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

    def _joint(self, box: Box) -> Bound:
        function = self.quotients.direct(box.face, box.outer, self.goal.slope)
        return upper_bound(lambda values, arithmetic: self.sign * function(values, arithmetic), box.sides)

    def _separate(self, box: Box) -> Bound:
        function = self.quotients.direct(box.face, box.outer, self.goal.slope, rest=False)
        return self._with_tail(function, self.quotients.direct_rest(box, self.goal.slope), box)

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
            split = _widest_relative(box)
        return Bound((main.upper + tail).upper(), main.point, split)


def _widest_relative(box: Box) -> int:
    widths = [float(high - low) for low, high in box.sides]
    if not box.sides[0][0].is_zero():
        widths[0] /= float(box.sides[0][1])
    return max(range(len(widths)), key=widths.__getitem__)


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
                split = _widest(box)
            if split is None or (negative == -math.inf and _is_tiny(box)):
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
            upper, split, known = math.inf, _widest(box), None
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


def _widest(box: Box) -> int | None:
    widths = [float(high - low) for low, high in box.sides]
    index = max(range(len(widths)), key=widths.__getitem__)
    return index if widths[index] > 0 else None


def _is_tiny(box: Box) -> bool:
    return all(float(high - low) <= TINY * max(1.0, abs(float(high))) for low, high in box.sides)


def positive_everywhere(
    evaluators: Sequence[Evaluator], boxes: Sequence[Box], *, deadline: float, max_boxes: int = 50_000
) -> Place | None:
    """None if on each box of a cover one of the quotients is certainly positive; else where that was not shown.

    The evaluators are those of smallest values; each box is tried with one after the other. Where the first one's
    quotient is certainly not positive, the search ends at once.
    """
    stack = list(boxes)
    order = list(evaluators)
    looked = 0
    while stack:
        looked += 1
        box = stack.pop()
        splits: list[int] = []
        hopeless = False
        for evaluator in tuple(order):
            try:
                bound = evaluator.bound(box, 0.0)
                if bound.upper < 0:
                    # What has worked here is tried first on the next box.
                    order.remove(evaluator)
                    order.insert(0, evaluator)
                    break
                if bound.split is not None:
                    splits.append(bound.split)
                if evaluator is evaluators[0]:
                    hopeless = bool(evaluator.value(box, bound.point) >= 0)
            except Undefined:
                continue
        else:
            split = splits[0] if splits else _widest(box)
            if hopeless or split is None or _is_tiny(box) or looked > max_boxes or time.perf_counter() > deadline:
                return Place(box, tuple(side[0] if side[0] is side[1] else middle(side) for side in box.sides))
            stack.extend(box.split(split))
    return None
