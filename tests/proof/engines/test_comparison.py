"""The comparison lemma: shown with every hypothesis, and not shown when one of them is missing."""

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.claim import Goal, claim
from ptproof.proof.engines.comparison import comparison
from ptproof.proof.engines.quantified import entailed, specialise
from ptproof.proof.engines.reals import reals
from ptproof.proof.engines.witnesses import refute
from ptproof.proof.statement import ForAll, eq, ge, gt, le, lt
from ptproof.proof.verdict import Verdict

s, t0, tau = sp.symbols("s t0 tau", real=True)
a, b = sp.symbols("a b", positive=True)
v = sp.Function("v", nonnegative=True)
w = sp.Function("w", real=True)
after = ge(tau, t0)


def rate(value, of=v, domain=None):
    return ForAll((s,), le(sp.Derivative(of(s), s), value), (ge(s, t0),) if domain is None else domain)


def run(statement, given, solution, **more):
    return comparison(Goal("test", statement, tuple(given)), solution, **more).verdict


decay = v(t0) * sp.exp(-a * (s - t0))
decayed = le(v(tau), v(t0) * sp.exp(-a * (tau - t0)))


def test_exponential_decay():
    assert run(decayed, [after, rate(-a * v(s))], decay) is Verdict.PROVED


def test_a_solution_above_the_equation():
    # The solution of v' = -a v + b from v(t0) + b/a is b/a + v(t0) e^(-a (s - t0)).
    bound = le(v(tau), v(t0) * sp.exp(-a * (tau - t0)) + b / a)
    assert run(bound, [after, rate(-a * v(s) + b)], decay + b / a) is Verdict.PROVED
    higher = le(v(tau), v(t0) + 2 * b * (tau - t0))
    assert run(higher, [after, rate(b)], v(t0) + 2 * b * (s - t0)) is Verdict.PROVED


def test_a_rate_with_a_saturation():
    follows = -sp.Min(a, sp.Max(-a, w(s))) + b
    assert run(le(w(tau), a), [after, le(w(t0), a), le(b, a), rate(follows, w)], a) is Verdict.PROVED
    assert run(le(w(tau), a), [after, le(w(t0), a), rate(follows, w)], a) is Verdict.UNDECIDED
    assert run(le(w(tau), a), [after, le(b, a), rate(follows, w)], a) is Verdict.UNDECIDED


def test_a_rate_that_is_clipped_in_time():
    gain = sp.Max(1, s - t0)
    bound, solution = le(v(tau), v(t0) * sp.exp(-(tau - t0))), v(t0) * sp.exp(-(s - t0))
    assert run(bound, [after, rate(-gain * v(s))], solution) is Verdict.PROVED
    assert run(bound, [after, rate(-sp.Min(1, s - t0) * v(s))], solution) is Verdict.UNDECIDED


def test_a_rate_without_the_value_needs_no_sign():
    assert run(le(w(tau), w(t0) - tau + t0), [after, rate(-1, w)], w(t0) - (s - t0)) is Verdict.PROVED


