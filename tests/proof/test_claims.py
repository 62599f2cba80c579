"""Claims, loading them, running them: crashes, hangs, circles, duplicates, and conclusions about ancestors."""

from __future__ import annotations

import textwrap
from dataclasses import replace
from pathlib import Path

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.claim import Goal, cited, claim
from ptproof.proof.deciding import run_one
from ptproof.proof.engines.exact import exact
from ptproof.proof.engines.existence import defeats_every_choice, exists_by
from ptproof.proof.engines.reals import reals
from ptproof.proof.load import load
from ptproof.proof.run import conclude, verify
from ptproof.proof.statement import Exists, Prose, Relation, eq, ge, le
from ptproof.proof.verdict import Evidence, Verdict

x, y = sp.symbols("x y", real=True)
a = sp.Symbol("a", positive=True)

HEADER = """
import sympy as sp
from ptproof.proof.claim import claim
from ptproof.proof.engines.exact import exact
from ptproof.proof.statement import eq
x = sp.Symbol("x", real=True)
SECTION = "Test"
"""


def write(folder: Path, body: str) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "claims.py").write_text(HEADER + textwrap.dedent(body))
    return folder


def test_both_sides_are_kept() -> None:
    assert Relation(x, "=", x).left == x


def test_verdict_is_not_a_truth_value() -> None:
    with pytest.raises(TypeError, match="compare it"):
        bool(Verdict.PROVED)


def test_uses_takes_claims_only() -> None:
    with pytest.raises(InputError, match="take claims"):
        claim("a", "a", eq(x, x), uses=["b"])(exact)  # type: ignore[list-item]


def test_used_statement_comes_with_its_own_assumptions() -> None:
    @claim("used", "used", le(x, 1), given=[le(x, 0)])
    def used(goal: Goal) -> Evidence:
        return reals(goal)

    goal = Goal("t", le(x, 1), (), (used,))
    assert reals(goal).verdict is not Verdict.PROVED
    assert reals(replace(goal, assumptions=(le(x, -1),))).verdict is Verdict.PROVED


def test_evidence_about_another_statement_counts_for_nothing() -> None:
    @claim("false", "false", eq(x, x + 1))
    def changes_the_statement(goal: Goal) -> Evidence:
        return exact(replace(goal, statement=eq(x, x)))

    @claim("false", "false", ge(x, 0))
    def adds_an_assumption(goal: Goal) -> Evidence:
        return reals(replace(goal, assumptions=(ge(x, 1),)))

    @claim("false", "false", eq(x, x + 1))
    def makes_it_up(goal: Goal) -> Evidence:
        return Evidence("trust me", Verdict.PROVED, "obviously")

    other = claim("other", "other", ge(x, 0))(exact)

    @claim("false", "false", ge(x, 0))
    def uses_what_it_does_not_name(goal: Goal) -> Evidence:
        return reals(replace(goal, uses=(other,)))

    for item in (changes_the_statement, adds_an_assumption, makes_it_up, uses_what_it_does_not_name):
        found = run_one(item)
        assert found.verdict is Verdict.UNDECIDED
        assert found.engine == "mismatch"


def test_crash_is_the_claims_own() -> None:
    @claim("crash", "crash", eq(x, x))
    def crash(goal: Goal) -> Evidence:
        raise ZeroDivisionError("inside the proof")

    evidence = run_one(crash)
    assert evidence.verdict is Verdict.UNDECIDED
    assert "inside the proof" in evidence.detail


def test_conclusions_look_at_all_ancestors() -> None:
    theorem = claim("theorem", "theorem", Prose("cited"), expected="cited")(cited("a book"))
    base = claim("base", "base", eq(x, x), uses=[theorem])(exact)
    top = claim("top", "top", eq(y, y), uses=[base])(exact)
    results = conclude([theorem, base, top], {item.id: run_one(item) for item in (theorem, base, top)})
    assert [result.verdict for result in results] == [Verdict.CITED, Verdict.PROVED, Verdict.PROVED]
    assert not any(result.fully_proved for result in results)
    assert results[2].rests_on == ("theorem",)


