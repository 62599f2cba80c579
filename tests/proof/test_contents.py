"""For a selection of claims only the files are loaded that may hold them, whatever has changed since."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from ptproof.errors import InputError
from ptproof.proof.load import Derivation
from ptproof.proof.memory import Memory

HEAD = "import sympy as sp\nfrom ptproof.proof import claim, eq, exact\nx = sp.Symbol('x', real=True)\n"
CLAIM = "{name} = claim('{id}', 'The sum {id}', eq(x + x, 2 * x), labels=['eq:{id}'])(exact)\n"


def one(id: str, name: str = "one", before: str = "") -> str:
    return HEAD + before + CLAIM.format(id=id, name=name)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Four files: ``b`` imports ``a``, ``c`` imports nothing, and what ``d`` imports its text does not tell."""
    monkeypatch.setenv("PTPROOF_CACHE", str(tmp_path / "cache"))
    place = tmp_path / "paper"
    place.mkdir()
    (place / "a.py").write_text(one("first"))
    (place / "b.py").write_text(one("second", before="from .a import one as used\n"))
    (place / "c.py").write_text(one("third"))
    (place / "d.py").write_text(one("fourth", before="import importlib\n"))
    (place / "data.json").write_text("{}")
    loaded(place)
    yield place
    forget()


def forget() -> None:
    for name in [name for name in sys.modules if name.startswith("ptproof_derivation_")]:
        del sys.modules[name]


def read(folder: Path, select: str, *, fresh: bool = False) -> Derivation:
    forget()
    return Memory([folder], fresh=fresh).load(select)


def loaded(folder: Path, select: str = "", *, fresh: bool = False) -> str:
    """The letters of the files whose claims are there."""
    derivation = read(folder, select, fresh=fresh)
    return "".join(sorted({Path(derivation.homes[item.id]).stem for item in derivation.claims}))


@pytest.mark.parametrize(
    ("select", "files"),
    [
        ("first", "a"),
        ("SECOND", "ab"),  # with what it imports
        ("sum third", "c"),  # a title
        ("eq:fourth", "d"),  # a label
        ("the sum", "abcd"),
        ("", "abcd"),
        ("nowhere", "abcd"),  # so that the sentence about it is about all
    ],
)
def test_a_selection_loads_the_files_that_hold_it(folder: Path, select: str, files: str) -> None:
    assert loaded(folder, select) == files


@pytest.mark.parametrize(
    ("changed", "files"),
    [("a.py", "abcd"), ("b.py", "abcd"), ("c.py", "cd"), ("d.py", "cd"), ("data.json", "abcd")],
)
def test_what_may_say_something_else_by_now_is_loaded(folder: Path, changed: str, files: str) -> None:
    file = folder / changed
    file.write_text(file.read_text() + "\n")
    # b imports a, and d may import anything.
    assert loaded(folder, "third") == files


def test_a_claim_that_was_renamed_is_found(folder: Path) -> None:
    (folder / "c.py").write_text(one("other"))
    derivation = read(folder, "other")
    assert [item.id for item in derivation.select("other")] == ["other"]


def test_a_new_file_is_loaded(folder: Path) -> None:
    (folder / "e.py").write_text(one("fifth"))
    assert [item.id for item in read(folder, "fifth").select("fifth")] == ["fifth"]


def test_an_id_that_stands_twice_is_an_error_also_where_the_other_file_is_not_needed(folder: Path) -> None:
    (folder / "c.py").write_text(one("first"))
    with pytest.raises(InputError, match="'first' stands twice"):
        read(folder, "fourth")


def test_a_selection_holds_the_same_claims_in_the_same_order(folder: Path) -> None:
    everything = read(folder, "")
    for select in ("second", "r", "fourth"):
        chosen = [item.id for item in read(folder, select).select(select)]
        assert chosen == [item.id for item in everything.select(select)]


def test_with_fresh_nothing_is_taken_from_an_earlier_run(folder: Path) -> None:
    assert loaded(folder, "first", fresh=True) == "abcd"
    assert loaded(folder, "first") == "a"
