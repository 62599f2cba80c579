"""Claims before Coq's kernel from the claims that they use, by the steps of their proofs: each with a false twin."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
import sympy as sp

from ptproof.proof import Evidence, ForAll, Goal, claim, eq, exact, exists_by, ge, instances, le, reals, specialise
from ptproof.proof.claim import Claim
from ptproof.proof.kernel import Confirmation, missing
from ptproof.proof.kernel.lemmas import Noted, lemmas_of, settled, steps_of
from ptproof.proof.kernel.theorem import proposition
from ptproof.proof.statement import Exists
from ptproof.proof.steps import Put

EFFORT = "lemmas"
x, y, s, p, q = sp.symbols("x y s p q", real=True)
a, b, k = sp.symbols("a b k", positive=True)
U, X, Y = sp.Function("U", real=True), sp.Function("X", real=True), sp.Function("Y", real=True)
F = sp.Function("F", real=True)


def lemma(id: str, statement: Any, **options: Any) -> Claim:
    return claim(id, id, statement, **options)(exact)


def using(id: str, statement: Any, used: Claim, values: dict[Any, Any], **options: Any) -> Claim:
    @claim(id, id, statement, uses=[used], **options)
    def made(goal: Goal) -> Evidence:
        return reals(goal, *specialise(goal, used, values))

    return made


def beside(id: str, statement: Any, used: Claim, values: dict[Any, Any], unmet: Claim, **options: Any) -> Claim:
    """The same with another claim, which is put to use where it says nothing, and first."""

    @claim(id, id, statement, uses=[used, unmet], **options)
    def made(goal: Goal) -> Evidence:
        return reals(goal, *specialise(goal, unmet, {x: -y - 2, a: b}), *specialise(goal, used, values))

    return made


PLACE = (q + 1, 0)


def placed(id: str, statement: Any, place: Any = PLACE, **options: Any) -> Claim:
    """A claim that uses no other, and what it assumes for all values at one place."""

    @claim(id, id, statement, **options)
    def made(goal: Goal) -> Evidence:
        return reals(goal, *instances(goal, place))

    return made


def chosen(id: str, statement: Exists, value: Any, **options: Any) -> Claim:
    @claim(id, id, statement, **options)
    def made(goal: Goal) -> Evidence:
        return exists_by(goal, {b: value})

    return made


INSIDE = (ge(s, p), le(s, q))


def rate(of: sp.Expr, value: sp.Expr) -> ForAll:
    """How fast a function changes between p and q."""
    return ForAll((s,), eq(sp.Derivative(of, s), value), INSIDE)


square = lemma("square", le(x**2, a**2), given=[ge(x, 0), le(x, a)])
decays = lemma(
    "decays", le(U(q), U(p) * sp.exp(-k * (q - p))),
    given=[ForAll((s,), le(sp.Derivative(U(s), s), -k * U(s)), INSIDE), ge(q, p)],
)  # fmt: skip
drifts = lemma(
    "drifts", le(U(q), U(p) + b * y * (q - p)),
    given=[ForAll((s,), le(sp.Derivative(U(s), s), b * y), INSIDE), ge(q, p)],
)  # fmt: skip
cube = lemma("cube", le(x**3, a**3), given=[ge(x, 0), le(x, a)])
AWAY = (x - q) ** 2 + y**2
BETWEEN = [ForAll((x, y), le(a * AWAY**k, F(x, y))), ForAll((x, y), le(F(x, y), b * AWAY**k))]
FALLING = [rate(X(s), -X(s)), ge(q, p)]
ON_A_CURVE = [rate(F(X(s), Y(s)), -F(X(s), Y(s))), rate(X(s), Y(s)), rate(Y(s), X(s)), ge(q, p)]
SLOPES = [ForAll((x, y), le(sp.Derivative(F(x, y), x), k))]
SLOPE = sp.Subs(sp.Derivative(F(x, Y(q)), x), x, X(q))
DECAYED = [ge(x, 0), le(x, a**2 * sp.exp(-2 * b))]
below = lemma("below", le(sp.sqrt(x), y), given=[ge(x, 0), ge(y, 0), le(x, y**2)])
root = lemma("root", le(sp.sqrt(x**2 + b**2) ** (2 * a), (x**2 + b**2) ** a))
SMALL, ABOVE = Exists((b,), (le(k * sp.exp(-k * b), a),)), Exists((b,), (le(x**2, b),), (x,))
SQUARED, CURVED = {U(s): X(s) ** 2, k: 2}, {U(s): F(X(s), Y(s)), k: 1}

TRUE = [
    using("at-a-value", le((y + 1) ** 2, b**2), square, {x: y + 1, a: b}, given=[ge(y, 0), le(y + 1, b)]),
    using("for-a-function", le(X(q) ** 2, X(p) ** 2 * sp.exp(-2 * (q - p))), decays, SQUARED, given=FALLING),
    using(
        "along-a-curve", le(F(X(q), Y(q)), F(X(p), Y(p)) * sp.exp(-(q - p))), decays, CURVED, given=ON_A_CURVE
    ),
    beside(
        "beside-an-unmet-one", le((y + 1) ** 2, b**2), square, {x: y + 1, a: b}, cube, given=[ge(y, 0), le(y + 1, b)]
    ),
    placed("at-a-place", le(a, b), given=BETWEEN),
    chosen("a-choice", SMALL, sp.log(k / a + 1) / k),
    chosen("a-choice-for-some", ABOVE, k**2, given=[ge(x, -k), le(x, k)]),
    using("without-its-letter", le(X(q) ** 2, X(p) ** 2), drifts, {U(s): X(s) ** 2, y: 0}, given=FALLING),
    placed("at-a-moving-place", le(SLOPE, k), place=(X(q), Y(q)), given=SLOPES),
    using("by-squares", le(sp.sqrt(x), a * sp.exp(-b)), below, {y: a * sp.exp(-b)}, given=DECAYED),
    using("in-other-words", le(y**2 + 1, sp.sqrt(y**2 + 1) ** 2), root, {x: y, a: 1, b: 1}),
]  # fmt: skip
NOT_CONFIRMED = [
    placed("at-a-place-false", le(a, b / 2), given=BETWEEN),
    chosen("a-choice-false", SMALL, sp.log(k / a + 1) / (2 * k)),
    chosen("a-choice-for-all-false", ABOVE, k**2),
    using("without-its-letter-false", le(X(q) ** 2, X(p) ** 2 / 2), drifts, {U(s): X(s) ** 2, y: 0}, given=FALLING),
    placed("at-a-moving-place-false", le(SLOPE, k / 2), place=(X(q), Y(q)), given=SLOPES),
    using("by-squares-false", le(sp.sqrt(x), a * sp.exp(-2 * b)), below, {y: a * sp.exp(-2 * b)}, given=DECAYED),
    using("at-a-value-false", le((y + 1) ** 2, b), square, {x: y + 1, a: b}, given=[ge(y, 0), le(y + 1, b)]),
    using("at-a-value-unmet", le((y + 1) ** 2, b**2), square, {x: y + 1, a: b}, given=[le(y + 1, b)]),
    using("for-a-function-false", le(X(q) ** 2, X(p) ** 2 * sp.exp(-3 * (q - p))), decays, SQUARED, given=FALLING),
    using(
        "along-a-curve-false", le(F(X(q), Y(q)), F(X(p), Y(p)) * sp.exp(-2 * (q - p))), decays, CURVED, given=ON_A_CURVE
    ),
]  # fmt: skip


@pytest.mark.skipif(bool(missing()), reason=missing() or "coq is there")
@pytest.mark.parametrize("item", TRUE, ids=lambda item: item.id)
def test_what_follows_from_a_lemma_waits_for_it(answers: dict[str, Confirmation], item: Claim) -> None:
    answer = answers[item.id]
    assert bool(answer.given) == bool(item.uses), answer.reason
    assert answer.confirmed == (not item.uses)
    assert answer.reason.startswith("only if") or not item.uses


@pytest.mark.skipif(bool(missing()), reason=missing() or "coq is there")
@pytest.mark.parametrize("id", [item.id for item in NOT_CONFIRMED])
def test_what_does_not_follow_is_not_shown(answers: dict[str, Confirmation], id: str) -> None:
    assert not answers[id].given
    assert not answers[id].confirmed


def said(confirmed: bool, proposition: str, *given: str) -> Confirmation:
    return Confirmation(confirmed, "" if confirmed else "only if", proposition, given=given)


def test_what_follows_counts_once_all_lemmas_are_confirmed() -> None:
    answers = {"a": said(True, "A"), "b": said(False, "B", "A"), "c": said(False, "C", "A", "B"), "d": said(False, "D")}
    after = settled(answers)
    assert {name: answer.confirmed for name, answer in after.items()} == {"a": True, "b": True, "c": True, "d": False}
    assert after["c"].reason == ""


@pytest.mark.parametrize(
    ("answers", "why"),
    [
        ({"b": said(False, "B", "A")}, "nobody was asked about the lemma"),
        ({"a": said(False, "A"), "b": said(False, "B", "A")}, "the lemma is refused"),
        ({"a": said(True, "A weaker"), "b": said(False, "B", "A")}, "what was confirmed is something else"),
        ({"a": said(False, "A", "B"), "b": said(False, "B", "A")}, "each from the other"),
    ],
)
def test_what_follows_from_what_is_not_confirmed_does_not_count(answers: dict[str, Confirmation], why: str) -> None:
    assert not settled(answers)["b"].confirmed, why


def test_a_lemma_says_what_its_own_claim_says() -> None:
    (found,) = lemmas_of(TRUE[0]).values()
    assert found.text == proposition(square).text


def test_what_has_no_translation_is_no_lemma() -> None:
    strange = lemma("strange", eq(sp.zeta(x), sp.zeta(x)))
    assert lemmas_of(using("uses", ge(x**2, 0), strange, {})) == {}


def test_a_claim_that_stands_in_no_file_has_no_steps() -> None:
    homeless = replace(TRUE[0], id="homeless")
    noted = Noted([homeless, TRUE[0]], 1, 60.0)
    noted.take()
    assert noted.of(homeless) == ()
    assert noted.of(TRUE[0]) == (Put(square.content, ((x, y + 1), (a, b))),)


def test_who_waits_is_told_when_nobody_takes_the_steps_any_more() -> None:
    noted = Noted(TRUE[:1], 1, 5.0)
    noted.stop()
    assert noted.of(TRUE[0]) == ()


def test_the_steps_before_a_proof_fails_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    from ptproof.proof import answering
    from ptproof.proof.kernel import lemmas

    @claim("fails", "fails", le((y + 1) ** 2, b**2), uses=[square], given=[ge(y, 0), le(y + 1, b)])
    def fails(goal: Goal) -> Evidence:
        specialise(goal, square, {x: y + 1, a: b})
        raise ValueError

    assert lemmas.READ is answering.READ
    monkeypatch.setitem(answering.READ, "fails", fails)
    (step,) = steps_of("fails")
    assert step.content == square.content
