"""What fuzzing found in the engines and commands, each as the smallest case; one that is not mended yet says so."""

from __future__ import annotations

from typing import Any

import pytest
import sympy as sp

from ptproof.certify import certify_field
from ptproof.errors import InputError
from ptproof.proof.claim import Goal
from ptproof.proof.engines.evaluation import definite
from ptproof.proof.engines.integrals import integrals
from ptproof.proof.engines.limits import limit_of
from ptproof.proof.statement import eq
from ptproof.proof.verdict import Verdict
from ptproof.transforms.clocks.made import clock_from_formula

x, y = sp.symbols("x y", real=True)
p = sp.Symbol("p", positive=True)


def test_nothing_is_shown_of_a_divergent_integral() -> None:
    statement = eq(1 / sp.Integral(1, (x, 0, sp.oo)), 0)
    assert integrals(Goal("divergent", statement)).verdict is Verdict.UNDECIDED


@pytest.mark.parametrize("integrand", [sp.sin(x), x * sp.exp(x)])
def test_an_integral_from_minus_infinity_is_a_number_or_none(integrand: Any) -> None:
    found = definite(sp.Integral(integrand, (x, -sp.oo, 0)))
    assert found is None or (found.is_finite and not found.has(sp.nan, sp.AccumBounds))


@pytest.mark.parametrize("expression", [sp.sqrt(x), x ** sp.Rational(3, 2), x**p])
def test_no_limit_from_a_side_on_which_there_is_no_value(expression: Any) -> None:
    assert limit_of(expression, x, sp.S.Zero, "-") is None


def test_a_field_with_a_kink_is_undecided() -> None:
    field = sp.Abs(x) * x**2 / 4 - x**2 - y**2 + 3
    found = certify_field(field, [x, y], [0, 0], 2, annulus=(sp.Rational(1, 2), 3), rtol=0.3, seconds=1)
    assert found.verdict is not Verdict.PROVED


def test_an_order_beyond_use_is_refused() -> None:
    with pytest.raises(InputError, match="kappa"):
        certify_field("-sqrt(x1**2 + x2**2)", ["x1", "x2"], [0, 0], "10**400", radius="1", seconds=1)


def test_a_clock_whose_times_end_is_not_attacked_beyond_them() -> None:
    t, tau = sp.symbols("t tau", real=True)
    T, a = sp.symbols("T a", positive=True)
    found = clock_from_formula(t, tau, T * t / (T + 2 * t), start=sp.S.Zero, horizon=a, prescribed_time=False)
    assert sp.simplify(found.to_t - T * tau / (T - 2 * tau)) == 0
