"""Smoothness is attacked on all sides of exact points."""

from __future__ import annotations

import pytest
import sympy as sp

from ptproof.proof import Goal, ge
from ptproof.proof.attack import attack
from ptproof.proof.statement import Assumption, Smooth

x, y = sp.symbols("x y", real=True)
p = sp.Symbol("p", positive=True)
F = sp.Function("F", real=True)(x)
ROUGH: dict[str, tuple[Smooth, list[Assumption]]] = {
    "a kink": (Smooth((sp.Abs(x),), (x,), 1), []),
    "a kink in the second derivative": (Smooth((x * sp.Abs(x),), (x,), 2), []),
    "a jump": (Smooth((sp.sign(x - 1),), (x,), 0), []),
    "a cone": (Smooth((sp.sqrt(x**2 + y**2),), (x, y), 1), []),
    "a root at the end of the domain": (Smooth((x ** sp.Rational(3, 4),), (x,), 1), [ge(x, 0)]),
    "a logarithm that grows": (Smooth((x * sp.log(sp.Abs(x) + x**2),), (x,), 1), []),
    "a denominator": (Smooth((1 / (x - y),), (x, y), 0), []),
    "a switch": (Smooth((sp.Piecewise((0, x < 1), ((x - 1) ** 2, True)),), (x,), 2), []),
    "two equal arguments": (Smooth((sp.Max(x, y) ** 2,), (x, y), 1), []),
    "the second of two": (Smooth((x**2, sp.Abs(x) ** 3), (x,), 3), []),
    "a function that is assumed less smooth": (Smooth((F**2,), (x,), 2, ((F, 1),)), []),
}
SMOOTH: dict[str, tuple[Smooth, list[Assumption]]] = {
    "once": (Smooth((x * sp.Abs(x),), (x,), 1), []),
    "twice": (Smooth((sp.Abs(x) ** 3,), (x,), 2), []),
    "continuous": (Smooth((sp.sqrt(x**2 + y**2),), (x, y), 0), []),
    "a root": (Smooth((x ** sp.Rational(3, 2),), (x,), 1), [ge(x, 0)]),
    "a denominator that is positive": (Smooth((1 / (1 + (x - y) / p),), (x, y), 2), [ge(x, y)]),
    "a function that is assumed smooth enough": (Smooth((F**2,), (x,), 2, ((F, 2),)), []),
    "a jump times what vanishes": (Smooth((x**3 * sp.sign(x),), (x,), 2), []),
}


@pytest.mark.parametrize("name", ROUGH)
def test_hits_what_is_rough(name: str) -> None:
    statement, assumptions = ROUGH[name]
    assert attack(Goal(name, statement, tuple(assumptions))).hit is not None


@pytest.mark.parametrize("name", SMOOTH)
def test_hits_nothing_smooth(name: str) -> None:
    statement, assumptions = SMOOTH[name]
    done = attack(Goal(name, statement, tuple(assumptions)))
    assert done.hit is None
    assert done.points
