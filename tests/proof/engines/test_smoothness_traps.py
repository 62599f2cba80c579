"""What only looks smooth is never said to be; beside each trap stands what is really smooth, and is proved."""

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.claim import Goal
from ptproof.proof.engines.smoothness import smooth, smoothness
from ptproof.proof.statement import ForAll, Relation, Smooth, ge, le, lt
from ptproof.proof.verdict import Verdict

x, y, w, p = sp.symbols("x y w p", real=True)
k = sp.Symbol("k", positive=True)
above, inside = sp.Symbol("a", nonnegative=True), sp.Symbol("b", positive=True)
n, m = sp.Symbol("n", integer=True), sp.Symbol("m", integer=True, positive=True)
c = sp.Symbol("c")
F, positive = sp.Function("F", real=True), sp.Function("F", positive=True)
half, three_quarters, three_halves = sp.Rational(1, 2), sp.Rational(3, 4), sp.Rational(3, 2)
RIGHT = [ge(x, 0)]

# (expression, variables, order, assumed, domain)
SMOOTH = [
    (x**three_halves, [x], 1, {}, RIGHT),
    (x ** sp.Rational(5, 2), [x], 2, {}, RIGHT),
    (sp.sqrt(x), [x], 0, {}, RIGHT),
    (sp.sqrt(above), [above], 0, {}, []),
    (inside**three_quarters, [inside], 2, {}, []),
    ((x**2 + y**2) ** three_quarters, [x, y], 1, {}, RIGHT),
    ((1 - sp.sin(x)) ** three_quarters, [x], 1, {}, []),
    (sp.Abs(x) ** (2 + k), [x], 2, {}, []),
    (inside**inside, [inside], 2, {}, []),
    ((1 + x**2) ** p, [x], 2, {}, []),
    (x**m, [x], 2, {}, []),
    (sp.Subs(1 / w, w, x), [x], 1, {}, [ge(x, 1)]),
    (sp.Subs(sp.Abs(x) * w, x, 1), [x, w], 2, {}, []),
    (sp.Derivative(x * sp.Abs(x), x), [x], 0, {}, []),
    (sp.diff(F(x**2), x), [x], 1, {F(w): 2}, []),
    (F(1 + x**2), [x], 2, {F(inside): 2}, []),
    (F(sp.Abs(x) ** 3), [x], 2, {F: 2}, []),
    (sp.sqrt(positive(x)), [x], 1, {positive(x): 2}, []),
    (sp.Piecewise((1 / p, p > 0), (0, True)) * x, [x], 1, {}, []),
    (sp.Piecewise((x**3 * F(y), x > 0), (0, True)), [x, y], 2, {F(x): 2}, []),
    (sp.Piecewise((1, x > y), (0, True)), [x, y], 0, {}, [lt(x, y)]),
    (sp.atan2(y, x), [x, y], 2, {}, [ge(x, 1)]),
    (sp.Abs(p * x) ** 3, [x], 2, {}, []),
    (x**3 * sp.Heaviside(x), [x], 2, {}, []),
    (1 / (x - inside), [x, inside], 1, {}, [le(x, 0)]),
    (sp.ceiling(p) * x, [x], 2, {}, []),
]
TRAPS = [
    # the rule of roots asks for a full neighbourhood
    (x**three_quarters, [x], 1, {}, RIGHT),
    (x**three_halves, [x], 2, {}, RIGHT),
    (above**three_quarters, [above], 1, {}, []),
    ((x * y) ** three_quarters, [x, y], 1, {}, [*RIGHT, ge(y, 0)]),
    ((1 - x**2) ** three_quarters, [x], 1, {}, [le(x**2, 1)]),
    ((x**2 + above) ** three_quarters, [x, above], 1, {}, []),
    # parameters that may be 0 or negative, powers whose base may be
    (x + 1 / p, [x], 2, {}, []),
    (x * sp.sqrt(p), [x], 1, {}, []),
    (x * sp.log(p), [x], 1, {}, []),
    (x**p, [x], 1, {}, []),
    (sp.Abs(x) ** p, [x], 0, {}, []),
    (x**x, [x], 1, {}, []),
    ((-2) ** x, [x], 0, {}, []),
    (sp.Integer(0) ** above, [above], 0, {}, []),
    (x**n, [x], 2, {}, []),
    (F(1 / p) * x, [x], 2, {F: 2}, []),
    # values that are not real, or none at all
    (sp.I * x, [x], 1, {}, []),
    (c * x, [x], 1, {}, []),
    (x * sp.log(-1), [x], 1, {}, []),
    (sp.sqrt(-1 - x**2), [x], 1, {}, []),
    (sp.exp(sp.I * x), [x], 2, {}, []),
    (x + sp.oo, [x], 0, {}, []),
    (sp.Piecewise((x, x < 0)), [x], 0, {}, []),
    (sp.Piecewise((x, p > 0)), [x], 1, {}, []),
    (x * sp.Integral(1 / w, (w, 0, 1)), [x], 1, {}, []),
    # bound variables and derivatives
    (sp.Subs(sp.Abs(w * x), w, 1), [x], 1, {}, []),
    (sp.Subs(sp.Abs(w) + x, w, y), [x, y], 1, {}, []),
    (sp.Subs(w * sp.Abs(x), w, 2), [x], 1, {}, []),
    (sp.Derivative(sp.Abs(x), x), [x], 0, {}, []),
    (sp.Derivative(x * sp.Abs(x), x), [x], 1, {}, []),
    (sp.Derivative(sp.sign(x), x), [x], 0, {}, []),
    (sp.Derivative(sp.Piecewise((0, x < 0), (1, True)), x), [x], 0, {}, []),
    (sp.sign(x) * x**3 * sp.Integral(sp.Abs(x), (x, 0, 1)), [x], 2, {}, []),
    # functions are what they are declared to be
    (F(x, y), [x, y], 2, {F(x): 2}, []),
    (positive(x), [x], 2, {F(x): 2}, []),
    (F(-1 - x**2), [x], 2, {F(inside): 2}, []),
    (F(x), [x], 1, {F(n): 2}, []),
    (sp.diff(F(x**2), x), [x], 1, {F(w): 1}, []),
    (F(sp.Abs(x)), [x], 1, {F: 2}, []),
    (F(sp.floor(x)), [x], 0, {F: 2}, []),
    (sp.sqrt(F(x)), [x], 1, {F: 2}, []),
    (sp.Function("H")(x), [x], 1, {sp.Function("H")(x): 3}, []),
    # conditions
    (sp.Piecewise((1, sp.Eq(x, 0)), (2, True)), [x], 0, {}, []),
    (sp.Piecewise((1, (x > 0) & (y > 0)), (0, True)), [x, y], 0, {}, []),
    (sp.Piecewise((x**2, sp.Or(x > 0, x < -1)), (0, True)), [x], 0, {}, []),
    (sp.Piecewise((x, sp.Contains(x, sp.Rationals)), (0, True)), [x], 0, {}, []),
    (sp.Piecewise((1, sp.sqrt(x) > 1), (2, True)), [x], 0, {}, RIGHT),
    # kinks that are not glued
    (sp.Abs(x) ** 3 * sp.Abs(y), [x, y], 2, {}, []),
    (sp.Piecewise((x**3 * sp.Abs(y), x > 0), (0, True)), [x, y], 2, {}, []),
    (sp.Abs(sp.Abs(x) - 1) ** 3, [x], 1, {}, []),
    (sp.Abs(x) / x, [x], 0, {}, []),
    (sp.Max(x, y), [x, y], 1, {}, []),
    (sp.atan2(x, -1), [x], 0, {}, []),
    (sp.Mod(x, p), [x], 0, {}, []),
    # what SymPy refuses to compare at some of the points that are tried
    (y**3 * sp.sign(sp.sqrt(x - y)) * sp.Min(0, sp.sqrt(x - 1)) ** 3, [x, y], 1, {}, []),
    (sp.sin(sp.Max((x - 1) / (1 - x**2), sp.log(y**2 + 1))), [x, y], 2, {}, []),
    ((x**2 + 1) ** 3 * sp.Min(0, (x**2 + y**2) / (x * y)) ** 2, [x, y], 1, {}, []),
    # functions of which nothing is known
    (sp.gamma(x), [x], 1, {}, []),
    (sp.acot(x), [x], 0, {}, []),
    (sp.frac(x), [x], 0, {}, []),
    # variables that are none
    (n, [n], 1, {}, []),
    (c, [c], 1, {}, []),
]
# Smooth, though not shown to be; a point that says otherwise would be wrong.
NEVER_REFUTED = [
    (sp.Piecewise((1 / x, x > 0), (0, True)), [x], 2, {}, [le(x, 0)]),
    (sp.Abs(x - 1), [x], 1, {}, [Relation(x, "=", 1)]),
    (sp.Abs(x + 1), [x], 1, {}, [le(x, p), le(p, y), le(y, -2)]),
    (sp.sqrt(sp.Abs(sp.Abs(x) - sp.Rational(1, 16))), [x], 0, {}, []),
    (1 / F(x), [x], 1, {F: 2}, [ge(F(x), 1)]),
    (1 / sp.Function("N", nonzero=True)(x), [x], 1, {}, []),
    (1 / (x - sp.Symbol("m", integer=True, positive=True)), [x], 1, {}, [le(x, 0)]),
    (1 / (x - 1), [x], 1, {}, [lt(y, y), ge(x, 0)]),
    (sp.Max(0, x) + sp.Min(0, x), [x], 2, {}, []),
    (sp.cos(sp.sqrt(x)), [x], 2, {}, []),
]


