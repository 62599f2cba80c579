"""Assumptions for all values of several variables: which follow from others, each beside twins that do not."""

from __future__ import annotations

import pytest
import sympy as sp

from ptproof.proof import ForAll, Goal, eq, ge
from ptproof.proof.engines.quantified import _arbitrary, _like, entailed

x, y, u, v = sp.symbols("x y u v", real=True)
F = sp.Function("F", real=True)
NEEDED = ForAll((x, y), ge(F(x, y), 0), (ge(x, 0),))


def follows_from(needed, *given):
    return entailed(needed, Goal("several", ge(x**2, 0), tuple(given))).shown


FOLLOWS = {
    "more, on a larger domain": (NEEDED, [ForAll((x, y), ge(F(x, y), 1), (ge(x, -1),))]),
    "other names": (NEEDED, [ForAll((u, v), ge(F(u, v), 0), (ge(u, 0),))]),
    "names exchanged": (NEEDED, [ForAll((y, x), ge(F(y, x), 0), (ge(y, 0),))]),
    "an identity": (ForAll((x, y), eq((x + y) ** 2, x**2 + 2 * x * y + y**2)), []),
    "a plain assumption on another letter": (ForAll((x, y), ge(F(x, y), u), (ge(x, 0),)), [
        ForAll((x, y), ge(F(x, y), v), (ge(x, 0),)), ge(v, u)]),
}  # fmt: skip
DOES_NOT = {
    "on a smaller domain": (NEEDED, [ForAll((x, y), ge(F(x, y), 0), (ge(x, 1),))]),
    "less": (NEEDED, [ForAll((x, y), ge(F(x, y), -1), (ge(x, 0),))]),
    "the domain of the other variable": (NEEDED, [ForAll((u, v), ge(F(u, v), 0), (ge(v, 0),))]),
    "the function of exchanged variables": (NEEDED, [ForAll((u, v), ge(F(v, u), 0), (ge(u, 0),))]),
    "on a line only": (NEEDED, [ForAll((x,), ge(F(x, 0), 0), (ge(x, 0),))]),
    "at free letters of the same names": (NEEDED, [ge(F(x, y), 0)]),
    "no identity": (ForAll((x, y), eq((x + y) ** 2, x**2 + y**2)), []),
    "what is assumed of a free letter of the same name": (ForAll((x, y), ge(x, y)), [ge(x, y)]),
}


@pytest.mark.parametrize("case", FOLLOWS)
def test_what_follows_for_several_variables(case):
    needed, given = FOLLOWS[case]
    assert follows_from(needed, *given)


@pytest.mark.parametrize("case", DOES_NOT)
def test_what_does_not_follow_for_several_variables(case):
    needed, given = DOES_NOT[case]
    assert not follows_from(needed, *given)


def test_a_letter_about_which_something_is_said_is_not_arbitrary():
    """The same letters serve many proofs: where one of them occurs, another has to be taken."""
    needed, hidden = ForAll((x,), ge(x, 1)), [_like(x, number) for number in range(3)]
    assert _arbitrary(x, []) == hidden[0]
    assert _arbitrary(x, hidden[:2]) == hidden[2]
    for assumed in (hidden[:1], hidden):
        assert not follows_from(needed, *(ge(letter, 1) for letter in assumed))
    assert not follows_from(needed, ForAll((y,), ge(y + hidden[0], 2 + y)))
    assert not entailed(needed, Goal("in the statement", ge(hidden[0], 1), (ge(hidden[0], 1),))).shown


def test_nothing_is_told_of_an_arbitrary_value_by_another_that_is_being_looked_at():
    """``along`` asks about a second arbitrary value while the first is being looked at."""
    inner = []

    def along(inside, point):
        inner.append(entailed(ForAll((x,), ge(x, 0)), inside).shown)
        return []

    needed = ForAll((x,), ge(x, 0), domain=(ge(x, 1),))
    assert entailed(needed, Goal("nested", ge(y**2, 0)), along=along).shown
    assert inner == [False]
