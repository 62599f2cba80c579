"""The benchmark measures what it says: every code meets the accuracy, and nothing is built twice."""

import numpy as np

from ptproof.problem import example
from ptproof.simulation import benchmark


def test_the_codes_agree_with_the_reference_to_the_accuracy():
    problem = example("vanishing")
    truth = benchmark._truth(problem)
    assert np.max(np.abs(benchmark._solve_ivp(problem, "DOP853", 1e-11) - truth)) < 1e-9
    rows = benchmark.one_trajectory(problem, truth)
    assert {row.code for row in rows} >= {"casadi", "lsoda", "radau", "heyoka"}
    assert all(row.error <= benchmark.ACCURACY for row in rows)
    assert all(row.seconds > 0 for row in rows)


def test_building_is_apart_and_happens_once():
    # An AssertionError inside says that a second run with other values built something.
    assert [row.code for row in benchmark.building(example("vanishing"))] == ["casadi", "heyoka"]


def test_the_table_has_the_machine_and_the_ratios():
    row = benchmark.Row("one trajectory", "casadi", 0.004, 1e-7, 1e-5)
    text = benchmark.table({"rows": [vars(row)], "ratios": {"a over b": 12.3}, "machine": benchmark.machine()})
    assert "| one trajectory | casadi | 0.004 | 1.0e-07 | 1.0e-05 |" in text
    assert "| a over b | 12.3 |" in text
    assert "cores" in text
