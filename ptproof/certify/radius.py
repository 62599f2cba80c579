"""The largest radius around the source for which a search can certify that positive constants exist."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, partial

import sympy as sp

from ptproof.balls.boxes import centre, is_tiny, widest
from ptproof.balls.cube import Box
from ptproof.balls.rounding import up
from ptproof.balls.search import Look, Search
from ptproof.balls.tape import Undefined
from ptproof.certify.domain import Domain
from ptproof.certify.evaluator import Evaluator, Goal, Place, start_boxes
from ptproof.certify.quotients import Quotients
from ptproof.certify.witness import Prosecutor
from ptproof.problem.field import Field

LARGEST_RADIUS = sp.Integer(2) ** 20
RADIUS_RTOL = sp.Rational(1, 1000)


@dataclass(frozen=True)
class RadiusSearch:
    """Bisection over radii: a radius counts only when a cover shows that both quotients are positive up to it."""

    field: Field
    quotients: Quotients
    inner: sp.Expr
    deadline: float

    @cached_property
    def evaluators(self) -> tuple[Evaluator, Evaluator, Evaluator]:
        """Those of the smallest (y·∇V)/‖y‖^(2κ), of the smallest slope quotient and of the smallest value quotient."""
        smallest, steepest = Goal(slope=False, largest=False), Goal(slope=True, largest=False)
        return (
            Evaluator(self.quotients.radial(), smallest),
            Evaluator(self.quotients, steepest),
            Evaluator(self.quotients, smallest),
        )

    def run(self, bad: float) -> tuple[sp.Expr | None, str]:
        """The largest radius found, or None, and how it was found; every ball of radius ``bad`` or more fails.

        On a bounded domain the other two constants are finite wherever F is smooth, and the enclosures are.
        """
        inner = self.inner
        ceiling = LARGEST_RADIUS if math.isinf(bad) else sp.Rational(bad)
        tried = 0

        def fails(start: sp.Expr, end: sp.Expr) -> bool:
            nonlocal ceiling, tried
            tried += 1
            # The first trial also prepares what all of them use.
            obstacle = self.obstacle(start, end, 1 / 2 if tried == 1 else 1 / 4)
            if obstacle is not None:
                ceiling = min(end, obstacle)
            return obstacle is not None

        trial = sp.Integer(1)
        if not inner < trial < ceiling:
            trial = _short_between(inner, ceiling if inner == 0 else min(ceiling, 2 * inner))
        while fails(inner, trial):
            trial = _short_between(inner, ceiling)
            if tried == 40:
                return None, f"No smaller ball was certified, down to radius {float(trial):.3g}"
        good, failed = trial, not math.isinf(bad) or tried > 1
        while not failed and good < LARGEST_RADIUS:
            failed = fails(good, 2 * good)
            good = good if failed else 2 * good
        while failed and ceiling - good > RADIUS_RTOL * good and time.perf_counter() < self.deadline:
            middle = _short_between(good, ceiling)
            good = good if fails(good, middle) else middle
        if not failed:
            return good, f"the largest that was tried, by {tried} doublings"
        brief = str(ceiling) if len(str(ceiling)) < 12 else f"{float(ceiling):.6g}"
        return good, f"the largest found by {tried} certified trials; radius {brief} was not certified"

    def obstacle(self, inner: sp.Expr, outer: sp.Expr, share: float) -> sp.Expr | None:
        """None if both quotients are certainly positive and finite between two radii, else where that may end.

        That is the distance of a witness where one is found, or ``outer``. It may take this ``share`` of the time that
        is left.
        """
        shell = Domain(inner, outer)
        boxes: list[Box] = list(start_boxes(self.quotients, shell))
        deadline = time.perf_counter() + share * max(0.0, self.deadline - time.perf_counter())
        radial, slope, value = self.evaluators
        for evaluators in ((slope, radial), (value,)):
            place = positive_everywhere(evaluators, boxes, deadline=deadline)
            if place is None:
                continue
            if not place.is_limit:
                prosecutor = Prosecutor(self.field, self.quotients, shell)
                witness = prosecutor.at_place(place, -math.inf, slope=True)
                if witness is not None:
                    return sp.Rational(witness.distance)
            return outer
        return None


def _short_between(low: sp.Expr, high: sp.Expr) -> sp.Rational:
    """A fraction with a short decimal form strictly between two numbers, near their middle."""
    middle = (low + high) / 2
    for digits in range(1, 30):
        value = sp.Rational(str(sp.N(middle, digits)))
        if low < value < high and abs(value - middle) <= (high - low) / 8:
            return value
    return sp.Rational(str(sp.N(middle, 30)))


def positive_everywhere(
    evaluators: Sequence[Evaluator], boxes: Sequence[Box], *, deadline: float, max_boxes: int = 50_000
) -> Place | None:
    """None if on each box of a cover one of the quotients is certainly positive; else where that was not shown.

    The evaluators are those of smallest values; each box is tried with one after the other. Where the first one's
    quotient is certainly not positive, the search ends at once.
    """
    order = list(evaluators)

    def look(box: Box, _: float) -> Look[Box, Box]:
        splits: list[int] = []
        failing = None
        for evaluator in tuple(order):
            try:
                bound = evaluator.bound(box, 0.0)
                if bound.upper < 0:
                    # What has worked here is tried first on the next box.
                    order.remove(evaluator)
                    order.insert(0, evaluator)
                    return Look(up(bound.upper), settled=True)
                if bound.split is not None:
                    splits.append(bound.split)
                if evaluator is evaluators[0] and evaluator.value(box, bound.point) >= 0:
                    failing = box
            except Undefined:
                continue
        split = splits[0] if splits else widest(box.sides)
        halves = None if split is None or is_tiny(box.sides) else partial(box.split, split)
        return Look(math.inf, False, halves, 0.0, failing)

    search = Search(look, boxes, depth_first=True)
    search.run(lambda: search.point is not None, deadline=deadline, most=max_boxes)
    box = search.point or search.next
    return None if box is None else Place(box, centre(box.sides))
