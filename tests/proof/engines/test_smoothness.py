"""Smoothness: proved with its reasons, refuted with a point, undecided otherwise."""

import pytest
import sympy as sp

from ptproof.proof.engines.smoothness import smoothness
from ptproof.proof.statement import Relation
from ptproof.proof.verdict import Verdict

x, y, tau = sp.symbols("x y tau", real=True)
k = sp.Symbol("k", positive=True)
F = sp.Function("F", real=True)(x, y)

SMOOTH = [
    sp.cos(k * F),
    x**3 + sp.exp(sp.sin(y)),
    sp.sqrt(1 + x**2),
    sp.Abs(x) ** 3,
    x**2 * sp.Abs(x),
    sp.cos(k * sp.Abs(x)),
    sp.sin(k * sp.Abs(x) ** 3) * sp.exp(y),
    1 / (1 + sp.Abs(x) ** 3),
    1 / (1 + x**2 + y**2),
    (x**2 + y**2) ** sp.Rational(3, 2),
    sp.log(2 + sp.sin(x)),
    sp.Max(x, 0) ** 3,
    sp.Piecewise((x**3, x < 0), (x**4, True)),
    x / (x**2 + k),
    sp.Abs(x) ** 3 / (1 + x**2),
    y * sp.Abs(x) ** 3 / (2 + sp.sin(x * y)),
]
NOT_SMOOTH = [
    x * sp.Abs(x),
    1 / x,
    sp.sqrt(x**2 + y**2),
    sp.Max(x, 0) ** 2,
    sp.sqrt(x),
    1 / (1 - tau) ** 2,
    sp.Piecewise((x**2, x < 0), (x**3, True)),
    sp.sign(x),
    sp.sign(x) ** 2 * (1 + x),
    sp.Abs(F),
    1 / F,
    sp.floor(x),
    sp.tan(x),
    1 / (x - y),
    1 / (x**2 - k),
    sp.sin(k * x * sp.Abs(x)),
    x * sp.Abs(x) / (1 + x**2),
    sp.Abs(x) ** 3 / (x**2 + y**2),
    sp.Abs(x) ** 3 / (1 - x),
    sp.Abs(x) ** 3 / (1 + sp.sin(x)),
]


@pytest.mark.parametrize("expression", SMOOTH, ids=str)
def test_smooth_twice(expression: sp.Expr) -> None:
    assert smoothness(expression, [x, y, tau], 2, {F: 2}).verdict is Verdict.PROVED


@pytest.mark.parametrize("expression", NOT_SMOOTH, ids=str)
def test_not_smooth_with_a_witness(expression: sp.Expr) -> None:
    evidence = smoothness(expression, [x, y, tau], 2, {F: 2})
    assert evidence.verdict is Verdict.REFUTED
    assert evidence.witness is not None


def test_a_derivative_costs_an_order() -> None:
    assert smoothness(sp.diff(F, x), [x, y], 2, {F: 2}).verdict is Verdict.UNDECIDED
    assert smoothness(sp.diff(F, x), [x, y], 2, {F: 3}).verdict is Verdict.PROVED


def test_a_function_without_assumption_is_undecided() -> None:
    assert smoothness(F, [x, y], 0).verdict is Verdict.UNDECIDED


def test_order_decides() -> None:
    assert smoothness(x * sp.Abs(x), [x], 1).verdict is Verdict.PROVED
    assert smoothness(sp.Abs(x), [x], 0).verdict is Verdict.PROVED
    assert smoothness(sp.Abs(x), [x], 1).verdict is Verdict.REFUTED


def test_the_domain_decides() -> None:
    gain = 1 / (1 + tau) ** 2
    assert smoothness(gain, [tau], 2).verdict is Verdict.REFUTED
    assert smoothness(gain, [tau], 2, domain=[Relation(sp.S.Zero, "<=", tau)]).verdict is Verdict.PROVED


def test_a_kink_on_the_boundary_is_no_witness() -> None:
    assert smoothness(sp.Abs(x), [x], 1, domain=[Relation(sp.S.Zero, "<=", x)]).verdict is not Verdict.REFUTED


def test_a_pole_outside_the_domain_is_no_witness() -> None:
    box = [Relation(sp.S.One, "<=", x), Relation(x, "<=", sp.Integer(3))]
    assert smoothness(1 / x, [x], 2, domain=box).verdict is Verdict.PROVED
    assert smoothness(sp.sqrt(x), [x], 2, domain=box).verdict is Verdict.PROVED
    assert smoothness(1 / (x - 2), [x], 2, domain=box).verdict is Verdict.REFUTED


def test_a_removable_singularity_is_undecided_not_refuted() -> None:
    assert smoothness(sp.sin(x) / x, [x], 2).verdict is Verdict.UNDECIDED


@pytest.mark.parametrize("expression", [sp.cos(sp.Abs(x) / x), sp.cos(sp.Abs(x) * sp.log(y))], ids=str)
def test_where_it_is_not_defined_it_is_not_smooth(expression: sp.Expr) -> None:
    assert smoothness(expression, [x, y], 2).verdict is not Verdict.PROVED


def test_two_kinks_that_cancel_are_never_refuted() -> None:
    assert smoothness(sp.Abs(x) - sp.Max(x, -x), [x], 2).verdict is not Verdict.REFUTED
