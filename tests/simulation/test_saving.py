"""Runs as files: what is read back is what was simulated."""

import csv
import json

import numpy as np
import pytest

from ptproof.errors import InputError
from ptproof.simulation import ensemble, simulate


def table(file):
    return list(csv.DictReader(file.read_text("utf-8").splitlines()))


def test_a_table_has_each_sample_to_the_last_digit(tmp_path):
    run = simulate("vanishing", until=0.1, samples=20)
    run.save(tmp_path / "run.csv")
    rows = table(tmp_path / "run.csv")
    assert len(rows) == len(run.t)
    names = ["t", "tau", "x1", "x2", "theta", "z", "field", "distance", "source_x1", "source_x2", "u1", "u2"]
    assert list(rows[0]) == names
    for name in ("t", "x1", "theta", "u2", "distance"):
        assert [float(row[name]) for row in rows] == run[name].tolist()


def test_arrays_have_their_names_and_the_settings(tmp_path):
    run = simulate("nonvanishing", until=0.1, samples=20)
    run.save(tmp_path / "run.npz")
    with np.load(tmp_path / "run.npz") as read:
        assert np.array_equal(read["x2"], run["x2"])
        settings = json.loads(str(read["settings"]))
    assert (settings["example"], settings["values"]["omega"]) == ("nonvanishing", 50)


def test_an_ensemble_has_a_row_for_each_member(tmp_path):
    many = ensemble("vanishing", 3, until=0.05)
    many.save(tmp_path / "many.csv")
    rows = table(tmp_path / "many.csv")
    assert [float(row["start_theta"]) for row in rows] == many.varied["theta"].tolist()
    assert [float(row["distance"]) for row in rows] == many.distances.tolist()
    assert {row["outcome"] for row in rows} == {"reached the time asked for"}


@pytest.mark.parametrize("name", ["run.txt", "run", "nowhere/run.csv", "."])
def test_refused(tmp_path, name):
    with pytest.raises(InputError, match="save"):
        simulate("vanishing", until=0.01, samples=3).save(tmp_path / name)
