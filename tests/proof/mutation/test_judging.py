"""What comes of one mutant, and that an engine which proves what is false is found out."""

from dataclasses import replace
from types import SimpleNamespace

import pytest
import sympy as sp

from ptproof.proof import Exists, ForAll, claim, eq, exact, ge, gt, le, reals
from ptproof.proof.mutation.haste import in_haste
from ptproof.proof.mutation.judging import Patience, judge
from ptproof.proof.mutation.mutant import Mutant
from ptproof.proof.mutation.outcomes import Word

x, y = sp.symbols("x y", real=True)
T = sp.Symbol("T", positive=True)
f = sp.Function("f", real=True)
PATIENCE = Patience(step=20.0)


def outcome(old, new, proof=reals, before=(), after=None, **changes):
    original = claim("original", "", old, given=before)(proof)
    changed = replace(original, statement=new, assumptions=tuple(before if after is None else after), **changes)
    return judge(Mutant(changed, original, "kind", "change"), PATIENCE)


TABLE = [
    ("false at a point", outcome(ge(x**2, 0), gt(x**2, 0)), Word.REFUTED),
    ("false without the assumption", outcome(gt(x, 0), gt(x, 0), before=[gt(x, 1)], after=[]), Word.REFUTED),
    ("false for a function", outcome(eq(f(x), f(x)), eq(f(x), f(x) ** 2), exact), Word.REFUTED),
    ("undefined at a point", outcome(eq(T / T**2, 1 / T), eq(x / x**2, 1 / x), exact), Word.REFUTED),
    ("no choice for some value", outcome(Exists((y,), (ge(y, x),)), Exists((T,), (le(T, x),))), Word.REFUTED),
    ("another form", outcome(le(x, y), le(x + 1, y + 1), before=[le(x, y - 1)]), Word.EQUIVALENT),
    ("weaker", outcome(ge(x**2, 0), ge(x**2 + 1, 0)), Word.PROVED),
]  # fmt: skip


@pytest.mark.parametrize(("found", "word"), [row[1:] for row in TABLE], ids=[row[0] for row in TABLE])
def test_word(found, word):
    assert found.word is word, found.why
    assert not found.alarm


@pytest.mark.parametrize("found", [row[1] for row in TABLE if row[2] is Word.REFUTED])
def test_what_is_refuted_has_a_witness(found):
    assert found.witness is not None


def test_why_a_true_one_is_true():
    assert "follows" in TABLE[-1][1].why


@pytest.fixture
def sabotaged(monkeypatch):
    """Exact algebra finds everything to be zero."""
    monkeypatch.setattr("ptproof.proof.engines.exact.is_zero", lambda expression: True)


@pytest.mark.parametrize("new", [eq(x, x + 1), eq(x**2, x), eq(f(x), f(x) ** 2), eq(sp.sqrt(x**2), x)])
def test_an_engine_that_proves_what_is_false_raises_the_alarm(new, sabotaged):
    found = outcome(eq(x + x, 2 * x), new, exact)
    assert found.alarm
    assert found.word is Word.PROVED
    assert found.statement


def test_a_wrong_proof_without_an_assumption_raises_the_alarm(sabotaged):
    assert outcome(eq(x, 1), eq(x, 1), exact, before=[eq(x, 1)], after=[ge(x, 1)]).alarm


@pytest.mark.parametrize("error", [RuntimeError("no"), SystemExit(0), KeyboardInterrupt()], ids=repr)
def test_a_proof_that_crashes_leaves_its_mutant_open(error):
    def crashing(goal):
        raise error

    found = outcome(ge(x**2, 0), ge(x**4 + x**2 * y**2, 0), crashing)
    assert found.word is Word.UNDECIDED
    assert type(error).__name__ in found.why or "sys.exit" in found.why


def test_a_proof_that_hangs_leaves_its_mutant_open():
    def hanging(goal):
        while True:
            pass

    original = claim("original", "", ge(x**2, 0))(hanging)
    changed = replace(original, statement=ge(x**4 + x**2 * y**2, 0))
    found = judge(Mutant(changed, original, "kind", "change"), Patience(step=0.5))
    assert "no answer in 0.5 s" in found.why


def test_haste_ends():
    import ptproof.proof.engines.reals as module

    usual = module.SECONDS, module._follows
    with in_haste(0.1):
        assert (module.SECONDS, module._follows) != usual
    assert (module.SECONDS, module._follows) == usual


s = sp.Symbol("s", real=True)
X = sp.Function("X", real=True)
GROWS = ForAll((s,), eq(sp.Derivative(X(s), s), X(s) ** 2), (ge(s, 0), le(s, 1)))


@pytest.mark.parametrize(
    ("new", "example", "refuted"),
    [
        (ge(X(0), X(1)), 1 / (2 - s), True),
        (ge(X(0), X(1)), 2 / (2 - s), False),  # no solution
        (ge(X(0), X(1)), None, False),
        (le(X(0), X(1) + 1), 1 / (2 - s), False),  # it holds there
    ],
)
def test_the_example_of_the_claim_is_tried_where_the_attacker_meets_nothing(new, example, refuted, monkeypatch):
    monkeypatch.setattr("ptproof.proof.mutation.attacking.attack", lambda goal, **limits: SimpleNamespace(hit=None))
    said = () if example is None else ((X(s), example),)
    found = outcome(le(X(0), X(1)), new, before=[GROWS], example=said)
    assert (found.word is Word.REFUTED) is refuted, found.why
