"""The upper solution of the radial comparison system, moved step by step in ball arithmetic."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import sympy as sp

from ptproof.balls.shells import down, up
from ptproof.gains.envelope import BITS, RadialEnvelope
from ptproof.gains.horizon import Horizon
from ptproof.gains.numbers import sign
from ptproof.problem import Problem
from ptproof.problem.model import TIME

_FALL = 1.25  # of w = dt/dτ over one step, at most
_GROWTH = 1000.0  # a bound that exceeds this many times the initial distance is given up


@dataclass(frozen=True)
class Node:
    """A grid time: elapsed t and τ, and w = dt/dτ there, exact."""

    stretched: sp.Expr
    elapsed: sp.Expr
    weight: sp.Expr


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
    if float(left.weight) <= _FALL * float(right.weight):
        return [right]
    s = (left.stretched + right.stretched) / 2
    middle = Node(s, horizon.elapsed(s), horizon.weight(s))
    return [*_refined(horizon, left, middle), *_refined(horizon, middle, right)]


class UpperSolution:
    """The upper solution y, moved step by step."""

    def __init__(self, problem: Problem, initial: sp.Expr, grid: list[Node]) -> None:
        from ptproof.balls.ball import ball_from, precision
        from ptproof.balls.tape import compile_tape

        self.problem = problem
        drift = problem.drift
        self.matrix = drift.matrix if drift.kind == "gradient" else None
        with precision(BITS):
            self.y = up(ball_from(initial))
            self.t0 = ball_from(problem.tuning.t0)
            self.balls = {
                node: (ball_from(node.stretched), ball_from(node.elapsed), ball_from(node.weight)) for node in grid
            }
            self.source = [ball_from(value) for value in problem.source]
            lowest, highest = down(self.balls[grid[-1]][2]), max(1.0, up(self.balls[grid[0]][2]))
        self.limit = _GROWTH * self.y
        weights = (1.0,) if self.matrix is None else _weights(lowest, highest)
        self.envelope = RadialEnvelope(
            problem.variables, problem.field.expression, problem.source, problem.tuning.k, self.matrix, self.y, weights
        )
        self.drift = compile_tape(list(drift.rate), (TIME, *problem.variables)) if drift.kind == "bounded" else None

    def step(self, left: Node, right: Node) -> str | None:
        """Move y over one step; returns the reason if that fails."""
        from ptproof.balls.ball import precision

        with precision(BITS):
            (s0, e0, w0), (s1, e1, w1) = self.balls[left], self.balls[right]
            weights = (min(down(w1), down(w0)), max(up(w0), up(w1)))
            length = s1 - s0
            reach = self.y
            for _ in range(8):  # the drift is enclosed on a ball that y must not leave on this step
                reach *= 1.05
                push = self._push(e0, e1, reach, weights[1])
                if push is None:
                    return "a drift without a finite enclosure"
                moved = self._move(push, weights, length, reach)
                if moved is None:
                    return "a shell where the field has no finite enclosure"
                if moved > self.limit:
                    return f"{_GROWTH:g} times the initial distance"
                if moved < reach:
                    self.y = moved
                    return None
                reach = moved
            return "a bound that grows too fast for the step"

    def _push(self, e0: Any, e1: Any, reach: float, weight: float) -> float | None:
        """An upper bound of w·‖f‖ on the step for ‖x − x*‖ ≤ reach."""
        from flint import arb

        from ptproof.balls.ball import BALLS, interval
        from ptproof.balls.tape import Undefined

        if self.drift is None:
            return 0.0
        around = interval(-arb(reach), arb(reach))
        try:
            values = self.drift.run([self.t0 + interval(e0, e1), *(c + around for c in self.source)], BALLS)
        except Undefined:
            return None
        total = sum((value * value for value in values), arb(0))
        return up(total.abs_upper().sqrt() * arb(weight))

    def _move(self, push: float, weights: tuple[float, float], length: Any, reach: float) -> float | None:
        """y at the end of y' = push + g·y with the shells' g; None where a shell has no finite rate."""
        from flint import arb

        y, envelope = self.y, self.envelope
        a = arb(push)
        shell = envelope.shell(y)
        left = length  # the time that is left: from below while y falls, from above while it rises
        for _ in range(10_000):
            g_up = envelope.rate(shell, *weights)
            if g_up == math.inf:
                return None
            g = arb(g_up)
            rate = a + g * arb(y)
            if rate < 0:
                low = envelope.boundary(shell)
                if y == low:
                    if low == 0:
                        return y
                    shell -= 1
                    g_low = envelope.rate(shell, *weights)
                    if g_low == math.inf:
                        return None
                    if not a + arb(g_low) * arb(y) < 0:
                        return y  # a barrier: outside it the rate is negative
                    continue
                rest = -a / g
                gap = arb(low) - rest
                end = rest + (arb(y) - rest) * (g * left).exp()
                if not end < low or not gap > 0:
                    return min(y, max(low if end < low else 0.0, up(end)))
                used = ((arb(y) - rest) / gap).log() / (-g)
                left = left - used
                if not left > 0:
                    return low
                left = left.lower()
                y = low
                continue
            high = envelope.boundary(shell + 1)
            if y == high:
                shell += 1
                continue
            rising = arb(max(0.0, up(rate)))
            end = arb(y) + rising * (left * _mean_exponential(g, left))
            if end <= high:
                return min(high, up(end))
            if high > reach:
                return max(up(end), high)  # the caller enlarges the ball, or gives up
            used = _time_to(arb(high) - arb(y), rising, g)
            if used.is_finite():
                left = (left - used).upper()
                left = left if left > 0 else arb(0)
            y = high
            outer = envelope.rate(shell + 1, *weights)
            if outer == math.inf:
                return None
            if a + arb(outer) * arb(y) < 0:
                return y
            shell += 1
        return None


def _mean_exponential(g: Any, length: Any) -> Any:
    """(e^(gL) − 1)/(gL), an upper ball also around g = 0, by convexity at most (1 + e^(gL))/2."""
    from flint import arb

    product = g * length
    if abs(product) < arb("1e-6"):
        return (1 + product.exp()) / 2
    return product.expm1() / product


def _time_to(distance: Any, rising: Any, g: Any) -> Any:
    """A lower bound of the time in which y' = rising·e^(g·time) covers the distance: at most distance/rising."""
    from flint import arb

    quotient = distance / rising
    argument = g * quotient
    if abs(argument) < arb("1e-6"):
        return quotient / (1 + abs(argument))
    return (1 + argument).log() / g


def _weights(low: float, high: float) -> tuple[float, ...]:
    """A grid of w with ends [low, high], uniform in √w."""
    if low >= high:
        return (low,)
    a, b, n = math.sqrt(low), math.sqrt(high), 8
    inner = [(a + (b - a) * i / n) ** 2 for i in range(1, n)]
    return (low, *(w for w in inner if low < w < high), high)
