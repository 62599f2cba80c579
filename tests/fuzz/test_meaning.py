"""The core of what a claim means: where an expression is defined, what is put in for a letter, and whole claims."""

from __future__ import annotations

from typing import Any

import hypothesis.strategies as st
import sympy as sp
from hypothesis import event, given

from ptproof.proof.claim import Claim
from ptproof.proof.deciding import run_one
from ptproof.proof.definedness import obligations
from ptproof.proof.engines.exact import exact
from ptproof.proof.engines.reals import reals
from ptproof.proof.statement import Relation
from ptproof.proof.substitution import NotOfKind, Substitution, replaced
from ptproof.proof.verdict import Verdict
from tests.fuzz import oracle, trees
from tests.fuzz.oracle import MP
from tests.fuzz.sizes import fuzz, or_nothing
from tests.fuzz.test_reals import relations, small
from tests.fuzz.test_zero import FUNCTIONS, differences

X, Y, P, W = trees.x, trees.y, trees.p, trees.w
heads = (sp.sin, sp.cos, sp.exp, sp.log, sp.sqrt, sp.Abs, sp.tan, sp.asin, sp.acos, sp.tanh, sp.atan)
anything = trees.expressions(functions=heads, undefined=(trees.F, trees.G), kinks=True, symbolic=True, leaves=6)


@given(anything, trees.seeds)
@fuzz(40)
def test_where_all_obligations_hold_there_is_a_value(expression: Any, seed: int) -> None:
    needs = or_nothing(5, lambda: list(obligations(expression)))
    if needs is None or any(need.relation is None for need in needs):
        return
    event("answered")
    for point in trees.points(expression.free_symbols, 8, seed):
        try:
            if not all(_met(need, point) for need in needs):
                continue
            oracle.value(expression, point, FUNCTIONS)
        except oracle.Unsure:
            continue
        except oracle.NoValue as error:
            raise AssertionError(f"{expression} at {point}: {error}; needs {[str(need) for need in needs]}") from None


def _met(need: Any, point: Any) -> bool:
    """Whether what is needed certainly holds at the point; an undefined condition around it holds nowhere."""
    try:
        if not all(_certainly(part, point) for part in need.given):
            return (
                all(not oracle.fails(part.left, part.sign, part.right, point, FUNCTIONS) for part in need.given)
                is False
            )
        return _certainly(need.relation, point)
    except oracle.Unsure:
        raise
    except oracle.NoValue:
        return False


def _certainly(part: Relation, point: Any) -> bool:
    difference = oracle.value(part.left, point, FUNCTIONS) - oracle.value(part.right, point, FUNCTIONS)
    if difference != 0 and abs(difference) < MP.mpf(10) ** -40:
        raise oracle.Unsure("too near")
    return {
        "=": difference == 0, "!=": difference != 0, "<": difference < 0, "<=": difference <= 0,
        ">": difference > 0,
        ">=": difference >= 0,
    }[part.sign]  # fmt: skip


plain = trees.expressions(
    (X, Y, P), functions=(sp.sin, sp.exp), powers=st.sampled_from([sp.Integer(2), sp.Integer(3)]), leaves=4
)
binding = st.one_of(
    st.builds(lambda e, v: sp.Derivative(e, v), plain, st.sampled_from([X, Y, P])),
    st.builds(
        lambda e, v, high: sp.Integral(e, (v, 0, high)),
        plain,
        st.sampled_from([X, Y, P]),
        st.sampled_from([sp.S.One, X, Y, P]),
    ),
    st.builds(
        lambda e, f, v, high: f * sp.Integral(sp.Derivative(e, v), (v, high, 1)) + e,
        plain,
        plain,
        st.sampled_from([X, Y]),
        plain,
    ),
    st.builds(
        lambda e, v, w: sp.Integral(sp.Derivative(e * w, w) + v, (v, 0, w)),
        plain,
        st.sampled_from([X, Y]),
        st.sampled_from([P, W]),
    ),
    plain,
)
letters = st.sampled_from([X, Y, P, W])
values = st.one_of(
    plain, st.sampled_from([X, Y, P, W, sp.S.Zero, sp.Rational(1, 2), X + Y, P + 1, 1 / P, sp.exp(X), -P])
)


