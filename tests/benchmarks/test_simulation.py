"""The benchmark measures what it says: every code meets the accuracy, and nothing is built twice."""

import json
from pathlib import Path

import numpy as np
import pytest

from benchmarks import simulation as benchmark
from benchmarks.by_hand import heyoka_loop, scipy_loop
from benchmarks.measuring import goal, ratios, targets
from ptproof.problem import example
from ptproof.simulation import ensemble
from ptproof.simulation.ensembles import headings


def test_the_reference_is_that_of_another_code():
    problem = example("vanishing")
    assert np.max(np.abs(scipy_loop(problem, "DOP853", 1e-12) - benchmark._truth(problem)[:, -1:])) < 1e-10


@pytest.mark.parametrize("samples", [1, 20])
def test_the_codes_agree_with_the_reference_to_the_accuracy(monkeypatch, samples):
    monkeypatch.setattr(benchmark, "_ROUNDS", 1)
    monkeypatch.setattr(benchmark, "LADDER", benchmark.LADDER[::4])  # whole decades will do to meet the accuracy
    rows = benchmark.one_trajectory(example("vanishing"), (benchmark.LOOSE,), samples)
    assert {row.code for row in rows} >= {"casadi", "lsoda", "radau", "heyoka"}
    assert all(row.error <= benchmark.LOOSE for row in rows)
    assert all(row.seconds > 0 for row in rows)


def test_a_code_gets_the_loosest_tolerance_that_meets_each_accuracy():
    met = benchmark._tolerances(lambda rtol: np.array([rtol]), np.array([0.0]), (5e-9, 5e-6))
    assert met == {5e-6: (3.2e-6, 3.2e-6), 5e-9: (3.2e-9, 3.2e-9)}


def test_a_code_that_never_meets_the_accuracy_is_not_compared():
    with pytest.raises(RuntimeError, match="no tolerance"):
        benchmark._tolerances(lambda rtol: np.array([2.0]), np.array([1.0]), (1e-9,))


def test_the_ensemble_is_what_heyoka_gives_by_hand():
    problem, angles = example("vanishing"), headings(24)
    ours = ensemble(problem, 24, engine="heyoka", vary={"theta": angles}, rtol=1e-9, **benchmark._OPTIONS)
    np.testing.assert_allclose(ours.x[:2], heyoka_loop(problem, angles, 2, 1e-9)(), atol=1e-9)


def test_the_targets_are_judged_by_the_ratios():
    one = "one trajectory to 1e-09"
    rows = [
        benchmark.Row(one, "lsoda", 0.09), benchmark.Row(one, "casadi", 0.01),
        benchmark.Row("many", "ptproof", 2e-4), benchmark.Row("many", "heyoka by hand", 1e-4),
    ]  # fmt: skip
    found = ratios(rows)
    judged = {target["ratio"]: target for target in targets(found)}
    assert found["lsoda over casadi, to 1e-09"] == pytest.approx(9)
    assert goal(judged["lsoda over casadi, to 1e-09"]) == "at least 10: missed"
    assert goal(judged["ensemble over heyoka by hand"]) == "at most 1.5: missed"


@pytest.mark.parametrize("arguments", [["--members", "1"], ["--members", "many"], ["--out", "no/such/folder/x.json"]])
def test_bad_use_is_refused_with_exit_2(arguments, capsys):
    with pytest.raises(SystemExit) as stopped:
        benchmark.main(arguments)
    assert stopped.value.code == 2
    assert arguments[0] in capsys.readouterr().err


def test_the_command_prints_json_alone_and_writes_the_file(tmp_path, monkeypatch, capsys):
    data = {"rows": [], "ratios": {}, "machine": {}}
    monkeypatch.setattr(benchmark, "run", lambda members, say: say("one trajectory") or data)
    assert benchmark.main(["--json", "--out", str(tmp_path / "out.json")]) == 0
    printed = capsys.readouterr()
    assert json.loads(printed.out) == json.loads((tmp_path / "out.json").read_text()) == data
    assert "one trajectory" in printed.err


def test_building_is_apart_and_happens_once():
    # An AssertionError inside says that a second run with other values built something.
    assert [row.code for row in benchmark.building(example("vanishing"))] == ["casadi", "heyoka"]


def test_the_table_has_the_machine_and_the_ratios():
    row = benchmark.Row("one trajectory", "casadi", 0.004, 1e-7, 1e-5)
    text = benchmark.table({"rows": [vars(row)], "ratios": {"a over b": 12.3}, "machine": benchmark.machine()})
    assert "| one trajectory | casadi | 0.004 | 1.0e-07 | 1.0e-05 |" in text
    assert "| a over b | 12.3 |" in text
    assert "cores" in text


def test_the_stored_result_is_accurate_and_goes_into_the_report():
    path = Path(__file__).parents[2] / "derivations" / "pt_seeker" / "benchmark.json"
    data = json.loads(path.read_text(encoding="utf-8"))
    compared = [row for row in data["rows"] if row["item"] == "one trajectory to 1e-09" or row["item"] == "many"]
    assert len(compared) >= 10
    assert all(row["error"] <= data["accuracy"] for row in compared)
    rows = [benchmark.Row(**row) for row in data["rows"]]
    assert data["ratios"] == pytest.approx(ratios(rows))
    assert data["targets"] == targets(data["ratios"])
