"""A goal over a box: proved by a cover, refuted by a witness, and undecided outside what the assumptions say."""

from functools import partial

import pytest
import sympy as sp

from ptproof.proof.claim import Goal
from ptproof.proof.engines.enclosures import enclosures
from ptproof.proof.settling import settle
from ptproof.proof.statement import eq, every, ge, gt, le, lt
from ptproof.proof.verdict import Verdict

x = sp.Symbol("x", real=True)
y = sp.Symbol("y", positive=True)
unit = (ge(x, 0), le(x, 1))


def decide(statement, assumptions=unit, box=((x, 0, 1),)):
    goal = Goal("a", statement, tuple(assumptions))
    values = {symbol: (low, high) for symbol, low, high in box}
    return settle(goal, partial(enclosures, box=values, seconds=2), seconds=0)


def test_inequality_over_a_box_is_proved():
    assert decide(le(sp.sin(x), 2 * x)).verdict is Verdict.PROVED


def test_every_part_has_to_hold():
    found = decide(every(le(sp.sin(x), 2 * x), lt(sp.exp(x), sp.Rational(27, 10))))
    assert found.verdict is Verdict.REFUTED
    assert found.witness.values == {"x": "1"}


def test_numbers_need_no_box():
    assert decide(lt(sp.pi, sp.Rational(22, 7)), (), ()).verdict is Verdict.PROVED
    assert decide(gt(sp.pi, sp.Rational(22, 7)), (), ()).verdict is Verdict.REFUTED


def test_box_may_be_larger_than_the_domain_but_the_witness_lies_inside_it():
    narrow = (ge(x, 0), le(x, sp.Rational(1, 2)))
    assert decide(le(x, sp.Rational(3, 4)), narrow).verdict is Verdict.UNDECIDED
    assert decide(le(x, 2), narrow).verdict is Verdict.PROVED


@pytest.mark.parametrize("assumptions", [(), unit[:1], unit[1:], (ge(x, 0), le(x, sp.Rational(11, 10)))])
def test_domain_that_reaches_beyond_the_box_is_undecided(assumptions):
    assert decide(le(x, 2), assumptions).verdict is Verdict.UNDECIDED


@pytest.mark.parametrize("statement", [eq(x, x), le(x, 1 + y), le(sp.Function("g")(x), 1), le(x / (x - x**2), 100)])
def test_what_cannot_be_covered_is_undecided(statement):
    assert decide(statement).verdict is Verdict.UNDECIDED
