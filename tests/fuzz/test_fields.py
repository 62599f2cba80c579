"""Certified constants of fields: quotients at random points lie within them."""

from __future__ import annotations

import math
from typing import Any

import hypothesis.strategies as st
import sympy as sp
from hypothesis import event, given

from ptproof.certify import certify_field
from ptproof.errors import InputError
from ptproof.proof.verdict import Verdict
from tests.fuzz import oracle, trees
from tests.fuzz.oracle import MP
from tests.fuzz.sizes import fuzz, or_nothing

X, Y = trees.x, trees.y
SECONDS = 1.0
parts = st.sampled_from(
    [X**2, Y**2, X * Y, X**4, Y**4, X**2 * Y**2, X**3, sp.cos(X) - 1, sp.cos(2 * Y) - 1,
    sp.exp(-(X**2) - Y**2) - 1, sp.sin(X) ** 2,
     sp.log(1 + X**2), sp.sqrt(1 + Y**2) - 1, (X**2 + Y**2) ** 2, sp.Abs(X) * X**2, sp.sin(X * Y), sp.Max(X,
     Y) ** 2, X * sp.Abs(Y),
     sp.Piecewise((X**2, X > 0), (2 * X**2, True)), X**2 * sp.atan(Y), sp.Piecewise((Y**2, Y < 1), (2 * Y**2,
     True)),
     (X**2 + Y**2) * sp.Piecewise((0, Y < 1), (1, True)), (X**2 + Y**2) * sp.floor(X),
     (X**2 + Y**2) * sp.sign(X - 1)]
)  # fmt: skip
coefficients = st.sampled_from([sp.Rational(k, 4) for k in (-3, -2, -1, 1, 2)])
fields = st.builds(
    lambda k, terms: 3 - (X**2 + Y**2) ** k + sum((c * part for c, part in terms), sp.S.Zero),
    st.sampled_from([1, 1, 1, 2]), st.lists(st.tuples(coefficients, parts), max_size=2),
)  # fmt: skip
domains = st.sampled_from(
    [{"radius": sp.S.Half}, {"radius": sp.Integer(2)}, {"annulus": (sp.Rational(1, 2), sp.Integer(3))}, {},
    {"radius": sp.Integer(5)}]
)  # fmt: skip


@given(fields, st.sampled_from([1, 1, 2]), domains, trees.seeds)
@fuzz(4)
def test_quotients_lie_within_certified_constants(field: Any, kappa: int, domain: Any, seed: int) -> None:
    try:
        found = or_nothing(20, lambda: certify_field(field, [X, Y], [0, 0], kappa, rtol=0.3, seconds=SECONDS, **domain))
    except InputError:
        return
    if found is None or found.verdict is not Verdict.PROVED:
        return
    event("answered")
    low, high = domain.get("annulus", (sp.Rational(1, 1000), domain.get("radius", sp.Integer(30))))
    peak = oracle.value(field, {X: sp.S.Zero, Y: sp.S.Zero})
    slack = 1 + MP.mpf(10) ** -9
    for k in range(40):
        r = low + (high - low) * sp.Rational(seed * (k + 3) % 101, 101) * (sp.S.One if k % 2 else sp.Rational(1, 10))
        angle = 2 * math.pi * ((seed % 97) / 97 + k / 40)
        point = {
            X: r * sp.Rational(round(math.cos(angle) * 10**6), 10**6),
            Y: r * sp.Rational(round(math.sin(angle) * 10**6), 10**6),
        }
        size = oracle.value(sp.sqrt(point[X] ** 2 + point[Y] ** 2), {})
        if not low <= size <= high:
            continue
        try:
            drop = (peak - oracle.value(field, point)) / size ** (2 * kappa)
            slope = _slope(field, point) / size ** (2 * kappa - 1)
        except oracle.NoValue:
            continue
        assert found.a2.lower / slack <= drop <= found.a1.upper * slack, f"{field}, drop at {point}"
        assert found.b1.lower / slack <= slope <= found.b2.upper * slack, f"{field}, slope at {point}"


def _slope(field: Any, point: Any) -> Any:
    h = sp.Rational(1, 10**20)
    squares = MP.mpf(0)
    for symbol in (X, Y):
        ahead, behind = (oracle.value(field, point | {symbol: point[symbol] + sign * h}) for sign in (1, -1))
        squares += ((ahead - behind) * 10**20 / 2) ** 2
    return MP.sqrt(squares)