@given(
    st.builds(lambda a, b: a + b, binding, binding),
    st.dictionaries(letters, values, min_size=1, max_size=2),
    trees.seeds,
)
@fuzz(10)
def test_what_is_put_in_has_the_value_of_the_letters(expression: Any, chosen: dict[Any, Any], seed: int) -> None:
    try:
        made = or_nothing(5, lambda: Substitution(chosen).into(expression))
    except NotOfKind:
        return
    if made is None:
        return
    event("answered")
    symbols = expression.free_symbols | set(chosen) | set().union(*(value.free_symbols for value in chosen.values()))
    for point in trees.points(symbols, 2, seed):
        if any(abs(value) > 10 for value in point.values()):
            continue
        with MP.workdps(25):
            try:
                there = {letter: oracle.value(value, point) for letter, value in chosen.items()}
                left, right = oracle.value(made, point), oracle.value(expression, point | there)
            except oracle.NoValue:
                continue
        assert abs(left - right) <= 1e-5 * (1 + abs(left)), f"{expression} with {chosen}: {made}, at {point}"


@given(st.builds(lambda a, b: a + b, binding, binding), letters, values, trees.seeds)
@fuzz(6)
def test_equal_values_are_exchanged_without_a_change(expression: Any, letter: Any, value: Any, seed: int) -> None:
    made = or_nothing(5, lambda: replaced(expression, {letter: value}))
    if made is None or letter in value.free_symbols:
        return
    for point in trees.points(expression.free_symbols | value.free_symbols, 2, seed):
        if any(abs(entry) > 10 for entry in point.values()):
            continue
        with MP.workdps(25):
            try:
                there = point | {letter: oracle.value(value, point)}
                left, right = oracle.value(made, there), oracle.value(expression, there)
            except oracle.NoValue:
                continue
        assert abs(left - right) <= 1e-5 * (1 + abs(left)), f"{expression} with {letter} = {value}: {made}, at {there}"


equalities = differences().filter(lambda entry: entry is not None).map(lambda entry: Relation(entry, "=", sp.S.Zero))
assumptions = st.lists(st.builds(Relation, small, st.sampled_from(["<=", "<", ">", "!=", "="]), small), max_size=2)


@given(st.one_of(relations(), equalities), assumptions, st.sampled_from(["exact", "reals"]), trees.seeds)
@fuzz(2)
def test_a_claim_that_is_proved_is_defined_and_holds(
    statement: Relation, known: list[Relation], engine: str, seed: int
) -> None:
    prove = exact if engine == "exact" else lambda goal: reals(goal, seconds=0.4)
    try:
        claim = Claim("fuzzed", "fuzzed", statement, prove, tuple(known))
    except ValueError:
        return
    found = or_nothing(8, run_one, claim)
    if found is None:
        return
    event(f"{found.verdict}")
    assert not any(item.verdict is Verdict.REFUTED for item in found.besides), (
        f"{statement} under {known}: {found.detail}"
    )
    assert found.engine != "crash", f"{statement} under {known}: {found.detail}"
    if found.verdict is not Verdict.PROVED:
        return
    symbols = statement.free_symbols.union(*(item.free_symbols for item in known))
    for point in trees.points(symbols, 15, seed):
        try:
            if not all(_certainly(item, point) for item in known):
                continue
        except oracle.NoValue:
            continue
        try:
            failed = oracle.fails(statement.left, statement.sign, statement.right, point, FUNCTIONS)
        except oracle.Unsure:
            continue
        except oracle.NoValue as error:
            raise AssertionError(f"{statement} under {known} is proved, at {point}: {error}") from None
        assert not failed, f"{statement} under {known} is proved, and fails at {point}"
