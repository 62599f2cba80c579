"""The errata of the paper: each says how grave it is, in words, and has a correction that is claimed as proved."""

import pytest

from ptproof.proof import Verdict, load

CLAIMS = load().claims
PRINTED = [claim for claim in CLAIMS if claim.expected is Verdict.REFUTED and (claim.labels or claim.place)]
CORRECTED = {claim.corrects.id: claim for claim in CLAIMS if claim.corrects is not None}


def test_there_are_errata():
    assert len(PRINTED) > 5


@pytest.mark.parametrize("printed", PRINTED, ids=lambda claim: claim.id)
def test_an_erratum_has_a_grade_and_a_proved_correction(printed):
    assert printed.erratum is not None
    assert CORRECTED[printed.id].expected is Verdict.PROVED


@pytest.mark.parametrize("printed", PRINTED, ids=lambda claim: claim.id)
def test_its_sentences_are_sentences(printed):
    for sentence in (printed.erratum.wrong, printed.erratum.survives):
        assert sentence[0].isupper() or not sentence[0].isalpha()
        assert sentence.endswith(".")


def test_what_the_paper_does_not_print_is_not_graded():
    assert all(claim.erratum is None for claim in CLAIMS if not (claim.labels or claim.place))
