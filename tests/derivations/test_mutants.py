"""A sample of corrupted claims of the paper: none that is false is proved. `ptproof mutate` tries all of them."""

import random

import pytest

from ptproof.proof import Verdict, load
from ptproof.proof.mutation.judging import Patience, judge
from ptproof.proof.mutation.making import mutants, neighbours
from ptproof.proof.mutation.outcomes import Word

CLAIMS = [claim for claim in load().claims if claim.expected is Verdict.PROVED]
SHARES, OF_EACH = 12, 6
LOT = random.Random("a sample of corrupted claims")
SAMPLE = LOT.sample(list(neighbours(CLAIMS)), SHARES * OF_EACH)


@pytest.mark.parametrize("share", range(SHARES))
def test_nothing_false_is_proved(share):
    outcomes = []
    for claim, others in SAMPLE[share::SHARES]:
        mutant = random.Random(claim.id).choice(mutants(claim, others, count=1))
        outcomes.append((claim.id, judge(mutant, Patience(step=4.0, question=0.3, attack=0.1))))
    assert [(id, found.change, found.why) for id, found in outcomes if found.alarm] == []
    assert any(found.word is Word.REFUTED for _, found in outcomes)
