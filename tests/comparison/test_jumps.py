"""A bound whose integral or convolution jumps is refused, although its derivative is right wherever there is one."""

from __future__ import annotations

import pytest
import sympy as sp

from ptproof.comparison.damped import LinearBound
from ptproof.comparison.power import PowerBound
from ptproof.errors import InputError

s = sp.Symbol("s", real=True)
a = sp.Symbol("a", positive=True)
JUMPS = {
    "sign": sp.sign(s - 1) + 1,
    "Heaviside": sp.Heaviside(s - 1),
    "Piecewise": sp.Piecewise((0, s < 1), (1, True)),
    "floor": sp.floor(s),
    "quotient": sp.Abs(s - 1) / (s - 1) + 1,
    "pole": 1 / (s - 2) + sp.Rational(1, 2),
    "arctangent": sp.atan(1 / (s - 1)) + sp.pi / 4,
}


def power(integral: sp.Expr) -> PowerBound:
    return PowerBound(s, sp.S.Zero, a, sp.diff(integral, s), sp.S.One, integral)


@pytest.mark.parametrize("name", JUMPS)
def test_an_integral_that_jumps_is_refused(name: str) -> None:
    with pytest.raises(InputError, match="comparison"):
        power(-s - JUMPS[name])


@pytest.mark.parametrize("name", ["sign", "Heaviside", "Piecewise", "floor"])
def test_a_convolution_that_jumps_is_refused(name: str) -> None:
    jump = JUMPS[name] * sp.exp(-s)
    with pytest.raises(InputError, match="comparison"):
        LinearBound(s, sp.S.Zero, a, sp.S.One, sp.simplify(sp.diff(jump, s) + jump), jump)


@pytest.mark.parametrize("integral", [-s, s**2, sp.log(1 + s), s / (1 + s), sp.sin(s)])
def test_a_smooth_integral_is_accepted(integral: sp.Expr) -> None:
    assert power(integral).bound.subs(s, 0) == a
