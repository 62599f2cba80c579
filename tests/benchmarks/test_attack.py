"""The command that attacks everything stops at a hit, with the status that says so."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from benchmarks import attack as command
from ptproof.proof.attack import WrongPromise


def test_clocks_and_averages_are_attacked() -> None:
    assert all(count > 5 for room in ("clocks", "averages") for count in command.ROOMS[room](1))


def test_a_hit_ends_it(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def broken(seed: int) -> Iterator[int]:
        raise WrongPromise("two is three", "it is two")
        yield 0

    monkeypatch.setattr(command, "ROOMS", {"claims": broken})
    monkeypatch.setattr("sys.argv", ["attack"])
    assert command.main() == 1
    assert capsys.readouterr().out.startswith("ptproof is wrong here: two is three, but it is two.")
