"""Growth far from the source encloses the function on every ray of the directions it was made for."""

import pytest
import sympy as sp
from flint import arb

from ptproof.balls.ball import enclose, interval
from ptproof.balls.growth import GROWTHS, Growth, coordinates, power_of
from ptproof.balls.tape import Undefined, compile_tape

x, y = sp.symbols("x y", real=True)

EXPRESSIONS = [
    x**2 + 3 * x * y - 7,
    sp.cos(x) * x + sp.sin(x * y) - sp.atan(x) * sp.tanh(y),
    1 / (1 + x**2) - 3 / (2 + x**2 + y**2) ** 2,
    sp.log(1 + x**2 + y**2),
    sp.log(2 + x**2),
    sp.sqrt(1 + x**2 + y**4),
    sp.sqrt(1 + x**2),
    (1 + x**2 + y**2) ** sp.Rational(3, 2),
    sp.exp(-(x**2) - y**2) * x**3,
    sp.exp(-((x - 1) ** 2)) * y,
    sp.exp(-sp.Abs(x) - y**2),
    sp.Max(x, y) - sp.Abs(x - y) + sp.Min(1, x),
    sp.floor(x) - x + sp.sign(x),
    sp.sinh(sp.sin(x)) + sp.cosh(y / (1 + y**2)),
    sp.atan2(y, x),
    sp.Piecewise((x, x < 2), (y**2, True)),
]


@pytest.mark.parametrize("expression", EXPRESSIONS)
@pytest.mark.parametrize("start", [1, 8])
def test_growth_encloses_the_values(expression, start):
    for low, high in (((6, 7), (8, 7)), ((-1, 0), (1, 10)), ((-8, 6), (-7, 6))):
        w = [interval(arb(a) / 10, arb(b) / 10) for a, b in zip(low, high, strict=True)]
        if not all(entry.is_finite() for entry in w):
            continue
        try:
            growth = compile_tape([expression], [x, y]).run(coordinates(w, arb(1) / start), GROWTHS)[0]
        except Undefined:
            continue
        if not isinstance(growth, Growth):
            growth = Growth({}, arb(1) / start).lift(growth)
        for factor in (1, 3, 50):
            r = sp.Integer(start * factor)
            direction = [sp.Rational(a + b, 20) for a, b in zip(low, high, strict=True)]
            value = enclose(expression, {x: r * direction[0], y: r * direction[1]})
            lower = sum((c.low * power_of(arb(int(r)), e) for e, c in growth.terms.items()), arb(0))
            upper = sum((c.high * power_of(arb(int(r)), e) for e, c in growth.terms.items()), arb(0))
            assert lower.lower() <= value.upper()
            assert upper.upper() >= value.lower()
            values = growth.range
            assert values.low.lower() <= value.upper()
            assert values.high.upper() >= value.lower()


@pytest.mark.parametrize(
    ("expression", "degree"),
    [
        (sp.log(1 + x**2), sp.Rational(1, 2)),
        (sp.exp(-(x**2)), -16),
        (sp.sqrt(1 + x**4), 2),
        (x**2 / (1 + x**2), 0),
        (x * sp.cos(x), 1),
        (x**3 - x**3 + x, 1),
    ],
)
def test_degree_along_an_axis(expression, degree):
    growth = compile_tape([expression], [x]).run(coordinates([arb(1)], arb(1) / 16), GROWTHS)[0]
    assert max(growth.terms) == degree


def test_growing_exponential_has_a_lower_bound_only():
    growth = compile_tape([sp.exp(x)], [x]).run(coordinates([arb(1)], arb(1) / 16), GROWTHS)[0]
    (exponent,) = growth.terms
    assert exponent > 10
    assert growth.terms[exponent].low > 0
    assert not growth.terms[exponent].high.is_finite()


@pytest.mark.parametrize("expression", [sp.tan(x), 1 / sp.cos(x), sp.log(x), sp.sqrt(x), sp.asin(x)])
def test_what_may_be_singular_far_out_is_undefined(expression):
    with pytest.raises(Undefined):
        compile_tape([expression], [x]).run(coordinates([arb(-1)], arb(1) / 2), GROWTHS)
