"""The search: its order, limits and reasons with a certificate that is made up, and once with the real one."""

import importlib
import math
from dataclasses import replace

import numpy as np
import pytest
import sympy as sp

from ptproof.certify.loop.certificate import LoopCertificate
from ptproof.design import Limits, design
from ptproof.design.answer import decimal_text
from ptproof.design.limits import angular_peak, forward_peak, steepest
from ptproof.errors import InputError
from ptproof.gains.tight import BoundCurve
from ptproof.problem import example
from ptproof.proof.verdict import Evidence, Verdict
from ptproof.simulation import ensemble, simulate

R = sp.Rational
searching = importlib.import_module("ptproof.design.search")  # the room has the function's name
PLAIN = example("saturated")


def made_up(problem, radius, *, filter_gap, tolerance, workers):
    """Within three circles of the source and a little more the coarser it is; nothing below ω = 20."""
    final = 3 / math.sqrt(problem.tuning.omega) * (1 + tolerance)
    good = float(problem.tuning.omega) >= 20
    size = 1.0 if radius is None else float(radius)
    return LoopCertificate(
        Verdict.PROVED if good else Verdict.UNDECIDED, float(problem.tuning.omega), float(problem.tuning.mu), size,
        0.0, (0.0, 1.0) if good else (), (size, final) if good else (), None, "made up", 0.0,
    )  # fmt: skip


def average(problem, radius=None, **_):
    """The average of the plain problem, dx/dτ = −(k/2)x, to the end of its clipped clock."""
    tuning = problem.tuning
    size = math.hypot(2, 2) if radius is None else float(radius)
    final = size * math.exp(-tuning.k * tuning.T * (2 / tuning.nu_min - 1) / 2)
    return BoundCurve((0.0, 1.0), (0.0, 1.0), (size, final), sp.Float(size), Evidence("arb", Verdict.PROVED, "", 0.0))


@pytest.fixture
def quick(monkeypatch):
    monkeypatch.setattr(searching, "certify_loop", made_up)
    monkeypatch.setattr(searching, "tight_bound", average)


def test_the_smallest_frequency_is_approached_and_the_product_with_mu_kept(quick):
    found = design(PLAIN, R(1, 2))
    assert found.verdict is Verdict.PROVED
    assert found.certificate.final <= 0.5
    least = (3 * 1.12 / 0.5) ** 2
    assert least <= found.numbers["omega"] < 1.6 * least
    product = found.numbers["omega"] * found.numbers["mu"]
    assert product == pytest.approx(float(PLAIN.tuning.omega * PLAIN.tuning.mu), rel=0.01)
    assert [trial.why for trial in found.trials][-1] == ""


def test_without_omega_nothing_but_the_given_one_is_tried(quick):
    found = design(PLAIN, R(1, 2), free=["k"], time_limit=60)
    assert found.verdict is Verdict.UNDECIDED
    assert {trial.numbers["omega"] for trial in found.trials} == {30}
    assert "free T, omega, mu, nu_min with --free as well" in found.detail


def test_limits_of_the_inputs_bound_the_frequency(quick):
    K = R(100, 9)
    tight = Limits(u1_max=K * 6)  # ω ≤ 36, but the residual needs 45
    found = design(PLAIN, R(1, 2), limits=tight)
    assert found.verdict is Verdict.UNDECIDED
    assert max(trial.numbers["omega"] for trial in found.trials) == 36
    assert design(PLAIN, R(1, 2), limits=Limits(u1_max=K * 8)).numbers["omega"] <= 64
    none = design(PLAIN, R(1, 2), limits=Limits(u1_max=1))
    assert "limits of the inputs end" in none.detail


def test_an_angular_velocity_that_is_not_certain_to_keep_its_limit_is_not_given(quick):
    free = design(PLAIN, R(1, 2))
    assert design(PLAIN, R(1, 2), limits=Limits(u2_max=R(free.u2_peak) * 2)).u2_peak <= free.u2_peak * 2
    below = design(PLAIN, R(1, 2), limits=Limits(u2_max=R(free.u2_peak) * R(3, 4)))
    assert below.verdict is Verdict.UNDECIDED
    assert "|u2|" in below.detail


def test_numbers_whose_average_does_not_get_there_are_not_certified(quick):
    slow = replace(PLAIN, tuning=replace(PLAIN.tuning, k=R(1, 10)))
    found = design(slow, R(1, 2))
    assert found.verdict is Verdict.UNDECIDED
    assert "the average itself ends within" in found.trials[0].why
    assert found.trials[0].vehicle is None
    freed = design(slow, R(1, 2), free=["omega", "mu", "T", "nu_min", "k"])
    assert freed.verdict is Verdict.PROVED
    assert freed.trials[-1].average <= 0.5


def test_the_time_limit_ends_the_search(quick):
    found = design(PLAIN, R(1, 2), time_limit=1e-9)
    assert (found.verdict, found.trials) == (Verdict.UNDECIDED, ())


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"residual": 0}, "residual"),
        ({"residual": -1}, "residual"),
        ({"free": ["kk"]}, "'kk' is not one of"),
        ({"time_limit": 0}, "time_limit"),
        ({"radius": sp.Symbol("q")}, "radius"),
    ],
)
def test_refused(arguments, message):
    with pytest.raises(InputError, match=message):
        design(PLAIN, **{"residual": 1, **arguments})


def test_without_a_clip_no_input_has_a_largest_value():
    unclipped = replace(PLAIN, tuning=replace(PLAIN.tuning, nu_min=None))
    with pytest.raises(InputError, match="not clipped"):
        design(unclipped, 1, limits=Limits(u1_max=100))
    with pytest.raises(InputError, match="nu_min can be chosen"):
        design(unclipped, 1, free=["nu_min"])


@pytest.mark.parametrize("name", ["vanishing", "nonvanishing", "saturated"])
def test_no_run_exceeds_the_bounds_of_its_inputs(name):
    problem = example(name)
    for theta in np.linspace(0, 6, 4):
        run = simulate(problem, "pt", initial={"theta": theta})
        reach = float(run["distance"].max())
        assert run["u1"].max() <= forward_peak(problem)
        assert np.abs(run["u2"]).max() <= angular_peak(problem, reach, sp.S.Zero)
    gap = simulate(problem, "pt", initial={"z": float(problem.measured) + 0.1})
    most = float(gap["distance"].max())
    assert np.abs(gap["u2"]).max() <= angular_peak(problem, most, R(1, 10))
    assert np.abs(gap["u2"]).max() > angular_peak(problem, most, sp.S.Zero) / 20


def test_the_slope_is_bounded_and_not_by_much():
    assert np.sqrt(2) * 2 <= steepest(PLAIN, 2.0) <= np.sqrt(2) * 2 * 1.001


@pytest.mark.parametrize(("value", "text"), [(R(296, 5), "59.2"), (R(1, 3), "1/3"), (sp.pi, "pi"), (R(30), "30")])
def test_numbers_are_exact_decimals_where_they_have_one(value, text):
    assert decimal_text(value) == text


def test_what_is_found_is_true_of_vehicles():
    found = design(PLAIN, R(4, 5), radius=1, free=["mu"])
    assert found.verdict is Verdict.PROVED
    ends = ensemble(found.problem, 60, "pt", initial={"x1": 1, "x2": 0}, seed=3)
    assert ends.max <= found.certificate.final <= 0.8
