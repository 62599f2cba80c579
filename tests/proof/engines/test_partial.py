"""Functions with poles or roots, as examples and witnesses: only where they are used away from these."""

from __future__ import annotations

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.proof import ForAll, Goal, eq, ge, gt, le, lt
from ptproof.proof.engines.partial import values_where_used
from ptproof.proof.engines.witnesses import at_example, check_witness

s, t, u = sp.symbols("s t u", real=True)
X = sp.Function("X", real=True)
P, N, Z = (
    sp.Function(name, **{kind: True}) for name, kind in (("P", "positive"), ("N", "nonnegative"), ("Z", "nonzero"))
)
root = 1 / sp.sqrt(1 + 4 * s)
moves = ForAll((s,), eq(sp.Derivative(X(s), s), -2 * X(s) ** 3), (ge(s, 0), le(s, t)))
falls = Goal("falls", le(X(t), X(0)), (moves, gt(t, 0)))


def used_on(function, *domain, statement=None):
    """A goal that takes the function on a domain."""
    return Goal("used", statement or ge(t, 0), (ForAll((s,), le(function(s), 9), domain),))


def test_a_solution_with_a_pole_before_the_start_is_an_example():
    assert at_example(falls, {X(s): root, t: 1})[0]


def test_it_is_a_witness_against_what_is_false():
    goal = Goal("rises", ge(X(t), X(0)), falls.assumptions)
    witness, _ = check_witness(goal, {X(s): root, t: 1})
    assert witness is not None


def test_what_does_not_solve_the_system_is_no_example():
    assert not at_example(falls, {X(s): 1 / sp.sqrt(1 + 5 * s), t: 1})[0]


closed, half_open = (ge(s, 0), le(s, 1)), (ge(s, 0), lt(s, 1))
FITS = {
    "a pole outside": (X, 1 / (1 + s), closed),
    "a pole outside of a half-line": (X, 1 / (1 + s), (ge(s, 0),)),
    "a positive one": (P, 1 / (1 + s), closed),
    "one that is not negative, away from 0": (N, 1 / (1 + s), closed),
    "one that is never 0": (Z, -1 / (1 + s), closed),
    "a root at what is never 0": (X, sp.sqrt(1 + s), closed),
}
DOES_NOT = {
    "a pole inside": (X, 1 / (s - sp.Rational(1, 2)), closed),
    "a pole at the end": (X, 1 / (1 - s), closed),
    "a pole at an end that the domain leaves out": (X, 1 / (1 - s), half_open),
    "a pole somewhere on the line": (X, 1 / (1 + s), ()),
    "a root at 0": (X, sp.sqrt(s), closed),
    "a kink": (X, sp.Abs(s - sp.Rational(1, 2)) / (1 + s), closed),
    "a jump": (X, sp.floor(s) / (1 + s), closed),
    "a positive one that is 0 at the end": (P, s / (1 + s), closed),
    "one that would have to turn negative behind its end": (N, s / (1 + s), closed),
    "a negative one": (P, -1 / (1 + s), closed),
    "one that changes its sign": (Z, (s - sp.Rational(1, 2)) / (1 + s), closed),
    "positive on one part and negative on the other": (Z, 1 / s, (ge(s**2, 1),)),
    "a domain that is not closed": (X, 1 / s, (ge(1 / s, 1),)),
}


@pytest.mark.parametrize("name", FITS)
def test_is_accepted_where_it_is_defined(name):
    function, value, domain = FITS[name]
    values_where_used(used_on(function, *domain), {function(s): value, t: 1})


@pytest.mark.parametrize("name", DOES_NOT)
def test_is_refused_where_it_is_not(name):
    function, value, domain = DOES_NOT[name]
    with pytest.raises(InputError):
        values_where_used(used_on(function, *domain), {function(s): value, t: 1})


ELSEWHERE = {
    "at a number": le(X(-1), t),
    "at a letter's value": le(X(-t), t),
    "in a limit": eq(sp.Limit(X(u), u, 0, "+"), t),
    "in an integral": ge(sp.Integral(X(u), (u, -2, t)), 0),
    "at what is not linear": ge(X(X(t)), 0),
    "at its pole, under a derivative": eq(sp.Derivative(X(t - 2), t), 1),
}


@pytest.mark.parametrize("name", ELSEWHERE)
def test_is_no_witness_where_the_statement_takes_it_elsewhere(name):
    with pytest.raises(InputError):
        values_where_used(used_on(X, *closed, statement=ELSEWHERE[name]), {X(s): 1 / (1 + s), t: 1})


def test_an_example_speaks_of_the_assumptions_only_where_the_statement_cannot_be_followed():
    goal = Goal("limit", eq(sp.Limit(X(u), u, sp.oo, "-"), 0), falls.assumptions)
    assert at_example(goal, {X(s): root, t: 1})[0]


def test_a_value_with_another_letter_is_refused():
    with pytest.raises(InputError):
        values_where_used(used_on(X, *closed), {X(s): 1 / (t + s), t: 1})
