"""The grade of a printed claim that is refuted: all three words or none, of a known kind, of a refuted claim."""

import pytest
import sympy as sp

from ptproof.errors import InputError
from ptproof.proof import claim, eq, exact
from ptproof.proof.erratum import Erratum, Grade
from ptproof.proof.run import decide

x = sp.Symbol("x", real=True)
SAID = {"grade": "number", "wrong": "It is 2.", "survives": "Nothing rests on it."}


def made(expected="refuted", **said):
    return claim("a/one", "One", eq(x, x + 1), expected=expected, **said)(exact)


def test_an_erratum_is_part_of_the_claim_and_of_its_json():
    wrong = made(**SAID)
    assert wrong.erratum == Erratum(Grade.NUMBER, "It is 2.", "Nothing rests on it.")
    (found,) = decide([wrong]).to_json()["claims"]
    assert found["erratum"] == SAID


def test_a_claim_without_grade_has_none():
    assert made().erratum is None
    (found,) = decide([made()]).to_json()["claims"]
    assert found["erratum"] is None


def test_words_about_a_claim_do_not_change_what_it_says():
    assert made(**SAID).content == made().content


@pytest.mark.parametrize("left_out", sorted(SAID))
def test_all_three_are_given_or_none(left_out):
    with pytest.raises(InputError, match="a/one: `grade`, `wrong` and `survives` are given together"):
        made(**{name: said for name, said in SAID.items() if name != left_out})


def test_an_unknown_grade_is_named_with_the_known_ones():
    with pytest.raises(InputError, match="'typo' is none of error, definition, hypothesis, number, misprint, wording"):
        made(**{**SAID, "grade": "typo"})


@pytest.mark.parametrize("expected", ["proved", "undecided", "cited"])
def test_only_a_refuted_claim_has_a_grade(expected):
    with pytest.raises(InputError, match="only a claim with expected='refuted'"):
        made(expected, **SAID)


def test_an_empty_sentence_is_refused():
    with pytest.raises(InputError, match="needs a sentence for 'wrong'"):
        made(**{**SAID, "wrong": " "})


def test_the_heaviest_grade_comes_first():
    assert [grade.value for grade in sorted(Grade, key=lambda grade: grade.rank)][:2] == ["error", "definition"]
    assert len({grade.words for grade in Grade}) == len({grade.meaning for grade in Grade}) == len(Grade)
