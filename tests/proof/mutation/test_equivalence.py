"""What says the same as the original is seen to, and what does not is never taken for it."""

from dataclasses import replace

import pytest
import sympy as sp

from ptproof.proof import claim, ge, le, lt, reals
from ptproof.proof.mutation.equivalence import equivalent, implied
from ptproof.proof.mutation.mutant import Mutant
from ptproof.proof.statement import Relation, eq

x, y = sp.symbols("x y", real=True)
T = sp.Symbol("T", positive=True)


def mutant(old, new, before=(), after=None):
    original = claim("original", "", old, given=before)(reals)
    changed = replace(original, statement=new, assumptions=tuple(before if after is None else after))
    return Mutant(changed, original, "", "")


SAME = {
    "another form": mutant(le((x + 1) ** 2, y), le(x**2 + 2 * x + 1, y)),
    "both sides moved": mutant(le(x, y), le(x + 1, y + 1)),
    "an equality negated": mutant(eq(x - y, 0), eq(y - x, 0)),
    "at the value assumed": mutant(eq(x + y, 1), eq(2 * x + y, 1), [eq(x, 0)]),
    "a positive factor": mutant(le(T * x, 0), le(x, 0)),
    "strictness that cannot matter": mutant(le(x, y), lt(x, y), [Relation(x, "!=", y)]),
    "an assumption that follows": mutant(ge(x, 0), ge(x, 0), [ge(x, 1), ge(x, 0)], [ge(x, 1)]),
    "an assumption by the declaration": mutant(ge(x, T), ge(x, T), [ge(x, T), ge(T, 0)], [ge(x, T)]),
}
OTHER = {
    "one more": mutant(le(x, y), le(x + 1, y)),
    "strictness": mutant(le(x, y), lt(x, y)),
    "a factor of any sign": mutant(le(y * x, 0), le(x, 0)),
    "an equality turned round": mutant(eq(x, 0), eq(x + 1, 0)),
    "an inequality negated": mutant(le(x, y), le(-x, -y)),
    "true by itself": mutant(ge(x**2, 0), ge(x**2 + 1, 0)),
    "defined elsewhere": mutant(le(y, 1), le(y + 1 / x, 1 + 1 / x)),
    "an assumption that does not follow": mutant(ge(x, 0), ge(x, 0), [ge(x, 1)], []),
    "a weaker assumption": mutant(ge(x, 0), ge(x, 0), [ge(x, 1)], [ge(x, 0)]),
    "a symbol of another kind": mutant(eq(T + T, 2 * T), eq(x + x, 2 * x)),
}


@pytest.mark.parametrize("name", SAME)
def test_equivalent(name):
    assert equivalent(SAME[name])


@pytest.mark.parametrize("name", OTHER)
def test_not_equivalent(name):
    assert not equivalent(OTHER[name])


@pytest.mark.parametrize(
    ("item", "word"),
    [
        (mutant(le(x, y), le(x, y + 1)), "the original"),
        (mutant(ge(x**2, 0), ge(x**2 + 1, 0)), "the assumptions"),
        (mutant(ge(x, 0), ge(x, 0), [ge(x, 1)], [ge(x, 2)]), "assumes at least"),
        (mutant(ge(x, 0), ge(x, 0)), "states what the original states"),
    ],
)
def test_implied_with_the_reason(item, word):
    assert word in implied(item)


@pytest.mark.parametrize("name", [name for name in OTHER if name not in ("strictness", "true by itself")])
def test_not_implied(name):
    assert not implied(OTHER[name])
