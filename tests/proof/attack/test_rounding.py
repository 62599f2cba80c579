"""Where a value is 0 exactly, what is left of it in numbers is rounding and no jump."""

import pytest
import sympy as sp

from ptproof.proof.attack import attack
from ptproof.proof.claim import Goal
from ptproof.proof.statement import Smooth

t, x, y = sp.symbols("t x y", real=True)


@pytest.mark.parametrize("expression", [
    -y / 100 + (1 + sp.sin(3 * t)) * sp.cos(x), y - sp.exp(x) * sp.cos(t), y - x * sp.sin(t), y**3 - sp.cos(x + t),
])  # fmt: skip
def test_a_smooth_expression_is_not_hit_where_it_vanishes(expression):
    for seed in range(3):
        assert attack(Goal("rounding", Smooth((expression,), (t, x, y), 2)), seed=seed).hit is None


def test_a_jump_is_hit_all_the_same():
    step = sp.Piecewise((0, y < x), (sp.Rational(1, 10**6), True))
    assert attack(Goal("jump", Smooth((step,), (x, y), 0))).hit is not None
