"""Claims before Coq's kernel: what is true is confirmed, and its corrupted twin is not."""

from __future__ import annotations

import json
import signal
import threading
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import sympy as sp

from ptproof.commands import opinion
from ptproof.commands.cli import main
from ptproof.proof import claim, eq, exact, ge, le, lt
from ptproof.proof.claim import Claim
from ptproof.proof.kernel import check, coq
from ptproof.proof.kernel.asking import EFFORTS
from ptproof.proof.kernel.lemmas import Noted
from ptproof.proof.kernel.theorem import proposition
from ptproof.proof.memory import Memory
from ptproof.proof.result import Result, Verification
from ptproof.proof.verdict import Verdict
from tests.proof.kernel.asked import needs_coq
from tests.proof.kernel.asked import test_what_is_not_true_is_not_confirmed as test_what_is_not_true_is_not_confirmed
from tests.proof.kernel.asked import test_what_is_true_is_confirmed as test_what_is_true_is_confirmed

x, y = sp.symbols("x y", real=True)
lam = sp.Symbol("lambda", positive=True)
a, b = sp.symbols("a b", positive=True)
n = sp.Symbol("n", integer=True, positive=True)
F = sp.Function("F", real=True)


def stated(id: str, statement: Any, **options: Any) -> Claim:
    return claim(id, id, statement, **options)(exact)


TRUE = [
    stated("identity", eq((x + lam) ** 2 / lam, x**2 / lam + 2 * x + lam)),
    stated("assumed", ge(x**2, y**2), given=[ge(x, y), ge(y, 0)]),
    stated("circle", eq(sp.sin(x) ** 2 * F(y) + sp.cos(x) ** 2 * F(y), F(y))),
    stated("derivative", eq(sp.Derivative(sp.exp(-a * x), x), -a * sp.exp(-a * x))),
    stated("powers", le(a ** (2 * n), b ** (2 * n)), given=[le(a, b)]),
    stated("root", le(a, sp.sqrt(a**2 + b**2))),
    stated("limit", eq(sp.Limit(x / (1 + x / a), x, sp.oo), a)),
]
NOT_CONFIRMED = [
    stated("coefficient", eq((x + lam) ** 2 / lam, x**2 / lam + 3 * x + lam)),
    stated("assumption-dropped", ge(x**2, y**2), given=[ge(x, y)]),
    stated("undefined-at-0", eq(x * (1 / x + 1), 1 + x)),
    stated("quotient-by-zero", eq(1 / (x - y), 0), given=[eq(x, y)]),
    stated("root-of-a-negative", eq(sp.sqrt(-1 - x**2), 0)),
    stated("power-of-a-negative", ge((-1 - x**2) ** (sp.pi), 0)),
    stated("logarithm", le(sp.log(x), x)),
    stated("derivative-of-nothing", eq(sp.Derivative(sp.sqrt(-1 - x**2), x), 0)),
    stated("wrong-limit", eq(sp.Limit(x / (1 + x / a), x, sp.oo), 2 * a)),
    stated("strictness", lt(a ** (2 * n), b ** (2 * n)), given=[le(a, b)]),
]


@needs_coq
@pytest.mark.usefixtures("library")
def test_an_axiom_of_our_own_is_noticed(tmp_path: Path) -> None:
    coq.prepare(tmp_path)
    theorem = coq.Theorem("claim_false", "False", "exact mine")
    text = coq.source([theorem], 5).replace("Open Scope R_scope.", "Open Scope R_scope.\nAxiom mine : False.")
    (tmp_path / "claims.v").write_text(text, encoding="utf-8")
    assert coq.heard(coq.ask(tmp_path, "claims.v", 60).output, [theorem]) == {
        theorem.name: "it or another of its file rests on mine"
    }


