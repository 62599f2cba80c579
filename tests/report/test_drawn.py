"""Figures are remembered by themselves, while nothing that they depend on has changed."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from ptproof.reading import hashes
from ptproof.report.content import Figure, Table
from ptproof.report.drawn import Drawing, Drawn

FIGURES = """
from pathlib import Path
from ptproof.report.content import Figure, Table
from .helper import caption
def figures():
    {body}
    text = Path({data!r}).read_text()
    yield Figure("f", caption + text, b"<svg xmlns='http://www.w3.org/2000/svg'/>")
def tables():
    return [Table("T", "C", ("a", "b"), (("1", "2"),))]
"""
pytestmark = pytest.mark.usefixtures("cache")


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PTPROOF_CACHE", str(tmp_path / "cache"))


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    folder = tmp_path / "derivation"
    folder.mkdir()
    (tmp_path / "data").write_text("1")
    (folder / "helper.py").write_text("caption = 'A figure '")
    (folder / "claims.py").write_text("raise SystemExit('claims are not needed for figures')")
    write(folder)
    return folder


def write(folder: Path, body: str = "pass") -> None:
    (folder / "figures.py").write_text(FIGURES.format(body=body, data=str(folder.parent / "data")))


def drawing(folder: Path, fresh: bool = False) -> Drawing:
    return Drawing.of([folder], fresh)


def test_what_was_drawn_is_known_again_as_it_was(folder: Path) -> None:
    assert drawing(folder).known() is None
    made = drawing(folder).drawn()
    assert made.figures == (Figure("f", "A figure 1", b"<svg xmlns='http://www.w3.org/2000/svg'/>"),)
    assert made.tables == (Table("T", "C", ("a", "b"), (("1", "2"),)),)
    assert str(folder.parent / "data") in made.files
    assert drawing(folder).known() == made
    assert drawing(folder, fresh=True).known() is None


def _environment(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hashes, "environment", lambda: "another version")


def _library(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ptproof.report.drawn.versions", lambda names: (("matplotlib", "another"),))


CHANGES: dict[str, Callable[[Path, pytest.MonkeyPatch], object]] = {
    "a figure's source": lambda folder, _: write(folder, "1 + 1"),
    "what it imports": lambda folder, _: (folder / "helper.py").write_text("caption = 'Another '"),
    "a new file": lambda folder, _: (folder / "more.csv").write_text("1"),
    "a file elsewhere": lambda folder, _: (folder.parent / "data").write_text("2"),
    "ptproof": _environment,
    "a library": _library,
}


@pytest.mark.parametrize("change", CHANGES)
def test_after_a_change_it_is_not_known(change: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    drawing(folder).drawn()
    assert drawing(folder).known() is not None
    CHANGES[change](folder, monkeypatch)
    assert drawing(folder).known() is None


@pytest.mark.parametrize(
    ("body", "failed"),
    [
        ("raise ValueError('no picture')", "The figures could not be drawn: ValueError: no picture"),
        ("raise SystemExit(3)", "The figures could not be drawn: their code called sys.exit(3)"),
        ("yield 3", "The figures could not be drawn: InputError: figures() gives figures and tables"),
        ("raise KeyboardInterrupt", ""),
    ],
)
def test_what_failed_is_said_and_not_remembered(body: str, failed: str, folder: Path) -> None:
    write(folder, body)
    made = drawing(folder).drawn()
    assert made.failed.startswith(failed)
    assert (made.interrupted, made.figures) == (not failed, ())
    assert drawing(folder).known() is None


@pytest.mark.parametrize("data", [None, {}, {"figures": [["f", "c", "AA=="]], "tables": [], "files": []}, []])
def test_what_is_no_drawing_is_not_taken_for_one(data: object) -> None:
    assert Drawn.again(data) is None


def test_a_folder_without_figures_brings_none(folder: Path) -> None:
    (folder / "figures.py").unlink()
    assert drawing(folder).files == ()
