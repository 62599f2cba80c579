"""No verdict rests on SymPy's definite integrals, limits or sums, which have been wrong without notice."""

from __future__ import annotations

from collections.abc import Callable

import pytest
import sympy as sp

from ptproof.proof.claim import Goal
from ptproof.proof.engines.enclosures import enclosures
from ptproof.proof.engines.evaluation import carried_out
from ptproof.proof.engines.exact import exact
from ptproof.proof.engines.integrals import integrals
from ptproof.proof.engines.limits import limits
from ptproof.proof.engines.reals import reals
from ptproof.proof.engines.witnesses import check_witness
from ptproof.proof.statement import Relation, eq, ge, le
from ptproof.proof.verdict import Evidence, Verdict

x = sp.Symbol("x", real=True)
s = sp.Symbol("s", positive=True)
arch = sp.Integral(sp.Abs(sp.sin(x)), (x, 0, 7 * sp.pi))  # 14; SymPy says 2
product = sp.Integral(sp.Abs(sp.sin(x) * sp.cos(x)), (x, 0, 2 * sp.pi))  # 2; SymPy says 1
one_sided = sp.Limit(sp.atan((1 - s) ** sp.Rational(-1, 2)), s, 1, "-")  # π/2; SymPy says −π/2


ENGINES = [exact, integrals, limits, reals, enclosures]
FALSE = [eq(arch, 2), le(arch, 3), eq(product, 1), le(product, sp.Rational(3, 2)), le(one_sided, 0)]
TRUE = [eq(arch, 14), ge(arch, 13), eq(product, 2), eq(one_sided, sp.pi / 2), ge(one_sided, 0)]


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("relation", FALSE, ids=str)
def test_false_value_from_sympy_is_not_proved(engine: Callable[[Goal], Evidence], relation: Relation) -> None:
    assert engine(Goal("t", relation)).verdict is not Verdict.PROVED


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("relation", TRUE, ids=str)
def test_true_value_is_not_refuted_by_sympy(engine: Callable[[Goal], Evidence], relation: Relation) -> None:
    assert engine(Goal("t", relation)).verdict is not Verdict.REFUTED


def test_witness_with_an_integral_that_the_rules_give() -> None:
    tail = sp.Integral(1 / (1 + x / s) ** 2, (x, 0, sp.oo))
    assert check_witness(Goal("t", eq(tail, 2 * s)), {s: 1})[0] is not None
    assert check_witness(Goal("t", eq(tail, s)), {s: 1})[0] is None


def test_sympy_s_own_evaluation_is_still_wrong() -> None:
    """What the tests above guard against; if this fails, SymPy has been mended."""
    assert (arch.doit(), product.doit(), one_sided.doit()) == (2, 1, -sp.pi / 2)


def test_limit_of_an_undefined_function_is_not_asked_of_sympy() -> None:
    f = sp.Function("f", real=True)(s)
    goal = Goal("t", ge(sp.Limit(f, s, 1, "-"), 0))
    assert check_witness(goal, {f: sp.atan((1 - s) ** sp.Rational(-1, 2)), s: 2})[0] is None


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        (sp.Derivative(x**2, x), 2 * x),
        (sp.Derivative(sp.Integral(sp.cos(s), (s, 0, x)), x), sp.cos(x)),
        (sp.Integral(sp.Derivative(sp.sin(x), x), (x, 0, sp.pi / 2)), 1),
        (sp.Limit(s / (1 + s), s, sp.oo, "-"), 1),
        (sp.Sum(s, (s, 1, 3)), None),
        (arch, None),
        (one_sided, None),
    ],
)
def test_values_by_rule(expression: sp.Expr, value: sp.Expr | None) -> None:
    assert carried_out(expression) == value
