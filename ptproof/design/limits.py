"""What the inputs may be at most, and what they certainly do not exceed along a certified run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sp
from flint import arb

from ptproof.balls.arithmetic import Undefined
from ptproof.balls.arrays import Intervals, run
from ptproof.balls.ball import ball_from, interval, largest_along
from ptproof.balls.rounding import up
from ptproof.balls.tape import compile_tape
from ptproof.errors import InputError
from ptproof.problem import Problem
from ptproof.problem.model import TIME, positive
from ptproof.transforms.clocks import CappedClock

_BOXES = 64
_INTERVALS = 512


@dataclass(frozen=True)
class Limits:
    """The largest |u₁| [length/time] and |u₂| [rad/time] that the vehicle can do; None where there is no limit."""

    u1_max: sp.Expr | None = None
    u2_max: sp.Expr | None = None

    def __post_init__(self) -> None:
        for name in ("u1_max", "u2_max"):
            value = getattr(self, name)
            if value is not None:
                object.__setattr__(self, name, positive(value, name))

    def excess(self, u1: float, u2: float) -> str | None:
        """The first limit that is not certainly kept, in words; None if both are."""
        for name, reached, most in (("u1", u1, self.u1_max), ("u2", u2, self.u2_max)):
            if most is not None and not reached <= float(most):
                return f"|{name}| is only certain to stay below {reached:.6g}, but at most {float(most):.6g} is allowed"
        return None


def largest_gain(problem: Problem) -> sp.Expr:
    """The gain K at its largest on [t₀, t₀ + T], exact; infinite where nothing caps it."""
    clock = problem.clock
    return sp.sympify(clock.last_rate) if isinstance(clock, CappedClock) else sp.oo


def forward_peak(problem: Problem) -> float:
    """The largest u₁ = K√ω on [t₀, t₀ + T], rounded up; it does not depend on the run."""
    gain = largest_gain(problem)
    return float("inf") if gain is sp.oo else up(ball_from(gain) * ball_from(problem.tuning.omega).sqrt())


def angular_peak(problem: Problem, reach: float, gap: sp.Expr) -> float:
    """A bound of |u₂| along every run that stays within ``reach`` of the source and starts with |F − z| ≤ ``gap``.

    u₂ = K(ω − (k/μ)e) with e = F(x) − z, and de/dτ = ∇F·(√ω e(θ) + f/K) − e/μ, so that |e| ≤ gap + μG(√ω + D) with
    G ≥ ‖∇F‖ and D ≥ ‖f‖/K where the run goes. Then |u₂| ≤ K(ω + k(gap/μ + G(√ω + D))) with the largest K.
    """
    gain, tuning = largest_gain(problem), problem.tuning
    if gain is sp.oo or not np.isfinite(reach):
        return float("inf")
    k, omega, mu = (ball_from(value) for value in (tuning.k, tuning.omega, tuning.mu))
    G, D = steepest(problem, reach), _fastest_drift(problem, reach)
    return up(ball_from(gain) * (omega + k * (ball_from(gap) / mu + arb(G) * (omega.sqrt() + arb(D)))))


def steepest(problem: Problem, reach: float) -> float:
    """A bound of ‖∇F‖ on the square around the source that contains the ball of radius ``reach``."""
    tape = compile_tape(list(problem.field.gradient), problem.variables)
    marks = np.linspace(-reach, reach, _BOXES + 1)
    low, high = np.nextafter(marks[:-1], -np.inf), np.nextafter(marks[1:], np.inf)
    centres = [Intervals.around(ball_from(value)) for value in problem.source]
    first = Intervals(np.repeat(low, _BOXES), np.repeat(high, _BOXES)) + centres[0]
    second = Intervals(np.tile(low, _BOXES), np.tile(high, _BOXES)) + centres[1]
    sizes = [part.magnitude() for part in run(tape, (first, second))]
    return float(np.nextafter(np.hypot(*sizes).max() * (1 + 1e-15), np.inf))


def _fastest_drift(problem: Problem, reach: float) -> float:
    """A bound of ‖f‖ divided by the smallest gain, which is the one at t₀: named clocks run faster and faster."""
    drift, tuning = problem.drift, problem.tuning
    if all(entry == 0 for entry in drift.rate):
        return 0.0
    around = interval(-arb(reach), arb(reach))
    inside: dict[sp.Symbol, Any] = {
        symbol: ball_from(place) + around for symbol, place in zip(problem.variables, problem.source, strict=True)
    }
    end = tuning.t0 + tuning.T
    norm = sp.sqrt(sp.Add(*(entry**2 for entry in drift.rate)))
    slowest = ball_from(problem.clock.rate.subs(TIME, tuning.t0))
    for candidate in (norm, drift.bound):
        if candidate is None:
            continue
        try:
            return up(arb(largest_along(candidate, inside, TIME, (tuning.t0, end), _INTERVALS)) / slowest)
        except Undefined:
            continue
    raise InputError(f"{problem.name}: the drift has no finite enclosure; give its bound")
