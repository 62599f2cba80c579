"""Letters on boxes and stretches of time, as linear forms: against their values at points."""

import numpy as np
import pytest
import sympy as sp

from ptproof.balls.arrays import Intervals
from ptproof.balls.ball import precision
from ptproof.balls.linear import Linear
from ptproof.certify.loop.boxes import Boxes
from ptproof.certify.loop.jets import CLOCK, FIELD, FIRST, SECOND
from ptproof.certify.loop.polynomials import Letter
from ptproof.certify.loop.setup import jets_of, phases
from tests.certify.loop.test_loop_flow import problem_of

LETTERS = (
    Letter(CLOCK), Letter(FIELD), Letter(FIELD, 1), Letter(FIELD, 1, 2), Letter(FIRST), Letter(SECOND, 1),
    Letter(FIRST, 0, 1, 1), Letter("R F 1", 1),
)  # fmt: skip
TIME = Intervals(np.asarray(0.2), np.asarray(0.3))
BOXES = Boxes(np.array([[-1.0, 0.25, 1.5], [0.5, -0.125, 1.0]]), 0.25)


def enclosed(drift="bounded", scale=1.0):
    """Whether no value at a corner, a middle or in between is outside, and by how much the forms are wide at most."""
    problem = problem_of(drift)
    with precision(128):
        jets = jets_of(problem, phases(problem)[0], 3)
        found = jets.linear(LETTERS, BOXES, TIME, 0.1)
    form = Linear(found.middle, found.slopes, found.radius * scale)
    table = sp.lambdify((*jets.position, jets.time), [jets.expression(item) for item in LETTERS[:-1]], "numpy")
    inside = True
    for place in [(a, b, c) for a in (-1, 0.5, 1) for b in (-1, 0, 1) for c in (-1, 0, 1)]:
        at = (
            *(side + 0.25 * d for side, d in zip(BOXES.middles, place, strict=False)),
            0.25 + 0.05 * place[2],
        )
        exact = np.stack([np.broadcast_to(value, 3) for value in table(*at)])
        middle = (form.middle + sum(d * slope for d, slope in zip(place, form.slopes, strict=False)))[:-1]
        inside &= bool((np.abs(exact - middle) <= form.radius[:-1] + 1e-13).all())
    return inside, found


@pytest.mark.parametrize("drift", ["bounded", "gradient"])
def test_no_value_is_outside(drift):
    inside, found = enclosed(drift)
    assert inside
    assert len(found.slopes) == 3


def test_half_the_rest_would_not_do():
    assert not enclosed(scale=0.5)[0]


def test_the_rest_of_a_taylor_polynomial_has_no_slope():
    _, found = enclosed()
    assert (found.slopes[:, -1] == 0).all()
    assert (found.middle[-1] == 0).all()
    assert (found.radius[-1] > 0).all()
