"""Symmetries by structure: what is made of invariant parts is invariant; a derivative of 0 is no proof."""

import pytest
import sympy as sp

from ptproof.balls.cube import is_rotational, reduced_faces

x, y, z = sp.symbols("x y z", real=True)
square = x**2 + y**2
step = sp.Piecewise((1, y < 1), (2, True))


@pytest.mark.parametrize(
    "expression",
    [
        square,
        x**4 + 2 * x**2 * y**2 + y**4 - 3 * square,
        x**2 * sp.exp(-square) + y**2 * sp.exp(-square),
        sp.exp(-(x**2)) * sp.exp(-(y**2)),
        x**2 / square + y**2 / square,
        sp.sqrt(square) * sp.sin(square),
        sp.floor(square) + sp.Mod(square, 2) + sp.sign(square - 1),
        square * sp.Piecewise((1, square < 1), (2, True)),
        sp.Max(square, 2 * square - 1),
    ],
)
def test_what_every_rotation_leaves_is_seen(expression):
    assert is_rotational(expression, [x, y])


@pytest.mark.parametrize(
    "expression",
    [
        x**2 + 2 * y**2,
        sp.cos(x) * sp.cos(y),
        square * step,
        square * (1 + sp.sign(x) ** 2),
        square * sp.Heaviside(y),
        square * (1 + sp.floor(x)),
        square * (1 + sp.ceiling(y)),
        square * sp.Abs(x) / x,
        square * (3 + sp.atan(x) + sp.atan(1 / x)),
        square * (3 + sp.sign(sp.sin(x + y))),
        square * sp.exp(sp.sign(x)),
        sp.Piecewise((square, sp.Max(x, y) < 1), (2 * square, True)),
    ],
)
def test_what_only_its_derivative_hides_is_not(expression):
    assert not is_rotational(expression, [x, y])


def test_rotations_of_space_need_every_plane():
    assert is_rotational(x**2 + y**2 + z**2, [x, y, z])
    assert not is_rotational(x**2 + y**2 + z**4, [x, y, z])


def test_a_jump_keeps_the_faces_that_differ():
    assert len(reduced_faces(square, [x, y])) == 1
    assert {(face.axis, face.sign) for face in reduced_faces(square * step, [x, y])} == {(0, 1), (1, 1), (1, -1)}
