"""A sample of corrupted claims of the paper: none that is false is proved. `ptproof mutate` tries all of them."""

import random

import pytest

from ptproof.proof import Verdict
from ptproof.proof.mutation.judging import Patience, judge
from ptproof.proof.mutation.making import mutants, neighbours
from ptproof.proof.mutation.outcomes import Word

SHARES, OF_EACH = 9, 4


@pytest.fixture(scope="module")
def sample(claims):
    lot = random.Random("a sample of corrupted claims")
    proved = [claim for claim in claims if claim.expected is Verdict.PROVED]
    return lot.sample(list(neighbours(proved)), SHARES * OF_EACH)


@pytest.mark.parametrize("share", range(SHARES))
def test_nothing_false_is_proved(sample, share):
    outcomes = []
    for claim, others in sample[share::SHARES]:
        mutant = random.Random(claim.id).choice(mutants(claim, others, count=1))
        outcomes.append((claim.id, judge(mutant, Patience(step=4.0, question=0.3, attack=0.1))))
    assert [(id, found.change, found.why) for id, found in outcomes if found.alarm] == []
    assert any(found.word is Word.REFUTED for _, found in outcomes)
