"""Hints by several steps: each mechanism confirms a true claim, and not its corrupted twin."""

from __future__ import annotations

from typing import Any

import sympy as sp

from ptproof.proof import claim, eq, exact, ge, gt, le, lt
from ptproof.proof.claim import Claim
from ptproof.proof.statement import Exists
from tests.proof.kernel.asked import test_what_is_not_true_is_not_confirmed as test_what_is_not_true_is_not_confirmed
from tests.proof.kernel.asked import test_what_is_true_is_confirmed as test_what_is_true_is_confirmed

x, y, u, v, p, q, r = sp.symbols("x y u v p q r", real=True)
a, b, c, w = sp.symbols("a b c w", positive=True)
n = sp.Symbol("n", integer=True, positive=True)
d = sp.Symbol("d", nonnegative=True)
e = sp.Symbol("e", positive=True)
ESCAPE = (d + c) - w * (a**2 * d * c - b**2 * d * (d + c))
ROOT = sp.sqrt((1 + sp.sin(3 * x)) ** 2 * sp.cos(y) ** 2 + (1 + sp.sin(3 * x)) ** 2 * sp.cos(u * y) ** 2)
FORM = p * x**2 + 2 * q * x * y + r * y**2


def stated(id: str, statement: Any, **options: Any) -> Claim:
    return claim(id, id, statement, **options)(exact)


PAIRS = {
    "cases": (
        stated("cases", eq(1 / sp.Max(a, b), sp.Min(1 / a, 1 / b))),
        stated("cases-false", eq(1 / sp.Max(a, b), sp.Max(1 / a, 1 / b))),
    ),
    "root": (
        stated("root", le(sp.sqrt(x**2 + y**2) / 2, sp.sqrt(x**2 + y**2 + u**2))),
        stated("root-false", le(sp.sqrt(x**2 + y**2) * 2, sp.sqrt(x**2 + y**2 + u**2))),
    ),
    "norm": (
        stated("norm", le((x**2 - y**2) * u + 2 * x * y * v, (x**2 + y**2) * sp.sqrt(u**2 + v**2))),
        stated("norm-false", le((x**2 - y**2) * u + 2 * x * y * v, (x**2 + y**2) * sp.sqrt(u**2 + v**2) / 2)),
    ),
    "multiples": (
        stated("multiples", gt(ESCAPE, 0), given=[lt(w * c * (a - b) ** 2, 1)]),
        stated("multiples-false", gt(ESCAPE, 0)),
    ),
    "form": (
        stated("form", gt(FORM, 0), given=[gt(p, 0), gt(p * r - q**2, 0), gt(x**2 + y**2, 0)]),
        stated("form-false", gt(FORM, 0), given=[gt(p, 0), gt(p * r, 0), gt(x**2 + y**2, 0)]),
    ),
    "half-line": (
        stated("half-line", ge(x**2 * 2 / 3 + sp.cos(x) + y**4, 1)),
        stated("half-line-false", ge(x**2 / 3 + sp.cos(x) + y**4, 1)),
    ),
    "circular": (
        stated("circular", le((2 * x**3 + sp.sin(x)) ** 2, x**2 * (2 * b**2 + 1) ** 2), given=[le(x**2, b**2)]),
        stated("circular-false", le((2 * x**3 + sp.sin(x)) ** 2, x**2 * (2 * b**2) ** 2), given=[le(x**2, b**2)]),
    ),
    "factor": (
        stated("factor", eq(x, 2), given=[eq((x - 2) * a, 0)]),
        stated("factor-false", eq(x, 2), given=[eq((x - 2) * y, 0)]),
    ),
    "witness": (
        stated("witness", Exists((w,), (lt(w, a), lt(b * w, c)))),
        stated("witness-false", Exists((w,), (lt(w, a), gt(w, b)))),
    ),
    "number": (
        stated("number", Exists((w,), (le(x, 1 + w * x**2), le(x**2, w * x**2)), (x,))),
        stated("number-false", Exists((w,), (le(x**4, w * x**2),), (x,))),
    ),
    "grows": (
        stated("grows", eq(sp.Limit(a * (b / e) ** (1 / (2 * n)), e, 0, "+"), sp.oo)),
        stated("grows-false", eq(sp.Limit(a * (b * e) ** (1 / (2 * n)), e, 0, "+"), sp.oo)),
    ),
    "value": (
        stated("value", eq(ROOT, 2 * sp.sqrt(2)), given=[eq(x, sp.pi / 6), eq(y, 0)]),
        stated("value-false", eq(ROOT, 2 * sp.sqrt(2)), given=[eq(x, sp.pi / 2), eq(y, 0)]),
    ),
}  # fmt: skip


TRUE, NOT_CONFIRMED = zip(*PAIRS.values(), strict=True)
EFFORT = "thorough"
