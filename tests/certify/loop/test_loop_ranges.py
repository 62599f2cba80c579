"""Ranges over headings and filter states, and what a half-plane leaves of a box, against points."""

import numpy as np
import pytest

from ptproof.balls.linear import Linear
from ptproof.certify.loop.boxes import Boxes
from ptproof.certify.loop.ranges import Waves

RANDOM = np.random.default_rng(11)
TURNS, POWERS = (0, 1, 3, 0, 2, 0), (0, 0, 0, 1, 1, 2)
BOXES = 5


def waves(**given):
    rows = 2 * len(TURNS)
    middle, slopes = RANDOM.normal(size=(rows, BOXES)), RANDOM.normal(size=(2, rows, BOXES)) / 5
    middle[5] = given.get("bend", -3.0)
    middle[[6, 9, 11]] = slopes[:, [6, 9, 11]] = 0.0  # the mean is real
    return Waves(TURNS, POWERS, Linear(middle, slopes, np.zeros((rows, BOXES))))


def values(made, headings, places, q):
    """Of the function at boxes × headings × places × q."""
    half, parts = len(TURNS), made.parts
    found = 0.0
    for at, (n, p) in enumerate(zip(made.turns, made.powers, strict=True)):
        real, imaginary = (
            parts.middle[row][:, None] + np.einsum("ab,ap->bp", parts.slopes[:, row], places) for row in (at, at + half)
        )
        turning = real[:, None] * np.cos(n * headings)[:, None] - imaginary[:, None] * np.sin(n * headings)[:, None]
        found = found + ((1 if n == 0 else 2) * turning)[..., None] * q**p
    return found


HEADINGS = np.linspace(0, 2 * np.pi, 211)
PLACES = np.array([[-1.0, -1, 1, 1, 0, 0.5], [-1.0, 1, -1, 1, 0, 0.25]])


@pytest.mark.parametrize("band", [(0.0, 0.5), (0.3, 0.9), (2.0, 4.0)])
@pytest.mark.parametrize("bend", [-3.0, 0.0, 2.0])
def test_no_point_is_outside_a_range(band, bend):
    made = waves(bend=bend)
    q = np.concatenate([np.linspace(*band, 31), -np.linspace(*band, 31)])
    seen = values(made, HEADINGS, PLACES, q)
    found = made.ranges()
    assert (seen.max(axis=(1, 2, 3)) <= found.above(*band)).all()
    assert (seen.min(axis=(1, 2, 3)) >= found.below(*band)).all()


def test_the_grid_is_sharper_than_the_sum_of_moduli():
    made = waves()
    moduli = np.hypot(made.parts.middle[:6], made.parts.middle[6:])
    still = Waves(TURNS, POWERS, Linear(made.parts.middle, 0 * made.parts.slopes, made.parts.radius))
    found = still.ranges()
    assert (found.high[0] < made.parts.middle[0] + 2 * moduli[1:3].sum(axis=0) - 0.01).any()
    assert (found.high[0] >= values(still, HEADINGS, PLACES, np.zeros(1)).max(axis=(1, 2, 3))).all()


def test_a_grid_without_what_it_misses_is_no_bound():
    turns = 2 * np.pi / 32
    made = Waves((0, 1), (0, 0), Linear(np.array([[0.0], [0.5 * np.cos(turns / 2)], [0.0], [-0.5 * np.sin(turns / 2)]]),
                                        np.zeros((2, 4, 1)), np.zeros((4, 1))))  # fmt: skip
    found = made.ranges()
    assert found.most[0] < 1.0 <= found.high[0]


def test_without_upright_slopes_the_mean_is_level():
    made = waves()
    assert (made.upright().mean().slopes == 0).all()
    assert (made.upright().parts.slopes[:, 1] == made.parts.slopes[:, 1]).all()


def test_waves_of_other_turns_are_not_added():
    other = Waves((1, 1, 3, 0, 2, 0), POWERS, waves().parts)
    with pytest.raises(ValueError, match="turns"):
        waves().plus(np.ones(BOXES), other)


def test_what_a_half_plane_leaves_of_a_box():
    boxes = Boxes(RANDOM.normal(size=(2, 200)), 0.25)
    slopes, bounds = RANDOM.normal(size=(2, 200)), RANDOM.normal(size=(1, 200))
    slopes[:, :20] = [[0.0], [1.0]]
    found = boxes.cut(slopes, bounds)[0]
    marks = np.linspace(-1, 1, 81)
    first, second = (part.ravel() for part in np.meshgrid(marks, marks))
    inside = np.outer(slopes[0], first) + np.outer(slopes[1], second) <= bounds[0][:, None]
    away = np.hypot(boxes.middles[0][:, None] + 0.25 * first, boxes.middles[1][:, None] + 0.25 * second)
    seen = np.where(inside, away, 0.0).max(axis=1)
    assert (seen <= found).all()
    assert (found - seen < 0.05)[inside.any(axis=1)].all()
