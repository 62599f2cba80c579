"""What Coq has said of a module's claims, ``TRUE`` and ``NOT_CONFIRMED``: the tests of each that has such."""

from __future__ import annotations

import pytest

from ptproof.proof.kernel import Confirmation, missing

needs_coq = pytest.mark.skipif(bool(missing()), reason=missing() or "coq is there")


@needs_coq
def test_what_is_true_is_confirmed(answers: dict[str, Confirmation], true: str) -> None:
    assert answers[true].confirmed, answers[true].reason


@needs_coq
def test_what_is_not_true_is_not_confirmed(answers: dict[str, Confirmation], not_confirmed: str) -> None:
    assert not answers[not_confirmed].confirmed
    assert answers[not_confirmed].reason
