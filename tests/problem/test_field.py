"""The field and its bounds: exact, checked at birth, refused with the reason."""

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.problem.field import Field, FieldBounds

x, y = sp.symbols("x y", real=True)
a, b = sp.symbols("a b", positive=True)
order = sp.Symbol("kappa", integer=True, positive=True)


@pytest.mark.parametrize(("kappa", "q", "sigma"), [(1, "1/2", "0"), (2, "3/4", "1/2"), (5, "9/10", "4/5")])
def test_exponents(kappa, q, sigma):
    bounds = FieldBounds(kappa, 3, 2, 1, 4)
    assert (bounds.q, bounds.sigma) == (sp.Rational(q), sp.Rational(sigma))


def test_ratios_divide_gradient_bounds_by_powers_of_field_bounds():
    bounds = FieldBounds(1, 9, 4, 6, 10)
    assert (bounds.c1, bounds.c2) == (2, 5)


def test_symbolic_order_stays_symbolic():
    assert sp.simplify(FieldBounds(order, a, a, b, b).sigma - (1 - 1 / order)) == 0


def test_equal_bounds_are_allowed():
    assert FieldBounds(1, 1, 1, 2, 2).c1 == 2


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((0, 1, 1, 1, 1), "kappa must be a positive integer"),
        ((sp.Rational(3, 2), 1, 1, 1, 1), "kappa must be a positive integer"),
        ((sp.Symbol("k", positive=True), 1, 1, 1, 1), "kappa must be a positive integer"),
        ((1, 1, 2, 1, 1), "a2 must not exceed a1"),
        ((1, 1, 1, 3, 2), "b1 must not exceed b2"),
        ((1, a, a + b, 1, 1), "a2 must not exceed a1"),
        ((1, sp.sqrt(2), sp.Rational(141422, 100000), 1, 1), "a2 must not exceed a1"),
        ((1, 1, -1, 1, 1), "a2 must be a positive"),
        ((1, 1, 1, 0, 1), "b1 must be a positive"),
        ((1, x, 1, 1, 1), "a1 must be a positive"),
        ((1, 0.5, 1, 1, 1), "a1 must be exact"),
        ((1, sp.Float("0.5"), 1, 1, 1), "a1 must be exact"),
        ((1, sp.oo, 1, 1, 1), "a1 must be finite"),
        ((1, True, 1, 1, 1), "a1 must be exact"),
    ],
)
def test_bounds_that_contradict_are_refused(arguments, message):
    with pytest.raises(InputError, match=message):
        FieldBounds(*arguments)


def test_field_knows_its_peak_gradient_and_hessian():
    field = Field((x, y), 5 - (x - 1) ** 2 - 3 * (y + 2) ** 2, (1, -2), 1)
    assert field.peak == 5
    assert field.value((1, 0)) == -7
    assert list(field.gradient) == [2 - 2 * x, -6 * y - 12]
    assert field.hessian_at_source == sp.Matrix([[-2, 0], [0, -6]])


def test_a_variable_that_is_not_declared_is_taken():
    plain = sp.Symbol("x")
    assert Field((plain,), -(plain**2), (0,), 1).peak == 0


def test_source_may_be_irrational():
    assert Field((x,), -((x**2 - 2) ** 2), (sp.sqrt(2),), 1).peak == 0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (((x, y), -(x**2), (0,), 1), "1 coordinates"),
        (((x, sp.Symbol("x")), -(x**2), (0, 0), 1), "distinct"),
        (((sp.Symbol("x"), y), -(x**2), (0, 0), 1), "the symbol x of the expression is declared otherwise"),
        (((a,), -(a**2), (1,), 1), "declared to be more than real"),
        (((sp.Symbol("n", integer=True),), sp.Integer(1), (0,), 1), "declared to be more than real"),
        (((sp.Symbol("n", imaginary=True),), sp.Integer(1), (0,), 1), "declared to be more than real"),
        (((x,), -(x**2) * sp.Function("g")(x), (0,), 1), r"undefined function g\(x\)"),
        (((x,), -(x**2) + sp.Integral(x, (x, 0, x)), (0,), 1), "without an unevaluated Integral"),
        (((x,), -sp.Derivative(x**3, x), (0,), 1), "without an unevaluated Derivative"),
        (((x,), -(x**2) + sp.I * x, (0,), 1), "without the imaginary unit"),
        (((x,), -(x**2) * sp.Symbol("omega", positive=True), (0,), 1), "contains omega"),
        (((x, x), -(x**2), (0, 0), 1), "distinct"),
        (((), sp.Integer(1), (), 1), "at least one variable"),
        (((x,), -(x**2) - y, (0,), 1), "contains y"),
        (((x,), -(x**2), (0.0,), 1), "source must be exact"),
        (((x,), -(x**2), (sp.I,), 1), "must be real numbers"),
        (((x,), -(x**2), (0,), 0), "positive integer"),
        (((x,), -(x**2), (0,), sp.Rational(1, 2)), "positive integer"),
        (((x,), -1 / x**2, (0,), 1), "no finite real value there"),
        (((x,), sp.Float("0.5") * x, (0,), 1), "field.expression must be exact"),
    ],
)
def test_field_refuses(arguments, message):
    with pytest.raises(InputError, match=message):
        Field(*arguments)
