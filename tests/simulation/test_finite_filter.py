"""A vehicle whose filter is as fast as its dither, beside the average that says so and the one that does not."""

import pytest
import sympy as sp

from ptproof.averaging import average_to_order
from ptproof.simulation import gap_order
from ptproof.system import System
from tests.averaging.orders import MU, finite_seeker, k, x, y, z

F = sp.Function("F", real=True)(x, y)
TAU, OMEGA = sp.Symbol("tau", real=True), sp.Symbol("omega", positive=True)


def gaps(rate: sp.Rational, average: System) -> object:
    """The vehicle with a drift that varies in time, its filter at μ = ``rate``/ω, against an average."""
    problem = finite_seeker(rate)
    assert problem.fast is not None
    d1, d2 = problem.system.drift
    speeds = problem.system.to_system().rhs
    vehicle = System(TAU, (x, y, z), (*speeds, problem.fast.rate[0] / MU))
    values = {F: -(x**2) / 2 - y**2, d1: sp.cos(TAU) / 4, d2: -y / 4, k: 2, MU: rate / OMEGA}
    start = {"x": 1, "y": -1, "z": sp.Rational(-3, 2)}
    return gap_order(vehicle, average, initial=start, end=1, omega=OMEGA, values=values)


@pytest.mark.parametrize("rate", [sp.Rational(1, 2), sp.Integer(2)])
def test_the_gap_to_the_finite_average_falls_like_the_root(rate: sp.Rational) -> None:
    found = gaps(rate, average_to_order(finite_seeker(rate), 1).system)
    assert found.agrees  # type: ignore[attr-defined]
    assert found.slope == pytest.approx(-0.5, abs=0.1)  # type: ignore[attr-defined]


@pytest.mark.parametrize("rate", [sp.Rational(1, 2), sp.Integer(2)])
def test_the_gap_to_the_lie_bracket_average_does_not(rate: sp.Rational) -> None:
    quick = average_to_order(finite_seeker(rate / 10**6), 1).system
    assert not gaps(rate, quick).agrees  # type: ignore[attr-defined]
