"""The envelope of the radial rate: above samples and close to them, on pieces that cover every direction."""

import numpy as np
import pytest
import sympy as sp
from flint import arb

from ptproof.balls.cube import Box, Face, shell
from ptproof.balls.radial import RadialEnvelope
from ptproof.errors import InputError
from ptproof.problem import example

R = sp.Rational


def circle(radius, count):
    angles = np.linspace(0, 2 * np.pi, count, endpoint=False)
    return radius * np.column_stack([np.cos(angles), np.sin(angles)])


@pytest.mark.parametrize("index", [-120, -30, -5, 0, 3])
@pytest.mark.parametrize("weight", [0, 1])
def test_the_envelope_lies_above_samples_and_close_to_them(index, weight):
    problem = example("vanishing")
    E = sp.ImmutableDenseMatrix([[R(-1), R(1, 2)], [R(0), R(1)]])
    envelope = RadialEnvelope(
        problem.variables, problem.field.expression, problem.source, problem.tuning.k, E, 2.0, (0.25, 1.0)
    )
    w = envelope.weights[weight]
    M = w * np.array(E.tolist(), dtype=float) + 0.9 * np.eye(2)
    slope = sp.lambdify(problem.variables, list(problem.field.gradient))
    low, high = envelope.boundary(index), envelope.boundary(index + 1)
    samples = [u @ M @ np.array(slope(*(r * u))) / r for r in np.linspace(low, high, 5) for u in circle(1.0, 180)]
    bound = envelope.rate(index, w, w)
    assert max(samples) <= bound <= max(samples) + 0.1 * abs(max(samples)) + 0.02


def test_between_two_weights_the_envelope_is_bounded_by_the_chord():
    problem = example("vanishing")
    E = -sp.eye(2)
    coarse = RadialEnvelope(
        problem.variables, problem.field.expression, problem.source, problem.tuning.k, E, 2.0, (0.1, 1.0)
    )
    fine = RadialEnvelope(
        problem.variables, problem.field.expression, problem.source, problem.tuning.k, E, 2.0, (0.1, 0.5, 1.0)
    )
    assert coarse.rate(0, 0.5, 0.5) >= fine.rate(0, 0.5, 0.5) - 0.05
    with pytest.raises(InputError, match="outside the grid"):
        coarse.rate(0, 0.05, 0.5)


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_the_pieces_cover_every_direction(dimension):
    rng = np.random.default_rng(1)
    faces = [Face(axis, sign, ((-1, 1),) * (dimension - 1)) for axis in range(dimension) for sign in (-1, 1)]
    pieces = shell(faces, arb(1), arb(1), 4)
    for _ in range(50):
        u = rng.normal(size=dimension)
        u /= np.linalg.norm(u)
        assert any(
            all(
                abs(float(ball.mid()) - value) <= float(ball.rad()) + 1e-12
                for ball, value in zip(p.direction(), u, strict=True)
            )
            for p in pieces
        )


def test_a_piece_is_halved_where_it_ranges_most_widely():
    wide, flat = (Box(Face(0, 1, ((-1, 1),)), False, ((arb(1), arb(high)), (arb(0), arb("0.25")))) for high in (2, 1.1))
    assert (wide.widest(), flat.widest()) == (0, 1)


@pytest.mark.parametrize("dimension", [1, 3])
def test_other_dimensions(dimension):
    variables = sp.symbols(f"y1:{dimension + 1}", real=True)
    field = -sp.Add(*(v**2 for v in variables)) / 2
    envelope = RadialEnvelope(variables, field, (sp.S.Zero,) * dimension, sp.Integer(2), None, 1.0, (1.0,))
    for index in (-160, -40, 0):
        assert -1 <= envelope.rate(index, 1.0, 1.0) <= -0.9


@pytest.mark.parametrize("radius", [0.0, 5e-324])
def test_what_is_too_near_for_a_float_lies_in_the_innermost_ball(radius):
    x = sp.Symbol("x", real=True)
    envelope = RadialEnvelope((x,), -(x**2), (sp.S.Zero,), sp.Integer(2), None, 2.0, (1.0,))
    assert envelope.boundary(envelope.shell(radius)) == 0


X, Y = sp.symbols("x y", real=True)
SQUARE, LONG = -(X**2) - Y**2, -(X**2) - 2 * Y**2
SYMMETRIC = {
    "a circle": (SQUARE, [[0, 1], [-1, 0]], 1),
    "both coordinates": (LONG, [[1, 0], [0, -1]], 2),
    "the middle alone": (LONG, [[1, 2], [0, 1]], 2),
    "one coordinate": (SQUARE - X**3 / 4, [[0, 0], [0, 0]], 3),
    "the field but not the rate": (LONG, [[0, 3], [0, 0]], 2),
    "none": (SQUARE - X**3 / 4 + Y**3 / 5, [[0, 0], [1, 0]], 4),
}


def rates(field, E, radii):
    """The envelope's first shell above the radius 1, and what is reached there over all directions."""
    envelope = RadialEnvelope((X, Y), field, (sp.S.Zero,) * 2, sp.Integer(2), sp.ImmutableDenseMatrix(E), 1.0, (1.0,))
    slope = sp.lambdify((X, Y), [sp.diff(field, X), sp.diff(field, Y)])
    M = np.array(E, dtype=float) + np.eye(2)
    return envelope, max(u @ M @ np.array(slope(*(r * u)), dtype=float) / r for r in radii for u in circle(1.0, 360))


@pytest.mark.parametrize("name", SYMMETRIC)
def test_directions_are_left_out_by_symmetry_and_none_that_is_needed(name):
    field, E, faces = SYMMETRIC[name]
    envelope, largest = rates(field, E, (1.0, 1.03, 1.06))
    assert len(envelope._faces) == faces
    assert largest - 1e-9 <= envelope.rate(0, 1.0, 1.0) <= largest + 0.1 * abs(largest) + 0.05


def test_a_direction_that_is_needed_and_left_out_would_show():
    field, E, _ = SYMMETRIC["none"]
    envelope, largest = rates(field, E, (1.0,))
    envelope.__dict__["_faces"] = (Face(0, 1, ((0, 1),)),)
    assert envelope.rate(0, 1.0, 1.0) < largest - 0.1
