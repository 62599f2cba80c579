"""The errata of the paper: each says how grave it is, in words, and has a correction that is claimed as proved."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from ptproof.proof import Claim, Verdict


@pytest.fixture(scope="module")
def printed(claims: Sequence[Claim]) -> list[Claim]:
    return [claim for claim in claims if claim.expected is Verdict.REFUTED and (claim.labels or claim.place)]


def test_there_are_errata(printed: list[Claim]) -> None:
    assert len(printed) > 5


def test_each_erratum_has_a_grade(printed: list[Claim]) -> None:
    assert [claim.id for claim in printed if claim.erratum is None] == []


def test_each_erratum_has_a_correction_that_is_claimed_as_proved(claims: Sequence[Claim], printed: list[Claim]) -> None:
    corrected = {claim.corrects.id: claim for claim in claims if claim.corrects is not None}
    assert {claim.id for claim in printed} <= set(corrected)
    assert {corrected[claim.id].expected for claim in printed} == {Verdict.PROVED}


def test_their_sentences_are_sentences(printed: list[Claim]) -> None:
    sentences = [text for claim in printed if claim.erratum for text in (claim.erratum.wrong, claim.erratum.survives)]
    assert len(sentences) == 2 * len(printed)
    assert [text for text in sentences if text[0].isalpha() and not text[0].isupper()] == []
    assert [text for text in sentences if not text.endswith(".")] == []


def test_what_the_paper_does_not_print_is_not_graded(claims: Sequence[Claim]) -> None:
    assert all(claim.erratum is None for claim in claims if not (claim.labels or claim.place))
