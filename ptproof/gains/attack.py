"""Attacking bounds and gains: the averaged system, integrated by SciPy from many starts, and the worst radial fields.

An integration is no proof, but a distance that exceeds a certified bound by far more than the integrator's tolerance
is an error of ptproof.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product

from ptproof.gains.answer import Gains
from ptproof.gains.data import GainData
from ptproof.gains.tight import BoundCurve
from ptproof.problem import Problem
from ptproof.problem.model import TIME
from ptproof.proof.attack import WrongPromise
from ptproof.proof.attack.floats import in_floats

_TOLERANCE = 1e-9  # of the integration, relative
_INSTANTS = 60
_SLACK = 1e-6  # of a comparison, relative
Rate = Callable[[float, Sequence[float]], list[float]]


def attack_curve(problem: Problem, curve: BoundCurve, *, starts: int = 6, seed: int = 0) -> int:
    """At how many instants and from how many starts the certified distances held, together.

    The average in t is integrated from the problem's own direction, from axes and from random directions, all at the
    curve's initial distance.

    Raises
    ------
    WrongPromise
        With the start and the instant at which the distance is larger than the bound.
    """
    system = problem.averaged("pt", "t")
    symbols = (system.time, *system.state)
    rates = [in_floats(entry, symbols) for entry in system.rhs]
    source = [float(coordinate) for coordinate in problem.source]

    def rate(t: float, x: Sequence[float]) -> list[float]:
        return [entry((t, *x)) for entry in rates]

    count = 0
    for direction in _directions(problem, starts, seed):
        start = [middle + float(curve.initial) * part for middle, part in zip(source, direction, strict=True)]
        for t, x in _run(rate, start, curve.times):
            distance, limit = math.dist(x, source), curve.distances[curve.times.index(t)]
            if not math.isfinite(limit):  # as at the last instant where the gain grows without bound
                continue
            count += 1
            if distance > limit * (1 + _SLACK) + _SLACK * float(curve.initial):
                where = ", ".join(f"{value:.6g}" for value in start)
                raise WrongPromise(
                    f"the averaged distance of {problem.name} at t = {t:.6g} was certified to be at most {limit:.9g}",
                    f"from ({where}) it is {distance:.9g}",
                )
    return count


def _run(rate: Rate, start: Sequence[float], times: Sequence[float]) -> Iterator[tuple[float, Sequence[float]]]:
    from scipy.integrate import solve_ivp

    times = sorted(set(times))
    done = solve_ivp(
        rate, (times[0], times[-1]), list(start), method="LSODA", t_eval=times, rtol=_TOLERANCE, atol=_TOLERANCE / 100
    )
    return zip(done.t.tolist(), done.y.T.tolist(), strict=True)


def _directions(problem: Problem, starts: int, seed: int) -> Iterator[list[float]]:
    generator = random.Random(f"ptproof:{seed}")
    n = problem.field.dimension
    own = [float(a) - float(b) for a, b in zip(problem.initial.x, problem.source, strict=True)]
    axes = [[float(i == j) for j in range(n)] for i in range(n)]
    drawn = [[generator.gauss(0, 1) for _ in range(n)] for _ in range(starts)]
    for direction in ([own] if any(own) else []) + axes + drawn:
        length = math.hypot(*direction)
        yield [part / length for part in direction]


@dataclass(frozen=True)
class _Radial:
    """F = F(x*) − c r^(2κ) with the drift −e∇F, or one of size d outwards: dr/dt = w(t)-free, in the distance alone."""

    c: float
    push: float
    drift: float
    kappa: int
    k: float

    def rate(self, gain: Callable[[float], float]) -> Rate:
        def rate(t: float, r: Sequence[float]) -> list[float]:
            slope = 2 * self.kappa * self.c * max(r[0], 0.0) ** (2 * self.kappa - 1)
            return [self.push * slope + self.drift - self.k / 2 * gain(t) * slope]

        return rate


def attack_answer(answer: Gains) -> int:
    """How many promises of the answer held for the radial fields that the data allow, with the worst drifts.

    The distance at t₀ + T from the given start must not exceed ``clip.residual_bound`` and its printed form, and until
    then that start times ``prescribed_time.overshoot_split``.

    Raises
    ------
    WrongPromise
        With the field and drift for which a bound is exceeded.
    """
    data = answer.data
    if data.k is None or data.T is None or data.nu_min is None or data.x0_norm is None:
        return 0
    gain, count, start = _gain(data), 0, float(data.x0_norm)
    times = [float(data.t0) + float(data.T) * step / _INSTANTS for step in range(_INSTANTS + 1)]
    for field in _fields(data):
        distances = [distance for _, (distance,) in _run(field.rate(gain), [start], times)]
        for key, scale, distance in (
            ("clip.residual_bound", 1.0, distances[-1]),
            ("clip.residual_bound_printed", 1.0, distances[-1]),
            ("prescribed_time.overshoot_split", start, max(distances)),
        ):
            quantity = answer[key]
            if quantity is None or quantity.value is None:
                continue
            count, limit = count + 1, scale * quantity.value
            if distance > limit * (1 + _SLACK) + _SLACK * start:
                raise WrongPromise(
                    f"an averaged distance of at most {limit:.9g} was promised ({key})",
                    f"it is {distance:.9g} for F = F(x*) − {field.c:g}·r^{2 * field.kappa} and an outward drift",
                )
    return count


def _gain(data: GainData) -> Callable[[float], float]:
    """The capped rate of the clock, in t."""
    from ptproof.problem.model import TAU
    from ptproof.transforms.clocks import capped, named_clock

    clock = named_clock(data.clock, TIME, TAU, start=data.t0, horizon=data.T, exponent=data.exponent)
    rate = in_floats(capped(clock, data.nu_min).rate, (TIME,))
    return lambda t: rate((t,))


def _fields(data: GainData) -> Iterator[_Radial]:
    """Fields c·r^(2κ) whose constants lie within the data, each with the drifts that push outwards most."""
    bounds, kappa = data.bounds, int(data.bounds.kappa)
    least = max(float(bounds.a2), float(bounds.b1) / (2 * kappa))
    largest = min(float(bounds.a1), float(bounds.b2) / (2 * kappa))
    if least > largest:
        return
    bounded = 0.0 if data.drift_bound is None else float(data.drift_bound)
    # A matrix E with the known norm, or the known matrix, pushes outwards by at most this much.
    pushes = {0.0, float(data.push) if bounded == 0 else 0.0}
    for c, push in product((least, (least + largest) / 2, largest), sorted(pushes)):
        yield _Radial(c, push, bounded, kappa, float(data.k or 0))
