"""Several papers at once: each stands for itself, and what is printed is about all of them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from ptproof.commands.cli import main
from ptproof.proof.papers import papers_of

CLAIMS = """
import sympy as sp
from ptproof.proof import claim, eq, exact
SECTION = "A section"
x = sp.Symbol("x", real=True)
base = claim("base", "A base of {name}", eq(x + x, 2 * x), labels=["eq:{name}"])(exact)
both = claim("both", "In both", eq({left}, 2 * x), labels=["eq:both"], uses=[base], expected="{expected}")(exact)
own = claim("{name}", "Of {name} alone", eq(x, x + 1), expected="refuted")(exact)
"""
PAPER = (
    r"\begin{equation} x + x = 2x \label{eq:one} \end{equation} \begin{equation} 1 = 1 \label{eq:both} \end{equation}"
)


@pytest.fixture
def papers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("PTPROOF_CACHE", str(tmp_path / "cache"))
    folder = tmp_path / "papers"
    for name, left, expected in (("one", "x + x", "proved"), ("two", "3 * x", "refuted")):
        (folder / name).mkdir(parents=True)
        (folder / name / "claims.py").write_text(CLAIMS.format(name=name, left=left, expected=expected))
    (folder / "helpers").mkdir()
    (folder / "helpers" / "none.py").write_text("NOTHING = 1\n")
    return folder


def run(capsys: pytest.CaptureFixture[str], *arguments: object) -> tuple[Any, str, str]:
    with pytest.raises(SystemExit) as ended:
        main([*map(str, arguments)])
    shown = capsys.readouterr()
    return ended.value.code or 0, shown.out, shown.err


def test_claims_with_one_id_stay_apart(papers: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "verify", papers, "--json", "--jobs", 1)
    data = json.loads(out)
    assert status == 0
    assert {item["id"]: (item["paper"], item["verdict"]) for item in data["claims"]} == {
        "one:base": ("one", "proved"), "one:both": ("one", "proved"), "one": ("one", "refuted"),
        "two:base": ("two", "proved"), "two:both": ("two", "refuted"), "two": ("two", "refuted"),
    }  # fmt: skip
    assert {item["id"]: item["uses"] for item in data["claims"]}["two:both"] == ["two:base"]
    assert data["summary"]["total"] == 6
    assert {name: found["refuted"] for name, found in data["papers"].items()} == {"one": 1, "two": 2}


def test_one_that_is_not_as_expected_is_the_status_of_all(papers: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = papers / "one" / "claims.py"
    file.write_text(file.read_text().replace('expected="refuted"', 'expected="proved"'))
    status, out, _ = run(capsys, "verify", papers, "--jobs", 1)
    assert status == 1
    assert "2 papers, 6 claims: 1 not as expected" in out


def test_a_paper_that_cannot_be_loaded_ends_the_run_before_anything_is_decided(
    papers: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (papers / "two" / "claims.py").write_text("boom = 1 / 0\n")
    status, out, err = run(capsys, "verify", papers, "--json")
    assert (status, out) == (2, "")
    assert "line 1: ZeroDivisionError" in err


def test_a_selection_leaves_out_the_papers_that_have_none_of_it(
    papers: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for _ in range(2):  # the second time nothing of the other is loaded
        status, out, _ = run(capsys, "verify", papers, "--json", "--jobs", 1, "-k", "alone")
        assert (status, [item["id"] for item in json.loads(out)["claims"]]) == (0, ["one", "two"])
        status, out, _ = run(capsys, "verify", papers, "--json", "--jobs", 1, "-k", "of two")
        assert (status, [item["id"] for item in json.loads(out)["claims"]]) == (0, ["base", "two"])
    status, out, err = run(capsys, "verify", papers, "-k", "nothing like it")
    assert (status, out) == (2, "")
    assert "no claim of helpers, one, two contains 'nothing like it'" in err


def test_each_paper_is_remembered_by_itself(papers: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def remembered() -> dict[str, bool]:
        claims = json.loads(run(capsys, "verify", papers, "--json", "--jobs", 1)[1])["claims"]
        return {item["id"]: any("remembered" in entry for entry in item["evidence"]) for item in claims}

    assert not any(remembered().values())
    assert all(remembered().values())
    file = papers / "two" / "claims.py"
    file.write_text(file.read_text() + "# another\n")
    assert {id for id, known in remembered().items() if not known} == {"two:base", "two:both", "two"}


def test_mutants_of_all_papers(papers: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, out, _ = run(capsys, "mutate", papers, "--json", "--jobs", 1, "-k", "base")
    data = json.loads(out)
    assert (status, set(data["claims"])) == (0, {"one:base", "two:base"})
    assert data["summary"]["claims"] == 2
    assert data["summary"]["made"] == sum(item["made"] for item in data["claims"].values())
    status, out, _ = run(capsys, "mutate", papers, "--json", "--jobs", 1, "-k", "both")
    assert set(json.loads(out)["claims"]) == {"both"}  # the other is expected to be refuted


def test_the_derivation_that_names_most_labels_is_the_papers_own(
    papers: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    paper = papers / "paper.tex"
    paper.write_text(PAPER)
    status, out, err = run(capsys, "coverage", paper, papers)
    assert (status, err) == (0, f"{paper} is held against one\n")
    assert "2 of 2 labelled equations are covered" in out
    paper.write_text(PAPER.replace("eq:one", "eq:none"))
    status, out, err = run(capsys, "coverage", paper, papers)
    assert (status, out) == (2, "")
    assert "one, two name as many of its labels" in err


def test_files_of_one_folder_are_one_paper_and_names_are_unlike(papers: Path) -> None:
    (papers / "other" / "one").mkdir(parents=True)
    (papers / "other" / "one" / "a.py").write_text("")
    files = [papers / "one" / "claims.py", papers / "other" / "one", papers / "two"]
    assert [(paper.name, paper.paths) for paper in papers_of(files)] == [
        ("one", (files[0],)), ("one-2", (files[1],)), ("two", (files[2],)),
    ]  # fmt: skip
