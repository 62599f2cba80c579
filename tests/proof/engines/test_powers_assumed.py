"""That an assumption speaks of a power with a letter as exponent does not make its base positive."""

import pytest
import sympy as sp

from ptproof.proof import Verdict, claim, eq, ge, gt, reals
from ptproof.proof.deciding import run_one

x, y, p = sp.symbols("x y p", real=True)
q = sp.Symbol("q", positive=True)
n = sp.Symbol("n", integer=True, positive=True)


@pytest.mark.parametrize(
    "given", [eq(y, x ** ((n + 1) / n)), eq(y, x**p), ge(x**q, 1), ge(x**q, y), ge(x ** (-p), y)], ids=str
)
def test_the_base_may_be_negative(given):
    found = run_one(claim("base", "", ge(x, 0), given=[given])(reals))
    assert found.verdict is Verdict.REFUTED, found.detail


@pytest.mark.parametrize("given", [ge(sp.sqrt(x), y), eq(y, x ** sp.Rational(-1, 2)), gt(sp.log(x), 0)], ids=str)
def test_a_root_or_a_logarithm_makes_it_so(given):
    assert run_one(claim("base", "", ge(x, 0), given=[given])(reals)).verdict is Verdict.PROVED


def test_a_power_of_zero_may_be_assumed():
    z = sp.Symbol("z", integer=True)
    found = run_one(claim("zero", "", gt(x**2, 0), given=[ge(x**z, y)])(reals))
    assert found.verdict is not Verdict.PROVED
    assert "shows what is false" not in found.detail
