"""The certified bound of the averaged distance: above every simulated start, tight for the paper's examples."""

import dataclasses
import functools
from itertools import pairwise

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp

from ptproof.errors import InputError
from ptproof.gains import upper
from ptproof.gains.horizon import Horizon, unit_clock
from ptproof.gains.tight import distance_from_source, tight_bound
from ptproof.gains.upper import time_grid
from ptproof.problem import example
from ptproof.problem.drift import bounded_drift, gradient_drift
from ptproof.problem.model import TIME
from ptproof.proof.verdict import Verdict
from ptproof.simulation.fleet import worst_distance

R = sp.Rational


@functools.cache
def curve(name):
    return tight_bound(example(name), steps=80)


def averaged(problem, starts, times):
    """‖x̄ − x*‖ for each start at each elapsed time, by integration of the averaged system in t."""
    x = problem.variables
    slope = sp.lambdify(x, list(problem.field.gradient))
    drift = sp.lambdify((TIME, *x), list(problem.drift.rate))
    tuning = problem.tuning
    k, T, nu_min = float(tuning.k), float(tuning.T), float(tuning.nu_min)
    source = np.array([float(value) for value in problem.source])

    def rate(e, y):
        return np.array(drift(e, *y), dtype=float) + k / 2 / max(nu_min, 1 - e / T) ** 2 * np.array(slope(*y))

    found = []
    for start in starts:
        run = solve_ivp(rate, (0, T), source + start, t_eval=times, method="LSODA", rtol=1e-8, atol=1e-11)
        found.append(np.linalg.norm(run.y.T - source, axis=1))
    return np.array(found)


def circle(radius, count=48):
    angles = np.linspace(0, 2 * np.pi, count, endpoint=False)
    return radius * np.column_stack([np.cos(angles), np.sin(angles)])


@pytest.mark.parametrize("name", ["vanishing", "nonvanishing", "saturated"])
def test_the_bound_is_proved_and_tight_for_the_paper_s_examples(name):
    found = curve(name)
    assert found.evidence.verdict is Verdict.PROVED
    problem = example(name)
    worst = averaged(problem, circle(float(found.initial)), [float(problem.tuning.T)]).max()
    assert worst <= found.final <= 3 * worst


@pytest.mark.parametrize("name", ["vanishing", "nonvanishing", "saturated"])
def test_the_bound_lies_above_every_start_at_every_time(name):
    found = curve(name)
    problem = example(name)
    keep = range(0, len(found.times), 4)
    distances = averaged(problem, circle(float(found.initial), 24), [found.times[i] for i in keep])
    bounds = np.array([found.distances[i] for i in keep])
    assert (distances <= bounds * (1 + 1e-6)).all()


@pytest.mark.parametrize("clock", ["power", "logarithmic", "exponential", "tangent"])
def test_the_bound_is_proved_and_tight_for_every_clock(clock):
    base = example("vanishing")
    tuning = dataclasses.replace(base.tuning, clock=clock, exponent=sp.Integer(2) if clock == "power" else None)
    problem = dataclasses.replace(base, tuning=tuning)
    found = tight_bound(problem, steps=20)
    assert found.evidence.verdict is Verdict.PROVED
    worst = worst_distance(problem, found.initial, starts=8).worst
    assert worst <= found.final <= 4 * worst


def test_a_bound_below_all_floats_is_still_a_bound():
    base = example("saturated")
    tuning = dataclasses.replace(base.tuning, clock="exponential", nu_min=R(1, 8))
    found = tight_bound(dataclasses.replace(base, tuning=tuning), steps=40)
    assert found.evidence.verdict is Verdict.PROVED
    assert found.final == 1e-300


def test_the_grid_is_finer_where_the_gain_grows_fast():
    horizon = Horizon(R(1), R(1, 5), unit_clock("exponential"))
    nodes = time_grid(horizon, R(1), 40)
    assert all(a.weight <= 1.25 * b.weight for a, b in pairwise(nodes))
    assert [nodes[i].stretched for i in (0, -1)] == [0, horizon.stretched_end]


def test_the_grid_ends_at_the_prescribed_time():
    found = curve("vanishing")
    assert found.times[0] == 0
    assert found.times[-1] == pytest.approx(1)
    assert found.stretched[-1] == pytest.approx(17 / 3)


def test_the_initial_distance_is_exact():
    assert distance_from_source(example("vanishing")) == 2 * sp.sqrt(2)


@pytest.mark.parametrize(
    "matrix",
    [[["0", "-2"], ["2", "0"]], [["1", "3"], ["0", "-1"]], [["-2", "1"], ["1", "-1/2"]]],
    ids=["skew", "not normal", "repulsive"],
)
def test_the_bound_holds_for_a_drift_that_is_not_a_multiple_of_the_identity(matrix):
    base = example("vanishing")
    E = sp.ImmutableDenseMatrix(2, 2, lambda i, j: R(matrix[i][j]))
    problem = dataclasses.replace(base, drift=gradient_drift(E.tolist(), base.field.expression, base.variables))
    found = tight_bound(problem, sp.Integer(1), steps=20)
    assert found.evidence.verdict is Verdict.PROVED
    keep = range(0, len(found.times), 2)
    distances = averaged(problem, circle(1.0, 16), [found.times[i] for i in keep])
    assert (distances <= np.array([found.distances[i] for i in keep]) * (1 + 1e-6)).all()


