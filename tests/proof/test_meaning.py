"""What a claim means: ten forms of each way in which something false could once be shown, and a true twin beside it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
import sympy as sp

from ptproof.proof import (
    All,
    Claim,
    Evidence,
    Exists,
    ForAll,
    Goal,
    Implication,
    Relation,
    Verdict,
    claim,
    comparison,
    decide,
    defeats_every_choice,
    eq,
    every,
    exact,
    exists_by,
    ge,
    gt,
    instances,
    integrals,
    le,
    limits,
    lt,
    reals,
    refute,
    specialise,
    squeezed,
)
from ptproof.proof import lemmas as library
from ptproof.proof.deciding import run_one

x, y, c, s, t = sp.symbols("x y c s t", real=True)
n = sp.Symbol("n", integer=True)
a = sp.Symbol("a", positive=True)
F, V = sp.Function("F", real=True), sp.Function("V", nonnegative=True)
half = sp.Rational(1, 2)


@pytest.fixture(autouse=True)
def short_search(monkeypatch: pytest.MonkeyPatch) -> None:
    """Most that is not proved here has no witness, and a search can only refute: to its end it would only take time."""
    monkeypatch.setattr("ptproof.proof.settling.SEARCH_SECONDS", 0.05)


def verdict(statement: Any, proof: Callable[[Goal], Evidence] = exact, *given: Any, **options: Any) -> Verdict:
    return run_one(claim("t", "T", statement, given=given, **options)(proof)).verdict


UNDEFINED = [
    (eq(x * (1 / x + 1), 1 + x), Ellipsis),
    (eq((x**2 - 1) / (x - 1), x + 1), Ellipsis),
    (eq(sp.log(x**2), 2 * sp.log(sp.Abs(x))), Ellipsis),
    (eq(sp.tan(x) * sp.cos(x), sp.sin(x)), Ellipsis),
    (eq((1 / (x - y) + 1) * (x - y), 1 + x - y), eq(x, y)),
    (eq(sp.sqrt(x) * sp.sqrt(x + 1) * 2, 2 * sp.sqrt(x) * sp.sqrt(1 + x)), Ellipsis),
    (eq(F(1 / x) - F(1 / x) + x / (y + 1) * (y + 1) + sp.acos(x) - sp.acos(x) + 1 / (1 + 1 / x), x + x / (x + 1)), ...),
    (eq(sp.Derivative(sp.Abs(x), x), sp.sign(x)), Ellipsis),
    (eq(sp.Derivative(sp.sign(x), x) + x, x), Ellipsis),
    (eq(sp.Derivative(sp.Piecewise((1, y < 1), (2, True)), y), 0), Ellipsis),
    (eq(sp.Derivative(sp.sqrt(x**2), x) ** 2, 1), Ellipsis),
    (eq(sp.Piecewise((1 / x, x < 1), (x, True)) * x, sp.Piecewise((1, x < 1), (x**2, True))), Ellipsis),
]  # fmt: skip


@pytest.mark.parametrize(("statement", "given"), UNDEFINED)
def test_what_is_undefined_somewhere_is_not_proved(statement: Any, given: Any) -> None:
    assert verdict(statement, exact, *([] if given is Ellipsis else [given])) is not Verdict.PROVED


@pytest.mark.parametrize(("statement", "given"), [
    (eq(x * (1 / x + 1), 1 + x), gt(x, 0)),
    (eq((x**2 - 1) / (x - 1), x + 1), gt(x, 1)),
    (eq((1 / (x - y) + 1) * (x - y), 1 + x - y), lt(x, y)),
    (eq(x * (1 / (a * x) + 1), 1 / a + x), lt(x, -1)),
    (eq(sp.Derivative(F(1 / x) * x, x), F(1 / x) + x * sp.Derivative(F(1 / x), x)), gt(x, 0)),
])  # fmt: skip
def test_it_is_proved_where_the_assumptions_keep_it_defined(statement: Any, given: Any) -> None:
    assert verdict(statement, exact, given) is Verdict.PROVED


def test_a_claim_may_say_that_it_speaks_only_of_where_it_is_defined() -> None:
    assert verdict(UNDEFINED[0][0], exact, where_defined=True) is Verdict.PROVED


def test_such_a_claim_is_a_fact_only_where_it_is_defined() -> None:
    limited = claim("used", "U", UNDEFINED[0][0], where_defined=True)(exact)
    assert verdict(gt(x**2, 0), reals, uses=[limited]) is not Verdict.PROVED
    found = decide([claim("top", "T", gt(x**2, 0), uses=[limited])(reals)])
    assert found.results[-1].verdict is not Verdict.PROVED


CAPTURE = [
    (eq(sp.Derivative(c * x, x), c), {c: x}, eq(x, 2 * x)),
    (eq(sp.Derivative(c * x**2, x), 2 * c * x), {c: x}, eq(3 * x**2, 2 * x**2)),
    (eq(sp.Integral(c, (x, 0, 1)), c), {c: x}, eq(half, x)),
    (eq(sp.Integral(c * x, (x, 0, 1)), c / 2), {c: x}, eq(sp.Rational(1, 3), x / 2)),
    (eq(sp.Derivative(F(c) * x, x), F(c)), {c: x}, eq(sp.Derivative(F(x) * x, x), F(x))),
    (eq(sp.Derivative(c * x, x), c), {c: x**2}, eq(3 * x**2, x**2)),
    (eq(sp.Subs(c * x, x, 2), 2 * c), {c: x}, eq(4, 2 * x)),
    (eq(sp.Derivative(c * x * y, x, y), c), {c: x * y}, eq(4 * x * y, x * y)),
]


@pytest.mark.parametrize(("statement", "values", "wrong"), CAPTURE)
def test_a_value_is_never_caught(statement: Any, values: Any, wrong: Any) -> None:
    fact = claim("used", "U", statement)(integrals if statement.left.has(sp.Integral) else exact)
    proof = lambda goal: reals(goal, *specialise(goal, fact, values))  # noqa: E731
    assert verdict(wrong, proof, uses=[fact]) is not Verdict.PROVED


def test_a_witness_is_checked_without_capture() -> None:
    assert verdict(eq(sp.Derivative(c * x, x), c), lambda goal: refute(goal, {c: 2, x: 3})) is not Verdict.REFUTED
    assert verdict(eq(sp.Integral(c, (x, 0, 1)), c), lambda goal: refute(goal, {c: 2, x: 3})) is not Verdict.REFUTED


def test_an_instance_of_an_assumption_is_taken_without_capture() -> None:
    assumed = ForAll((c,), eq(sp.Integral(c * x, (x, 0, 1)), c / 2))
    proof = lambda goal: reals(goal, *instances(goal, x))  # noqa: E731
    assert verdict(eq(sp.Integral(x * x, (x, 0, 1)), x / 2), proof, assumed) is not Verdict.PROVED


KINDS = [
    (sp.Function("g", negative=True), lt, x**2),
    (sp.Function("g", negative=True), lt, x),
    (sp.Function("g", positive=True), gt, x**2),
    (sp.Function("g", positive=True), gt, sp.sqrt(x)),
    (sp.Function("g", nonnegative=True), ge, x**3),
    (sp.Function("g", positive=True), gt, x),
    (sp.Function("g", positive=True), gt, 1 / x**2),
    (sp.Function("g", nonpositive=True), le, sp.sin(x)),
]


@pytest.mark.parametrize(("g", "relation", "value"), KINDS)
def test_a_function_is_replaced_only_by_what_it_was_declared_to_be(g: Any, relation: Any, value: sp.Expr) -> None:
    fact = claim("used", "U", relation(g(x), 0))(reals)
    proof = lambda goal: reals(goal, *specialise(goal, fact, {g(x): value}))  # noqa: E731
    assert verdict(relation(value, 0), proof, uses=[fact]) is not Verdict.PROVED


def test_the_sign_of_an_argument_says_nothing_of_other_arguments() -> None:
    g = sp.Function("g", positive=True)
    fact = claim("used", "U", gt(g(a) + g(-a), 0))(reals)
    proof = lambda goal: reals(goal, *specialise(goal, fact, {g(a): a}))  # noqa: E731
    assert verdict(gt(a + (-a), 0), proof, uses=[fact]) is not Verdict.PROVED


def test_nonzero_and_integer_functions_keep_their_kind() -> None:
    nonzero, whole = sp.Function("g", real=True, zero=False), sp.Function("h", integer=True)
    for g, value in ((nonzero, x), (whole, x / 2), (whole, sp.sin(x))):
        fact = claim("used", "U", ge(g(x) ** 2, 0))(reals)

        def proof(goal: Goal, fact: Claim = fact, g: Any = g, value: sp.Expr = value) -> Evidence:
            return reals(goal, *specialise(goal, fact, {g(x): value}))

        assert verdict(ge(value**2, 0), proof, uses=[fact]) is not Verdict.PROVED


@pytest.mark.parametrize("time", [
    sp.Symbol("s", integer=True), sp.Symbol("s", positive=True), sp.Symbol("s", negative=True), sp.Symbol("s"),
    sp.Symbol("s", real=True, nonzero=True), sp.Symbol("s", rational=True),
])  # fmt: skip
def test_a_bound_time_with_gaps_serves_neither_a_comparison_nor_a_squeeze(time: sp.Symbol) -> None:
    rate = ForAll((time,), le(sp.Derivative(V(time), time), -V(time)), (ge(time, 0),))
    bound = le(V(t), V(0) * sp.exp(-t))
    proof = lambda goal: comparison(goal, V(0) * sp.exp(-time))  # noqa: E731
    assert verdict(bound, proof, rate, ge(t, 0)) is not Verdict.PROVED
    below = ForAll((time,), le(V(time), 1 / time**2), (ge(time, 1),))
    squeeze = lambda goal: squeezed(goal, 1 / time**2, [gt(time, 2)], lambda there: instances(there, time))  # noqa: E731
    assert verdict(eq(sp.Limit(V(time), time, sp.oo, "-"), 0), squeeze, below) is not Verdict.PROVED


COMPLEX = [
    ge(sp.exp(2 * sp.I * x), 0),
    ge(sp.Integral(sp.sqrt(-1 - s**2), (s, 0, 1)) ** 2, 0),
    ge(sp.Integral(1 / s, (s, 0, 1)) ** 2, 0),
    ge(sp.Integral(1 / s**2, (s, -1, 1)) ** 2, 0),
    ge(sp.Integral(sp.exp(s), (s, 0, sp.oo)) ** 2, 0),
    ge(sp.sqrt(-1 - x**2) * sp.sqrt(-2 - x**2), 0),
    ge(sp.acos(2 + x**2) ** 2, 0),
    ge(sp.log(-1 - x**2) ** 2, 0),
    ge(sp.asin(x) ** 2, 0),
    ge((sp.I * x) ** 4 + sp.Symbol("w") ** 2, 0),
    ge(F(sp.I * x) ** 2, 0),
    ge((-2) ** x * (-2) ** x, 0),
    ge(sp.Limit(sp.sqrt(-s), s, 1, "+") ** 2, 0),
]


@pytest.mark.parametrize("statement", COMPLEX)
def test_what_is_not_real_is_not_compared(statement: Any) -> None:
    assert verdict(statement, reals) is not Verdict.PROVED


LIMITS = [
    eq(sp.Limit(sp.sqrt(-s), s, 0, "+"), 0),
    eq(sp.Limit(1 / s, s, 0, "+-"), sp.oo),
    eq(sp.Limit(a, a, -sp.oo), -sp.oo),
    eq(sp.Limit(sp.sqrt(a**2), a, -1, "+"), -1),
    eq(sp.Limit(n, n, 0, "+"), 0),
    eq(sp.Limit(sp.log(s), s, 0, "-"), -sp.oo),
    eq(sp.Limit((s - 1) ** half, s, 1, "-"), 0),
    eq(sp.Limit(sp.Abs(s) / s, s, 0, "+-"), 1),
]


@pytest.mark.parametrize("statement", LIMITS)
def test_a_limit_is_taken_where_there_is_something_to_approach(statement: Any) -> None:
    assert verdict(statement, limits) is not Verdict.PROVED


def test_the_limits_beside_them_are_proved() -> None:
    assert verdict(eq(sp.Limit(sp.sqrt(s), s, 0, "+"), 0), limits) is Verdict.PROVED
    assert verdict(eq(sp.Limit(1 / a, a, 0, "+"), sp.oo), limits) is Verdict.PROVED


FORGED: dict[str, Callable[[Goal], Evidence]] = {
    "evidence by hand": lambda goal: Evidence("z3", Verdict.PROVED, "so it is"),
    "a verdict rewritten": lambda goal: replace(reals(goal), verdict=Verdict.PROVED),
    "what was found elsewhere": lambda goal: replace(reals(goal), engine="exact algebra"),
    "a second opinion by hand": lambda goal: replace(
        reals(replace(goal, statement=ge(x**2, 0))), besides=(Evidence("coq", Verdict.PROVED, ""),)
    ),
    "an implication as a lemma": lambda goal: reals(goal, Implication((), ge(x, 0))),  # type: ignore[arg-type]
    "another statement": lambda goal: reals(replace(goal, statement=ge(x**2, 0))),
    "another assumption": lambda goal: reals(replace(goal, assumptions=(gt(x, 1),))),
    "only where it is defined": lambda goal: exact(replace(goal, where_defined=True)),
    "a claim of its own": lambda goal: reals(replace(goal, uses=(claim("z", "Z", ge(x, 0))(reals),))),
    "facts of another goal": lambda goal: reals(
        goal, *Goal("z", ge(x, 0), uses=(claim("z", "Z", ge(x, 0))(reals),)).facts
    ),
    "instances of another goal": lambda goal: reals(
        goal, *instances(Goal("z", ge(x, 0), (ForAll((y,), ge(y, 0)),)), x)
    ),
    "a lemma of its own": lambda goal: reals(goal, library.lemma(lambda: Implication((), ge(x, 0)))()),
}  # fmt: skip


@pytest.mark.parametrize("way", FORGED)
def test_evidence_and_facts_are_not_forged(way: str) -> None:
    assert verdict(ge(x, 0), FORGED[way]) is not Verdict.PROVED


def test_a_used_claim_counts_by_what_it_says() -> None:
    true, false = (claim("base", "B", statement)(reals) for statement in (ge(x**2, 0), ge(x, 0)))
    top = claim("top", "T", ge(x + 1, 1), uses=[false])(reals)
    from ptproof.proof.run import conclude

    results = conclude([true, top], {item.id: run_one(item) for item in (true, top)})
    assert results[1].verdict is not Verdict.PROVED
    assert not results[1].fully_proved


def test_evidence_counts_for_what_was_decided() -> None:
    from ptproof.proof.run import conclude

    true, false = (claim("base", "B", statement)(reals) for statement in (ge(x**2, 0), ge(x, 0)))
    assert conclude([false], {"base": run_one(true)})[0].verdict is Verdict.UNDECIDED
    assert conclude([true], {"base": run_one(true)})[0].verdict is Verdict.PROVED


NOTHING = {
    "an empty conjunction": (every(), (), "nothing"),
    "what is assumed": (ge(x, 1), (ge(x, 1),), "assumptions"),
    "what is assumed, turned around": (ge(x, 1), (le(1, x),), "assumptions"),
    "contradicting signs": (ge(x, y), (gt(x, 1), lt(x, 0)), "contradict"),
    "contradicting a declaration": (ge(x, y), (lt(a, 0),), "contradict"),
    "a sine above one": (ge(x, y), (gt(sp.sin(x), 1),), "contradict"),
    "both on a circle and off it": (ge(x, y), (eq(sp.cos(x), 1), eq(sp.sin(x), 1)), "contradict"),
    "a square below zero": (ge(x, y), (lt(x**2 + y**2, 0),), "contradict"),
    "an exponential of nothing": (ge(x, y), (le(sp.exp(x), 0),), "contradict"),
    "a root of what is negative": (ge(x, y), (ge(sp.sqrt(x), 0), lt(x, -1)), "contradict"),
}  # fmt: skip


@pytest.mark.parametrize("name", NOTHING)
@pytest.mark.parametrize("proof", [reals, exact])
def test_a_claim_that_says_nothing_is_named(name: str, proof: Any) -> None:
    statement, given, word = NOTHING[name]
    found = run_one(claim("t", "T", statement, given=given)(proof))
    assert found.verdict is not Verdict.PROVED
    assert proof is exact or word in found.detail


def test_two_sides_that_are_the_same_are_named() -> None:
    found = run_one(claim("t", "T", eq(x + 1, 1 + x))(exact))
    assert "form" in {item.engine for item in found.besides}


def test_no_choice_is_defeated_under_assumptions_that_contradict_each_other() -> None:
    statement = Exists((a,), (le(x, a),), over=(x,))
    proof = lambda goal: defeats_every_choice(goal, {x: a + 1})  # noqa: E731
    assert verdict(statement, proof) is Verdict.REFUTED
    assert verdict(statement, proof, gt(y, 1), lt(y, 0)) is not Verdict.REFUTED
    assert verdict(statement, proof, gt(sp.sin(y), 1)) is not Verdict.REFUTED


def test_a_choice_is_defined_and_of_its_kind() -> None:
    statement = Exists((a,), (ge(a * x**2, 0),))
    assert verdict(statement, lambda goal: exists_by(goal, {a: 1})) is Verdict.PROVED
    assert verdict(statement, lambda goal: exists_by(goal, {a: x})) is not Verdict.PROVED
    assert verdict(statement, lambda goal: exists_by(goal, {a: 1 / x**2})) is not Verdict.PROVED
    assert verdict(statement, lambda goal: exists_by(goal, {a: a + 1})) is not Verdict.PROVED


def test_the_attack_is_beside_what_is_proved() -> None:
    found = run_one(claim("t", "T", ge(x**2 + 1, 2 * x))(reals))
    (item,) = [item for item in found.besides if item.engine == "attack"]
    assert item.verdict is Verdict.OBSERVED
    assert "attacked at" in item.detail


def test_a_sabotaged_engine_is_caught_by_the_attack(monkeypatch: pytest.MonkeyPatch) -> None:
    from ptproof.proof.engines import reals as engine

    monkeypatch.setattr(engine, "_follows", lambda *_: engine.Answer(True, "sabotaged"))
    monkeypatch.setattr("ptproof.proof.settling.contradictory", lambda _: False)
    results = decide([claim("t", "T", All((ge(x**2, x),)))(reals)]).results
    assert results[0].verdict is Verdict.UNDECIDED
    assert results[0].hit is not None
    assert not results[0].as_expected


p = sp.Symbol("p", real=True)


@pytest.mark.parametrize("assumed", [
    ge(x**p, 1), eq(y, x**p), ge(x**n, 1), ge(x ** (2 * p), 1),
])  # fmt: skip
def test_that_an_assumption_is_defined_shows_no_more_than_it_needs(assumed: Any) -> None:
    for statement in (gt(x, 0), ge(x, 0), Relation(x, "!=", sp.S.Zero)):
        assert verdict(statement, reals, assumed) is not Verdict.PROVED


def test_where_it_is_defined_is_not_only_where_that_is_plain() -> None:
    assert verdict(ge(x**p * 0 + sp.Abs(x**p), x**p), reals, where_defined=True) is not Verdict.REFUTED
    assert verdict(ge(x**n * x, 0), reals, where_defined=True) is not Verdict.PROVED
    assert verdict(ge(x ** (2 * p) * x, 0), reals, where_defined=True) is not Verdict.PROVED
