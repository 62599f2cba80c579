"""Upper solutions of y' ≤ a + y·G(y), G an envelope that is constant on shells, by the formula of y' = a + g·y.

y lies above every solution that starts at or below it: where y moves inside a shell by the Lipschitz comparison, and
where it rests on a boundary because the outer shell's rate is negative there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from flint import arb

from ptproof.balls.radial import RadialEnvelope
from ptproof.balls.rounding import up

_MOVES = 10_000


class _State(NamedTuple):
    """y in a shell; the time that is left is taken from below while y falls, and from above while it rises."""

    y: float
    shell: int
    left: arb
    ends: bool = False


@dataclass(frozen=True)
class Transport:
    """One step with a constant push a ≥ 0 and weights w in an interval; ``reach`` is what y may not leave.

    Balls at the present precision, every rounding outward.
    """

    envelope: RadialEnvelope
    push: float
    weights: tuple[float, float]
    reach: float

    def move(self, y: float, length: arb) -> float | None:
        """y after the time ``length``; a number above ``reach`` if it gets there, None where a shell has no rate."""
        state = _State(y, self.envelope.shell(y), length)
        for _ in range(_MOVES):
            g = self._rate(state.shell)
            if g is None:
                return None
            falls = self.push + g * arb(state.y) < 0
            after = self._fall(state, g) if falls else self._rise(state, g)
            if after is None or after.ends:
                return None if after is None else after.y
            state = after
        return None

    def _rate(self, shell: int) -> arb | None:
        rate = self.envelope.rate(shell, *self.weights)
        return None if rate == math.inf else arb(rate)

    def _fall(self, state: _State, g: arb) -> _State | None:
        y, shell, left, _ = state
        low = self.envelope.boundary(shell)
        if y == low:
            if low == 0:
                return _State(y, shell, left, True)
            inner = self._rate(shell - 1)
            if inner is None:
                return None
            # A barrier, unless y falls on: outside it the rate is negative.
            return _State(y, shell - 1, left, not self.push + inner * arb(y) < 0)
        rest = -arb(self.push) / g
        gap = arb(low) - rest
        end = rest + (arb(y) - rest) * (g * left).exp()
        if not end < low or not gap > 0:
            return _State(min(y, max(low if end < low else 0.0, up(end))), shell, left, True)
        left = left - ((arb(y) - rest) / gap).log() / (-g)
        return _State(low, shell, left.lower(), not left > 0)

    def _rise(self, state: _State, g: arb) -> _State | None:
        y, shell, left, _ = state
        high = self.envelope.boundary(shell + 1)
        if y == high:
            return _State(y, shell + 1, left)
        rising = arb(max(0.0, up(self.push + g * arb(y))))
        end = arb(y) + rising * (left * _mean_exponential(g, left))
        if end <= high:
            return _State(min(high, up(end)), shell, left, True)
        if high > self.reach:
            return _State(max(up(end), high), shell, left, True)
        used = _time_to(arb(high) - arb(y), rising, g)
        if used.is_finite():
            left = (left - used).upper()
            left = left if left > 0 else arb(0)
        outer = self._rate(shell + 1)
        return None if outer is None else _State(high, shell + 1, left, bool(self.push + outer * arb(high) < 0))


def _mean_exponential(g: arb, length: arb) -> arb:
    """(e^(gL) − 1)/(gL), an upper ball also around g = 0, by convexity at most (1 + e^(gL))/2."""
    product = g * length
    if abs(product) < arb("1e-6"):
        return (1 + product.exp()) / 2
    return product.expm1() / product


def _time_to(distance: arb, rising: arb, g: arb) -> arb:
    """A lower bound of the time in which y' = rising·e^(g·time) covers the distance: at most distance/rising."""
    quotient = distance / rising
    argument = g * quotient
    if abs(argument) < arb("1e-6"):
        return quotient / (1 + abs(argument))
    return (1 + argument).log() / g
