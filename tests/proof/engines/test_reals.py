"""Real inequalities by z3: what follows, and what must not."""

from __future__ import annotations

import random
import threading

import pytest
import sympy as sp

from ptproof.proof.claim import Goal
from ptproof.proof.engines.reals import follows, reals
from ptproof.proof.lemmas import exp_monotone, power_monotone
from ptproof.proof.settling import settle
from ptproof.proof.statement import eq, ge, gt, le, lt
from ptproof.proof.verdict import Verdict

x, y, u, v = sp.symbols("x y u v", real=True)
a, b, V, G, R = sp.symbols("a b V G R", positive=True)
kappa = sp.Symbol("kappa", positive=True, integer=True)
q = (2 * kappa - 1) / (2 * kappa)
norm = sp.sqrt(x**2 + y**2) * sp.sqrt(u**2 + v**2)

TRUE = {
    "Cauchy-Schwarz": (le(-x * u - y * v, norm), []),
    "integer at least one": (ge(kappa, 1), []),
    "range of the exponent": (lt(q, 1), []),
    "maximum": (ge(sp.Max(x, y), x), []),
    "minimum of the two": (le(sp.Min(x, y), (x + y) / 2), []),
    "absolute value": (ge(sp.Abs(x), -x), []),
    "sine and cosine": (le(sp.sin(x) * sp.cos(x), sp.Rational(1, 2)), []),
    "pi between fractions": (lt(sp.pi, sp.Rational(22, 7)), []),
    "exponential is positive": (gt(sp.exp(x), 0), []),
}


@pytest.mark.parametrize("name", TRUE)
def test_true_inequality_follows(name: str) -> None:
    conclusion, assumptions = TRUE[name]
    assert follows(conclusion, assumptions).shown


FALSE = {
    "Cauchy-Schwarz with a factor": (le(-2 * x * u - y * v, norm), []),
    "an integer above one": (gt(kappa, 1), []),
    "exponent below a half": (lt(q, sp.Rational(1, 2)), []),
    "maximum below": (le(sp.Max(x, y), x), []),
    "assumption dropped": (gt(x, 0), []),
    "assumption too weak": (gt(x, 0), [ge(x, 0)]),
    "pi below 3.14": (lt(sp.pi, sp.Rational(314, 100)), []),
    "monotone without being told": (le(sp.exp(x), sp.exp(y)), [le(x, y)]),
}


@pytest.mark.parametrize("name", FALSE)
def test_false_inequality_does_not_follow(name: str) -> None:
    conclusion, assumptions = FALSE[name]
    assert not follows(conclusion, assumptions).shown


def test_power_lemma_carries_the_gradient_bound() -> None:
    given = [le(V, a * R ** (2 * kappa)), ge(G, b * R ** (2 * kappa - 1))]
    lemma = power_monotone(V / a, R ** (2 * kappa), q).says
    assert follows(le(b / a**q * V**q, G), given, [lemma]).shown
    assert not follows(le(b / a**q * V**q, G), given[:1], [lemma]).shown
    assert not follows(le(2 * b / a**q * V**q, G), given, [lemma]).shown


def test_a_lemma_does_not_prove_its_own_hypothesis() -> None:
    assert not follows(le(sp.exp(x), sp.exp(y)), [], [exp_monotone(x, y).says]).shown


def test_failed_proof_ends_in_a_witness() -> None:
    evidence = settle(Goal("t", le(x**2, x)), reals)
    assert evidence.verdict is Verdict.REFUTED
    assert evidence.witness is not None


def test_equality_assumption_is_used() -> None:
    assert reals(Goal("t", le(x, 2), (eq(x, y), le(y, 1)))).verdict is Verdict.PROVED


def test_contradictory_assumptions_prove_nothing() -> None:
    evidence = settle(Goal("t", le(x, 0), (gt(y, 1), lt(y, 0))), reals)
    assert evidence.verdict is Verdict.UNDECIDED
    assert "contradict" in evidence.detail


GAIN = sp.Piecewise((1 / (1 - x) ** 2, x <= sp.Rational(1, 2)), (4, True))


@pytest.mark.parametrize(
    ("conclusion", "given", "holds"),
    [
        (eq(GAIN, 1 / sp.Max(sp.Rational(1, 2), 1 - x) ** 2), (), True),
        (le(sp.Abs(GAIN), 4), (), True),
        (eq(GAIN, 4), (ge(x, sp.Rational(1, 2)),), True),
        (eq(GAIN, 4), (ge(x, sp.Rational(1, 3)),), False),
        (le(GAIN, 3), (), False),
        (eq(sp.Piecewise((1, x < 0), (2, x < 1), (3, True)), 2), (ge(x, 0), le(x, 1)), False),
        (eq(sp.Piecewise((1, x < 0), (2, x <= 1), (3, True)), 2), (ge(x, 0), le(x, 1)), True),
    ],
)
def test_a_choice_by_comparisons_is_followed_case_by_case(conclusion, given, holds):
    assert follows(conclusion, given).shown is holds


def test_several_threads_may_ask_at_once() -> None:
    """A proof that has run out of time may still be asking while the next one does; z3's own terms are not for that."""
    letters, shown = sp.symbols("a:z", real=True), []

    def ask(n: int) -> None:
        draw = random.Random(n)
        for _ in range(25):
            x, y, z = draw.sample(letters, 3)
            c = sp.Integer(draw.randint(1, 10**6))
            square = (x - c * y) ** 2
            shown.append(follows(ge(square + c * z**2, 0), []).shown)
            shown.append(not follows(gt(square, 0), []).shown)

    threads = [threading.Thread(target=ask, args=(n,)) for n in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert shown == [True] * 200