def test_the_bound_holds_for_a_source_away_from_the_origin():
    base = example("nonvanishing")
    a, b = base.variables
    shift = {a: a - R(3, 2), b: b + sp.sqrt(2)}
    problem = dataclasses.replace(
        base,
        field=dataclasses.replace(base.field, expression=base.field.value(shift), source=(R(3, 2), -sp.sqrt(2))),
        drift=bounded_drift([sp.sin(TIME) / 2, sp.cos(a) / 3]),
        initial=dataclasses.replace(base.initial, x=(R(2), sp.Integer(0))),
    )
    found = tight_bound(problem, sp.Integer(1), steps=30)
    worst = averaged(problem, circle(1.0, 24), [2.0]).max()
    assert worst <= found.final <= 3 * worst


def test_a_field_of_order_four_is_covered():
    base = example("saturated")
    a, b = base.variables
    problem = dataclasses.replace(base, field=dataclasses.replace(base.field, expression=-(a**4 + 2 * b**4), kappa=2))
    found = tight_bound(problem, sp.Integer(1), steps=30)
    assert found.evidence.verdict is Verdict.PROVED
    worst = averaged(problem, circle(1.0, 24), [1.0]).max()
    assert worst <= found.final <= 1.2 * worst


def test_a_drift_that_wins_gives_a_bound_that_grows():
    base = example("vanishing")
    problem = dataclasses.replace(
        base,
        drift=gradient_drift([[-8, 0], [0, -8]], base.field.expression, base.variables),
        tuning=dataclasses.replace(base.tuning, T=R(1, 25)),
    )
    found = tight_bound(problem, R(1, 10), steps=12)
    worst = averaged(problem, circle(0.1, 8), [0.04]).max()
    assert 0.1 < worst <= found.final <= 2 * worst


def test_a_bound_that_grows_too_far_is_given_up(monkeypatch):
    monkeypatch.setattr(upper, "_GROWTH", 1.2)
    base = example("saturated")
    problem = dataclasses.replace(base, drift=gradient_drift([[-9, 0], [0, -9]], base.field.expression, base.variables))
    found = tight_bound(problem, R(1, 10), steps=10)
    assert found.evidence.verdict is Verdict.UNDECIDED
    assert found.final == np.inf


def test_a_field_that_ends_is_given_up_with_the_reason():
    base = example("saturated")
    a, b = base.variables
    problem = dataclasses.replace(
        base,
        field=dataclasses.replace(base.field, expression=sp.log(4 - a**2 - b**2)),
        drift=bounded_drift([sp.Integer(20), sp.Integer(0)]),
        initial=dataclasses.replace(base.initial, x=(R(1), R(1))),
    )
    found = tight_bound(problem, steps=40)
    assert found.evidence.verdict is Verdict.UNDECIDED
    assert found.final == np.inf
    assert "given up" in found.evidence.detail


@pytest.mark.parametrize("kink", ["Abs", "Piecewise", "Max"])
def test_a_field_with_a_kink_is_left_open(kink):
    base = example("saturated")
    a, b = base.variables
    bend = {"Abs": sp.Abs(a) ** 3, "Piecewise": sp.Piecewise((a**4, a < 1), (a, True)), "Max": sp.Max(a, 2 * a) ** 2}
    field = dataclasses.replace(base.field, expression=-(a**2) - b**2 - bend[kink])
    found = tight_bound(dataclasses.replace(base, field=field), steps=5)
    assert found.evidence.verdict is Verdict.UNDECIDED
    assert kink in found.evidence.detail


def test_a_source_that_is_no_critical_point_is_refused():
    base = example("saturated")
    with pytest.raises(InputError, match="not zero at the source"):
        tight_bound(dataclasses.replace(base, field=dataclasses.replace(base.field, source=(R(1, 2), R(0)))))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"x0_norm": sp.Integer(0)}, "must be positive"),
        ({"steps": 0}, "steps"),
        ({"until": sp.Integer(2)}, "until"),
        ({"until": sp.Integer(0)}, "until"),
    ],
)
def test_bad_requests_are_refused(options, message):
    with pytest.raises(InputError, match=message):
        tight_bound(example("saturated"), **options)


def test_without_a_clip_the_bound_stops_before_the_end():
    base = example("saturated")
    problem = dataclasses.replace(base, tuning=dataclasses.replace(base.tuning, nu_min=None))
    with pytest.raises(InputError, match="below T"):
        tight_bound(problem)
    found = tight_bound(problem, until=R(9, 10), steps=50)
    assert found.final == pytest.approx(2 * np.sqrt(2) * np.exp(-0.7 * 9), rel=0.3)
    assert found.final >= 2 * np.sqrt(2) * np.exp(-0.7 * 9)