NOT_SHOWN = {
    "a start below": (decayed, [after, rate(-a * v(s))], decay / 2, {}),
    "before the start": (decayed, [rate(-a * v(s))], decay, {}),
    "after the end of the domain": (decayed, [after, rate(-a * v(s), domain=(ge(s, t0), le(s, t0 + 1)))], decay, {}),
    "a hole in the domain": (decayed, [after, rate(-a * v(s), domain=(ge(s, t0), gt((s - 1) ** 2, 1)))], decay, {}),
    "another rate": (decayed, [after, rate(-a * v(s) + b)], decay, {}),
    "a pole of the rate": (
        le(v(tau), v(t0) * (tau - 1) / (t0 - 1)), [after, rate(v(s) / (s - 1))], v(t0) * (s - 1) / (t0 - 1), {},
    ),
    "a pole of the solution": (
        le(v(tau), v(t0) / (1 - v(t0) * (tau - t0))), [after, rate(v(s) ** 2)], v(t0) / (1 - v(t0) * (s - t0)), {},
    ),
    "a rate that is not Lipschitz": (le(v(tau), (tau - t0) ** 2 / 4), [after, eq(v(t0), 0), rate(sp.sqrt(v(s)))],
                                     (s - t0) ** 2 / 4, {}),
    "a maximum with a side that is not Lipschitz": (
        le(v(tau), (tau - t0) ** 2 / 4), [after, eq(v(t0), 0), rate(sp.Max(sp.sqrt(v(s)), v(s)))],
        (s - t0) ** 2 / 4, {},
    ),
    "a root of a maximum": (
        le(v(tau), (tau - t0) ** 2 / 4), [after, eq(v(t0), 0), rate(sp.sqrt(sp.Max(v(s), v(s) / 2)))],
        (s - t0) ** 2 / 4, {},
    ),
    "a quotient by a minimum": (
        le(v(tau), v(t0) + tau - t0), [after, rate(1 / sp.Min(1, v(s)))], v(t0) + s - t0, {},
    ),
    "a solution with a kink": (
        le(w(tau), sp.Max(w(t0), tau)), [after, rate(sp.Max(0, s), w)], sp.Max(w(t0), s), {},
    ),
    "a bound below the solution": (
        le(v(tau), v(t0) * sp.exp(-2 * a * (tau - t0))), [after, rate(-a * v(s))], decay, {},
    ),
    "a start at zero that is called positive": (le(v(tau), -1), [after, eq(v(t0), 0), rate(-a * v(s))], decay, {}),
    "a power of a function without a sign": (
        le(w(tau), w(t0)), [after, rate(-(w(s) ** sp.Rational(3, 2)), w)], w(t0), {},
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", NOT_SHOWN)
def test_is_not_proved(case):
    statement, given, solution, more = NOT_SHOWN[case]
    assert run(statement, given, solution, **more) is not Verdict.PROVED


def test_positive_denominator_from_a_quantified_assumption():
    bound = le(v(tau), v(t0) / (1 - v(t0) * (tau - t0)))
    stays = ForAll((s,), gt(1 - v(t0) * (s - t0), 0), (ge(s, t0), le(s, tau)))
    solution, denominators = v(t0) / (1 - v(t0) * (s - t0)), [1 - v(t0) * (s - t0)]
    assert run(bound, [after, stays, rate(v(s) ** 2)], solution, denominators=denominators) is Verdict.PROVED


def assuming(*given):
    return Goal("test", le(0, 1), given)


def test_entailed_on_a_smaller_interval_only():
    wide, narrow = rate(-a * v(s)), rate(-a * v(s), domain=(ge(s, tau),))
    assert entailed(narrow, assuming(after, wide)).shown
    assert not entailed(wide, assuming(after, narrow)).shown
    assert not entailed(narrow, assuming(wide)).shown


def test_entailed_does_not_use_what_is_known_of_a_free_namesake():
    assert not entailed(ForAll((s,), le(s, 1)), assuming(le(s, 1))).shown


@claim("test/decay", "decay", decayed, given=[after, rate(-a * v(s))])
def decays(goal):
    return comparison(goal, decay)


q = sp.Symbol("q", real=True)


def at_q(given, values):
    goal = Goal("test", le(v(q), v(tau) * sp.exp(-a * (q - tau))), tuple(given), (decays,))
    return reals(goal, *specialise(goal, decays, values)).verdict


def test_specialise_moves_the_interval():
    assert at_q([after, ge(q, tau), rate(-a * v(s))], {t0: tau, tau: q}) is Verdict.PROVED


def test_specialise_leaves_plain_assumptions_to_z3():
    assert at_q([after, rate(-a * v(s))], {t0: tau, tau: q}) is not Verdict.PROVED


def test_specialise_refuses_an_interval_that_is_not_covered():
    with pytest.raises(InputError, match="does not follow"):
        at_q([ge(q, tau), lt(tau, t0), rate(-a * v(s))], {t0: tau, tau: q})


def test_specialise_refuses_a_value_of_the_wrong_sign():
    with pytest.raises(InputError, match="not known to be"):
        at_q([after, ge(q, tau), rate(-a * v(s))], {t0: tau, tau: q, a: q})


def test_specialise_takes_a_sign_that_z3_shows():
    goal = Goal("test", le(v(q), v(t0)), (after, gt(q, t0), rate(-(q - t0) * v(s))), (decays,))
    (fact,) = specialise(goal, decays, {a: q - t0, tau: q})
    assert fact.says.conclusion == le(v(q), v(t0) * sp.exp(-((q - t0) ** 2)))


def test_specialise_refuses_capture():
    with pytest.raises(InputError, match="caught"):
        at_q([after, ge(q, tau), rate(-a * v(s))], {t0: s, tau: q})


def test_a_witness_must_satisfy_a_quantified_assumption_everywhere():
    x = sp.Symbol("x", real=True)
    F = sp.Function("F", real=True)(x)
    goal = Goal("test", le(x * F, -1), (ForAll((x,), le(F, 0)),))
    assert refute(goal, {x: -1, F: x}).verdict is Verdict.UNDECIDED
    assert refute(goal, {x: -1, F: -(x**2)}).verdict is Verdict.REFUTED


def test_what_is_known_of_a_base_survives_its_roots():
    order = sp.Symbol("order", positive=True, integer=True)
    goal = Goal("test", le(1, order), (le(order ** (1 / (2 * order + 1)), w(s)),))
    assert reals(goal).verdict is Verdict.PROVED
    assert reals(Goal("test", le(2, order), goal.assumptions)).verdict is not Verdict.PROVED
