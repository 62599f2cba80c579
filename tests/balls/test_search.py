"""Branch and bound on functions whose largest value is known, and floats that lie outside of balls."""

import math

import pytest
import sympy as sp
from flint import arb

from ptproof.balls.ball import BALLS
from ptproof.balls.boxes import centre, halves, widest
from ptproof.balls.cube import Face, shell
from ptproof.balls.jet import upper_bound
from ptproof.balls.rounding import decimal_down, decimal_up, down, up
from ptproof.balls.search import Look, Search
from ptproof.balls.tape import compile_tape

x, y = sp.symbols("x y", real=True)
SQUARE = ((arb(-2), arb(2)), (arb(-2), arb(2)))


def bump(sides, best):
    tape = compile_tape([x * sp.exp(-(x**2) - y**2)], (x, y))
    bound = upper_bound(lambda values, arithmetic: tape.run(values, arithmetic)[0], sides)
    point = centre(sides)
    index = widest(sides)
    return Look(
        up(bound.upper),
        up(bound.upper) <= best,
        None if index is None else lambda: halves(sides, index),
        down(tape.run(point, BALLS)[0]),
        point,
    )


@pytest.mark.parametrize("depth_first", [False, True])
def test_both_bounds_close_in_on_the_largest_value(depth_first):
    search = Search(bump, [SQUARE], depth_first=depth_first)
    largest = math.exp(-0.5) / math.sqrt(2)
    search.run(lambda: search.upper - search.best < 1e-4, most=5000)
    assert search.best <= largest <= search.upper
    assert search.upper - search.best < 1e-4 or depth_first


def test_a_search_goes_on_where_it_was_stopped():
    search = Search(bump, [SQUARE])
    search.run(lambda: False, most=40)
    before = search.upper - search.best
    assert search.looks == 40
    search.run(lambda: False, most=400)
    assert search.looks == 400
    assert search.upper - search.best < before


def test_before_the_first_look_nothing_is_known():
    search = Search(bump, [SQUARE])
    search.run(lambda: False, most=0)
    assert (search.best, search.upper, search.point, search.next) == (-math.inf, math.inf, None, SQUARE)


def test_what_cannot_be_halved_ends_the_search_and_is_named():
    search = Search(lambda part, best: Look(math.inf, halves=None), ["all"])
    search.run(lambda: False)
    assert (search.stuck, search.upper, search.left) == ("all", math.inf, 1)


@pytest.mark.parametrize("value", ["0.1", "-0.1", "1e-400", "-1e-400", "1e400", "0", "3", "[0.5 +/- 1e-9]", "nan"])
def test_floats_lie_outside_of_the_ball(value):
    ball = arb(value)
    assert not arb(up(ball)) < ball.upper()
    assert not arb(down(ball)) > ball.lower()
    assert up(ball) - down(ball) <= 3e-9 or value in ("1e400", "nan")


def test_decimals_lie_outside_of_the_float():
    assert str(decimal_up(0.1, 3)) == "0.101"
    assert str(decimal_down(0.1, 3)) == "0.100"


@pytest.mark.parametrize("n", [1, 2, 3])
def test_directions_of_a_shell_are_unit_vectors_in_every_direction(n):
    faces = [Face(axis, sign, ((-1, 1),) * (n - 1)) for axis in range(n) for sign in (-1, 1)]
    boxes = shell(faces, arb(1), arb(2), pieces=2)
    assert len(boxes) == 2 * n * 2 ** (n - 1)
    for box in boxes:
        assert sum((entry * entry for entry in box.direction()), arb(0)).contains(1)
    diagonal = 1 / arb(n).sqrt()
    assert any(all(entry.overlaps(-diagonal) for entry in box.direction()) for box in boxes)
