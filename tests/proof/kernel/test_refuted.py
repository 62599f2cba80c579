"""Goals by contradiction before Coq's kernel: each with a false twin."""

from __future__ import annotations

from typing import Any

import pytest
import sympy as sp

from ptproof.proof import claim, eq, exact, ge, gt, le
from ptproof.proof.claim import Claim
from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.needed import needed
from ptproof.proof.kernel.hints.positivstellensatz import Product, Sign, contradiction
from ptproof.proof.kernel.hints.slack import slackened
from ptproof.proof.statement import Relation
from tests.proof.kernel.asked import test_what_is_not_true_is_not_confirmed as test_what_is_not_true_is_not_confirmed
from tests.proof.kernel.asked import test_what_is_true_is_confirmed as test_what_is_true_is_confirmed

x, y, s, t, p, v, w = sp.symbols("x y s t p v w", real=True)
a, b, k, r = sp.symbols("a b k r", positive=True)
n = sp.Symbol("n", positive=True, integer=True)
m = sp.Symbol("m", nonnegative=True)
F, G = (sp.Function(name, real=True) for name in "FG")
EFFORT = "thorough"


def stated(id: str, statement: Any, **options: Any) -> Claim:
    return claim(id, id, statement, **options)(exact)


BELOW_A_LINE = 1 + (t - p) / k
BASE = x - y
POWERS = [ge(BASE, 0), le(v, -k * w**2), le(b * BASE ** ((2 * n - 1) / (2 * n)) / a, w), gt(x, p)]
VALUES = [eq(F(t), 0), eq(G(t), 0), le(v, a * sp.sqrt(F(t) ** 2 + G(t) ** 2) - k)]
PRODUCTS = [le(v, -(x**2) - y**2), le(p, 1), ge(p, -1), le(w, 1), ge(w, -1)]
CROSSED = 2 * s * (p * x + w * y) + v * k
FORM = ge(v * x**2 + 2 * p * x * y + w * y**2, 0)
ENDS = [ge(v, 0), ge(v * w - p**2, 0), ge(w, 0)]
BELOW_BY_A_PRODUCT = ge(m / (x + y), 0)
EARLY, LATE = 1 + (t - p) / k, 1 + (t - s) / k
FALLING = [le(v, -r * (1 - 1 / EARLY**2) * x**2), le(w**2, x**2), ge(t, s), ge(s, p)]
LATER = le(v, -r * (1 - 1 / LATE**2) * w**2)
TRUE = [
    stated("quotient", le(x / BELOW_A_LINE, x), given=[ge(t, p), ge(x, 0)]),
    stated("not-zero", Relation(BELOW_A_LINE, "!=", 0), given=[ge(t, p)]),
    stated("powers", le(v, -k * b**2 * BASE ** ((2 * n - 1) / n) / a**2), given=POWERS),
    stated("values", le(v, -k), given=VALUES),
    stated("products", le(CROSSED, 4 * s**2 / k - k * (x**2 + y**2) / 2), given=PRODUCTS),
    stated("form", FORM, given=ENDS),
    stated("below-by-a-product", BELOW_BY_A_PRODUCT, given=[gt(x, 0), gt(x * y, v**2)]),
    stated("in-order", LATER, given=FALLING),
]
NOT_CONFIRMED = [
    stated("quotient-false", le(x / BELOW_A_LINE, x / 2), given=[ge(t, p), ge(x, 0)]),
    stated("not-zero-false", Relation(BELOW_A_LINE, "!=", 0), given=[le(t, p)]),
    stated("powers-false", le(v, -2 * k * b**2 * BASE ** ((2 * n - 1) / n) / a**2), given=POWERS),
    stated("values-false", le(v, -k), given=VALUES[1:]),
    stated("products-false", le(CROSSED, 3 * s**2 / k - k * (x**2 + y**2) / 2), given=PRODUCTS),
    stated("form-false", FORM, given=ENDS[:2]),
    stated("below-by-a-product-false", BELOW_BY_A_PRODUCT, given=[gt(x, 0), gt(x * y, -(v**2))]),
    stated("in-order-false", LATER, given=[*FALLING[:3], ge(p, s)]),
]


def test_a_variable_is_its_lower_bound_and_what_is_above() -> None:
    names = {symbol: symbol.name for symbol in (t, s, p, n, a)}
    goal = Goal(ge(a * t**2, a * p * t), (ge(t, s), gt(s, p), ge(n, 2)), names)
    lines, loose = slackened(goal)
    assert lines == ["at_least t s gap0", "above s p gap1"]
    first, second = (symbol for symbol in loose.names if str(symbol).startswith("gap"))
    assert (first.is_nonnegative, first.is_positive, second.is_positive) == (True, None, True)
    assert sp.expand(loose.relation.left - a * (p + first + second) ** 2) == 0
    assert loose.known == (ge(n, 2),)


def test_a_variable_in_an_exponent_stays() -> None:
    goal = Goal(ge(a**t, a), (ge(t, s),), {symbol: symbol.name for symbol in (t, s, a)})
    assert slackened(goal) == ([], goal)


def test_what_is_needed_is_little() -> None:
    known = [ge(x, 1), ge(y, 2), ge(v, x), le(w, 0), ge(x**2, 1)]
    assert needed(ge(v, 0), known) == (ge(x, 1), ge(v, x))
    assert needed(le(v, 0), known) is None


def weighted(products: tuple[Product, ...]) -> bool:
    """Whether weights make the sum of the products vanish, exactly: positive ones, but for those that are 0."""
    polynomials = [
        sp.expand(sp.Mul(*item.symbols, *(factor.polynomial for factor in item.factors))) for item in products
    ]
    weights = sp.symbols(f"c:{len(products)}", real=True)
    total = sp.expand(sum(c * item for c, item in zip(weights, polynomials, strict=True)))
    symbols = sorted(set().union(*(item.free_symbols for item in polynomials)), key=str)
    (solution,) = sp.solve([*sp.Poly(total, *symbols).coeffs(), sum(weights) - 1], weights, dict=True)
    signs = [item.sign for item in products]
    return ">" in signs and all(solution[c] > 0 for c, sign in zip(weights, signs, strict=True) if sign != "=")


@pytest.mark.parametrize(
    ("known", "denied"),
    [
        ([Sign(1 - x**2 - y**2, ">=")], Sign(x * y - 1, ">")),
        ([Sign(-v - k * w**2, ">="), Sign(w - b * r, ">=")], Sign(v + k * b**2 * r**2, ">")),
        ([Sign(x - 1, ">="), Sign(y - x, "=")], Sign(-y, ">=")),
    ],
)
def test_a_contradiction_adds_up(known: list[Sign], denied: Sign) -> None:
    found = contradiction(known, denied)
    assert found
    assert weighted(found)


@pytest.mark.parametrize(
    ("known", "denied"),
    [
        ([Sign(1 - x**2 - y**2, ">=")], Sign(2 * x * y - 1, ">=")),
        ([Sign(x - 1, ">="), Sign(y - x, "=")], Sign(y - 1, ">=")),
        ([], Sign(m, ">=")),
    ],
)
def test_what_can_hold_together_is_no_contradiction(known: list[Sign], denied: Sign) -> None:
    assert contradiction(known, denied) is None
