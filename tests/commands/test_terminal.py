"""What `ptproof verify` shows to people."""

from __future__ import annotations

from dataclasses import replace

import pytest
import sympy as sp

from ptproof.commands.shown import Shown
from ptproof.commands.terminal import verification_table
from ptproof.proof.claim import Goal, claim
from ptproof.proof.deciding import run_one
from ptproof.proof.engines.witnesses import refute
from ptproof.proof.result import Verification
from ptproof.proof.run import conclude
from ptproof.proof.statement import Relation, eq, lt
from ptproof.proof.verdict import Evidence

x = sp.Symbol("x", real=True)


def _shown(statement: Relation, values: dict[sp.Symbol, int], expected: str, capsys: pytest.CaptureFixture[str]) -> str:
    def prove(goal: Goal) -> Evidence:
        return refute(goal, values)

    item = replace(claim("a/b", "A false statement", statement, expected=expected)(prove), section="One section")
    verification_table(Shown.of(Verification(conclude([item], {item.id: run_one(item)}), 0.1)))
    return capsys.readouterr().out


def test_witness_shows_its_values_and_both_sides(capsys: pytest.CaptureFixture[str]) -> None:
    lines = [line.strip() for line in _shown(lt(x, 1), {x: 2}, "refuted", capsys).splitlines()]
    assert {"One section", "at x = 2", "left side   2", "right side  1"} <= set(lines)


def test_witness_without_values_says_so(capsys: pytest.CaptureFixture[str]) -> None:
    assert "at all values" in _shown(eq(sp.Integer(1), 2), {}, "refuted", capsys)


def test_what_did_not_come_out_as_recorded_stands_out(capsys: pytest.CaptureFixture[str]) -> None:
    shown = _shown(lt(x, 1), {x: 2}, "proved", capsys)
    assert "(expected proved)" in shown
    assert "1 not as expected" in shown


@pytest.mark.parametrize("width", [40, 80, 120])
def test_no_line_is_wider_than_the_terminal(
    width: int, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    assert max(map(len, _shown(lt(x, 1), {x: 2}, "refuted", capsys).splitlines())) <= width
