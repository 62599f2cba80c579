"""Claims about a function of time at a composed function; quantified assumptions on several variables; examples."""

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.claim import Goal, claim
from ptproof.proof.deciding import run_one
from ptproof.proof.engines.comparison import comparison
from ptproof.proof.engines.quantified import instances, specialise
from ptproof.proof.engines.reals import reals
from ptproof.proof.statement import ForAll, eq, ge, le
from ptproof.proof.verdict import Verdict

s, x, y, t0, tau = sp.symbols("s x y t0 tau", real=True)
a = sp.Symbol("a", positive=True)
W, X, F = (sp.Function(name, real=True) for name in ("W", "X", "F"))
domain = (ge(s, t0), le(s, tau))
after = ge(tau, t0)


@claim(
    "test/falls", "falls", le(W(tau), W(t0) * sp.exp(-a * (tau - t0))),
    given=[after, ForAll((s,), le(sp.Derivative(W(s), s), -a * W(s)), domain)],
)  # fmt: skip
def falls(goal):
    return comparison(goal, W(t0) * sp.exp(-a * (s - t0)))


moves = ForAll((s,), eq(sp.Derivative(X(s), s), -a * X(s)), domain)


def square_falls(rate):
    """d/dτ X² = 2XX′, along a solution of X′ = −aX."""

    @claim("test/rate", "rate", le(sp.Derivative(X(tau) ** 2, tau), rate * X(tau) ** 2), given=[after, moves])
    def along_solution(goal):
        return reals(goal, *instances(goal, tau))

    return along_solution


def composed(used, given=(after, moves)):
    goal = Goal("test", le(X(tau) ** 2, X(t0) ** 2 * sp.exp(-a * (tau - t0))), tuple(given), (falls, used))

    def along(there, point):
        return specialise(there, used, {tau: point})

    return reals(goal, *specialise(goal, falls, {W(s): X(s) ** 2}, along=along)).verdict


def test_a_function_of_time_is_put_in_along_a_solution():
    used = square_falls(-2 * a)
    assert run_one(used).verdict is Verdict.PROVED
    assert composed(used) is Verdict.PROVED


def test_not_with_a_rate_that_is_too_weak():
    used = square_falls(-2 * a)
    goal = Goal("test", le(X(tau) ** 2, X(t0) ** 2), (after, moves), (falls, used))
    with pytest.raises(InputError, match="does not follow"):
        specialise(
            goal, falls, {a: 4 * a, W(s): X(s) ** 2},
            along=lambda there, point: specialise(there, used, {tau: point}),
        )  # fmt: skip


def test_not_where_the_solution_ends_before():
    short = ForAll((s,), moves.relation, (ge(s, t0), le(s, tau - 1)))
    with pytest.raises(InputError, match="does not follow"):
        composed(square_falls(-2 * a), (after, short))


def test_not_with_facts_of_a_claim_that_is_not_used():
    used = square_falls(-2 * a)
    goal = Goal("test", le(X(tau) ** 2, X(t0) ** 2), (after, moves), (falls,))
    with pytest.raises(InputError, match="not among the claims used"):
        specialise(goal, falls, {W(s): X(s) ** 2}, along=lambda there, point: specialise(there, used, {tau: point}))


everywhere = ForAll((x, y), le(F(x, y), x**2 + y**2))


def test_several_variables_at_a_point():
    goal = Goal("test", le(F(X(tau), 1), X(tau) ** 2 + 1), (everywhere,))
    assert reals(goal, *instances(goal, (X(tau), 1))).verdict is Verdict.PROVED


@pytest.mark.parametrize("point", [X(tau), (X(tau),), (X(tau), 1, 2), (X(tau), sp.sqrt(tau))])
def test_no_instance_at_a_point_of_another_kind(point):
    assert instances(Goal("test", le(0, 1), (everywhere,)), point) == []


def test_a_free_letter_is_not_the_bound_one():
    @claim("test/there", "there", le(F(x, y), x**2 + y**2), given=[everywhere])
    def there(goal):
        return reals(goal, *instances(goal, (x, y)))

    goal = Goal("test", le(F(1, y), 1 + y**2), (everywhere,), (there,))
    assert reals(goal, *specialise(goal, there, {x: 1})).verdict is Verdict.PROVED
    other = Goal("test", le(F(1, y), 1 + y**2), (ForAll((y,), le(F(1, y), 1 + y**2)),), (there,))
    with pytest.raises(InputError, match="does not follow"):
        specialise(other, there, {x: 1})


HARD = [ForAll((x, y), eq(F(x, y), x**2 + 3 * y**2 + sp.Rational(17, 19)))]
VALUES = {F(x, y): x**2 + 3 * y**2 + sp.Rational(17, 19), x: 1, y: 2}


def with_example(values, statement=None):
    @claim("test/example", "example", statement or ge(F(x, y), 0), given=HARD, example=values)
    def exemplified(goal):
        return reals(goal, *instances(goal, (x, y)))

    return run_one(exemplified)


def test_an_example_is_checked():
    assert with_example(VALUES).verdict is Verdict.PROVED


@pytest.mark.parametrize("wrong", [{F(x, y): x**2}, {F(x, y): sp.sqrt(x)}, {y: sp.I}])
def test_what_is_no_example_proves_nothing(wrong):
    found = with_example(VALUES | wrong)
    assert found.verdict is Verdict.UNDECIDED
    assert "the example is none" in found.detail
