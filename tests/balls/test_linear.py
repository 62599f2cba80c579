"""Linear forms with a rest: products and matrices contain what they stand for."""

from fractions import Fraction

import numpy as np
import pytest

from ptproof.balls.arithmetic import Undefined
from ptproof.balls.arrays import Intervals
from ptproof.balls.linear import Linear, Matrix, around

RANDOM = np.random.default_rng(5)


def made(rows, boxes=3):
    middle, slopes = RANDOM.normal(size=(rows, boxes)), RANDOM.normal(size=(2, rows, boxes)) / 4
    return Linear(middle, slopes, np.abs(RANDOM.normal(size=(rows, boxes))) / 50)


def one(form, place, sign):
    """One value of what a form stands for, as exact fractions."""
    exact = np.vectorize(Fraction)
    d = [Fraction(value) for value in place]
    return exact(form.middle) + d[0] * exact(form.slopes[0]) + d[1] * exact(form.slopes[1]) + sign * exact(form.radius)


def contains(form, values, place):
    left = np.abs(one(form, place, 0) - values)
    return bool((left <= np.vectorize(Fraction)(form.radius)).all())


@pytest.mark.parametrize("place", [(-1, -1), (-1, 1), (0, 0), (0.5, -0.25), (1, 1)])
@pytest.mark.parametrize("sign", [-1, 1])
def test_a_product_contains_the_product(place, sign):
    a, b = made(4), made(4)
    assert contains(a.times(b), one(a, place, sign) * one(b, place, sign), place)


def test_a_product_without_its_second_order_would_not():
    a, b = made(4), made(4)
    found = a.times(b)
    narrow = Linear(found.middle, found.slopes, found.radius - a.reach * b.reach)
    assert not contains(narrow, one(a, (1, 1), 1) * one(b, (1, 1), 1), (1, 1))


@pytest.mark.parametrize("place", [(-1, 1), (0, 0), (1, 1)])
def test_a_sum_and_a_matrix_contain_theirs(place):
    a, b = made(4), made(4)
    factor = np.array([2.0, -0.5, 0.0])
    exact = np.vectorize(Fraction)
    assert contains(a.plus(factor, b), one(a, place, 1) + exact(factor) * one(b, place, -1), place)
    middle, radius = RANDOM.normal(size=(2, 4)), np.full((2, 4), 1e-3)
    found = Matrix.of(middle, radius).times(a)
    assert contains(found, (exact(middle) + exact(radius)) @ one(a, place, 1), place)


def test_some_rows_are_what_they_were():
    form = made(4)
    assert (form.rows(np.array([2, 0])).slopes == form.slopes[:, [2, 0]]).all()


def test_middles_and_radii_lie_around():
    value = Intervals(np.array([-1.0, 0.1]), np.array([3.0, 0.3]))
    middle, radius = around(value)
    assert (middle - radius <= value.low).all()
    assert (middle + radius >= value.high).all()


def test_a_matrix_with_too_many_columns_is_refused():
    with pytest.raises(Undefined, match="columns"):
        Matrix.of(np.zeros((1, 4001)), np.zeros((1, 4001)))
