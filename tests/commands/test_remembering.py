"""The commands remember: a second run says the same without deciding again."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from ptproof.commands.cli import main
from ptproof.proof import memory

CLAIMS = """
import sympy as sp
from pathlib import Path
from ptproof.proof import claim, eq, exact
SECTION = "A section"
x = sp.Symbol("x", real=True)
@claim("sum", "A sum", eq(x + x, 2 * x))
def sum(goal):
    with open({log!r}, "a") as log:
        log.write("decided")
    return exact(goal)
false = claim("false", "False", eq(x, x + 1), expected="{expected}")(exact)
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("PTPROOF_CACHE", str(tmp_path / "cache"))
    monkeypatch.chdir(tmp_path)
    folder = tmp_path / "derivation"
    folder.mkdir()
    write(folder)
    return folder


def write(folder: Path, expected: str = "refuted") -> None:
    (folder / "claims.py").write_text(CLAIMS.format(log=str(folder.parent / "log"), expected=expected))


def run(capsys: pytest.CaptureFixture[str], *arguments: object) -> tuple[Any, str, str]:
    with pytest.raises(SystemExit) as ended:
        main([*map(str, arguments)])
    shown = capsys.readouterr()
    return ended.value.code, shown.out, shown.err


def decided(folder: Path) -> int:
    log = folder.parent / "log"
    return log.read_text().count("decided") if log.exists() else 0


@pytest.mark.parametrize("arguments", [("--json",), (), ("--json", "-k", "sum")], ids=str)
def test_a_second_verification_says_the_same_and_decides_nothing(
    arguments: tuple[str, ...], folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    first = run(capsys, "verify", folder, *arguments)
    second = run(capsys, "verify", folder, *arguments)
    assert decided(folder) == 1
    assert (first[0], second[0]) == (0, 0)
    if "--json" in arguments:
        again = json.loads(second[1])
        for item in again["claims"]:
            assert item["evidence"][0].pop("remembered")
        assert again == json.loads(first[1])
    else:
        assert second[1].partition(" claims in")[0] == first[1].partition(" claims in")[0]
        assert "remembered" in second[1]


def test_fresh_decides_again(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run(capsys, "verify", folder)
    run(capsys, "verify", folder, "--fresh")
    assert decided(folder) == 2


def test_a_status_of_1_is_remembered_as_one(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(folder, expected="proved")
    assert [run(capsys, "verify", folder)[0] for _ in range(2)] == [1, 1]
    assert decided(folder) == 1


def test_a_change_is_decided_again(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run(capsys, "verify", folder)
    (folder / "more.py").write_text("y = 1\n")
    run(capsys, "verify", folder)
    assert decided(folder) == 2


def test_a_report_takes_what_a_verification_has_decided(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run(capsys, "verify", folder)
    assert run(capsys, "report", folder, "--out", "out")[0] == 0
    assert run(capsys, "report", folder, "--out", folder / "out")[0] == 0
    assert run(capsys, "verify", folder)[0] == 0
    assert decided(folder) == 1


def test_a_place_that_cannot_be_written_is_one_warning(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder.parent / "file").write_text("")
    monkeypatch.setenv("PTPROOF_CACHE", str(folder.parent / "file"))
    status, _, err = run(capsys, "verify", folder)
    assert (status, err.count("\n"), err.count("nothing is remembered")) == (0, 1, 1)


FIGURES = """
from pathlib import Path
from ptproof.report.content import Figure
def figures():
    with open({log!r}, "a") as log:
        log.write("drawn")
    return [Figure(name="f", caption="A figure.", content=b"<svg xmlns='http://www.w3.org/2000/svg'/>")]
"""
AGAIN = [  # what is changed, what is asked, and how often the figures are drawn by then
    ("nothing", (), 1),
    ("another place", ("--out", "other"), 1),
    ("a file elsewhere", (), 2),
    ("another question", ("--single",), 2),
    ("a file elsewhere that remembered figures have read", ("--single",), 3),
    ("another question and a file elsewhere", (), 4),
    ("a file", (), 5),
    ("fresh", ("--fresh",), 6),
]


def test_a_report_is_made_again_where_something_it_depends_on_has_changed(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    figures, data = FIGURES.format(log=str(folder.parent / "log")), folder.parent / "data"
    data.write_text("1")
    (folder / "figures.py").write_text(
        figures.replace("    return", f"    Path({str(data)!r}).read_text()\n    return")
    )
    first = run(capsys, "report", folder, "--jobs", 1, "--out", "out")
    assert first[0] == 0
    for change, arguments, drawn in AGAIN:
        monkeypatch.setattr(memory, "_read_before", set())  # as in a process of its own
        if "a file elsewhere" in change:
            data.write_text(data.read_text() + "1")
        elif change == "a file":
            (folder / "more.py").write_text("y = 1\n")
        out = "other" if "--out" in arguments else "out"
        again = run(
            capsys, "report", folder, "--jobs", 1, *(() if "--out" in arguments else ("--out", out)), *arguments
        )
        assert (change, again[0]) == (change, 0)
        assert (change, (folder.parent / "log").read_text().count("drawn")) == (change, drawn)
        if "--single" in arguments:
            assert (folder.parent / "out" / "report.html").is_file()
        else:
            assert again[1] == first[1].replace("out/", f"{out}/")
            assert (folder.parent / out / "figures" / "f.svg").is_file()


def test_a_report_without_its_figures_is_tried_again(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    figures = FIGURES.format(log=str(folder.parent / "log")).replace("return", "raise ValueError")
    (folder / "figures.py").write_text(figures)
    assert [run(capsys, "report", folder, "--out", "out")[0] for _ in range(2)] == [1, 1]
    assert (folder.parent / "log").read_text().count("drawn") == 2
