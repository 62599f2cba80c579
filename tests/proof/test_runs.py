"""Statements about runs: what they may say, who attacks them, and what becomes of their mutants."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.proof import Claim, Evidence, Goal, Runs, Verdict, claim, decide, engine, eq, gt, le, lt
from ptproof.proof.attack import attack
from ptproof.proof.mutation.making import mutants
from ptproof.proof.statement import Relation

t, x, y, z = sp.symbols("t x y z", real=True)
STARTS = (eq(x, 1), eq(y, 0))
SPAN = (0, sp.pi)


def turning(*parts: Relation, **changes: Any) -> Runs:
    """A turn by half a circle from (1, 0), which ends at (−1, 0)."""
    said = Runs(t, (x, y), (-y, x), SPAN, STARTS, parts or (lt(x, 0),), (sp.pi, sp.pi))
    return replace(said, **changes)


def of(said: Runs) -> Claim:
    """A claim with a proof that shows nothing."""

    @claim("turn", "", said)
    def turn(goal: Goal) -> Evidence:
        return Evidence("none", Verdict.UNDECIDED, "")

    return turn


@pytest.mark.parametrize(
    "changes",
    [
        {"parts": ()},
        {"rates": (-y,)},
        {"state": (x, x)},
        {"rates": (-z, x)},
        {"starts": (eq(x, z),)},
        {"starts": (eq(x, t),)},
        {"parts": (lt(z, 0),)},
        {"span": (0, z)},
        {"during": (0, x)},
        {"rates": (sp.Function("F")(x), x)},
        {"state": (sp.Symbol("x", positive=True), y)},
        {"starts": (eq(sp.Matrix([x, y]), sp.Matrix([1, 0])),)},
    ],
)
def test_what_says_nothing_definite_is_refused(changes: dict[str, Any]) -> None:
    with pytest.raises(InputError):
        turning(**changes)


def test_it_is_read_as_it_is_meant() -> None:
    assert "x' = -y" in str(turning())
    assert "where x = 1 and y = 0 at t = 0" in str(turning())
    assert "x < 0 at t = pi" in str(turning())


@pytest.mark.parametrize(
    "changes",
    [
        {"parts": (gt(x, 0),)},
        {"rates": (-y, 2 * x)},
        {"starts": (eq(x, 2), eq(y, 0))},
        {"span": (0, 4)},
        {"during": (3, sp.pi)},
    ],
)
def test_every_part_of_it_counts(changes: dict[str, Any]) -> None:
    assert of(turning(**changes)).content != of(turning()).content


@pytest.mark.parametrize(
    ("said", "hit"),
    [
        (turning(lt(x, 0)), False),
        (turning(gt(x, 0)), True),
        (turning(lt(x, sp.Rational(-999, 1000))), False),
        (turning(lt(x, sp.Rational(-1001, 1000))), True),
        (turning(gt(y, sp.Rational(-1, 10**5)), during=SPAN), False),
        (turning(lt(y, sp.Rational(99, 100)), during=SPAN), True),
        (turning(lt(x, 0), starts=(eq(y, 0), gt(x, 0))), False),
        (turning(lt(x, 0), starts=(eq(y, 0),)), True),
        (turning(le(x**2 + y**2, 4), starts=(le(x**2 + y**2, 4),)), False),
        (turning(le(x**2 + y**2, 1), starts=(le(x**2 + y**2, 4),)), True),
    ],
)
def test_it_is_attacked_on_runs(said: Runs, hit: bool) -> None:
    found = attack(of(said).goal())
    assert found.points > 0
    assert (found.hit is not None) is hit


def test_what_is_false_of_a_run_is_not_proved() -> None:
    wrong = of(turning(gt(x, 0)))

    @engine
    def careless(goal: Goal) -> Evidence:
        return Evidence("careless", Verdict.PROVED, "")

    careless.__wrapped__.__module__ = "ptproof.proof.engines.careless"
    (found,) = decide([replace(wrong, prove=careless)]).results
    assert found.verdict is Verdict.UNDECIDED


def test_an_engine_of_another_package_proves_nothing() -> None:
    @engine
    def foreign(goal: Goal) -> Evidence:
        return Evidence("foreign", Verdict.PROVED, "")

    assert foreign(of(turning()).goal()).verdict is Verdict.UNDECIDED


def test_starts_rates_and_parts_are_changed() -> None:
    kinds = {mutant.kind for mutant in mutants(of(turning()))}
    assert {"start", "rate", "direction", "strictness"} <= kinds
