"""A limit asks nothing of places that are not near enough: no value there is no hit."""

import pytest
import sympy as sp

from ptproof.proof import claim, eq, exact
from ptproof.proof.attack import attack

v = sp.Symbol("v", real=True)
k = sp.Symbol("k", positive=True)


@pytest.mark.parametrize(
    "expression",
    [1 / sp.sqrt(v / 10**9 - 1), sp.log(1 + 1 / (v - 10**30)), sp.exp(-k * sp.sqrt(v - 10**40)), 1 / (v - 10**8)],
)
def test_what_is_real_only_far_away_is_not_hit(expression):
    assert attack(claim("limit", "", eq(sp.Limit(expression, v, sp.oo), 0))(exact).goal()).hit is None


def test_a_wrong_limit_is_hit():
    assert attack(claim("limit", "", eq(sp.Limit(1 / v, v, sp.oo), 1))(exact).goal()).hit is not None
