"""Functions that satisfy a differential inequality: with what drives them, and without it where that may be less."""

import pytest
import sympy as sp

from ptproof.proof import eq, le
from ptproof.proof.attack.functions import solutions
from ptproof.proof.statement import ForAll

s = sp.Symbol("s", real=True)
b, k, m = sp.symbols("b k m", positive=True)
V = sp.Function("V", positive=True)
RIGHT = b / (1 + s**2) - k * V(s) ** (2 * m + 1)


@pytest.mark.parametrize("right", [RIGHT, RIGHT - b * s, b / (1 + s**2) - k * V(s)])
def test_an_inequality_may_leave_out_what_drives_it(right):
    bodies = [concrete.body for _, concrete in solutions(ForAll((s,), le(sp.Derivative(V(s), s), right)))]
    assert any(not body.has(b) and body.has(k) for body in bodies)


def test_an_equation_may_not():
    found = solutions(ForAll((s,), eq(sp.Derivative(V(s), s), RIGHT)))
    assert all(concrete.body.has(b) for _, concrete in found)
