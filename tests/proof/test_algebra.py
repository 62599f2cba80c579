"""The normal form of zero: identities that it must see, and near misses that it must not."""

from __future__ import annotations

import pytest
import sympy as sp

from ptproof.proof.algebra import NotAlgebraic, is_zero

x, y, tau, t, t0 = sp.symbols("x y tau t t0", real=True)
a, b, T, k, V, r = sp.symbols("a b T k V r", positive=True)
kappa = sp.Symbol("kappa", positive=True, integer=True)
q = (2 * kappa - 1) / (2 * kappa)
F = sp.Function("F", real=True)(x, y)
nu = 1 - (t - t0) / T
root = sp.sqrt(x**2 + y**2 + 1)

IDENTITIES = {
    "power of a power": (r ** (2 * kappa)) ** q - r ** (2 * kappa - 1),
    "power of a product": (a * r ** (2 * kappa)) ** q - a**q * r ** (2 * kappa - 1),
    "powers that add up": V**q * V ** (1 / (2 * kappa)) - V,
    "powers over a sum": V ** (kappa / (kappa + 1)) * V ** (1 / (kappa + 1)) - V,
    "equal exponents in the base of a power": (
        (1 + V ** (kappa / (kappa + 1))) ** q - (1 + V ** (2 * kappa / (2 * kappa + 2))) ** q
    ),
    "equal exponents two powers deep": (
        (1 + (1 + V ** (2 / (2 * kappa))) ** q) ** (1 / kappa) - (1 + (1 + V ** (1 / kappa)) ** q) ** (1 / kappa)
    ),
    "root of a sum": sp.sqrt(x**2 + y**2) ** 3 - (x**2 + y**2) * sp.sqrt(x**2 + y**2),
    "rationalised denominator": 1 / (root - 1) - (root + 1) / (x**2 + y**2),
    "roots of numbers": sp.sqrt(8) - 2 * sp.sqrt(2),
    "angle addition": sp.cos(k * F - tau) - sp.cos(k * F) * sp.cos(tau) - sp.sin(k * F) * sp.sin(tau),
    "double angle": sp.cos(2 * x) - 1 + 2 * sp.sin(x) ** 2,
    "tangent": sp.tan(x) ** 2 + 1 - 1 / sp.cos(x) ** 2,
    "exponentials in another time": sp.exp(-k * (t - t0) / nu) - sp.exp(-k * (tau - t0)).subs(tau, t0 + (t - t0) / nu),
    "derivative of an undefined function": sp.diff(sp.cos(k * F), x) + k * sp.sin(k * F) * sp.diff(F, x),
    "equal arguments in two forms": sp.Function("f")(1 / (1 + x)) - sp.Function("f")((x - 1) / (x**2 - 1)),
    "absolute value": sp.Abs(x) ** 2 - x**2,
    "hyperbolic": sp.cosh(x) ** 2 - sp.sinh(x) ** 2 - 1,
}


@pytest.mark.parametrize("name", IDENTITIES)
def test_identity_is_seen(name: str) -> None:
    assert is_zero(IDENTITIES[name])


NEAR_MISSES = {
    "exponent": (r ** (2 * kappa)) ** q - r ** (2 * kappa + 1),
    "coefficient": V**q * V ** (1 / (2 * kappa)) - 2 * V,
    "exponents in the base of a power": (
        (1 + V ** (kappa / (kappa + 1))) ** q - (1 + V ** (2 * kappa / (2 * kappa + 1))) ** q
    ),
    "numerator of an exponent in a base": (
        (1 + V ** (kappa / (kappa + 1))) ** q - (1 + V ** ((2 * kappa + 2) / (2 * kappa + 2))) ** q
    ),
    "sign of an exponent in a base": ((1 + V ** (1 / (2 * kappa))) ** q - (1 + V ** (-2 / (4 * kappa))) ** q),
    "sign of an angle": sp.cos(k * F - tau) - sp.cos(k * F) * sp.cos(tau) + sp.sin(k * F) * sp.sin(tau),
    "square root of a square": sp.sqrt(x**2) - x,
    "logarithm of an exponential of another": sp.exp(x) - sp.exp(y),
    "pi is not 22/7": sp.pi - sp.Rational(22, 7),
    "power of a product of signs": sp.sqrt(x * y) - sp.sqrt(x) * sp.sqrt(y),
    "one derivative for another": sp.diff(F, x) - sp.diff(F, y),
}


@pytest.mark.parametrize("name", NEAR_MISSES)
def test_near_miss_is_not_zero(name: str) -> None:
    assert not is_zero(NEAR_MISSES[name])


def test_floats_are_refused() -> None:
    with pytest.raises(NotAlgebraic, match="floating-point"):
        is_zero(sp.Float("0.1") * x - y)


def test_identically_vanishing_denominator_is_refused() -> None:
    with pytest.raises(NotAlgebraic, match="denominator"):
        is_zero((sp.sin(y) ** 2 + sp.cos(y) ** 2 - 1) / (sp.sin(x) ** 2 + sp.cos(x) ** 2 - 1))


def test_random_polynomials_with_roots_agree_with_their_expansion() -> None:
    import random

    generator = random.Random(7)
    for _ in range(30):
        p = sum(generator.randint(-3, 3) * x**i * sp.sqrt(V) ** j for i in range(3) for j in range(3))
        s = sum(generator.randint(-3, 3) * y**i * sp.cos(x) ** j for i in range(2) for j in range(3))
        assert is_zero((p + s) ** 2 - sp.expand(p**2 + 2 * p * s + s**2))
        assert not is_zero((p + s) ** 2 - sp.expand(p**2 + 2 * p * s + s**2) + sp.sin(x))
