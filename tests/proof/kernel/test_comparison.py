"""Chains of inequalities and differential inequalities before Coq's kernel: each with a twin that is false."""

from __future__ import annotations

from typing import Any

import pytest
import sympy as sp

from ptproof.proof import ForAll, claim, eq, exact, ge, le
from ptproof.proof.claim import Claim
from ptproof.proof.kernel.hints.bernoulli import rated
from ptproof.proof.kernel.hints.bernoulli import rooted as rooted_bound
from ptproof.proof.kernel.hints.comparisons import compared
from ptproof.proof.kernel.theorem import proposition
from ptproof.proof.statement import Relation
from tests.proof.kernel.asked import test_what_is_not_true_is_not_confirmed as test_what_is_not_true_is_not_confirmed
from tests.proof.kernel.asked import test_what_is_true_is_confirmed as test_what_is_true_is_confirmed

s, t, p, v = sp.symbols("s t p v", real=True)
a, b, c, g, r = sp.symbols("a b c g r", positive=True)
z, w = sp.symbols("z w", nonnegative=True)
n = sp.Symbol("n", integer=True, positive=True)
U = sp.Function("U", nonnegative=True)
V = sp.Function("V", positive=True)
Y = sp.Function("Y", real=True)


def stated(id: str, statement: Any, **options: Any) -> Claim:
    return claim(id, id, statement, **options)(exact)


def rate(function: Any, right: Any) -> list[Any]:
    return [ge(t, p), ForAll([s], le(sp.Derivative(function(s), s), right), [ge(s, p), le(s, t)])]


CHAIN = [le(v, -(g**2)), le(b * r ** (2 * n - 1), g), le(c, a * r ** (2 * n))]
POWER = (2 * n - 1) / n
ROOT = [ge(r, (z / a) ** (1 / (2 * n - 1))), le(v, z - a * r ** (2 * n - 1))]
LEVEL = (z / c) ** (1 / (2 * n + 1))
BERNOULLI = [*rate(U, z - c * U(s) ** (2 * n + 1))]
FADING = z / (1 + (s - p) / r) ** 2
SIGMA = n / (n + 1)
SAVED = a * (1 - 1 / (1 + (s - p) / r) ** 2)
TIMED = [*rate(Y, -SAVED * Y(s) ** (1 + SIGMA)), ForAll([s], ge(Y(s), 0))]
PASSED = a * (t - p) ** 2 / (r + t - p)
Q = (2 * n + 1) / (2 * n + 2)
ROOTED = rate(U, -(2 * n + 2) * c * U(s) ** (2 * Q))


def timed(paid: sp.Expr) -> Any:
    return le(Y(t), Y(p) * (1 + SIGMA * Y(p) ** SIGMA * paid) ** (-1 / SIGMA))


def rooted(speed: sp.Expr) -> Any:
    start = U(p) ** (1 / (2 * n + 2))
    return le(U(t), (start * (1 + 2 * n * speed * start ** (2 * n) * (t - p)) ** (-1 / (2 * n))) ** (2 * n + 2))


EFFORT = "thorough"
TRUE = [
    stated("chain", le(v, -(b**2) * (c / a) ** POWER), given=CHAIN),
    stated("value", le(v, b**2 * z), given=[eq(z, a**2), le(v, g**2 * a**2), le(g, b)]),
    stated("raised", le(v, 0), given=ROOT),
    stated("raised-from-0", le(v, 0), given=[item.map(lambda side: side.subs(r, w)) for item in ROOT]),
    stated("integral", le(Y(t), Y(p) + a * (t - p)), given=rate(Y, a)),
    stated("exponential", le(Y(t), Y(p) * sp.exp(-a * (t - p))), given=rate(Y, -a * Y(s))),
    stated("decay", le(U(t), z / a + U(p) * sp.exp(-a * (t - p))), given=rate(U, z - a * U(s))),
    stated("greatest", le(U(t), z / a + U(p) * sp.exp(-a * (t - p))), given=rate(U, FADING - a * U(s))),
    stated("bernoulli", le(U(t), LEVEL + U(p) * (1 + 2 * n * c * U(p) ** (2 * n) * (t - p)) ** (-1 / (2 * n))),
           given=BERNOULLI),
    stated("bernoulli-in-time", timed(PASSED), given=TIMED),
]  # fmt: skip
NOT_CONFIRMED = [
    stated("chain-factor", le(v, -2 * (b**2) * (c / a) ** POWER), given=CHAIN),
    stated("value-without", le(v, b**2 * z), given=[le(z, a**2), le(v, g**2 * a**2), le(g, b)]),
    stated("raised-too-far", le(v, -a), given=ROOT),
    stated("integral-backwards", le(Y(p), Y(t) + a * (t - p)), given=rate(Y, a)),
    stated("exponential-faster", le(Y(t), Y(p) * sp.exp(-2 * a * (t - p))), given=rate(Y, -a * Y(s))),
    stated("decay-level", le(U(t), z / (2 * a) + U(p) * sp.exp(-a * (t - p))), given=rate(U, z - a * U(s))),
    stated("greatest-at-the-end", le(U(t), z / a + U(p) * sp.exp(-a * (t - p))),
           given=rate(U, z * (1 + s - p) - a * U(s))),
    stated("bernoulli-faster", le(U(t), LEVEL + U(p) * (1 + 4 * n * c * U(p) ** (2 * n) * (t - p)) ** (-1 / (2 * n))),
           given=BERNOULLI),
    stated("before-the-start", le(Y(t), Y(p) + a * (t - p)), given=rate(Y, a)[1:]),
]  # fmt: skip


@pytest.mark.parametrize(
    ("bound", "better", "given"), [(timed(PASSED), timed(2 * PASSED), TIMED), (rooted(c), rooted(2 * c), ROOTED)]
)
def test_a_bound_is_derived_as_it_is_claimed(bound: Relation, better: Relation, given: list[Any]) -> None:
    said = proposition(stated("derived", bound, given=given))
    found = [relation for relation, _ in compared(said.claim, [ge(t, p)], said.names, (rated, rooted_bound))]
    assert bound in found
    assert better not in found
