"""A second run decides again only what has changed, and trusts nothing that is not its own."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
import sympy as sp

from ptproof.proof import Evidence, Verdict, claim, eq, exact, load, lt
from ptproof.proof import memory as module
from ptproof.proof.memory import Memory, read_evidence, written_evidence
from ptproof.proof.result import Verification
from ptproof.proof.run import conclude
from ptproof.proof.verdict import Witness
from ptproof.reading import hashes
from ptproof.reading.cache import Cache

CLAIMS = """
import sympy as sp
from ptproof.proof import claim, eq, exact
from .letters import x
one = claim("one", "One", eq(x + x, 2 * x))(exact)
two = claim("two", "Two", eq(x - x, 0), uses=[one])(exact)
"""
LETTERS = "import sympy as sp\nx = sp.Symbol('x', real=True)\n"
PROVED = Evidence("exact algebra", Verdict.PROVED, "shown", 1.5)
x = sp.Symbol("x", real=True)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("PTPROOF_CACHE", str(tmp_path / "cache"))
    folder = tmp_path / "derivation"
    folder.mkdir()
    (folder / "claims.py").write_text(CLAIMS)
    (folder / "letters.py").write_text(LETTERS)
    return folder


def told(folder: Path, **options: object) -> Memory:
    """A memory that was told of the loading of the folder."""
    memory = Memory([folder], **options)  # type: ignore[arg-type]
    with memory.loading():
        pass
    return memory


def kept(folder: Path, evidence: Evidence = PROVED) -> Memory:
    memory = told(folder)
    memory.keep(ONE, evidence)
    return memory


ONE = claim("one", "One", eq(x + x, 2 * x))(exact)


def test_what_was_decided_is_recalled_as_it_was(folder: Path) -> None:
    refuted = Evidence("witness", Verdict.REFUTED, "at 1", 0.5, Witness({"x": "1"}, "1", "2"))
    kept(folder, refuted)
    assert told(folder).recall(ONE) == refuted


OTHERS = [
    replace(ONE, statement=eq(x + x, 3 * x)),
    replace(ONE, assumptions=(lt(x, 1),)),
    replace(ONE, uses=(replace(ONE, id="other"),)),
    replace(ONE, id="another"),
    replace(ONE, statement=eq(sp.Symbol("x", positive=True) * 2, 2 * sp.Symbol("x", positive=True))),
]


@pytest.mark.parametrize("other", OTHERS, ids=["statement", "assumption", "uses", "id", "declaration"])
def test_another_claim_is_not_taken_for_it(other: object, folder: Path) -> None:
    kept(folder)
    assert told(folder).recall(other) is None  # type: ignore[arg-type]


def _environment(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hashes, "environment", lambda: "another version")


CHANGES: dict[str, Callable[[Path, pytest.MonkeyPatch], object]] = {
    "a proof": lambda folder, _: (folder / "claims.py").write_text(CLAIMS + "# another proof\n"),
    "a neighbour": lambda folder, _: (folder / "letters.py").write_text(LETTERS + "y = x\n"),
    "a new file": lambda folder, _: (folder / "more.py").write_text(""),
    "a file fewer": lambda folder, _: (folder / "letters.py").unlink(),
    "data": lambda folder, _: (folder / "numbers.csv").write_text("1"),
    "another version": _environment,
}


@pytest.mark.parametrize("change", CHANGES)
def test_after_a_change_nothing_is_recalled(change: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    memory = kept(folder)
    memory.keep_run("", {"json": 1}, lasting=True)
    assert Memory([folder]).run("") == {"json": 1}
    CHANGES[change](folder, monkeypatch)
    assert told(folder).recall(ONE) is None
    assert Memory([folder]).run("") is None


UNCHANGED = ["__pycache__/x.pyc", ".hidden", "report/.ptproof-report.json", "report/index.html"]


def test_what_a_run_itself_writes_is_no_change(folder: Path) -> None:
    kept(folder)
    for name in UNCHANGED:
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text("{}")
    assert told(folder).recall(ONE) == PROVED


def test_what_was_read_elsewhere_while_loading_belongs_to_it(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "data.txt").write_text("1")
    (folder / "claims.py").write_text(f"text = open({str(tmp_path / 'data.txt')!r}).read()\n{CLAIMS}")

    def read() -> Memory:
        memory = Memory([folder])
        with memory.loading():
            (tmp_path / "data.txt").read_text()
        return memory

    read().keep(ONE, PROVED)
    assert read().recall(ONE) == PROVED
    (tmp_path / "data.txt").write_text("2")
    assert read().recall(ONE) is None


NOT_KEPT = {
    "time": Evidence("time limit", Verdict.UNDECIDED, "no answer in 60 s"),
    "crash": Evidence("crash", Verdict.UNDECIDED, "the proof called sys.exit(0)"),
    "interrupt": Evidence("interrupted", Verdict.UNDECIDED, ""),
    "open": Evidence("z3", Verdict.UNDECIDED, "unknown"),
}


@pytest.mark.parametrize("evidence", NOT_KEPT.values(), ids=NOT_KEPT)
def test_what_is_open_for_want_of_time_is_tried_again(evidence: Evidence, folder: Path) -> None:
    memory = kept(folder, evidence)
    assert told(folder).recall(ONE) is None
    memory.keep_run("", {}, memory.lasts(Verification(conclude([ONE], {"one": evidence}), 0.0)))
    assert Memory([folder]).run("") is None


def test_what_is_expected_to_be_open_is_kept(folder: Path) -> None:
    open_ = replace(ONE, expected=Verdict.UNDECIDED)
    told(folder).keep(open_, NOT_KEPT["open"])
    assert told(folder).recall(open_) == NOT_KEPT["open"]


def test_a_proof_that_reads_other_files_is_not_kept(folder: Path, tmp_path: Path) -> None:
    told(folder).keep(ONE, PROVED, [str(tmp_path / "elsewhere")])
    assert told(folder).recall(ONE) is None
    told(folder).keep(ONE, PROVED, [str(folder / "letters.py")])
    assert told(folder).recall(ONE) == PROVED


def test_a_file_that_changes_during_the_run_ends_the_keeping(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_LOOK", 0.0)
    memory = told(folder)
    text = (folder / "letters.py").read_text()
    (folder / "letters.py").write_text("x = 1")
    memory.keep(ONE, PROVED)
    (folder / "letters.py").write_text(text)
    assert told(folder).recall(ONE) is None


def test_fresh_recalls_nothing_and_keeps(folder: Path) -> None:
    kept(folder)
    assert told(folder, fresh=True).recall(ONE) is None
    assert Memory([folder], fresh=True).run("") is None


SPOILED = {
    "empty": lambda text: "",
    "cut": lambda text: text[: len(text) // 2],
    "no JSON": lambda text: "\x00\x01",
    "another value": lambda text: text.replace("proved", "refuted"),
    "another form": lambda text: json.dumps([1, 2]),
    "without check": lambda text: json.dumps({"value": json.loads(text)["value"]}),
    "deep": lambda text: "[" * 100_000,
}


@pytest.mark.parametrize("spoil", SPOILED.values(), ids=SPOILED)
def test_an_entry_that_is_not_whole_is_not_there(spoil: Callable[[str], str], tmp_path: Path) -> None:
    cache = Cache(tmp_path)
    cache.write("key", written_evidence(PROVED))
    (file,) = tmp_path.iterdir()
    file.write_text(spoil(file.read_text()))
    assert cache.read("key") is None


def test_an_entry_under_another_key_is_not_there(tmp_path: Path) -> None:
    cache = Cache(tmp_path)
    cache.write("key", 1)
    (file,) = tmp_path.iterdir()
    file.rename(tmp_path / Cache._name("other"))
    assert cache.read("other") is None


@pytest.mark.parametrize("data", [None, 1, {}, {"verdict": "true"}, {"verdict": "proved", "other": 1}, "proved"])
def test_what_is_no_evidence_is_none(data: object) -> None:
    assert read_evidence(data) is None


def test_where_nothing_can_be_kept_it_is_said_once(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    said: list[str] = []
    cache = Cache(tmp_path / "file" / "cache", said.append)
    cache.write("a", 1)
    cache.write("b", 1)
    assert len(said) == 1
    assert "nothing is remembered for the next run" in said[0]


def test_nothing_half_written_is_left(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.replace", full)
    Cache(tmp_path).write("a", 1)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_of_too_much_is_left(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hashes, "_FILES", 1)
    kept(folder)
    assert told(folder).recall(ONE) is None


def test_a_module_that_is_read_from_its_compiled_file_counts_as_its_source(tmp_path: Path) -> None:
    compiled = tmp_path / "__pycache__" / "letters.cpython-311.pyc"
    assert hashes.foreign([str(compiled)]) == (str(tmp_path / "letters.py"),)


def test_a_file_that_is_only_written_is_not_read(tmp_path: Path) -> None:
    (tmp_path / "read").write_text("1")
    with hashes.opened() as found:
        os.close(os.open(tmp_path / "written", os.O_CREAT | os.O_WRONLY))
        os.close(os.open(tmp_path / "read", os.O_RDONLY))
        (tmp_path / "also").write_text("2")
    assert {Path(file).name for file in found if file.startswith(str(tmp_path))} == {"read"}


def test_python_libraries_and_ptproof_are_not_foreign() -> None:
    assert hashes.foreign([json.__file__, sp.__file__, module.__file__]) == ()


@pytest.mark.parametrize("compiled", [True, False])
def test_claims_are_recalled_when_a_derivation_is_loaded_again(
    folder: Path, monkeypatch: pytest.MonkeyPatch, compiled: bool
) -> None:
    from ptproof.proof import verify

    monkeypatch.setattr(sys, "dont_write_bytecode", not compiled)
    outcomes = []
    for _ in range(2):
        memory = Memory([folder])
        with memory.loading():
            derivation = load([folder])
        outcomes.append(verify(derivation, workers=1, memory=memory))
    first, second = outcomes
    assert (first.remembered, second.remembered) == (frozenset(), {"one", "two"})
    data = second.to_json()
    marked = [item["evidence"][0].pop("remembered") for item in data["claims"]]
    assert marked == [True, True]
    assert data == first.to_json()
