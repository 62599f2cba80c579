"""What Coq printed is held against what was asked, without Coq."""

from __future__ import annotations

import pytest

from ptproof.proof.kernel.coq import Printed, Theorem, heard

ASKED = [Theorem("claim_one", "True", "exact I"), Theorem("claim_two", "True", "exact I")]
REALS = "Axioms:\nClassicalDedekindReals.sig_forall_dec\n  : forall P : nat -> Prop, True\n"


def said(name: str, proposition: str, rest: str) -> str:
    return f"proof_of_{name}\n     : {proposition}\n{rest}"


def test_the_axioms_of_the_reals_are_allowed() -> None:
    assert list(heard(said("claim_one", "claim_one", REALS), ASKED)) == [""]


def test_what_needs_no_axiom_is_allowed() -> None:
    assert list(heard(said("claim_one", "claim_one", "Closed under the global context\n"), ASKED)) == [""]


@pytest.mark.parametrize(
    ("output", "reason"),
    [
        (said("claim_one", "claim_two", REALS), "not what was asked"),
        (said("claim_two", "claim_two", REALS), "not what was asked"),
        (said("claim_one", "True", REALS), "not what was asked"),
        (said("claim_one", "claim_one", REALS + "mine : False\n"), "rests on mine"),
        (said("claim_one", "claim_one", "Axioms:\n"), "cannot be read"),
    ],
)
def test_what_speaks_against_a_theorem(output: str, reason: str) -> None:
    (found,) = heard(output, ASKED)
    assert reason in found


@pytest.mark.parametrize("output", ["", "Some goals\n", said("claim_one", "claim_one", "")])
def test_a_theorem_whose_axioms_were_not_printed_is_not_heard_of(output: str) -> None:
    assert list(heard(output, ASKED)) == []


def test_every_theorem_answers_for_itself() -> None:
    output = said("claim_one", "claim_one", REALS) + said("claim_two", "claim_two", REALS + "mine : False\n")
    assert list(heard(output, ASKED)) == ["", "it rests on mine"]


@pytest.mark.parametrize(
    ("printed", "reason"),
    [
        (Printed("", "", True), "time limit"),
        (Printed("", "Error: Timeout!", False), "time limit"),
        (Printed("", "Error: Tactic failure: at (x = y).", False), "no tactic proved (x = y)"),
        (Printed("", "Error: No applicable tactic.", False), "no tactic proved it"),
        (Printed("", "Error: The reference f was not found.", False), "Coq does not take it: The reference f was"),
    ],
)
def test_why_coq_stopped(printed: Printed, reason: str) -> None:
    assert printed.stopped().startswith(reason)
