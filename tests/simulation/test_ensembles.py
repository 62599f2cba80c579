"""Ensembles: reproducible from a seed, independent of workers, an outcome for each member."""

import numpy as np
import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.simulation import Outcome, ensemble, simulate
from ptproof.simulation.drawing import RED
from ptproof.simulation.ensembles import headings, members
from ptproof.system import System
from tests.pictures import shown

t, x = sp.symbols("t x", real=True)


@pytest.mark.parametrize("engine", ["casadi", "heyoka"])
def test_the_number_of_workers_changes_nothing(engine):
    runs = [ensemble("vanishing", 70, seed=3, engine=engine, workers=w, rtol=1e-4) for w in (1, 3)]
    assert np.array_equal(runs[0].x, runs[1].x)


def test_a_seed_repeats_and_another_differs():
    one, same, other = (members(50, seed, {"k": (1, 2), "theta": (0, 1)}, ["k", "theta"]) for seed in (1, 1, 2))
    assert np.array_equal(one["k"], same["k"])
    assert not np.array_equal(one["k"], other["k"])


def test_a_member_does_not_depend_on_how_many_there_are():
    few, many = (members(n, 5, {"k": (1, 2), "theta": (0, 1)}, ["k", "theta"]) for n in (10, 1000))
    assert np.array_equal(few["theta"], many["theta"][:10])


def test_a_member_is_the_run_of_its_own_values():
    many = ensemble("nonvanishing", 6, seed=1, vary={"theta": (0, 6.28), "x1": (-1, 1), "k": (1, 2)})
    for i in (0, 5):
        values = {name: row[i] for name, row in many.varied.items()}
        one = simulate("nonvanishing", initial={n: values[n] for n in ("theta", "x1")}, parameters={"k": values["k"]})
        assert many.distances[i] == pytest.approx(one.final_distance, abs=1e-6)


@pytest.mark.parametrize("coordinates", ["full", "reduced"])
def test_the_engines_agree(coordinates):
    runs = [
        ensemble("vanishing", 3, vary={"theta": headings(3)}, engine=engine, coordinates=coordinates, frame="tau")
        for engine in ("casadi", "heyoka", "lsoda")
    ]
    for run in runs[1:]:
        assert np.max(np.abs(runs[0].distances - run.distances)) < 1e-6


@pytest.mark.parametrize("engine", ["casadi", "heyoka"])
def test_members_that_escape_do_not_take_the_others_with_them(engine):
    system = System(t, (x,), (x**2 - x,))
    starts = np.array([0.5, 2.0, -1.0, 0.9, 3.0])
    result = ensemble(system, 5, initial=[0], span=(0, 2), vary={"x": starts}, engine=engine)
    assert result.outcomes == tuple(Outcome.ESCAPED if s > 1.2 else Outcome.REACHED for s in starts)
    # x = 1/(1 - (1 - 1/x0) e^t), which is infinite at t = log(x0/(x0 - 1)).
    assert result.t[1] == pytest.approx(np.log(2), abs=1e-5)
    assert result.x[0, 0] == pytest.approx(1 / (1 + np.exp(2)), rel=1e-6)
    assert result.counts == {"escaped": 2, "reached T": 3}


def test_times_may_vary_too():
    result = ensemble("saturated", 4, vary={"T": np.array([0.5, 1, 1.5, 2])}, model="average")
    assert result.t == pytest.approx([0.5, 1, 1.5, 2])


def test_members_that_end_before_the_clip_and_after_it_run_together():
    result = ensemble("vanishing", 4, vary={"nu_min": np.array([0.3, 0.5, 1.0, 0.3])}, model="average")
    assert result.settings["engine"] == "casadi"
    for nu_min, distance in zip(result.varied["nu_min"], result.distances, strict=True):
        alone = simulate("vanishing", model="average", parameters={"nu_min": nu_min})
        assert distance == pytest.approx(alone.final_distance, rel=1e-6)


def test_an_ensemble_may_end_before_the_clip():
    early = ensemble("vanishing", 3, vary={"theta": headings(3)}, until=0.4, engine="heyoka")
    other = ensemble("vanishing", 3, vary={"theta": headings(3)}, until=0.4, engine="casadi")
    assert np.max(np.abs(early.distances - other.distances)) < 1e-7


def test_heyoka_refuses_a_kink_in_time_that_it_is_not_told():
    system = System(t, (x,), (sp.Max(t, 1) - x,))
    with pytest.raises(InputError, match="kink in time at an unknown instant"):
        simulate(system, initial=[0], span=(0, 3), engine="heyoka")
    result = ensemble(system, 2, initial=[0], span=(0, 3), vary={"x": (0, 1)})
    assert result.settings["engine"] == "casadi"


def test_progress_counts_every_member():
    seen = []
    ensemble("vanishing", 300, model="average", engine="heyoka", progress=seen.append)
    assert sum(seen) == 300


def test_an_ensemble_shows_itself(saved):
    result = ensemble("vanishing", 12, model="average")
    assert result.q95 <= result.max
    picture = result._repr_png_()
    axes = saved[0].axes[0]
    assert shown(picture, axes, result.median, axes.get_ylim()[1] / 2, RED) == 1
    assert "reached T" in result._repr_html_()
