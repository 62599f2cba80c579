"""The derivation of the second paper: each claim is decided as its author expects, and what is spoilt is not proved."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace

import pytest
import sympy as sp

from ptproof.proof import Claim, Verdict, load
from ptproof.proof.shipped import shipped
from ptproof.proof.statement import Relation


@pytest.fixture(scope="module")
def newton() -> tuple[Claim, ...]:
    return tuple(load([shipped() / "newton_seeker"]).claims)


def test_each_claim_is_decided_as_its_author_expects(newton: Sequence[Claim]) -> None:
    assert len(newton) > 100
    assert [claim.id for claim in newton if claim.prove(claim.goal()).verdict is not claim.expected] == []


def test_each_erratum_has_a_correction_that_is_claimed_as_proved(newton: Sequence[Claim]) -> None:
    printed = {claim.id for claim in newton if claim.expected is Verdict.REFUTED}
    corrected = {claim.corrects.id: claim for claim in newton if claim.corrects is not None}
    assert len(printed) > 10
    assert printed == set(corrected)
    assert {claim.expected for claim in corrected.values()} == {Verdict.PROVED}
    assert [claim.id for claim in newton if claim.id in printed and claim.erratum is None] == []


@pytest.mark.parametrize(
    "id", ["newton/4-average", "newton/5-average", "newton/5-average-in-logarithm", "newton/5-shifted", "newton/5-in-z"]
)
def test_a_printed_system_with_one_sign_changed_is_not_proved(newton: Sequence[Claim], id: str) -> None:
    (claim,) = (item for item in newton if item.id == id)
    assert isinstance(claim.statement, Relation)
    left = sp.Matrix(claim.statement.left)
    left[1] = -left[1]
    spoilt = replace(claim, statement=Relation(left, "=", claim.statement.right))
    assert spoilt.prove(spoilt.goal()).verdict is not Verdict.PROVED


def test_nothing_of_the_first_paper_is_used(newton: Sequence[Claim]) -> None:
    modules = {claim.prove.__module__.split(".")[0] for claim in newton}
    assert len(modules - {"ptproof"}) == 1
    (package,) = modules - {"ptproof"}
    values = [
        value for name in list(sys.modules) if name.startswith(package) for value in vars(sys.modules[name]).values()
    ]
    assert not any("pt_seeker" in str(getattr(value, "__module__", "")) for value in values)
