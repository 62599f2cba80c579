"""Expressions as JavaScript: what has no exact counterpart is refused by name, never printed as something else."""

from itertools import pairwise

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.report.instruments.javascript import expression, function

x, y = sp.symbols("x y", real=True)
F = sp.Function("F", real=True)
OTHERS = {name: sp.Function(name, real=True) for name in ("exp", "Max", "sin", "Abs")}


@pytest.mark.parametrize(
    "source",
    [
        F(x), sp.Integral(F(x), (x, 0, 1)), sp.Derivative(F(x), x), sp.Limit(F(x), x, 0), sp.LambertW(x), sp.erf(x),
        sp.gamma(x), sp.factorial(x), sp.cot(x), sp.sec(x), sp.I * x, sp.zoo, sp.nan, sp.Sum(x, (y, 1, 3)),
        sp.Matrix([x]), sp.DiracDelta(x), sp.ITE(x < 1, y < 1, y > 2), sp.Xor(x < 1, y < 1), sp.re(F(x)),
        OTHERS["exp"](x), OTHERS["Max"](x, y), OTHERS["sin"](x), OTHERS["Abs"](x), sp.Integer(10) ** 400 * x,
        sp.Rational(1, 10**400) * x, sp.log(x, 2, evaluate=False),
    ],
    ids=str,
)  # fmt: skip
def test_what_has_no_exact_counterpart_is_refused(source):
    with pytest.raises(InputError, match=r"JavaScript"):
        expression(source, {x: "x", y: "y"})


def test_the_refusal_names_what_it_is_about():
    with pytest.raises(InputError, match=r"LambertW\(x\) has no exact counterpart"):
        function([x + sp.exp(sp.LambertW(x) * y)], {"s": [x, y]})


def test_a_symbol_without_a_value_is_refused():
    with pytest.raises(InputError, match="q has no value"):
        function([x + sp.Symbol("q")], {"s": [x]})


def test_letters_of_the_language_are_no_trouble():
    odd = sp.symbols("class function `${1} </script> return", real=True)
    assert function([sp.Add(*odd)], {"s": odd}).count("s[") == len(odd)


def test_what_is_shared_is_computed_once():
    shared = sp.sqrt(x + y)
    assert function([shared, shared * x, sp.exp(shared)], {"s": [x, y]}).count("Math.sqrt") == 1


def test_it_is_the_same_in_every_run():
    """However many letters somebody has made before."""
    parts = [sp.sqrt(x + n * y) + 1 for n in range(1, 30)]
    sources = [sum(parts), *(a * b for a, b in pairwise(parts))]
    assert len({function(sources, {"s": [x, y]}) for _ in range(12)}) == 1
