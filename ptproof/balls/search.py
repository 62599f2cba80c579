"""Branch and bound: the largest value of a function over parts of a domain, enclosed from both sides.

A part is anything that can be bounded from above and halved. The search is the same whether the largest value is
wanted (stop when both bounds are close) or only its sign (settle the parts on which it is certainly negative, stop at
a point where it is not).
"""

from __future__ import annotations

import heapq
import math
import time
from collections import deque
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

Part = TypeVar("Part")
Point = TypeVar("Point")


@dataclass(frozen=True)
class Look(Generic[Part, Point]):
    """What one look at a part has shown.

    ``upper`` is not below any value there, infinite where nothing is known. ``settled`` says that the part needs no
    further look. ``halves`` makes the parts to look at next; None where halving has become pointless. ``lower`` is
    not above the value at ``point``, where one was tried.
    """

    upper: float
    settled: bool = False
    halves: Callable[[], Sequence[Part]] | None = None
    lower: float = -math.inf
    point: Point | None = None


class Search(Generic[Part, Point]):
    """The largest value over ``parts``, which cover the domain; its bounds are rigorous at any time.

    Parameters
    ----------
    look
        From a part and the best value so far, what is certain there.
    depth_first
        Follow one part to its end, instead of the one with the largest upper bound.

    Attributes
    ----------
    best, point
        The largest value that is certainly reached, and where; −∞ and None before there is one.
    looks
        How many parts have been looked at.
    stuck
        A part that could not be halved when it was its turn, which has ended the search.

    Examples
    --------
    >>> def look(part: tuple[float, float], best: float) -> Look[tuple[float, float], float]:
    ...     low, high = part
    ...     middle = (low + high) / 2
    ...     return Look(high * (1 - low), False, lambda: [(low, middle), (middle, high)], middle * (1 - middle), middle)
    >>> search = Search(look, [(0.0, 1.0)])
    >>> search.run(lambda: search.upper - search.best < 0.01)
    >>> search.best
    0.25
    """

    def __init__(
        self, look: Callable[[Part, float], Look[Part, Point]], parts: Iterable[Part], *, depth_first: bool = False
    ) -> None:
        self.best = -math.inf
        self.point: Point | None = None
        self.looks = 0
        self.stuck: Part | None = None
        self._look, self._depth_first = look, depth_first
        self._waiting, self._above = deque(parts), math.inf
        self._settled = -math.inf
        self._open: list[tuple[float, int, Part, Look[Part, Point]]] = []

    def run(self, enough: Callable[[], bool], *, deadline: float = math.inf, most: float = math.inf) -> None:
        """Go on until ``enough`` says so, nothing is left, or ``most`` looks or the ``deadline`` are reached.

        ``enough`` is asked whenever a part is about to be halved; ``deadline`` is a time of ``time.perf_counter``.
        """
        while self.looks < most and time.perf_counter() < deadline:
            if self._waiting:
                self._take(self._waiting.popleft())
                continue
            if not self._open or enough():
                return
            _, _, part, look = self._open[0]
            if look.halves is None:
                self.stuck = part
                return
            heapq.heappop(self._open)
            self._waiting.extend(look.halves())
            self._above = look.upper

    def _take(self, part: Part) -> None:
        look = self._look(part, self.best)
        self.looks += 1
        if look.point is not None and look.lower > self.best:
            self.best, self.point = look.lower, look.point
        if look.settled:
            self._settled = max(self._settled, look.upper)
        else:
            key = -self.looks if self._depth_first else -look.upper
            heapq.heappush(self._open, (key, self.looks, part, look))

    @property
    def left(self) -> int:
        """How many parts are not settled."""
        return len(self._waiting) + len(self._open)

    @property
    def next(self) -> Part | None:
        """The part whose turn it is; None where all are settled."""
        return self._waiting[0] if self._waiting else self._open[0][2] if self._open else None

    @property
    def open_upper(self) -> float:
        """What no value on the parts that are not settled exceeds."""
        waiting = self._above if self._waiting else -math.inf
        top = self._open if self._depth_first else self._open[:1]
        return max([waiting, *(look.upper for *_, look in top)])

    @property
    def upper(self) -> float:
        """What no value exceeds."""
        return max(self._settled, self.best, self.open_upper)
