"""A limit is decided by the limits engine alone: SymPy's own limits never make a verdict."""

import sympy as sp

from ptproof.proof.claim import Goal, claim
from ptproof.proof.engines.exact import exact
from ptproof.proof.engines.limits import limits
from ptproof.proof.engines.quantified import instances
from ptproof.proof.engines.reals import reals
from ptproof.proof.engines.squeeze import squeezed
from ptproof.proof.statement import ForAll, eq, ge, gt, le, lt
from ptproof.proof.verdict import Verdict

x, end = sp.symbols("x end", real=True)
a = sp.Symbol("a", positive=True)
R = sp.Function("R", nonnegative=True)
sinc = eq(sp.Limit(sp.sin(x) / x, x, 0, "-"), 1)


def test_exact_algebra_does_not_evaluate_a_limit():
    assert exact(Goal("test", sinc)).verdict is not Verdict.PROVED


def test_z3_does_not_evaluate_a_limit():
    assert reals(Goal("test", sinc)).verdict is not Verdict.PROVED


@claim("test/limit", "limit", eq(sp.Limit(1 / x, x, sp.oo, "-"), 0))
def a_limit(goal):
    return limits(goal)


def test_a_limit_among_the_claims_used_does_no_harm():
    assert reals(Goal("test", le(x, x + 1), (), (a_limit,))).verdict is Verdict.PROVED


def test_a_limit_inside_a_limit_has_no_value():
    inner = sp.Limit(sp.sin(end) / end, end, 0, "-")
    assert limits(Goal("test", eq(sp.Limit(inner + 1 / x, x, sp.oo, "-"), 1))).verdict is not Verdict.PROVED


def test_z3_takes_only_functions_that_are_declared_real():
    unknown, known = sp.Function("f")(x), sp.Function("g", real=True)(x)
    assert reals(Goal("test", ge(unknown**2, 0))).verdict is not Verdict.PROVED
    assert reals(Goal("test", ge(known**2, 0))).verdict is Verdict.PROVED


def below(bound, near, given=True):
    assumed = ForAll((x,), le(R(x), 1 / x), (ge(x, 1),))
    goal = Goal("test", eq(sp.Limit(R(x), x, sp.oo, "-"), 0), (assumed,) if given else ())
    return squeezed(goal, bound, near, lambda there: instances(there, x)).verdict


def test_a_squeeze():
    assert below(1 / x, [gt(x, 2)]) is Verdict.PROVED


def test_no_squeeze_without_the_bound():
    assert below(1 / x, [gt(x, 2)], given=False) is Verdict.UNDECIDED


def test_no_squeeze_by_a_bound_that_stays():
    assert below(1 / x + a, [gt(x, 2)]) is Verdict.UNDECIDED


def test_no_squeeze_on_a_domain_that_is_not_near():
    assert below(1 / x, [gt(x, 2), lt(x, 5)]) is Verdict.UNDECIDED


def test_no_squeeze_of_a_function_without_a_sign():
    S = sp.Function("S", real=True)
    assumed = ForAll((x,), le(S(x), 1 / x), (ge(x, 1),))
    goal = Goal("test", eq(sp.Limit(S(x), x, sp.oo, "-"), 0), (assumed,))
    assert squeezed(goal, 1 / x, [gt(x, 2)], lambda there: instances(there, x)).verdict is Verdict.UNDECIDED