@pytest.mark.parametrize("question", SMOOTH, ids=str)
def test_proved(question):
    assert smoothness(*question).verdict is Verdict.PROVED


@pytest.mark.parametrize("question", TRAPS, ids=str)
def test_a_trap_is_not_proved(question):
    assert smoothness(*question).verdict is not Verdict.PROVED


@pytest.mark.parametrize("question", NEVER_REFUTED, ids=str)
def test_what_may_be_smooth_is_not_refuted(question):
    assert smoothness(*question).verdict is not Verdict.REFUTED


def test_an_assumption_for_all_values_is_not_overlooked_by_a_witness():
    statement = Smooth((1 / F(x),), (x,), 1, ((F(x), 2),))
    assert smooth(Goal("free", statement)).verdict is Verdict.REFUTED
    bounded = ForAll((x,), ge(F(x), 1))
    assert smooth(Goal("bounded", statement, (bounded,))).verdict is Verdict.UNDECIDED


@pytest.mark.parametrize("order", [-1, half, sp.oo, x])
def test_an_order_is_a_natural_number(order):
    with pytest.raises(InputError, match="order of differentiability"):
        smoothness(x, [x], order)


def test_the_witness_names_a_value_for_every_symbol_of_the_domain():
    found = smoothness(sp.Abs(x), [x], 1, {}, [le(p, 0), le(x, p + 1)])
    assert found.verdict is Verdict.REFUTED
    assert set(found.witness.values) == {"x", "p"}
