"""Assumptions for all values of several variables: which follow from others, each beside twins that do not."""

from __future__ import annotations

import pytest
import sympy as sp

from ptproof.proof import ForAll, Goal, eq, ge
from ptproof.proof.engines.quantified import entailed

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
