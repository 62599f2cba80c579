"""What switches, where it may, and which branch applies."""

import itertools

import pytest
import sympy as sp

from ptproof.proof.kinks import branch, innermost, is_kink, level, resolved, switching

x, y = sp.symbols("x y", real=True)


def signs_at(point):
    return lambda side: int(sp.sign(side.subs(x, point)))


def floors_at(point):
    return lambda counted: int(sp.floor(counted.subs(x, point)))


EXAMPLES = [
    sp.Abs(x - 1),
    sp.sign(x),
    sp.Heaviside(x),
    sp.Heaviside(x, 1),
    sp.Max(x, x**2, 1 - x),
    sp.Min(x, x**2, 1 - x),
    sp.Piecewise((x**2, x < 0), (3, sp.Eq(x, 0)), (sp.sin(x), True)),
    sp.Piecewise((1, (x > 0) & (x < 2)), (2, True)),
    sp.floor(2 * x),
    sp.ceiling(2 * x),
    sp.Mod(x, sp.Rational(2, 3)),
    sp.asin(sp.sin(3 * x)),
    sp.acos(sp.cos(3 * x)),
    sp.atan(sp.tan(3 * x)),
    sp.Max(sp.Abs(x), sp.Mod(x, 2)) + sp.sign(sp.floor(x) + 1),
]


@pytest.mark.parametrize("expression", EXAMPLES, ids=str)
@pytest.mark.parametrize("point", [sp.Rational(-7, 3), -1, 0, sp.Rational(2, 7), 1, sp.Rational(9, 4)])
def test_the_branch_has_the_value_of_the_expression(expression, point):
    smooth = resolved(expression, {x}, signs_at(point), floors_at(point))
    assert innermost(smooth, {x}) is None
    assert abs(sp.N((smooth - expression).subs(x, point), 30)) < 1e-25


@pytest.mark.parametrize("expression", EXAMPLES[:-1], ids=str)
def test_between_neighbouring_switches_the_branch_stays(expression):
    assert is_kink(expression, {x})
    assert not is_kink(expression, {y})
    if level(expression) is None:
        zeros = {root for side in switching(expression) for root in sp.solveset(side, x, sp.S.Reals)}
        ends = [-3, *sorted(zeros), 3]
        for low, high in itertools.pairwise(ends):
            inside = [low + (high - low) * sp.Rational(i, 7) for i in (1, 3, 6)]
            assert len({branch(expression, signs_at(point)) for point in inside}) == 1


def test_nothing_is_chosen_where_a_sign_is_not_known():
    assert resolved(sp.Abs(x) + sp.floor(x), {x}, lambda side: None) is None
    assert branch(sp.floor(x), lambda side: 1) is None
    assert branch(sp.Piecewise((1, x > 0), (2, True)), lambda side: None) is None


def test_no_piece_holds():
    assert branch(sp.Piecewise((1, x > 0)), lambda side: -1) is sp.nan


def test_an_arcsine_of_anything_else_is_no_kink():
    assert not is_kink(sp.asin(x), {x})
    assert level(sp.asin(x)) is None
