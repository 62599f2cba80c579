"""Smoothness before Coq's kernel: what is so often differentiable is confirmed, its corrupted twin is not."""

from __future__ import annotations

from typing import Any

import pytest
import sympy as sp

from ptproof.proof import claim, ge
from ptproof.proof import smooth as engine
from ptproof.proof.claim import Claim
from ptproof.proof.kernel.terms import NoTranslation
from ptproof.proof.kernel.theorem import proposition
from ptproof.proof.statement import Smooth
from tests.proof.kernel.asked import test_what_is_not_true_is_not_confirmed as test_what_is_not_true_is_not_confirmed
from tests.proof.kernel.asked import test_what_is_true_is_confirmed as test_what_is_true_is_confirmed

x, y, z, t = sp.symbols("x y z t", real=True)
a = sp.Symbol("a", positive=True)
c = sp.Symbol("c", nonnegative=True)
F = sp.Function("F", real=True)


def stated(id: str, expression: sp.Expr, *variables: sp.Symbol, order: int = 2, **options: Any) -> Claim:
    assumed = options.pop("assumed", ())
    return claim(id, id, Smooth((expression,), variables, order, assumed), **options)(engine)


TRUE = [
    stated("polynomial", x**3 * y - x / 2, x, y),
    stated("functions", sp.exp(-a * x) * sp.sin(x * y) + sp.sqrt(1 + x**2) + sp.log(a + y**2), x, y, order=3),
    stated("one-variable", sp.cos(x) / (1 + x**2), x),
    stated("four-variables", x * y * z * t, x, y, z, t),
    stated("composed", F(x / a, sp.sin(x * y)), x, y, assumed=((F(x, y), 2),)),
    stated("of-three", F(x + y, x * y, y), x, y, assumed=((F(x, y, z), 3),)),
    stated("of-one", F(x + y), x, y, assumed=((F(x), 2),)),
    stated("derivative", a * F(x, y).diff(x) + z, x, y, z, order=1, assumed=((F(x, y), 2),)),
    stated("second-derivative", F(x, y).diff(x, y), x, y, order=0, assumed=((F(x, y), 2),)),
    stated("on-a-half-line", 1 / (a + x), x, given=[ge(x, 0)]),
]
NOT_CONFIRMED = [
    stated("corner", sp.Abs(x), x),
    stated("quotient-by-zero", x / y, x, y),
    stated("root-of-zero", sp.sqrt(x**2 + y**2), x, y),
    stated("order", F(x), x, assumed=((F(x), 1),)),
    stated("derivative-order", F(x, y).diff(x), x, y, order=2, assumed=((F(x, y), 2),)),
    stated("nothing-assumed", F(x), x),
    stated("boundary", sp.log(x), x, given=[ge(x, 0)]),
    stated("other-kind", F(x), x, assumed=((F(a), 2),)),
]


def test_what_is_smooth_up_to_a_boundary_only_is_not_assumed_beyond_it() -> None:
    with pytest.raises(NoTranslation):
        proposition(stated("closed", F(c), c, assumed=((F(c), 2),)))
