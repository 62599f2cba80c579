"""Assumptions on several variables at once: what follows from them is shown at one arbitrary value of each."""

from __future__ import annotations

import pytest
import sympy as sp

from ptproof.proof import ForAll, Goal, ge, gt, le
from ptproof.proof.engines.quantified import entailed
from ptproof.proof.statement import Assumption

x, y, a = sp.symbols("x y a", real=True)
F = sp.Function("F", real=True)(x, y)
G = sp.Function("G", real=True)(x, y)
NEEDED = ForAll((x, y), ge(F + G, 0), (gt(x, 0),))

ENTAILED: dict[str, tuple[Assumption, ...]] = {
    "itself": (NEEDED,),
    "two others at the same place": (ForAll((x, y), ge(F, 0)), ForAll((x, y), ge(G, 0))),
    "in the domain only": (ForAll((x, y), ge(F, 1), (ge(x, 0),)), ForAll((x, y), ge(G, -1), (gt(x, -1),))),
    "in other letters": (ForAll((y, x), ge(F + G, 0).map(lambda side: side.subs({x: y, y: x}, simultaneous=True))),),
}
NOT_ENTAILED: dict[str, tuple[Assumption, ...]] = {
    "one of the two": (ForAll((x, y), ge(F, 0)),),
    "on a smaller domain": (ForAll((x, y), ge(F + G, 0), (gt(x, 1),)),),
    "the other direction": (ForAll((x, y), le(F + G, 0)),),
    "with the variables exchanged": (ForAll((y, x), ge(F + G, 0), (gt(y, 0),)),),
    "at a free namesake": (ge(F + G, 0), gt(x, 0)),
    "on one variable": (ForAll((x,), ge(F + G, 0)),),
}  # fmt: skip


@pytest.mark.parametrize("name", ENTAILED)
def test_follows(name: str) -> None:
    assert entailed(NEEDED, Goal("test", ge(a, 0), ENTAILED[name])).shown


@pytest.mark.parametrize("name", NOT_ENTAILED)
def test_does_not_follow(name: str) -> None:
    assert not entailed(NEEDED, Goal("test", ge(a, 0), NOT_ENTAILED[name])).shown
