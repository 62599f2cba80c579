"""The derivation of the second paper: each claim is decided as its author expects, and what is spoilt is not proved."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace
from importlib import import_module
from types import ModuleType

import pytest
import sympy as sp

from ptproof.proof import Claim, Prose, Runs, Verdict, load
from ptproof.proof.shipped import shipped
from ptproof.proof.statement import Relation

DEAR = {
    "newton/2-coefficients-of-two-cosines", "newton/2-limits-printed", "newton/A2-second-coefficients",
    "newton/5-first-bound",
}  # fmt: skip


@pytest.fixture(scope="module")
def newton() -> tuple[Claim, ...]:
    return tuple(load([shipped() / "newton_seeker"]).claims)


@pytest.fixture(scope="module")
def observations() -> ModuleType:
    """Read when a test first asks for it: seconds of algebra, which collecting tests needs none of."""
    return import_module("derivations.newton_seeker.experiments.observations")


def test_each_claim_is_decided_as_its_author_expects(newton: Sequence[Claim]) -> None:
    """But for what is observed, runs, and what takes half a second or more, which `ptproof verify` decides."""
    chosen = [claim for claim in newton if not isinstance(claim.statement, Prose | Runs) and claim.id not in DEAR]
    assert len(chosen) > 120
    assert [claim.id for claim in chosen if claim.prove(claim.goal()).verdict is not claim.expected] == []


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


def test_what_is_observed_is_said_with_its_numbers(observations: ModuleType) -> None:
    estimate = observations.estimates([1])
    assert estimate.supported
    assert estimate.data["spread"] < 1e-5
    assert not observations.too_fast([1]).supported


def test_a_filter_that_is_too_fast_does_not_count_as_one_that_fits(observations: ModuleType) -> None:
    assert not observations.estimates([20]).supported


def test_the_gap_to_a_wrong_average_does_not_fall(observations: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    power, ladder = sp.Rational(3, 4), (50, 100, 200)
    assert observations.as_steep(observations.order("gradient", power, ladder))
    average = observations.chain.gradient_averaged
    spoilt = replace(average, rhs=tuple(2 * rate for rate in average.rhs), parameters=None)
    monkeypatch.setattr(observations.chain, "gradient_averaged", spoilt)
    assert not observations.as_steep(observations.order("gradient", power, ladder))


def test_runs_that_differ_between_tolerances_do_not_count(
    observations: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(observations, "spread", lambda *arguments: 1e-3)
    assert not observations.estimates([1]).supported
