"""Random fields, drifts and tunings with known constants, and the averaged system integrated beside the bounds.

``python tests/gains/random_sets.py 10000 [first seed]`` checks that many sets and prints the worst ratio.
"""

import math
import random
import sys
from dataclasses import dataclass

import numpy as np
import sympy as sp
from scipy.integrate import solve_ivp

from ptproof.gains import GainData, nonvanishing, vanishing
from ptproof.problem.field import FieldBounds

R = sp.Rational
# The rate of each clock at ν, in floats and by hand.
GAINS = {
    "paper": lambda nu, m: nu**-2,
    "power": lambda nu, m: nu ** -(m + 1),
    "logarithmic": lambda nu, m: 1 / nu,
    "exponential": lambda nu, m: nu**-2 * math.exp(1 / nu - 1),
    "tangent": lambda nu, m: 1 + math.tan(math.pi / 2 * (1 - nu)) ** 2,
}


@dataclass(frozen=True)
class Case:
    data: GainData
    gradient: object  # x - x* (array) -> grad F
    drift: object  # (elapsed, x - x*, grad F) -> f
    start: np.ndarray


def rational(rng, low, high, denominator=20):
    return R(rng.randint(round(low * denominator), round(high * denominator)), denominator)


def field(rng):
    """Constants that hold, and the gradient: -(x'Qx)^kappa, or a sum of powers; both around a source at 0."""
    kappa = rng.choice([1, 1, 2, 2, 3])
    low = rational(rng, 0.3, 1.5)
    high = low * (1 + rational(rng, 0, 1))
    if rng.random() < 0.5:
        bounds = FieldBounds(kappa, high**kappa, low**kappa, 2 * kappa * low**kappa, 2 * kappa * high**kappa)
        angle = rng.uniform(0, math.pi)
        turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
        Q = turn @ np.diag([float(low), float(high)]) @ turn.T
        return bounds, lambda x: -2 * kappa * (x @ Q @ x) ** (kappa - 1) * (Q @ x)
    shrink = R(1, 2 ** (kappa - 1))
    bounds = FieldBounds(kappa, high, low * shrink, 2 * kappa * low * shrink, 2 * kappa * high)
    weights = np.array([float(low), float(high)])
    return bounds, lambda x: -2 * kappa * weights * x ** (2 * kappa - 1)


def matrix(rng):
    kind = rng.randrange(4)
    if kind == 0:
        return sp.ImmutableDenseMatrix([[-1, 0], [0, -1]]) * rational(rng, 0.1, 2.5)
    if kind == 1:
        return sp.ImmutableDenseMatrix([[0, 1], [-1, 0]]) * rational(rng, 0.1, 2.5)
    if kind == 2:
        return sp.ImmutableDenseMatrix([[0, 1], [0, 0]]) * rational(rng, 0.1, 2.5)
    return sp.ImmutableDenseMatrix(2, 2, lambda i, j: rational(rng, -1.5, 1.5))


def make(seed, clock="paper"):
    rng = random.Random(seed)
    bounds, gradient = field(rng)
    angle = rng.uniform(0, 2 * math.pi)
    distance = rational(rng, 0.1, 2)
    start = float(distance) * np.array([math.cos(angle), math.sin(angle)])
    common = {
        "k": rational(rng, 0.3, 4),
        "T": rational(rng, 0.2, 3),
        "nu_min": rational(rng, 0.15, 1),
        "x0_norm": distance,
        "clock": clock,
        "exponent": rng.choice([R(1, 2), R(2), R(3)]) if clock == "power" else None,
    }
    kind = rng.choice(["none", "norm", "matrix", "bounded"])
    if kind == "none":
        return Case(GainData(bounds, **common), gradient, lambda e, x, g: 0 * x, start)
    if kind == "bounded":
        d = rational(rng, 0.05, 2)
        shape, speed = rng.randrange(2), rng.uniform(0, 6)

        def push(e, x, g):
            if shape:
                return float(d) * x / (np.linalg.norm(x) + 1e-9)
            return float(d) * np.array([math.cos(speed * e), math.sin(speed * e)])

        return Case(GainData(bounds, drift_bound=d, **common), gradient, push, start)
    E = matrix(rng)
    data = GainData(bounds, drift_matrix=E, **common)
    if kind == "norm":
        data = GainData(bounds, drift_norm=data.drift_norm, **common)
    array = np.array(E.tolist(), dtype=float)
    return Case(data, gradient, lambda e, x, g: array @ g, start)


class Escape(Exception):
    """The averaged position has left every reasonable ball."""


def distances(case, elapsed):
    """The averaged distance at these elapsed times, integrated in the original time up to and from the corner."""
    k, T, nu_min = (float(value) for value in (case.data.k, case.data.T, case.data.nu_min))
    gain, order = GAINS[case.data.clock], float(case.data.exponent or 0)

    def rate(e, x):
        if not np.linalg.norm(x) < 1e9:
            raise Escape
        g = case.gradient(x)
        return case.drift(e, x, g) + k / 2 * gain(max(nu_min, 1 - e / T), order) * g

    corner = T * (1 - nu_min)
    grid = sorted({*map(float, elapsed), corner, T})
    x, last, found = case.start, 0.0, {0.0: float(np.linalg.norm(case.start))}
    for e in grid:
        if e - last < 1e-12 * T:
            found[e] = float(np.linalg.norm(x))
            continue
        try:
            run = solve_ivp(rate, (last, e), x, method="LSODA", rtol=1e-9, atol=1e-12)
        except Escape:
            return found, True  # the averaged system itself escapes
        assert run.success, run.message
        x, last = run.y[:, -1], e
        found[e] = float(np.linalg.norm(x))
    return found, False


def violations(seed, clock="paper"):
    """The largest distance/bound over chains and times for one set; more than 1 would be a false bound."""
    case = make(seed, clock)
    data = case.data
    chains = ("printed", "split") if clock == "paper" else ("split",)
    times = [data.T * share for share in (R(1, 5), R(1, 2), R(4, 5), R(1))]
    found, escaped = distances(case, times)
    worst = 0.0
    for e in times:
        distance = found.get(float(e), math.inf if escaped else None)
        if distance is None or distance < 1e-9:
            continue
        if data.drift_bound is not None:
            bounds = [nonvanishing.distance_bound(data, e)]
            if e == data.T and "printed" in chains:
                bounds.append(nonvanishing.printed_distance_bound(data))
        else:
            bounds = [vanishing.distance_bound(data, e, chain) for chain in chains]
        values = [None if bound is None else float(bound) for bound in bounds]
        if data.drift_bound is None and None not in values and values[-1] > values[0] * (1 + 1e-9):
            return math.inf
        worst = max([worst, *((distance - 1e-9) / value for value in values if value is not None)])
    return worst


if __name__ == "__main__":
    count, first = int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0
    ratios = [violations(seed) for seed in range(first, first + count)]
    print(f"{count} sets, largest distance/bound {max(ratios):.9f} at seed {first + ratios.index(max(ratios))}")
