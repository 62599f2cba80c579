"""Writing a report: as a whole or not at all."""

import os
from pathlib import Path

import pytest

from ptproof.errors import InputError
from ptproof.report.writing import MANIFEST, check_place, write_report


def tree(folder):
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file() and path.name != MANIFEST
    }


def test_files_are_written(tmp_path):
    files = {"index.html": b"a", "figures/one.svg": b"b"}
    write_report(tmp_path / "deep" / "reports", files)
    assert tree(tmp_path / "deep" / "reports") == files


def test_nothing_is_left_beside(tmp_path):
    write_report(tmp_path / "reports", {"index.html": b"a"})
    assert [path.name for path in tmp_path.iterdir()] == ["reports"]


def test_stale_files_of_an_older_report_go_and_other_files_stay(tmp_path):
    out = tmp_path / "reports"
    write_report(out, {"index.html": b"1", "figures/old.svg": b"1", "figures/kept.svg": b"1"})
    (out / "notes.txt").write_bytes(b"mine")
    write_report(out, {"index.html": b"2", "figures/kept.svg": b"2"})
    assert tree(out) == {"index.html": b"2", "figures/kept.svg": b"2", "notes.txt": b"mine"}


def test_an_empty_folder_of_figures_goes(tmp_path):
    out = tmp_path / "reports"
    write_report(out, {"index.html": b"1", "figures/old.svg": b"1"})
    write_report(out, {"index.html": b"2"})
    assert not (out / "figures").exists()


def test_a_failure_in_the_middle_leaves_the_older_report(tmp_path, monkeypatch):
    out = tmp_path / "reports"
    old = {"a.html": b"old", "b.html": b"old"}
    write_report(out, old)
    write = Path.write_bytes

    def full(path, data):
        if path.name == "b.html":
            raise OSError(28, "No space left on device")
        return write(path, data)

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(InputError, match="No space left"):
        write_report(out, {"a.html": b"new", "b.html": b"new"})
    assert tree(out) == old
    assert [path.name for path in tmp_path.iterdir()] == ["reports"]


def test_a_failure_while_moving_leaves_whole_files_that_the_next_report_knows(tmp_path, monkeypatch):
    out = tmp_path / "reports"
    write_report(out, {"a.html": b"old", "b.html": b"old"})
    move = os.replace

    def failing(source, target):
        if Path(target).name == "d.html":
            raise OSError(5, "Input/output error")
        move(source, target)

    monkeypatch.setattr(os, "replace", failing)
    with pytest.raises(InputError):
        write_report(out, {"c.html": b"new", "d.html": b"new"})
    monkeypatch.undo()
    assert set(tree(out).values()) <= {b"old", b"new"}
    write_report(out, {"e.html": b"last"})
    assert tree(out) == {"e.html": b"last"}


def test_a_list_that_names_places_outside_removes_nothing(tmp_path):
    out = tmp_path / "reports"
    out.mkdir()
    (tmp_path / "mine.txt").write_bytes(b"mine")
    (out / MANIFEST).write_text('{"files": ["../mine.txt", "/etc/hostname"]}')
    write_report(out, {"index.html": b"1"})
    assert (tmp_path / "mine.txt").read_bytes() == b"mine"


@pytest.mark.parametrize("content", ["", "[]", "nonsense", '{"files": 3}', '{"files": [1]}'])
def test_a_broken_list_counts_as_none(tmp_path, content):
    out = tmp_path / "reports"
    out.mkdir()
    (out / MANIFEST).write_text(content)
    write_report(out, {"index.html": b"1"})
    assert tree(out) == {"index.html": b"1"}


@pytest.mark.parametrize("name", ["../x", "/x", MANIFEST, ""])
def test_files_of_a_report_are_inside(tmp_path, name):
    with pytest.raises(ValueError, match="not a file"):
        write_report(tmp_path / "reports", {name: b"1"})


def test_a_file_is_no_place(tmp_path):
    (tmp_path / "file").write_text("")
    for out in (tmp_path / "file", tmp_path / "file" / "reports"):
        with pytest.raises(InputError, match="is a file"):
            check_place(out)


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser may write everywhere")
def test_a_folder_without_permission_is_no_place(tmp_path):
    tmp_path.chmod(0o500)
    with pytest.raises(InputError, match="permission"):
        check_place(tmp_path / "reports")