def test_what_uses_a_refuted_claim_is_not_proved() -> None:
    false = claim("false", "false", eq(x, x + 1), expected="refuted")(exact)
    top = claim("top", "top", eq(y, y), uses=[false])(exact)
    results = conclude([false, top], {item.id: run_one(item) for item in (false, top)})
    assert results[1].verdict is Verdict.UNDECIDED


def test_existence_by_a_value_and_its_refutation() -> None:
    above = Goal("t", Exists((a,), (ge(a, x),)))
    assert exists_by(above, {a: x**2 + 1}).verdict is Verdict.PROVED
    assert exists_by(above, {a: sp.Rational(1)}).verdict is Verdict.UNDECIDED
    bounded = Goal("t", Exists((a,), (le(x, a),), over=(x,)))
    assert defeats_every_choice(bounded, {x: a + 1}).verdict is Verdict.REFUTED
    assert defeats_every_choice(bounded, {x: a - 1}).verdict is Verdict.UNDECIDED
    assert exists_by(bounded, {a: x**2 + 1}).verdict is Verdict.UNDECIDED


def test_duplicate_id_is_an_error(tmp_path: Path) -> None:
    folder = write(
        tmp_path / "d", "a = claim('same', 'one', eq(x, x))(exact)\nb = claim('same', 'two', eq(x, x))(exact)\n"
    )
    with pytest.raises(InputError, match="stands twice"):
        load([folder])


def test_import_error_names_file_and_line(tmp_path: Path) -> None:
    folder = write(tmp_path / "d", "a = claim('one', 'one', eq(x, x))(exact)\nboom = 1 / 0\n")
    with pytest.raises(InputError, match=r"claims\.py, line \d+: ZeroDivisionError"):
        load([folder])


@pytest.mark.parametrize("path", ["nowhere", "empty"])
def test_missing_or_empty_folder(tmp_path: Path, path: str) -> None:
    (tmp_path / "empty").mkdir()
    with pytest.raises(InputError):
        load([tmp_path / path])


def test_a_hang_and_a_dying_process_cost_one_claim_each(tmp_path: Path) -> None:
    folder = write(
        tmp_path / "d",
        """
        import os, time
        good = claim('good', 'good', eq(x, x))(exact)
        @claim('hang', 'hang', eq(x, x))
        def hang(goal):
            time.sleep(600)
        @claim('dies', 'dies', eq(x, x))
        def dies(goal):
            os._exit(9)
        last = claim('last', 'last', eq(2 * x, x + x))(exact)
        """,
    )
    verification = verify(load([folder]), workers=2, timeout=2)
    found = {result.claim.id: result.verdict for result in verification.results}
    assert found == {
        "good": Verdict.PROVED, "hang": Verdict.UNDECIDED, "dies": Verdict.UNDECIDED, "last": Verdict.PROVED,
    }  # fmt: skip
    assert not verification.as_expected


@pytest.mark.parametrize(
    "options", [{"workers": 0}, {"timeout": 0.0}, {"timeout": float("nan")}, {"select": "no such"}]
)
def test_bad_options(tmp_path: Path, options: dict[str, object]) -> None:
    folder = write(tmp_path / "d", "a = claim('one', 'one', eq(x, x))(exact)\n")
    with pytest.raises(InputError):
        verify(load([folder]), **options)  # type: ignore[arg-type]


def test_selection_brings_what_it_uses(tmp_path: Path) -> None:
    folder = write(
        tmp_path / "d",
        "a = claim('alpha', 'one', eq(x, x))(exact)\nb = claim('beta', 'two', eq(x, x), uses=[a])(exact)\n"
        "c = claim('gamma', 'three', eq(x, x))(exact)\n",
    )
    assert [item.id for item in load([folder]).select("beta")] == ["alpha", "beta"]


@pytest.mark.parametrize(
    ("options", "word"),
    [
        ({"labels": "eq:a"}, "`labels` takes a list of labels, got the text 'eq:a'"),
        ({"given": [3]}, "`given` takes relations"),
    ],
)
def test_what_would_be_read_otherwise_is_refused(options: dict[str, object], word: str) -> None:
    with pytest.raises(InputError, match=word):
        claim("a", "A claim", eq(sp.Integer(1), 1), **options)(exact)
