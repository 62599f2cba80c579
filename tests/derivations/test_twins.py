"""Every proved claim of the paper has corrupted twins that are certainly false, and none of them is proved.

A twin counts as certainly false when the refuting engine, which shares no code with the proving ones beyond
exact evaluation, finds a witness. So the test would fail for a proof that does not look at its statement.
"""

from __future__ import annotations

from itertools import chain, islice
from typing import Any

import pytest
from mutations import mutants, swapped, without_assumptions

import ptproof.proof.engines.reals
import ptproof.proof.settling
from ptproof.proof.claim import Claim
from ptproof.proof.deciding import run_one
from ptproof.proof.load import load
from ptproof.proof.settling import with_witness
from ptproof.proof.verdict import Evidence, Verdict

CLAIMS = [claim for claim in load().claims if claim.expected is Verdict.PROVED]
_NOT_TRIED = Evidence("none", Verdict.UNDECIDED, "")


@pytest.fixture(autouse=True)
def short_limits(monkeypatch: pytest.MonkeyPatch) -> None:
    """A failed proof is what is expected here, so it may give up early; that can only lose proofs.

    A witness is looked for only where something is proved.
    """
    monkeypatch.setattr(ptproof.proof.engines.reals, "SECONDS", 2.0)
    monkeypatch.setattr(ptproof.proof.settling, "with_witness", lambda goal, evidence, **_: evidence)


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim.id)
def test_corrupted_twin_is_not_proved(claim: Claim) -> None:
    killed: list[Any] = []
    for word, twin in mutants(claim):
        found = run_one(twin)
        if found.verdict is Verdict.PROVED:
            # Some changes leave a true statement, such as a bound that is doubled; a false one must not be proved.
            check = with_witness(twin.goal(), _NOT_TRIED, seconds=1.0)
            assert check.verdict is not Verdict.REFUTED, f"proved and false: {word}: {twin.statement}: {check.witness}"
            continue
        killed.append((word, found.verdict))
        if len(killed) >= 2:
            break
    assert killed, "every change of this claim is still proved: its proof does not look at it"


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim.id)
def test_exchanged_index_or_dropped_assumption_proves_nothing_false(
    claim: Claim, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ptproof.proof.engines.reals, "SECONDS", 0.3)
    twins = chain(islice(swapped(claim), 1), islice(without_assumptions(claim), 1))
    for word, twin in twins:
        if run_one(twin).verdict is Verdict.PROVED:
            check = with_witness(twin.goal(), _NOT_TRIED, seconds=0.5)
            assert check.verdict is not Verdict.REFUTED, f"proved and false: {word}: {twin.statement}: {check.witness}"
