"""Taylor polynomials and remainders at the source."""

import pytest
import sympy as sp
from flint import arb

from ptproof.balls.ball import enclose, interval
from ptproof.balls.jet import JETS, variables
from ptproof.balls.series import Nested, coefficient_along, taylor
from ptproof.balls.tape import Undefined, compile_tape

x, y = sp.symbols("x y", real=True)

SMOOTH = [
    sp.exp(x * y) * sp.cos(x - y) + 3,
    sp.log(2 + x + y**2) / (1 + x),
    sp.sqrt(1 + x * y) + (2 + y) ** sp.Rational(1, 3) + (1 + x) ** -2,
    sp.tan(x) + sp.tanh(y) + sp.sinh(x) * sp.cosh(y) + sp.atan(x) * sp.asin(y) - sp.acos(x / 2),
    sp.asinh(x + y) + sp.erf(x) + sp.cot(1 + y),
    (2 + x) ** y + sp.Abs(1 + x) + sp.Max(x, 1 + y) + sp.Min(x, 5) + sp.sign(2 + x),
    x**5 * y - x**2 * y**3 + sp.pi,
]


@pytest.mark.parametrize("expression", SMOOTH)
def test_coefficients_are_the_derivatives(expression):
    found = taylor(compile_tape([expression], [x, y]), 2, 4)[0]
    for i in range(5):
        for j in range(5 - i):
            derivative = expression
            for variable, times in ((x, i), (y, j)):
                derivative = sp.diff(derivative, variable, times) if times else derivative
            derivative = derivative.replace(sp.DiracDelta, lambda *args: sp.Integer(0)).subs({x: 0, y: 0}).doit()
            expected = enclose(derivative / (sp.factorial(i) * sp.factorial(j)))
            assert (found.terms.get((i, j), arb(0)) - expected).abs_upper() < 1e-12


@pytest.mark.parametrize("expression", SMOOTH)
def test_remainder_is_enclosed(expression):
    order, r = 3, sp.Rational(1, 4)
    tape = compile_tape([expression], [x, y])
    w = (sp.Rational(3, 5), sp.Rational(-4, 5))
    balls = [enclose(entry) for entry in w]
    polynomial = [coefficient_along(tape, arb(0), balls, k)[0] for k in range(order + 1)]
    bound = coefficient_along(tape, interval(0, arb(1) / 4), balls, order + 1)[0]
    value = enclose(expression, {x: r * w[0], y: r * w[1]})
    missing = value - sum((c * (arb(1) / 4) ** k for k, c in enumerate(polynomial)), arb(0))
    assert (bound * (arb(1) / 4) ** (order + 1)).overlaps(missing)


@pytest.mark.parametrize(
    "expression", [sp.Abs(x), sp.Max(x, y), sp.sqrt(x), 1 / x, sp.log(x), sp.sign(x), sp.floor(x), sp.atan2(y, x)]
)
def test_what_is_not_smooth_at_the_source_has_no_polynomial(expression):
    with pytest.raises(Undefined):
        taylor(compile_tape([expression + y], [x, y]), 2, 3)


@pytest.mark.parametrize("expression", [sp.Abs(x), sp.sqrt(1 - x), 1 / (x - sp.Rational(1, 2)), sp.sign(x - 1 / sp.pi)])
def test_remainder_across_a_singularity_is_undefined(expression):
    with pytest.raises(Undefined):
        coefficient_along(compile_tape([expression], [x]), interval(0, 2), [arb(1)], 3)


def test_global_length_of_series_is_put_back():
    import flint

    before = flint.ctx.cap
    taylor(compile_tape([sp.exp(x)], [x]), 1, 20)
    assert flint.ctx.cap == before


@pytest.mark.parametrize("terms", [{(0, 0): 1}, {(3, 0): 2, (0, 2): -1, (1, 1): 5}, {(4, 2): 1, (0, 0): 7}, {}])
def test_nested_form_has_the_same_values(terms):
    nested = Nested({key: arb(value) for key, value in terms.items()})
    point = (arb(3), arb(-2))
    assert nested.run(point) == sum((v * point[0] ** i * point[1] ** j for (i, j), v in terms.items()), arb(0))
    if any(map(sum, terms)):
        assert nested.run(variables(list(point))).value == nested.run(point)
        assert JETS.order(nested.run(variables(list(point)))) is not None
