"""What a fact says outright needs no z3; what it says under a hypothesis, or of something else, does."""

from __future__ import annotations

import pytest
import sympy as sp

from ptproof.proof import eq, ge, gt, le, lt
from ptproof.proof.facts import is_said
from ptproof.proof.statement import Implication, Relation

x, y = sp.symbols("x y", real=True)
not_zero = Relation(x, "!=", sp.S.Zero)

SAID = {
    "itself": (gt(x, 0), gt(x, 0)),
    "turned round": (gt(x, 0), lt(0, x)),
    "a strict one for a weak one": (gt(x, 0), ge(x, 0)),
    "an equality for a weak one": (eq(x, y), le(x, y)),
    "positive, so not 0": (gt(x, 0), not_zero),
    "negative, so not 0": (lt(x, 0), not_zero),
}
NOT_SAID = {
    "a weak one for a strict one": (ge(x, 0), gt(x, 0)),
    "a weak one for what is not 0": (ge(x, 0), not_zero),
    "the other direction": (gt(x, 0), lt(x, 0)),
    "another letter": (gt(y, 0), gt(x, 0)),
    "an equality for a strict one": (eq(x, 0), gt(x, 0)),
    "what is not 0 for a strict one": (not_zero, gt(x, 0)),
}


@pytest.mark.parametrize("name", SAID)
def test_a_fact_says_it(name):
    fact, relation = SAID[name]
    assert is_said(relation, [Implication((), fact)])


@pytest.mark.parametrize("name", NOT_SAID)
def test_a_fact_does_not_say_it(name):
    fact, relation = NOT_SAID[name]
    assert not is_said(relation, [Implication((), fact)])


def test_under_a_hypothesis_nothing_is_said():
    assert not is_said(gt(x, 0), [Implication((gt(y, 0),), gt(x, 0))])
