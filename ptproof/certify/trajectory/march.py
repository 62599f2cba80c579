"""Step by step through time: propose in floats, prove in balls, and choose the next step."""

from __future__ import annotations

import time as clock
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import sympy as sp
from flint import arb
from numpy.polynomial import legendre

from ptproof.balls.ball import ball_from
from ptproof.balls.flow import GuardCrossed, across, flow, lowest
from ptproof.balls.pieces import Piece, Proposal, Region
from ptproof.balls.tape import Undefined
from ptproof.certify.trajectory import collocation
from ptproof.certify.trajectory.collocation import DEGREE, Trial, scales, slow_part, split
from ptproof.certify.trajectory.modes import Choices, Mode, mode_of

Progress = Callable[[float], None]
_ORDER = DEGREE - 1
_ADDED, _SHARE = 300.0, 1e-3  # a step may add so many tolerances, and that share of the errors that there are
_CAREFUL = (
    1e-6  # of the former, where the right-hand side has kinks: each makes of errors a time in which it is in doubt
)
_SHORTEST = 1e-13  # of the length of the run
# A step across a kink is of first order: many short ones add less to the errors than a long one.
_PARTS, _GROWING, _RETREAT = 4, 1.4, 1e-12


class Stopped(Exception):
    """The enclosure can't be carried further, for a reason in words."""


@dataclass(frozen=True)
class Switch:
    """A span of time in which the right-hand side may have changed from one branch of a Max, Min or Abs to another."""

    start: arb
    end: arb
    before: tuple[int, ...]
    after: tuple[int, ...]


@dataclass
class March:
    """What has been enclosed so far, and how to go on.

    ``ends`` has a ball for each state at the end of each piece. ``tolerance`` is the relative size at which the last
    terms of a step's polynomial are left out; ``deadline`` an instant of the wall clock; ``progress`` is told the time
    that has been reached.
    """

    region: Region
    tolerance: float
    deadline: float
    progress: Progress = lambda _: None
    pieces: list[Piece] = field(default_factory=list)
    ends: list[list[arb]] = field(default_factory=list)
    switches: list[Switch] = field(default_factory=list)
    length: float = 0.0

    def through(self, choices: Choices, first: sp.Expr, last: sp.Expr) -> None:
        """Carry the enclosure over one stretch of time; raises :class:`Stopped` where it ends before."""
        walk = _Walk(self, choices, ball_from(first), ball_from(last))
        while not walk.done:
            if clock.monotonic() > self.deadline:
                raise Stopped("the time limit was met")
            walk.step()
            self.progress(float(walk.now))


