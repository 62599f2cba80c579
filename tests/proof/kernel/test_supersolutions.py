"""Bounds that a function never comes above, by its rate, before Coq's kernel: each with a false twin."""

from __future__ import annotations

from typing import Any

import sympy as sp

from ptproof.proof import ForAll, claim, exact, ge, le, lt
from ptproof.proof.claim import Claim
from tests.proof.kernel.asked import test_what_is_not_true_is_not_confirmed as test_what_is_not_true_is_not_confirmed
from tests.proof.kernel.asked import test_what_is_true_is_confirmed as test_what_is_true_is_confirmed

s, t, p = sp.symbols("s t p", real=True)
a, b, k = sp.symbols("a b k", positive=True)
Y = sp.Function("Y", real=True)
U = sp.Function("U", nonnegative=True)


def stated(id: str, statement: Any, **options: Any) -> Claim:
    return claim(id, id, statement, **options)(exact)


def rate(function: Any, right: Any, end: Any = t) -> list[Any]:
    inside = (ge(s, p), le(s, end))
    return [ge(end, p), ForAll([s], le(sp.Derivative(function(s), s), right), inside)]


FILTER = [le(Y(p), b), *rate(Y, (b - Y(s)) / k)]
ROOTS = [ForAll([s], ge(U(s), 0)), *rate(U, 2 * a * sp.sqrt(U(s)) - 2 * k * U(s))]
CLIPPED = p + a * (1 - b)
FADING = [lt(b, 1), *rate(Y, -k * Y(s) / (1 - (s - p) / a) ** 2, CLIPPED)]
EARLY = [ForAll([s], ge(U(s), 0)), ge(p, 0), *rate(U, (b / (1 + s / a) ** 2 - k) * U(s))]
TRUE = [
    stated("filter", le(Y(t), b), given=FILTER),
    stated("roots", le(U(t), (a / k + sp.sqrt(U(p)) * sp.exp(-k * (t - p))) ** 2), given=ROOTS),
    stated("clipped", le(Y(CLIPPED), Y(p) * sp.exp(-k * a * (1 / b - 1))), given=FADING),
    stated("weakened", le(U(t), U(p) * sp.exp(b * a) * sp.exp(-k * (t - p))), given=EARLY),
]
NOT_CONFIRMED = [
    stated("filter-false", le(Y(t), b), given=FILTER[1:]),
    stated("roots-false", le(U(t), (a / k + sp.sqrt(U(p)) * sp.exp(-2 * k * (t - p))) ** 2), given=ROOTS),
    stated("clipped-false", le(Y(CLIPPED), Y(p) * sp.exp(-k * a / b)), given=FADING),
    stated("weakened-false", le(U(t), U(p) * sp.exp(b * a / 2) * sp.exp(-k * (t - p))), given=EARLY),
]
