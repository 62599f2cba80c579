"""What a proof puts to use is noted while somebody listens, in its order and with what it is shown by."""

from __future__ import annotations

import sympy as sp

from ptproof.proof import ForAll, claim, exact, ge, instances, le, power_nonnegative, specialise
from ptproof.proof.claim import Claim
from ptproof.proof.statement import Assumption, Relation
from ptproof.proof.steps import Anywhere, At, Lemma, Put, noting

x, s = sp.symbols("x s", real=True)
U = sp.Function("U", real=True)
EVERYWHERE = ForAll((s,), ge(U(s), 1), (ge(s, 0),))


def stated(id: str, statement: Relation, given: list[Assumption], uses: tuple[Claim, ...] = ()) -> Claim:
    return claim(id, id, statement, given=given, uses=uses)(exact)


USED = stated("used", ge(U(2), 0), [ForAll((s,), ge(U(s), 0), (ge(s, 0),))])
SAME = stated("same", ge(U(3), 1), [EVERYWHERE])
GOAL = stated("goal", ge(U(2), 0), [EVERYWHERE], (USED, SAME)).goal()


def test_a_point_is_noted() -> None:
    with noting() as steps:
        instances(GOAL, sp.Integer(2), x)
    assert steps == [At((2,)), At((x,))]


def test_a_lemma_of_the_library_is_noted() -> None:
    with noting() as steps:
        fact = power_nonnegative(x**2, sp.Rational(1, 2))
    assert steps == [Lemma(fact.says)]


def test_what_is_shown_anywhere_is_noted_with_its_steps() -> None:
    with noting() as steps:
        specialise(GOAL, USED, {}, along=lambda there, point: instances(there, point))
    (put,) = steps
    (anywhere,) = put.assumed
    (point,) = anywhere.point
    assert (put.content, put.values) == (USED.content, ())
    assert anywhere.steps == (At((point,)),)


def test_what_is_assumed_as_it_stands_needs_no_steps() -> None:
    with noting() as steps:
        specialise(GOAL, SAME, {})
    assert steps == [Put(SAME.content, (), (Anywhere(),))]


def test_nothing_is_noted_for_others_or_afterwards() -> None:
    with noting() as outer:
        with noting() as inner:
            instances(GOAL, sp.Integer(2))
        instances(GOAL, sp.Integer(3))
    instances(GOAL, sp.Integer(4))
    assert (inner, outer) == ([At((2,))], [At((3,))])


def test_facts_are_the_same_whether_somebody_listens_or_not() -> None:
    with noting():
        heard = specialise(GOAL, USED, {})
    assert heard == specialise(GOAL, USED, {})
    assert le(0, U(2)) == heard[0].says.conclusion.standard()
