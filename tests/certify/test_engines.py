"""The engines of statements about runs: an enclosure of one run, a certificate of every vehicle."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import pytest
import sympy as sp

from ptproof.certify import certified, enclosed
from ptproof.problem import Problem, example
from ptproof.proof import Evidence, Goal, Runs, Verdict, claim, eq, ge, gt, le, lt
from ptproof.proof.statement import Relation

t, x, y = sp.symbols("t x y", real=True)
HALF, WHOLE = sp.pi, (0, sp.pi)


def turning(*parts: Relation, **changes: Any) -> Runs:
    """A turn by half a circle from (1, 0)."""
    said = Runs(t, (x, y), (-y, x), WHOLE, (eq(x, 1), eq(y, 0)), parts or (lt(x, 0),), (HALF, HALF))
    return replace(said, **changes)


def goal_of(said: Runs) -> Goal:
    """The goal of a claim that says this."""

    @claim("run", "", said)
    def run(goal: Goal) -> Evidence:
        return enclosed(goal)

    return run.goal()


@pytest.mark.parametrize(
    ("said", "verdict"),
    [
        (turning(lt(x, sp.Rational(-999, 1000))), "proved"),
        (turning(lt(x, sp.Rational(-1001, 1000))), "refuted"),
        (turning(le(x, -1)), "undecided"),  # true, and no ball shows it
        (turning(eq(y, 1)), "refuted"),
        (turning(lt(sp.Abs(x**2 + y**2 - 1), sp.Rational(1, 50)), during=WHOLE), "proved"),
        (turning(lt(y, sp.Rational(99, 100)), during=WHOLE), "refuted"),
        (turning(lt(y, sp.Rational(101, 100)), gt(x, -sp.Rational(1, 2)), during=(0, 2)), "proved"),
        (turning(gt(x, -sp.Rational(2, 5)), during=(0, 2)), "refuted"),
        (turning(lt(x, 0), during=(0, 4)), "undecided"),
        (turning(lt(x, 0), during=(3, 2)), "undecided"),
        (turning(lt(1 / y, 0)), "undecided"),
        (turning(starts=(eq(x, 1),)), "undecided"),
        (turning(starts=(eq(x, 1), ge(y, 0))), "undecided"),
        (turning(starts=(eq(x, 1), eq(y, 0), eq(x, 2))), "undecided"),
        (turning(rates=(1 + x**2, x), span=(0, 2), during=(2, 2)), "undecided"),  # it escapes
    ],
)
def test_what_an_enclosure_decides(said: Runs, verdict: str) -> None:
    assert str(enclosed(goal_of(said), seconds=60.0).verdict) == verdict


def test_the_witness_is_an_instant() -> None:
    found = enclosed(goal_of(turning(lt(y, sp.Rational(99, 100)), during=WHOLE)))
    assert found.witness is not None
    assert sp.sin(sp.Rational(found.witness.values["t"])) >= sp.Rational(99, 100)


@cache
def still() -> Problem:
    """A vehicle of which much is certain at once: Section 7.3 without saturation."""
    return example("saturated")


def every(**changes: Any) -> Runs:
    """What is certain of it."""
    problem = still()
    loop, far, z = problem.closed_loop("pt"), x1**2 + x2**2, problem.states.filter
    starts = (le(far, 8), eq(z, problem.field.expression))
    said = Runs(loop.time, loop.state, loop.rhs, (0, 1), starts, (lt(far, sp.Rational(1, 2)),), (1, 1))
    return replace(said, **changes)


x1, x2 = still().variables
FAR, Z = x1**2 + x2**2, still().states.filter
FILTER = eq(Z, still().field.expression)
RATES = still().closed_loop("pt").rhs


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"parts": (le(FAR, sp.Rational(1, 2)),)},
        {"parts": (le(FAR, 12),), "during": (sp.Rational(1, 2), 1)},
        {"starts": (le(x2**2 + x1**2, 8), FILTER)},
    ],
)
def test_what_a_certificate_proves(changes: dict[str, Any]) -> None:
    assert certified(goal_of(every(**changes)), still(), tolerance=0.5).verdict is Verdict.PROVED


@pytest.mark.parametrize(
    "changes",
    [
        {"parts": (lt(FAR, sp.Rational(1, 10)),)},
        {"parts": (lt(FAR, sp.Rational(1, 2)),), "during": (0, 1)},
        {"parts": (gt(FAR, 0),)},
        {"parts": (lt(x1**2, sp.Rational(1, 2)),)},
        {"parts": (lt(FAR, 1 + x1),)},
        {"starts": (le(FAR, 8),)},
        {"starts": (FILTER,)},
        {"starts": (ge(FAR, 8), FILTER)},
        {"starts": (le(FAR, 8), eq(Z, 0))},
        {"starts": (le(FAR, 8), FILTER, eq(x1, 5))},
        {"starts": (le(x1**2, 8), FILTER)},
        {"rates": tuple(2 * rate for rate in RATES)},
        {"rates": (RATES[1], RATES[0], *RATES[2:])},
        {"span": (0, 2), "during": (2, 2)},
        {"during": (0, 2)},
        {"parts": (lt(FAR, -1),)},
    ],
)
def test_what_a_certificate_does_not_say(changes: dict[str, Any]) -> None:
    assert certified(goal_of(every(**changes)), still(), tolerance=0.5).verdict is Verdict.UNDECIDED


def test_a_certificate_of_another_problem_is_none() -> None:
    other = replace(still(), tuning=replace(still().tuning, omega=sp.Integer(300)))
    assert certified(goal_of(every()), other, tolerance=0.5).verdict is Verdict.UNDECIDED
