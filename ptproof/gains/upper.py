"""The upper solution of the radial comparison system, moved step by step in ball arithmetic."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import sympy as sp
from flint import arb

from ptproof.balls.ball import BALLS, ball_from, interval, precision
from ptproof.balls.radial import BITS, RadialEnvelope
from ptproof.balls.rounding import down, up
from ptproof.balls.tape import Undefined, compile_tape
from ptproof.balls.transport import Transport
from ptproof.errors import InputError
from ptproof.gains.horizon import Horizon
from ptproof.gains.numbers import NotApplicable, sign
from ptproof.problem import Problem
from ptproof.problem.model import TIME
from ptproof.proof.signs import vanishes

_FALL = 1.25  # of w = dt/dτ over one step, at most
_TINY = 1e-300  # no bound is taken below this, where floats lose their digits
_GROWTH = 1000.0  # a bound that exceeds this many times the initial distance is given up


@dataclass(frozen=True)
class Node:
    """A grid time: elapsed t and τ, and w = dt/dτ there, exact."""

    stretched: sp.Expr
    elapsed: sp.Expr
    weight: sp.Expr

    @cached_property
    def about(self) -> float:
        """w as a float."""
        return float(self.weight)


def time_grid(horizon: Horizon, end: sp.Expr, steps: int) -> list[Node]:
    """Uniform in the stretched time on both sides of the corner, which is a node, and finer where w falls fast."""
    final = horizon.stretched(end)
    corner = None if horizon.nu_min is None or sign(end - horizon.corner) <= 0 else horizon.stretched_corner
    if corner is None or sign(corner) == 0:
        marks = [final * sp.Rational(i, steps) for i in range(steps + 1)]
    else:
        early = min(steps - 1, max(1, round(steps * float(corner / final)))) if steps > 1 else 1
        late = max(1, steps - early)
        marks = [corner * sp.Rational(i, early) for i in range(early + 1)]
        marks += [corner + (final - corner) * sp.Rational(i, late) for i in range(1, late + 1)]
    nodes = [Node(s, horizon.elapsed(s), horizon.weight(s)) for s in marks]
    return [nodes[0], *(node for pair in pairwise(nodes) for node in _refined(horizon, *pair))]


def _refined(horizon: Horizon, left: Node, right: Node) -> list[Node]:
    """The nodes after ``left`` up to ``right``: halves, until w falls by no more than a fifth from one to the next."""
    if left.about <= _FALL * right.about:
        return [right]
    s = (left.stretched + right.stretched) / 2
    middle = Node(s, horizon.elapsed(s), horizon.weight(s))
    return [*_refined(horizon, left, middle), *_refined(horizon, middle, right)]


class UpperSolution:
    """The upper solution y, moved step by step.

    Raises
    ------
    InputError
        If the gradient is not shown to be zero at the source.
    NotApplicable
        If the field has no envelope.
    """

    def __init__(self, problem: Problem, initial: sp.Expr, grid: list[Node]) -> None:
        field, drift = problem.field, problem.drift
        matrix = drift.matrix if drift.kind == "gradient" else None
        with precision(BITS):
            self.y = up(ball_from(initial))
            self.t0 = ball_from(problem.tuning.t0)
            self.balls = {
                node: (ball_from(node.stretched), ball_from(node.elapsed), ball_from(node.weight)) for node in grid
            }
            self.source = [ball_from(value) for value in field.source]
            lowest, highest = down(self.balls[grid[-1]][2]), max(1.0, up(self.balls[grid[0]][2]))
        self.limit = _GROWTH * self.y
        weights = (1.0,) if matrix is None else _weights(lowest, highest)
        try:
            self.envelope = RadialEnvelope(
                field.variables, field.expression, field.source, problem.tuning.k, matrix, self.y, weights
            )
        except Undefined as error:
            raise NotApplicable(str(error)) from None
        at_source = dict(zip(field.variables, field.source, strict=True))
        if not all(vanishes(entry.subs(at_source, simultaneous=True)) for entry in field.gradient):
            raise InputError(f"the gradient of the field is not zero at the source {field.source}")
        self.drift = compile_tape(list(drift.rate), (TIME, *field.variables)) if drift.kind == "bounded" else None

    def step(self, left: Node, right: Node) -> float:
        """Move y over one step and return it; raises :class:`NotApplicable` where that fails."""
        with precision(BITS):
            (s0, e0, w0), (s1, e1, w1) = self.balls[left], self.balls[right]
            weights = (min(down(w1), down(w0)), max(up(w0), up(w1)))
            reach = self.y
            for _ in range(8):  # the drift is enclosed on a ball that y must not leave on this step
                reach *= 1.05
                push = self._push(interval(e0, e1), reach, weights[1])
                moved = Transport(self.envelope, push, weights, reach).move(self.y, s1 - s0)
                if moved is None:
                    raise NotApplicable("a shell where the field has no finite enclosure")
                if moved > self.limit:
                    raise NotApplicable(f"{_GROWTH:g} times the initial distance")
                if moved < reach:
                    self.y = max(moved, _TINY)
                    return self.y
                reach = moved
            raise NotApplicable("a bound that grows too fast for the step")

    def _push(self, elapsed: arb, reach: float, weight: float) -> float:
        """An upper bound of w·‖f‖ on the step for ‖x − x*‖ ≤ reach."""
        if self.drift is None:
            return 0.0
        around = interval(-arb(reach), arb(reach))
        try:
            values = self.drift.run([self.t0 + elapsed, *(c + around for c in self.source)], BALLS)
        except Undefined:
            raise NotApplicable("a drift without a finite enclosure") from None
        total = sum((value * value for value in values), arb(0))
        return up(total.abs_upper().sqrt() * arb(weight))


def _weights(low: float, high: float) -> tuple[float, ...]:
    """A grid of w with ends [low, high], uniform in √w."""
    if low >= high:
        return (low,)
    a, b, n = math.sqrt(low), math.sqrt(high), 8
    inner = [(a + (b - a) * i / n) ** 2 for i in range(1, n)]
    return (low, *(w for w in inner if low < w < high), high)
