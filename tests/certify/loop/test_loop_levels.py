"""Levels: ranges, and the comparison in time."""

import math

import numpy as np
import pytest

from ptproof.certify.loop.levels import Levels, fallen, largest_over, smallest_within

LEVELS = Levels(np.array([1.0, 2.0, 3.0, 4.0]))


@pytest.mark.parametrize(
    ("level", "rates", "length", "expected"),
    [
        (3.5, [-1, -1, -1], 1.0, 2.5),
        (3.5, [1, 1, -1], 9.0, 3.0),
        (3.5, [-1, -1, -1], 99.0, 1.0),
        (2.5, [-1, 1, -1], 9.0, 3.0),
        (2.5, [-1, 1, 1], 0.25, 2.75),
        (2.5, [-1, 1, 1], 9.0, math.inf),
        (3.5, [-1, -1, 0], 9.0, 3.5),
        (0.5, [1, -1, -1], 9.0, 2.0),
        (5.0, [-1, -1, -1], 1.0, math.inf),
        (3.5, [-1, 1, -1], math.inf, 3.0),
    ],
)
def test_comparison(level, rates, length, expected):
    assert fallen(level, np.array(rates, float), LEVELS, length, length) == pytest.approx(expected, rel=1e-9)


def test_falling_takes_the_shortest_time_and_rising_the_longest():
    assert fallen(3.5, np.array([-1.0, -1, -1]), LEVELS, 0.5, 1.0) == pytest.approx(3.0)
    assert fallen(2.25, np.array([-1.0, 1, 1]), LEVELS, 0.5, 1.0) == pytest.approx(3.25)


def test_a_level_at_an_edge_counts_for_both_bands():
    first, last = LEVELS.touched(np.array([2.0, 4.5, 0.1]), np.array([2.0, 5.0, 0.9]))
    assert (first.tolist()[0], last.tolist()[0]) == (0, 2)
    assert (first[1:] >= last[1:]).all()


def test_ranges_against_the_plain_way():
    draw = np.random.default_rng(0)
    first = draw.integers(0, 50, 300)
    last = np.minimum(first + draw.integers(0, 20, 300), 50)
    values = draw.normal(size=300)
    most = np.full(50, -np.inf)
    for a, b, value in zip(first, last, values, strict=True):
        most[a:b] = np.maximum(most[a:b], value)
    assert np.array_equal(largest_over(first, last, values, 50), most)
    least = [most[a:b].min(initial=np.inf) for a, b in zip(first, last, strict=True)]
    assert np.array_equal(smallest_within(first, last, most), least)
