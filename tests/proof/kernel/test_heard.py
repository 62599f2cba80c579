"""What Coq printed is held against what was asked, without Coq."""

from __future__ import annotations

import pytest

from ptproof.proof.kernel.coq import Printed, Refusal, Theorem, heard, proved

ASKED = [Theorem("claim_one", "True", "exact I"), Theorem("claim_two", "True", "exact I")]
REALS = "Axioms:\nClassicalDedekindReals.sig_forall_dec\n  : forall P : nat -> Prop, True\n"


def said(name: str, proposition: str) -> str:
    return f"proof_of_{name}\n     : {proposition}\n"


def kept(proposition: str, rest: str, number: int = 2) -> str:
    """What is printed of the conjunction after ``number`` theorems."""
    return f"kept_{number}\n     : {proposition}\n{rest}"


ONE, TWO = said("claim_one", "claim_one"), said("claim_two", "claim_two")
BOTH = "(True /\\ claim_one) /\\ claim_two"


def test_the_axioms_of_the_reals_are_allowed() -> None:
    assert heard(ONE + kept("True /\\ claim_one", REALS), ASKED) == {"claim_one": ""}


def test_what_needs_no_axiom_is_allowed() -> None:
    output = TWO + kept("True /\\ claim_two", "Closed under the global context\n")
    assert heard(output, ASKED) == {"claim_two": ""}


def test_what_coq_says_of_its_files_is_no_axiom() -> None:
    output = ONE + kept("True /\\ claim_one", f"Fetching opaque proofs from disk for Coq.Init.Logic\n{REALS}")
    assert heard(output, ASKED) == {"claim_one": ""}


def test_a_long_conjunction_is_read_in_all_its_lines() -> None:
    output = ONE + TWO + kept("(True /\\ claim_one) /\\\n       claim_two", REALS)
    assert heard(output, ASKED) == {"claim_one": "", "claim_two": ""}


@pytest.mark.parametrize(
    ("output", "reason"),
    [
        (said("claim_one", "claim_two") + kept(BOTH, REALS), "not what was asked"),
        (said("claim_one", "True") + kept("True /\\ True", REALS), "not what was asked"),
        (ONE * 2 + kept("True /\\ claim_one", REALS), "not what was asked"),
        (ONE + kept("True /\\ claim_one", REALS + "mine : False\n"), "rests on mine"),
        (ONE + kept("True /\\ claim_one", "Axioms:\n"), "cannot be read"),
    ],
)
def test_what_speaks_against_a_theorem(output: str, reason: str) -> None:
    assert reason in heard(output, ASKED)["claim_one"]


@pytest.mark.parametrize(
    "output",
    [
        "",
        "Some goals\n",
        ONE,
        ONE + kept("True /\\ claim_one", ""),
        ONE + kept("True", REALS),
        ONE + kept("True /\\ claim_one_too", REALS),
        ONE + kept("True /\\ claim_one", REALS, number=1),
        ONE + kept("True /\\ claim_one", REALS) * 2,
        kept("True /\\ claim_one", REALS),
        said("other", "other") + kept("True /\\ other", REALS),
    ],
)
def test_a_theorem_whose_axioms_were_not_printed_is_not_heard_of(output: str) -> None:
    assert heard(output, ASKED) == {}


def test_an_axiom_of_one_speaks_against_all_that_were_kept_with_it() -> None:
    output = ONE + TWO + kept(BOTH, REALS + "mine : False\n")
    assert heard(output, ASKED) == dict.fromkeys(("claim_one", "claim_two"), "it or another of its file rests on mine")


def test_what_is_proved_is_known_before_its_axioms_are() -> None:
    assert proved(ONE + said("claim_two", "True"), ASKED) == {
        "claim_one": "", "claim_two": "what Coq proved is not what was asked",
    }  # fmt: skip


def typed(inside: str) -> str:
    """The error stream of a session of which ``inside`` is the proof of the second theorem."""
    return f"Coq < \nproof_of_claim_one < \nCoq < \nproof_of_claim_two < {inside}"


@pytest.mark.parametrize(
    ("inside", "late", "reason"),
    [
        ("", True, "time limit"),
        ("Error: Timeout!\n\nToplevel input, 1-2:\nError: Attempt to save an incomplete proof", False, "time limit"),
        ("Error: Tactic failure: at (x = y).", False, "no tactic proved (x = y)"),
        ("Error: No applicable tactic.", False, "no tactic proved it"),
        ("Error: The reference f was not found.", False, "Coq does not take it: The reference f was"),
        ("Error: (in proof x): Attempt to save an incomplete proof", False, "no tactic proved it"),
    ],
)  # fmt: skip
def test_why_coq_stopped(inside: str, late: bool, reason: str) -> None:
    found = Printed("", typed(inside), late).stopped(ASKED[1])
    assert found is not None
    assert found.reason.startswith(reason)
    assert found.late is (reason == "time limit")


def test_a_proposition_that_coq_does_not_take() -> None:
    error = (
        "Coq < Toplevel input, characters 1-2:\n> Definition claim_two : Prop := g.\nError: The reference g was not "
        "found.\n\nCoq < Toplevel input, characters 3-4:\n> Theorem proof_of_claim_two : claim_two.\n"
    )
    found = Printed("", error, False).stopped(ASKED[1])
    assert found == Refusal("Coq does not take it: The reference g was not found.")


def test_a_theorem_that_coq_did_not_come_to() -> None:
    assert Printed("", "Coq < \nproof_of_claim_one < ", True).stopped(ASKED[1]) is None