@needs_coq
@pytest.mark.usefixtures("library")
def test_verify_adds_the_evidence(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lines = "import sympy as sp; from ptproof.proof import claim, eq, exact; x = sp.Symbol('fun', real=True)"
    (tmp_path / "claims.py").write_text(f"{lines}; one = claim('sum', 'A sum', eq(x + x, 2 * x))(exact)")
    kept = tmp_path / "kept"
    with pytest.raises(SystemExit) as ended:
        main(["verify", str(tmp_path), "--kernel", "--keep", str(kept), "--json"])
    assert ended.value.code == 0
    (entry,) = json.loads(capsys.readouterr().out)["claims"]
    assert [item["engine"] for item in entry["evidence"]][-1] == "coq"
    assert "fun_2" in next(kept.glob("claims_*.v")).read_text("utf-8")


@pytest.mark.parametrize(("count", "files"), [(1, 1), (6, 1), (20, 2), (60, 5)])
def test_a_file_has_many_claims_and_every_process_one(
    count: int, files: int, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(coq, "missing", lambda: "")
    monkeypatch.setattr(coq, "prepare", lambda folder: None)
    monkeypatch.setattr(coq, "ask", lambda *_: coq.Printed("", "", False))
    told = check([replace(TRUE[0], id=str(n)) for n in range(count)], workers=2, keep=tmp_path, efforts=["quick"])
    assert {item.reason for item in told.values()} == {"Coq gave no answer"}
    assert len(told) == count
    assert len(list(tmp_path.glob("claims_*.v"))) == files


@pytest.fixture
def pretended(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Coq confirms whatever it is asked; the files that it was asked about."""
    asked: list[str] = []

    def ask(folder: Path, file: str, *_: object) -> coq.Printed:
        asked.append(file)
        return coq.Printed("", "", False)

    for name, value in {
        "missing": lambda: "", "prepare": lambda folder: None, "version": lambda: "8.16", "ask": ask,
        "heard": lambda output, theorems: {theorem.name: "" for theorem in theorems},
    }.items():  # fmt: skip
        monkeypatch.setattr(coq, name, value)
    return asked


def test_what_coq_has_confirmed_is_remembered(
    pretended: list[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("PTPROOF_CACHE", str(tmp_path))
    first = check(TRUE, memory=Memory(["nowhere"]))
    assert pretended
    assert not any(item.remembered for item in first.values())
    pretended.clear()
    again = check([replace(TRUE[0], id="by another name"), *TRUE[1:]], memory=Memory(["elsewhere"]))
    assert not pretended
    assert all(item.confirmed and item.remembered for item in again.values())
    assert [item.proposition for item in again.values()] == [item.proposition for item in first.values()]


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (lambda patch: patch.setattr(coq, "version", lambda: "8.17"), "another Coq"),
        (lambda patch: patch.setattr(Memory, "recall_said", lambda *_: {"confirmed": "yes"}), "not what was kept"),
    ],
)
def test_what_is_not_the_same_is_asked_again(
    change: Any, why: str, pretended: list[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("PTPROOF_CACHE", str(tmp_path))
    check(TRUE[:1], memory=Memory([tmp_path]))
    pretended.clear()
    change(monkeypatch)
    assert not check(TRUE[:1], memory=Memory([tmp_path]))["identity"].remembered, why
    assert pretended


@pytest.mark.usefixtures("pretended")
def test_with_another_statement_fresh_or_files_to_leave_it_is_asked_again(
    pretended: list[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("PTPROOF_CACHE", str(tmp_path / "cache"))
    check(TRUE[:1], memory=Memory([tmp_path]))
    pretended.clear()
    check([replace(TRUE[0], statement=eq(x, x))], memory=Memory([tmp_path]))
    check(TRUE[:1], memory=Memory([tmp_path], fresh=True))
    check(TRUE[:1], memory=Memory([tmp_path]), keep=tmp_path / "kept")
    assert len(pretended) == 3


def test_what_came_too_late_is_not_remembered(
    pretended: list[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("PTPROOF_CACHE", str(tmp_path))
    monkeypatch.setattr(coq, "heard", lambda *_: {})
    assert check(TRUE[:1], memory=Memory([tmp_path]), efforts=["quick"])["identity"].late
    pretended.clear()
    check(TRUE[:1], memory=Memory([tmp_path]), efforts=["quick"])
    assert pretended


def test_what_a_later_effort_confirms_is_remembered_although_an_earlier_one_was_late(
    pretended: list[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("PTPROOF_CACHE", str(tmp_path))
    hearing = coq.heard
    monkeypatch.setattr(coq, "heard", lambda output, asked: {} if "quick" in asked[0].name else hearing(output, asked))
    answer = check(TRUE[:1], memory=Memory([tmp_path]), efforts=["quick", "thorough"])["identity"]
    assert answer.confirmed
    assert not answer.late
    assert check(TRUE[:1], memory=Memory([tmp_path]), efforts=["quick", "thorough"])["identity"].remembered


def test_an_interrupt_ends_coq_and_keeps_what_is_known(
    pretended: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.setenv("PTPROOF_CACHE", str(tmp_path))
    confirming, begun, ended = coq.ask, threading.Event(), threading.Event()

    def ask(folder: Path, file: str, seconds: float, stop: coq.Stop) -> coq.Printed:
        if "quick_000" in file:
            return confirming(folder, file, seconds)
        begun.set()
        until = time.monotonic() + 30
        while not stop.is_set() and time.monotonic() < until:
            time.sleep(0.01)
        ended.set()
        return coq.Printed("", "", True)

    def take(self: Noted) -> None:  # this process is interrupted while it waits
        assert begun.wait(30)
        raise KeyboardInterrupt

    monkeypatch.setattr(coq, "ask", ask)
    monkeypatch.setattr(Noted, "take", take)
    results = tuple(Result(replace(TRUE[0], id=f"n{n}"), Verdict.PROVED, (), True) for n in range(18))
    memory = Memory([tmp_path])
    after, status = opinion.confirmed(Verification(results, 0.0), 1, None, memory)
    assert status == 128 + signal.SIGINT
    assert [len(item.evidence) for item in after.results] == [1] * 12 + [0] * 6
    assert "interrupted; Coq's kernel confirmed 12 of 18" in capsys.readouterr().err
    assert ended.wait(5)
    assert memory.recall_said("Coq's kernel", "8.16", *EFFORTS, proposition(TRUE[0]).text)


@needs_coq
@pytest.mark.usefixtures("library")
def test_coq_is_ended_when_it_is_told_to_stop(tmp_path: Path) -> None:
    coq.prepare(tmp_path)
    (tmp_path / "endless.v").write_text("Goal True. repeat (assert True by exact I; idtac). Qed.", "utf-8")
    stop = coq.Stop()
    threading.Timer(0.5, stop.set).start()
    start = time.monotonic()
    assert coq.ask(tmp_path, "endless.v", 60, stop).late
    assert coq.ask(tmp_path, "endless.v", 60, stop).late  # nor does it begin again
    assert time.monotonic() - start < 10


def test_without_coq_every_claim_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(coq.shutil, "which", lambda name: None)
    answer = check([TRUE[0]])["identity"]
    assert not answer.confirmed
    assert answer.reason.startswith("coq is not installed")


def test_without_coq_the_command_refuses(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(coq.shutil, "which", lambda name: None)
    with pytest.raises(SystemExit) as ended:
        main(["verify", "--kernel"])
    assert ended.value.code == 2
    assert "libcoq-interval" in capsys.readouterr().err
