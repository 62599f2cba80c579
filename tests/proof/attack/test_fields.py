"""Fields that satisfy assumptions for all positions exactly, motions in them, and drifts that belong to a motion."""

from __future__ import annotations

import itertools
import random

import pytest
import sympy as sp

from ptproof.proof import ForAll, Goal, eq, ge, gt, le, lt
from ptproof.proof.attack import attack
from ptproof.proof.attack.fields import Range, fields
from ptproof.proof.attack.functions import START
from ptproof.proof.attack.preparation import prepared
from ptproof.proof.attack.putting import concretely

x, y, s, t, u = sp.symbols("x y s t u", real=True)
a, b, c, k, T = sp.symbols("a b c k T", positive=True)
d = sp.Symbol("d", nonnegative=True)
n = sp.Symbol("n", positive=True, integer=True)
F = sp.Function("F", real=True)
X, Y = (sp.Function(name, real=True) for name in "XY")
f, g = (sp.Function(name, real=True) for name in "fg")
square = x**2 + y**2
depth = F(0, 0) - F(x, y)
slope = sp.sqrt(sp.Derivative(F(x, y), x) ** 2 + sp.Derivative(F(x, y), y) ** 2)
between = (ForAll((x, y), le(b * square**n, depth)), ForAll((x, y), le(depth, a * square**n)))
steep = ForAll((x, y), le(c * sp.sqrt(square) ** (2 * n - 1), slope))

HOLD = {
    "between powers of the distance": between,
    "with a gradient": (*between, steep),
    "a strict inequality turned round": (ForAll((x, y), ge(a * square, depth)), ForAll((x, y), ge(depth, b * square))),
    "of no letter": (ForAll((x, y), ge(depth, 0)), ForAll((x, y), ge(slope, 0))),
}
NOT = {
    "an odd term": (ForAll((x, y), le(b * x, depth)),),
    "two letters in one assumption": (ForAll((x, y), le(a * b * square, depth)),),
    "another power than the field has": (ForAll((x, y), le(a * square**4, depth)),),
    "it is said of a strict inequality": (ForAll((x, y), lt(b * square, depth)),),
    "an upper bound below the lower one": (ForAll((x, y), le(depth, 0)), ForAll((x, y), le(square, depth))),
    "a sum of letters": (ForAll((x, y), le((a + b) * square, depth)),),
    "a letter that may be negative": (ForAll((x, y), le(u * square, depth)), ForAll((x, y), le(depth, -square))),
}


def inside(interval: Range, share: sp.Rational):
    """A value of the range: its best end at share 1."""
    return interval.low / share if interval.high is None else interval.high * share


@pytest.mark.parametrize("name", HOLD)
def test_what_is_found_satisfies_the_assumptions(name):
    found = fields(HOLD[name], ())
    assert found
    generator = random.Random(name)
    for field, share in itertools.product(found, (sp.S.One, sp.Rational(1, 3))):
        letters = {**dict(field.letters), **{letter: inside(one, share) for letter, one in field.ranges}}
        for item in HOLD[name]:
            for _ in range(5):
                place = {letter: sp.Rational(generator.randint(-30, 30), 7) for letter in (x, y)}
                low, high = (
                    concretely(side, dict(field.functions)).subs(letters).subs(place)
                    for side in (item.relation.standard().left, item.relation.standard().right)
                )
                assert sp.N(high - low, 30) >= -sp.Rational(1, 10**20)


def test_the_ranges_are_sharp():
    field = fields((*between, steep), ())[0]
    assert dict(field.ranges) == {b: Range(high=sp.S.One), a: Range(low=sp.S.One), c: Range(high=sp.Integer(2))}


@pytest.mark.parametrize("name", NOT)
def test_nothing_is_found_where_nobody_knows(name):
    assert not fields(NOT[name], ())


moves = tuple(
    ForAll(
        (s,),
        eq(sp.Derivative(Z(s), s), k / 2 * sp.Subs(sp.Derivative(F(x, y), z), (x, y), (X(s), Y(s)))),
        (ge(s, 0), le(s, t)),
    )
    for Z, z in ((X, x), (Y, y))
)
here = {x: X(t), y: Y(t)}
V, begun = F(0, 0) - F(X(t), Y(t)), F(0, 0) - F(X(0), Y(0))
bounds = tuple(
    ForAll(item.variables, item.relation.map(lambda e: e.subs(n, 1)), item.domain) for item in (*between, steep)
)


def decay(factor):
    """V falls at the rate k c²/(2a), times a factor."""
    return Goal("decay", le(V, begun * sp.exp(-factor * k * c**2 / (2 * a) * t)), (*moves, *bounds, gt(t, 0)))


def test_a_true_claim_about_all_solutions_in_all_fields_is_attacked_and_not_hit():
    done = attack(decay(1))
    assert done.points
    assert done.hit is None


@pytest.mark.parametrize("factor", [2, sp.Rational(11, 10)])
def test_a_false_one_is_hit(factor):
    assert attack(decay(factor)).hit is not None


def test_a_false_one_without_an_assumption_is_hit():
    goal = decay(1)
    assumptions = tuple(item for item in goal.assumptions if item != bounds[2])
    assert attack(Goal("less", goal.statement, assumptions)).hit is not None


pushed = (
    ForAll(
        (s,), eq(sp.Derivative(X(s), s), f(s / (1 + s), X(s), Y(s)) / (1 + s) ** 2 - k * X(s)), (ge(s, 0), le(s, t))
    ),
    ForAll(
        (s,), eq(sp.Derivative(Y(s), s), g(s / (1 + s), X(s), Y(s)) / (1 + s) ** 2 - k * Y(s)), (ge(s, 0), le(s, t))
    ),
    ForAll((u, x, y), le(sp.sqrt(f(u, x, y) ** 2 + g(u, x, y) ** 2), d), (ge(u, 0), lt(u, 1))),
    ForAll((x, y), le(square * a, depth)),
)


def with_drift():
    """The settings with a drift that is not 0."""
    ready = prepared(Goal("pushed", le(X(t), d), (*pushed, gt(t, 0))))
    return [one for one in ready.settings if any(fun == f and made.body != 0 for fun, made in one.functions)]


def test_a_drift_belongs_to_its_motion():
    found = with_drift()
    assert found
    for one in found:
        made, numbers = dict(one.functions), {k: sp.Rational(3, 7), START: sp.Rational(5, 3), s: sp.Rational(2, 3)}
        relation = pushed[0].relation
        assert sp.simplify(concretely(relation.left - relation.right, made).subs(numbers)) == 0


def test_the_bound_of_a_drift_is_met():
    for one in with_drift():
        numbers = {k: sp.Rational(3, 7), START: sp.Rational(5, 3)}
        drift, bound = dict(one.functions)[f].body.subs(numbers), dict(one.letters)[d].subs(numbers)
        time = dict(one.functions)[f].arguments[0]
        assert all(abs(drift.subs(time, sp.Rational(i, 50))) <= bound for i in range(50))
        assert any(abs(drift.subs(time, end)) == bound for end in (0, 1))
