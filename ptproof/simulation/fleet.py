"""Many vehicles side by side with their whole way, by one fixed-step method: for pictures over a certificate.

Ensembles keep where vehicles end; here the largest distance in between counts as well.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import sympy as sp

from ptproof.problem import Problem
from ptproof.problem.model import TAU
from ptproof.simulation.plan import Array

_PER_RADIAN = 12  # steps
_PER_FILTER = 1.2  # steps in the filter's time constant, from below


@dataclass(frozen=True, eq=False)
class Fleet:
    """Distances from the source at times t (vehicles × times)."""

    times: Array
    distances: Array


def fleet(
    problem: Problem, size: int, *, radius: float, filter_gap: float = 0.0, seed: int = 0, samples: int = 400,
    share: float = 1.0,
) -> Fleet:  # fmt: skip
    """``size`` vehicles of the prescribed-time seeker, started within ``radius`` of the source with any heading.

    Half of them start at that distance exactly. Their filter starts within ``filter_gap`` of the field. The classical
    Runge–Kutta method in τ, with steps that are short against a turn and against the filter.

    Parameters
    ----------
    share
        The part of [t₀, t₀ + T] that is run: less than 1 where the gain is not clipped.
    """
    tuning, clock = problem.tuning, problem.clock
    omega, mu = float(tuning.omega), float(tuning.mu)
    system = problem.closed_loop("pt", "tau")
    rate = sp.lambdify((TAU, *system.state), list(system.rhs), "numpy")
    start, end = (float(clock.to_tau.subs(clock.t, tuning.t0 + part * tuning.T)) for part in (0, sp.nsimplify(share)))
    to_t = sp.lambdify(TAU, clock.to_t, "numpy")
    state = _start(problem, size, radius, filter_gap, seed)
    marks = np.linspace(start, end, samples + 1)
    longest = min(1 / (_PER_RADIAN * omega), mu / _PER_FILTER)
    steps = max(1, math.ceil((marks[1] - marks[0]) / longest))
    h = (marks[1] - marks[0]) / steps
    source = np.array([float(item) for item in problem.source])[:, None]
    distances = [np.hypot(*(state[:2] - source))]

    def slope(tau: float, at: Array) -> Array:
        return np.stack([np.broadcast_to(item, size) for item in rate(tau, *at)])

    for mark in marks[:-1]:
        for step in range(steps):
            tau = mark + step * h
            a = slope(tau, state)
            b = slope(tau + h / 2, state + h / 2 * a)
            c = slope(tau + h / 2, state + h / 2 * b)
            d = slope(tau + h, state + h * c)
            state = state + h / 6 * (a + 2 * b + 2 * c + d)
        distances.append(np.hypot(*(state[:2] - source)))
    return Fleet(np.asarray(to_t(marks), dtype=np.float64), np.stack(distances, axis=1))


def _start(problem: Problem, size: int, radius: float, gap: float, seed: int) -> Array:
    """Random positions, headings and filter states (4 × size), in the order of the loop's states."""
    draw = np.random.default_rng(seed)
    far = radius * np.where(np.arange(size) % 2, 1.0, np.sqrt(draw.random(size)))
    angle, heading = (draw.random(size) * 2 * np.pi for _ in range(2))
    field = sp.lambdify(problem.variables, problem.field.expression, "numpy")
    position = [float(c) + far * f(angle) for c, f in zip(problem.source, (np.cos, np.sin), strict=True)]
    return np.stack([*position, heading, field(*position) + gap * (2 * draw.random(size) - 1)])
