"""A field is differentiated only where it is shown to be smooth; a jump is refused by a sentence that names it."""

from dataclasses import replace

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.problem import example
from ptproof.problem.doubts import source_doubt
from ptproof.problem.drift import gradient_drift, no_drift
from ptproof.problem.field import Field
from ptproof.problem.smooth import roughness
from ptproof.proof.statement import ge, le

x, y = sp.symbols("x y", real=True)
square = x**2 + y**2
JUMPS = {
    "Piecewise": sp.Piecewise((1, y < 1), (2, True)),
    "three pieces": sp.Piecewise((1, y < -1), (2, y < 1), (3, True)),
    "sign squared": 1 + sp.sign(x) ** 2,
    "Heaviside": 1 + sp.Heaviside(y - 1),
    "floor": 2 + sp.floor(x),
    "ceiling": 2 + sp.ceiling(x),
    "Mod": 1 + sp.Mod(x, 1),
    "quotient": 2 + sp.Abs(x - 1) / (x - 1),
    "atan2": 4 + sp.atan2(y, x - 1),
    "pole in atan": 2 + sp.atan(1 / (x - 1)),
    "hidden pole": 4 + sp.atan(1 / (x - 1)) + sp.atan(x - 1),
    "tan in atan": 2 + sp.atan(sp.tan(x)) - x,
    "pole in exp": 2 + sp.exp(-1 / (x - 1)),
    "nested": 2 + sp.tanh(sp.sign(sp.cos(x))),
}
KINKS = {
    "Max": sp.Max(x - 1, 0),
    "Min": -sp.Min(x, 1),
    "Abs": sp.Abs(x - 1),
    "root of a square": sp.sqrt((square - 1) ** 2),
    "triangle wave": sp.asin(sp.sin(x)),
    "glued with a kink": sp.Piecewise((square, square < 1), (2 * square - 1, True)),
    "one half power": (square**2 - 2 * square + 1) ** sp.Rational(1, 2),
}
SMOOTH = {
    "polynomial": square**2,
    "compositions": sp.exp(-square) + sp.sin(x * y) + sp.atan(x) * sp.tanh(y),
    "Abs cubed": sp.Abs(x) ** 3,
    "equal pieces": sp.Piecewise((square, y < 1), (x**2 + y**2, True)),
    "glued": sp.Piecewise((square, square < 1), (square + (square - 1) ** 3, True)),
    "same power of Max": sp.Max(x - 1, 0) ** 3,
    "denominator": 1 / (1 + square) + sp.log(1 + square) + sp.sqrt(1 + square),
    "undefined function": sp.Function("F", real=True)(x, y),
    "a pole that is seen": 1 / (x - 1),
}


@pytest.mark.parametrize("factor", JUMPS.values(), ids=JUMPS)
def test_a_jump_has_no_gradient(factor):
    assert "is not shown to be continuously differentiable" in roughness(-square * factor, (x, y), 1)


@pytest.mark.parametrize("term", KINKS.values(), ids=KINKS)
def test_a_kink_has_no_gradient(term):
    assert roughness(-square - term, (x, y), 1) is not None


@pytest.mark.parametrize("term", SMOOTH.values(), ids=SMOOTH)
def test_what_is_smooth_is_taken(term):
    assert roughness(-square - term, (x, y), 2) is None


def test_once_is_less_than_twice():
    bent = -square - x * sp.Abs(x) / 4
    assert roughness(bent, (x, y), 1) is None
    assert "twice continuously" in roughness(bent, (x, y), 2)


def test_a_jump_outside_of_the_domain_does_not_count_and_one_on_its_edge_does():
    jumps = -square * sp.Piecewise((1, square <= 1), (2, True))
    assert roughness(jumps, (x, y), 1, [le(square, sp.Rational(9, 10))], covered=True) is None
    assert roughness(jumps, (x, y), 1, [ge(square, sp.Rational(11, 10))], covered=True) is None
    for domain in ([le(square, 1)], [ge(square, 1)]):
        assert roughness(jumps, (x, y), 1, domain, covered=True) is not None


@pytest.mark.parametrize("factor", JUMPS.values(), ids=JUMPS)
def test_a_drift_along_the_gradient_of_a_jump_is_refused(factor):
    with pytest.raises(InputError, match=r"drift: E∇F needs the gradient of the field: .* is not shown"):
        gradient_drift([[-1, 0], [0, -1]], -square * factor, (x, y))


@pytest.mark.parametrize("factor", [JUMPS["Piecewise"], JUMPS["sign squared"], JUMPS["Mod"], JUMPS["hidden pole"]])
def test_a_field_that_jumps_is_not_averaged(factor):
    problem = replace(example("saturated"), field=Field((x, y), -square * factor, (0, 0), 1), drift=no_drift())
    with pytest.raises(InputError, match="average: the Lie brackets need a smooth field"):
        problem.averaged()


def test_a_field_with_a_smooth_seam_is_averaged():
    field = Field((x, y), -square - sp.Abs(x) ** 3, (0, 0), 1)
    average = replace(example("saturated"), field=field, drift=no_drift()).averaged(symbolic=True)
    assert average.rhs[0].has(sp.sign)


def test_a_kink_at_the_source_raises_no_doubt():
    """Min(x, −2x) is largest at 0, where SymPy's derivative is −1/2."""
    field = Field((x, y), sp.Min(x, -2 * x) - y**2, (0, 0), 1)
    assert any(entry.subs({x: 0, y: 0}) != 0 for entry in field.gradient)
    assert source_doubt(replace(example("saturated"), field=field, drift=no_drift())) is None
