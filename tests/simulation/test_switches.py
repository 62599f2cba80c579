"""Rates that jump at instants that no grid of samples knows: every engine stops there, and none steps over one."""

import numpy as np
import pytest
import sympy as sp

from ptproof import load, simulate
from ptproof.errors import InputError
from ptproof.simulation.switches import between_switches
from ptproof.system import System

t, x, w = sp.symbols("t x w", real=True)


def edges(rate, end, **values):
    system = System(t, (x,), (rate,), tuple(symbol for symbol in (w,) if rate.has(symbol)))
    size = len(values.get("w", [0]))
    return between_switches(system, np.outer((0.0, float(end)), np.ones(size)), values)


SWITCHES = [
    (sp.sign(sp.sin(4 * t)), sp.pi, [n * sp.pi / 4 for n in range(5)]),
    (sp.Max(0, 1 - t) * sp.Abs(3 * t - 1), 2, [0, sp.Rational(1, 3), 1, 2]),
    (sp.floor(2 * t), sp.Rational(7, 5), [0, 0.5, 1, 1.4]),
    (sp.Mod(t, sp.Rational(1, 2)), sp.Rational(7, 5), [0, 0.5, 1, 1.4]),
    (sp.sign(sp.Max(0, t - 1)), 3, [0, 1, 3]),
    (sp.Piecewise((1, t < 1), (x, t < 2), (3, True)), 3, [0, 1, 2, 3]),
    (sp.asin(sp.sin(t)), 7, [0, sp.pi / 2, 3 * sp.pi / 2, 7]),
    (sp.cos(t) * x, 3, [0, 3]),
    (sp.sign(x + t), 3, [0, 3]),
]


@pytest.mark.parametrize(("rate", "end", "wanted"), SWITCHES, ids=[str(row[0]) for row in SWITCHES])
def test_the_instants_are_the_switches_of_time_alone(rate, end, wanted):
    found = edges(rate, end).ravel()
    assert found == pytest.approx([float(value) for value in wanted], abs=1e-12)


def test_members_that_switch_less_often_end_with_the_end():
    found = edges(sp.sign(sp.sin(w * t)), 1, w=np.array([4.0, 30.0, 4.0]))
    assert found.shape == (11, 3)
    assert found[2:, 0] == pytest.approx(1)
    assert found[1:-1, 1] == pytest.approx(np.pi / 30 * np.arange(1, 10))
    assert (found[:, 0] == found[:, 2]).all()


def test_switches_that_no_grid_can_tell_are_refused():
    with pytest.raises(InputError, match="switches more than 65536 times between 0 and 3; take a shorter span"):
        edges(sp.sign(sp.sin(2_000_000 * t)), 3)


# Each of these would be stepped over: before and after the jump the rates are the same where the method looks.
@pytest.mark.parametrize("engine", ["casadi", "lsoda", "dop853", "radau"])
@pytest.mark.parametrize(
    ("rate", "end", "exact"),
    [
        (sp.sign(sp.sin(4 * t)), np.pi, 0.0),
        (sp.Piecewise((1, sp.Abs(t - sp.Rational(1, 2)) < sp.Rational(1, 1000)), (0, True)), 5.0, 0.002),
        (sp.floor(10 * t) - 10 * t, 3.0, -1.5),
    ],
    ids=["square wave", "pulse", "sawtooth"],
)
def test_no_engine_steps_over_a_jump(engine, rate, end, exact):
    run = simulate(System(t, (x,), (rate,)), initial=[0], span=(0, end), engine=engine, samples=8)
    assert run.x[0, -1] == pytest.approx(exact, abs=1e-6)


PULSE = """
[field]
expression = "-x1**2/2 - x2**2/2"
variables = ["x1", "x2"]
source = ["0", "0"]
kappa = 1
[drift]
kind = "bounded"
f = ["Piecewise((100, Abs(t - 1/2) < 1/1000), (0, True))", "0"]
bound = "100"
[seeker]
k = "2"
omega = "50"
mu = "0.001"
T = "1"
nu_min = "0.2"
[initial]
x = ["0", "0"]
theta = "0"
"""


@pytest.mark.parametrize("frame", ["t", "tau"])
def test_a_drift_of_a_problem_is_met_in_time(tmp_path, frame):
    (tmp_path / "pulse.toml").write_text(PULSE)
    run = simulate(load(tmp_path / "pulse.toml"), model="average", frame=frame, samples=8)
    place = np.flatnonzero(np.abs(run.t - 0.501) < 1e-9)
    assert run.x[0, place] == pytest.approx(0.2, rel=0.01)  # 100 m/s for 2 ms, of which the seeker takes little back
