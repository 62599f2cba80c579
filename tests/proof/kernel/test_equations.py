"""Integrals of waves, equations by others, squares and parts that grow before Coq's kernel: each with a false twin."""

from __future__ import annotations

from typing import Any

import sympy as sp

from ptproof.proof import claim, eq, exact, ge, gt, le, lt
from ptproof.proof.claim import Claim
from tests.proof.kernel.asked import test_what_is_not_true_is_not_confirmed as test_what_is_not_true_is_not_confirmed
from tests.proof.kernel.asked import test_what_is_true_is_confirmed as test_what_is_true_is_confirmed

x, y, u, v, q = sp.symbols("x y u v q", real=True)
a, b, w = sp.symbols("a b w", positive=True)
c, d = sp.symbols("c d", nonnegative=True)
PERIOD = 2 * sp.pi / w


def stated(id: str, statement: Any, **options: Any) -> Claim:
    return claim(id, id, statement, **options)(exact)


def double(outer: sp.Expr, inner: sp.Expr) -> sp.Expr:
    """The integral of both over a period, the inner one up to the outer variable."""
    return sp.Integral(outer.subs(x, w * u) * inner.subs(x, w * v), (v, 0, u), (u, 0, PERIOD))


def triple(*waves: sp.Expr) -> sp.Expr:
    """The same of three, the outermost first."""
    first, second, third = (wave.subs(x, w * at) for wave, at in zip(waves, (y, u, v), strict=True))
    return sp.Integral(first * second * third, (v, 0, u), (u, 0, y), (y, 0, PERIOD))


FORM = 1 + a * x**2 + x * y + (1 + 1 / a) * y**2
# The derivative of ln FORM along x' = y, y' = -x.
ALONG = (sp.diff(FORM, x) * y - sp.diff(FORM, y) * x) / FORM
SINE, COSINE, DOUBLE = sp.sin(x), sp.cos(x), sp.cos(2 * x)
ROOT = sp.sqrt(a**2 / 4 - b)
SHIFTED = sp.sin(w * (x + PERIOD)) + sp.cos(3 * w * (x + PERIOD))
POSITIVE = 2 * a * x**2 + 2 * a * x * y + a * y**2 + b
GIVEN_ROOT = [ge(a**2 / 4 - b, 0), eq(u, a / 2 + ROOT)]
PRODUCT = [eq(u, v**2 / (2 * b))]
EXPANDED = sp.exp(2 * x) * sp.exp(-x)
SUM = c**2 * (a + b * sp.exp(x)), (c + sp.Abs(x)) ** 2 * (a + b * sp.exp(c + sp.Abs(x)))
GROWN = tuple(4 * a * value**2 * (b + w * sp.exp(2 * value)) for value in (c, d))
NORM = [eq(d**2, c**2 + x**2)]

PAIRS = {
    "triple-integral": (
        w**a * triple(SINE, COSINE, SINE), 2 * sp.pi * w ** (a - 3), 2 * sp.pi * w ** (a - 2),
    ),
    "period": (SHIFTED, sp.sin(w * x) + sp.cos(3 * w * x), sp.sin(w * x) + sp.cos(2 * w * x)),
    "exponentials": (EXPANDED + 1, sp.exp(x) + 1, sp.exp(2 * x) + 1),
}  # fmt: skip
TRUE = [stated(name, eq(left, right)) for name, (left, right, _) in PAIRS.items()]
NOT_CONFIRMED = [stated(f"{name}-false", eq(left, wrong)) for name, (left, _, wrong) in PAIRS.items()]
TRUE += [
    stated("double-integral", eq(double(COSINE, SINE) + double(DOUBLE, SINE), -PERIOD / (2 * w))),
    stated("root-of-polynomial", eq(u**2 - a * u + b, 0), given=GIVEN_ROOT),
    stated("one-equation", eq((b * u - v**2 / 2) * sp.exp(x) + x, x), given=PRODUCT),
    stated("squares", gt(POSITIVE, 0)),
    stated("along", eq(ALONG, (2 * a - 2 - 2 / a) * x * y / FORM + (y**2 - x**2) / FORM)),
    stated("squares-of-both", le(c + sp.Abs(x), 2 * d), given=NORM),
    stated("exponential", ge(sp.exp(x) - x - 1, sp.Abs(x) - 1)),
    stated("logarithm", eq(sp.Limit(sp.log(1 + a * w), w, sp.oo), sp.oo)),
    stated("parts", le(*SUM)),
    stated("parts-strictly", lt(*GROWN), given=[lt(c, d)]),
]
NOT_CONFIRMED += [
    stated("double-integral-false", eq(double(COSINE, SINE), PERIOD / (2 * w))),
    stated("root-of-polynomial-false", eq(u**2 - a * u + 2 * b, 0), given=GIVEN_ROOT),
    stated("one-equation-false", eq((b * u - v**2) * sp.exp(x) + x, x), given=PRODUCT),
    stated("squares-false", gt(POSITIVE - a * y**2, 0)),
    stated("along-false", eq(ALONG, (2 * a - 2 / a) * x * y / FORM + (y**2 - x**2) / FORM)),
    stated("squares-of-both-false", le(c + sp.Abs(x), d), given=NORM),
    stated("exponential-false", ge(sp.exp(x) - 2 * x - 1, sp.Abs(x) - 1)),
    stated("logarithm-false", eq(sp.Limit(sp.log(1 + a / w), w, sp.oo), sp.oo)),
    stated("parts-false", le(*reversed(SUM))),
    stated("parts-strictly-false", lt(*GROWN), given=[le(c, d)]),
]
