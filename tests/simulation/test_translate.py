"""SymPy to CasADi: every rule gives SymPy's own number, and what has no rule is refused by name."""

import numpy as np
import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.simulation import simulate
from ptproof.simulation.smooth import constants_apart
from ptproof.simulation.taylor_form import converted
from ptproof.simulation.translate import to_function, translate
from ptproof.system import System

t, x, y = sp.symbols("t x y", real=True)
k = sp.Symbol("k", positive=True)
POINTS = [(0.3, -0.7, 1.9, 2.5), (1.7, 0.4, -0.2, 0.8)]

EXPRESSIONS = [
    x + y * k - sp.Rational(1, 3), x**3, x**-2, sp.sqrt(x**2 + 1), 1 / sp.sqrt(k), k**x, x**20, sp.exp(x),
    sp.exp(-(x**2)),
    sp.log(k), sp.sin(x) + sp.cos(y), sp.tan(x), sp.asin(x / 3), sp.acos(x / 3), sp.atan(x), sp.sinh(x), sp.cosh(x),
    sp.tanh(x), sp.Abs(x), sp.sign(y), sp.Max(x, y, 0), sp.Min(x, y), sp.floor(3 * x), sp.ceiling(3 * y), sp.Mod(x, 2),
    sp.Mod(y, sp.Rational(3, 2)), sp.atan2(y, x), sp.Heaviside(x), sp.erf(x), sp.pi * x, sp.E * y, t * x,
    sp.Piecewise((x, t < 1), (y**2, True)),
    sp.Piecewise((1, sp.And(x > 0, y < 0)), (2, sp.Or(x < -1, y > 1)), (3, True)),
    sp.Piecewise((1, sp.Not(x > 0)), (2, True)), sp.Piecewise((x, sp.Mod(t, 1) < sp.Rational(1, 2)), (-x, True)),
]  # fmt: skip


@pytest.mark.parametrize("expression", EXPRESSIONS, ids=str)
def test_a_rule_gives_the_number_that_sympy_gives(expression):
    function = to_function(System(t, (x, y), (expression, sp.Integer(0)), (k,)))
    for now, a, b, gain in POINTS:
        expected = float(expression.subs({t: now, x: a, y: b, k: gain}).evalf(20))
        assert float(function(now, [a, b], [gain])[0]) == pytest.approx(expected, rel=1e-13, abs=1e-14)


SMOOTH = [
    e for e in EXPRESSIONS if not e.has(sp.Abs, sp.sign, sp.Max, sp.Min, sp.floor, sp.ceiling, sp.Mod, sp.Heaviside)
]


def test_heyoka_takes_the_smooth_ones():
    import heyoka as hy

    smooth = [e for e in SMOOTH if not e.has(sp.Piecewise)]
    assert len(smooth) > 15
    names = hy.make_vars("x", "y")
    table = {x: names[0], y: names[1], t: hy.expression(0.3), k: hy.expression(2.5)}
    compiled = hy.cfunc(converted(smooth, table), names)
    for value, expression in zip(compiled([-0.7, 1.9]), smooth, strict=True):
        assert value == pytest.approx(float(expression.subs({t: 0.3, x: -0.7, y: 1.9, k: 2.5}).evalf(20)), rel=1e-13)


@pytest.mark.parametrize(
    "expression", [sp.Abs(x), sp.Max(x, 0), sp.Piecewise((x, x > 0), (0, True)), sp.sign(x)], ids=str
)
def test_heyoka_refuses_kinks(expression):
    import heyoka as hy

    with pytest.raises(InputError, match="smooth systems of elementary functions only"):
        converted([expression], {x: hy.make_vars("x")})


@pytest.mark.parametrize(
    ("expression", "message"),
    [
        (sp.Function("F")(x), "undefined function"),
        (y + x, "the symbol y has no value"),
        (sp.gamma(x), "gamma"),
        (x + sp.oo * k, "oo|symbol|finite"),
    ],
)
def test_what_has_no_rule_is_named(expression, message):
    import casadi as ca

    with pytest.raises(InputError, match=message):
        translate([expression], {x: ca.SX.sym("x")})


@pytest.mark.parametrize("power", [2, 3, 7, 12, -2])
def test_integer_powers_have_their_taylor_series_at_zero_too(power):
    # heyoka's own rule for powers divides by the base.
    exact = 1 / (power + 1) if power > 0 else 0.5
    base = x if power > 0 else x + 1
    run = simulate(System(t, (x, y), (sp.Integer(1), base**power)), initial=[0, 0], span=(0, 1), engine="heyoka")
    assert run["y"][-1] == pytest.approx(exact, rel=1e-12)


def test_what_depends_on_parameters_alone_is_computed_once_a_run():
    a = sp.Symbol("a", real=True)
    system = System(t, (x,), (sp.sqrt(k) * a * sp.cos(k**2 * x) / 3 + a**2 * t + k,), (a, k))
    rhs, constants = constants_apart(system)
    assert not any(entry.free_symbols & {a} for entry in rhs)
    back = {symbol: entry for entry, symbol in constants.items()}
    assert sp.simplify(rhs[0].xreplace(back) - system.rhs[0]) == 0
    question = {"initial": [1], "span": (0, 2), "parameters": {a: 0.7, k: 1.3}}
    runs = [simulate(system, engine=engine, **question) for engine in ("heyoka", "lsoda")]
    assert np.max(np.abs(runs[0].x - runs[1].x)) < 1e-7
