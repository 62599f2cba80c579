"""Minima, branches, powers and waves with bounds before Coq's kernel: each with a false twin."""

from __future__ import annotations

from typing import Any

import sympy as sp

from ptproof.proof import claim, eq, exact, ge, gt, le, lt
from ptproof.proof.claim import Claim
from tests.proof.kernel.asked import test_what_is_not_true_is_not_confirmed as test_what_is_not_true_is_not_confirmed
from tests.proof.kernel.asked import test_what_is_true_is_confirmed as test_what_is_true_is_confirmed

t, p, x, y, v = sp.symbols("t p x y v", real=True)
T, c, d = sp.symbols("T c d", positive=True)
n = sp.Symbol("n", positive=True, integer=True)
EFFORT = "thorough"


def stated(id: str, statement: Any, **options: Any) -> Claim:
    return claim(id, id, statement, **options)(exact)


def clipped(above: int) -> Any:
    """1/(1 - (t - p)/T)^2 clipped at 4: as a minimum, and by branches with another value ``above``."""
    rate = T**2 / (T - t + p) ** 2
    return eq(y * sp.Min(4, (1 - (t - p) / T) ** -2), y * sp.Piecewise((rate, t <= p + T / 2), (above, True)))


BEFORE = [ge(t, p), lt(t, p + T)]
MOST = sp.Max(c, 1 - (t - p) / T)
SATURATED = sp.Min(c, sp.Max(-c, x))
NEAR = [le(x, sp.Rational(1, 2)), ge(x, -sp.Rational(1, 2))]
WAVES = (sp.sin(3 * t) + 1) * sp.cos(x)
ROOT = sp.sqrt(1 + (t - p) / T)

TRUE = [
    stated("branches", clipped(4), given=BEFORE),
    stated("bounded", le(sp.Abs(x - y) / MOST**2, d / c**2), given=[le(sp.Abs(x - y), d)]),
    stated("settled", eq(v, x / c), given=[eq(v, x / MOST), ge(t, p + T * (1 - c))]),
    stated("saturated", eq(v, x), given=[eq(v, SATURATED), le(x, c), ge(x, -c)]),
    stated("waves", ge(WAVES, 7 * (sp.sin(3 * t) + 1) / 8), given=NEAR),
    stated("powers", gt(d * (1 + 1 / d) ** (2 * n), 1 + d)),
    stated("circle", eq(c * sp.sin(x) ** 2 / (T - t) ** 2 + c * sp.cos(x) ** 2 / (T - t) ** 2, c / (T - t) ** 2),
           given=[lt(t, T)]),
    stated("squares-of-roots", eq(sp.Derivative(1 / ROOT, t), -1 / (2 * T * ROOT**3)), given=[ge(t, p)]),
]  # fmt: skip
NOT_CONFIRMED = [
    stated("branches-false", clipped(5), given=BEFORE),
    stated("bounded-false", le(sp.Abs(x - y) / MOST**2, d / (2 * c**2)), given=[le(sp.Abs(x - y), d)]),
    stated("settled-false", eq(v, x / c), given=[eq(v, x / MOST), le(t, p + T * (1 - c))]),
    stated("saturated-false", eq(v, x), given=[eq(v, SATURATED), le(x, c), ge(x, -2 * c)]),
    stated("waves-false", ge(WAVES, 9 * (sp.sin(3 * t) + 1) / 10), given=NEAR),
    stated("powers-false", gt(d * (1 + 1 / d) ** (2 * n), 2 + d + 1 / d)),
    stated("circle-false", eq(c * sp.sin(x) ** 2 / (T - t) ** 2 - c * sp.cos(x) ** 2 / (T - t) ** 2, c / (T - t) ** 2),
           given=[lt(t, T)]),
    stated("squares-of-roots-false", eq(sp.Derivative(1 / ROOT, t), -1 / (T * ROOT**3)), given=[ge(t, p)]),
]  # fmt: skip