class _Walk:
    """One stretch: the present instant, mode and length of step."""

    def __init__(self, march: March, choices: Choices, now: arb, end: arb) -> None:
        self.march, self.choices, self.now, self.end = march, choices, now, end
        self.whole = float(end - now)
        self.length = march.length or self.whole / 1000
        self.last: tuple[Trial, Any, float] | None = None
        self.mode: Mode | None = None
        self.scale: Any = None
        self.retreat = _RETREAT * self.whole
        self.event: float | None = None
        self.done, self.tries = False, 0
        self.bridge: tuple[arb, tuple[int, ...]] | None = None
        self.bridging, self.past = 1e-12 * self.whole, -np.inf

    @property
    def state(self) -> Any:
        return np.array([float(c) for c in self.march.region.centre])

    def step(self) -> None:
        """Enclose one more step, of whatever kind."""
        if self.mode is None and (float(self.now) < self.past or not self.settled()):
            return self.hull(self.bridging)
        assert self.mode is not None
        remaining = float(self.end - self.now)
        length = min(self.length, remaining)
        if length > 0.9 * remaining:
            length = remaining
        try:
            self.smooth(length)
        except GuardCrossed as error:
            self.retreat *= 4
            self.shorten(length / 2 if self.event is None else length, str(error))
        except Undefined as error:
            self.shorten(length / 2, str(error))

    def shorten(self, length: float, why: str) -> None:
        self.tries += 1
        if length < _SHORTEST * self.whole or self.tries > 200:
            raise Stopped(f"no step could be proved at {self.choices.system.time} = {float(self.now):.10g}: {why}")
        self.length, self.last = length, None if length < 0.1 * self.length else self.last

    def settled(self) -> bool:
        """Find the mode that certainly holds here."""
        if not self.choices.nodes:
            self.mode = mode_of(self.choices, ())
            return True
        mode = mode_of(self.choices, self.choices.choice(float(self.now), self.state))
        try:
            if not all(low > 0 for low in lowest(mode.guards, self.march.region, self.now)):
                return False
        except Undefined:
            return False
        self.mode, self.retreat, self.event = mode, _RETREAT * self.whole, None
        if self.bridge is not None:
            start, before = self.bridge
            if before != mode.choice:
                self.march.switches.append(Switch(start, self.now, before, mode.choice))
            self.bridge = None
        self.bridging, self.length = 1e-12 * self.whole, max(self.length / 50, 1e-9 * self.whole)
        return True

    def hull(self, length: float) -> None:
        """Go on without knowing the mode."""
        remaining = float(self.end - self.now)
        closing = length >= remaining
        after = self.end if closing else arb(float(self.now) + length)
        if not after > self.now:
            self.bridging = 2 * length
            return
        self.tries += 1
        if length > 1e-3 * self.whole or self.tries > 200:
            raise Stopped(f"a switch at {self.choices.system.time} = {float(self.now):.10g} could not be resolved")
        try:
            piece, region = across(self.choices.tape, self.march.region, self.now, after - self.now)
        except Undefined as error:
            self.bridging = length / 4
            if self.bridging < 1e-18 * self.whole:
                raise Stopped(str(error)) from None
            return
        if self.bridge is None:
            self.bridge = self.now, self.choices.choice(float(self.now), self.state)
        self.accept(piece, region, after)
        self.last, self.bridging = None, _GROWING * length

    def smooth(self, length: float) -> None:
        """One step with the present mode; a shorter one is asked for where that is not good enough."""
        mode, begin = self.mode, self.state
        assert mode is not None
        now, march = float(self.now), self.march
        trial = self.solve(mode, now, length, begin)
        if trial is None or not trial.tail < 30 * march.tolerance:
            factor = 0.5 if trial is None else max(0.2, 0.9 * (march.tolerance / trial.tail) ** (1 / _ORDER))
            return self.shorten(length * factor, "the run could not be followed in floating-point numbers")
        crossing = self.crossing(mode, trial, length)
        if crossing is not None:
            self.event = now + crossing[0]
            self.retreat = max(self.retreat, crossing[1])
        away = np.inf if self.event is None else self.event - now
        if length > away - self.retreat / 2:
            if away < 2 * self.retreat:
                self.mode, self.past, self.event = None, now + max(away, 0.0) + self.retreat, None
                return self.hull((max(away, 0.0) + self.retreat) / _PARTS)
            return self.shorten(away - self.retreat, "a switch")
        closing = length >= float(self.end - self.now) * (1 - 1e-12)
        after = self.end if closing else arb(now + length)
        exact = after - self.now
        piece, region = flow(mode.field, march.region, self.now, exact, self.proposal(mode, trial, exact, begin))
        worst = self.worst(piece, begin)
        if worst > 1 and length > 1e-7 * self.whole:
            return self.shorten(length * max(0.3, 0.9 * worst ** (-1 / _ORDER)), "the proved errors grow too fast")
        self.last = trial, begin, length
        self.accept(piece, region, after)
        self.length = length * min(2.0, max(0.4, 0.9 * (march.tolerance / max(trial.tail, 1e-30)) ** (1 / _ORDER)))
        march.length = self.length

    def worst(self, piece: Piece, state: Any) -> float:
        """The errors that a step adds, as a share of those that it may add."""
        scale = np.maximum(np.abs(state), 1e-6 * np.abs(state).max())
        added = _ADDED * (_CAREFUL if self.choices.nodes else 1.0)
        allowed = added * self.march.tolerance * scale + _SHARE * np.array([float(e) for e in self.march.region.errors])
        return float((np.array([float(entry) for entry in piece.added]) / np.maximum(allowed, 1e-300)).max())

    def solve(self, mode: Mode, now: float, length: float, begin: Any) -> Trial | None:
        flat = np.tile(begin, (DEGREE, 1))
        if self.last is not None:
            guess = collocation.extended(self.last[0], self.last[1], self.last[2], length)
            if (trial := collocation.attempt(mode.rates, now, length, begin, guess)) is not None:
                return trial
        return collocation.attempt(mode.rates, now, length, begin, flat)

    def proposal(self, mode: Mode, trial: Trial, exact: arb, begin: Any) -> Proposal:
        centre, length = self.march.region.centre, float(exact)
        rates = collocation.refined(trial, mode.plain, centre, self.now, exact)
        self.scale = scales(trial.jacobians, self.scale)
        basis, slow = split(trial.jacobians[DEGREE // 2], length)
        kept = None
        if slow < len(basis):
            _, first, _ = mode.rates.of(np.array([float(self.now)]), begin[None, :])
            kept = slow_part(first[0], length, slow)
        if kept is None:
            kept = np.eye(len(basis))
        return collocation.proposal(trial, rates, centre, length, kept, basis, self.scale)

    def crossing(self, mode: Mode, trial: Trial, length: float) -> tuple[float, float] | None:
        """How far away a guard vanishes first in the step, in floats, and how long its doubt lasts there; or None."""
        if not mode.rates.guards:
            return None
        first = mode.rates.of(np.array([float(self.now)]), self.state[None, :])[2]
        nodes = np.concatenate([[-1.0], collocation.scheme(DEGREE).nodes])
        sure = lowest(mode.guards, self.march.region, self.now)
        values, dense = np.concatenate([first, trial.guards]), np.linspace(-1, 1, 401)
        found = []
        for index in range(mode.rates.guards):
            series = legendre.legfit(nodes, values[:, index], DEGREE)
            along = legendre.legval(dense, series)
            below = np.nonzero(along < 0)[0]
            if len(below):
                k = int(below[0])
                s = -1.0 if k == 0 else _root(series, float(dense[k - 1]), float(dense[k]))
                rate = abs(float(legendre.legval(s, legendre.legder(series)))) * 2 / length
                doubt = max(float(first[0, index]) - float(sure[index]), 0.0)
                found.append(((s + 1) / 2 * length, min(4 * doubt / max(rate, 1e-300), 1e-5 * self.whole)))
        return min(found, default=None)

    def accept(self, piece: Piece, region: Region, after: arb) -> None:
        """Go on from there. Each instant but a stretch's end is exact, so that no doubt about the time adds up."""
        self.march.pieces.append(piece)
        self.march.ends.append(region.box)
        self.march.region, self.tries = region, 0
        self.now, self.done = after, after is self.end
        if self.event is not None and self.event - float(after) > 0.5 * self.whole:
            self.event = None


def _root(series: Any, low: float, high: float) -> float:
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if legendre.legval(middle, series) >= 0 else (low, middle)
    return low
