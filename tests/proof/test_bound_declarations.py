"""What a bound variable is declared to be says nothing of the point at which it is taken."""

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.proof import Verdict, claim, exact
from ptproof.proof.deciding import run_one
from ptproof.proof.definedness import obligations
from ptproof.proof.statement import eq

s, y = sp.symbols("s y", real=True)
T = sp.Symbol("T", positive=True)


def test_at_a_point_of_another_kind_it_may_be_undefined():
    found = run_one(claim("subs", "", eq(sp.Subs(1 - T / s, T, s), 0))(exact))
    assert found.verdict is Verdict.UNDECIDED
    assert found.detail.startswith("not shown to be defined")


@pytest.mark.parametrize("inside", [1 / T, sp.log(T), sp.sqrt(T), T ** sp.Rational(-1, 2)])
def test_the_obligation_stands(inside):
    assert any(not need.settled for need in obligations(sp.Subs(inside, T, y)))


def test_at_a_point_of_its_kind_it_is_defined():
    found = run_one(claim("subs", "", eq(sp.Subs(1 / T, T, sp.exp(y)), sp.exp(-y)))(exact))
    assert found.verdict is Verdict.PROVED, found.detail


@pytest.mark.parametrize("inside", [sp.Subs(s**4, s**2, s**2), sp.Subs(sp.cos(s), sp.cos(s), 2)])
def test_a_value_is_put_in_place_of_a_symbol_only(inside: sp.Expr) -> None:
    with pytest.raises(InputError, match="only a symbol"):
        eq(inside, 0)
