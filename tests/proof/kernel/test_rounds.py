"""The rounds in which Coq is asked: what is asked again, with how much time, and what is said at the end."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pytest
import sympy as sp

from ptproof.proof import Evidence, Goal, claim, exact, ge, reals, specialise
from ptproof.proof.claim import Claim
from ptproof.proof.kernel import Confirmation
from ptproof.proof.kernel.asking import EFFORTS, Question
from ptproof.proof.kernel.rounds import Inquiry, Round, rounds
from ptproof.proof.kernel.theorem import proposition

x = sp.Symbol("x", real=True)


@claim("used", "used", ge(x**2, 0))
def used(goal: Goal) -> Evidence:
    return exact(goal)


@claim("using", "using", ge(x**2 + 1, 0), uses=[used])
def using(goal: Goal) -> Evidence:
    return reals(goal, *specialise(goal, used, {}))


USED, USING = proposition(used).text, proposition(using).text
YES, NO, LATE = (
    Confirmation(True),
    Confirmation(False, "no tactic proved it"),
    Confirmation(False, "time limit", late=True),
)
IF = Confirmation(False, "only if used", USING, given=(USED,))


def asked_of(
    says: Mapping[tuple[str, str, bool], Confirmation], known: Mapping[str, Confirmation] | None = None,
    given: Confirmation | None = None, efforts: Any = EFFORTS,
) -> tuple[list[tuple[str, str, float]], dict[str, list[Confirmation]]]:  # fmt: skip
    """What was asked of whom, with how many seconds, and all that was told of each claim."""
    told: dict[str, list[Confirmation]] = {}
    asked: list[tuple[str, str, float]] = []
    questions = [Question(item, proposition(item)) for item in (used, using) if item.id not in (known or {})]
    if given is not None:
        questions = [Question(using, proposition(using), given=given)]

    def answer(about: Claim, said: Confirmation) -> None:
        told.setdefault(about.id, []).append(said)

    inquiry = Inquiry(questions, known or {}, answer)
    for now in rounds(efforts, 40.0):
        for question in inquiry.now(now):
            asked.append((question.claim.id, now.effort, now.seconds))
            inquiry.say(now, question, says.get((question.claim.id, now.effort, now.waiting), NO))
    inquiry.end()
    return asked, told


def test_one_effort_has_all_the_time_at_once() -> None:
    assert list(rounds(["thorough"], 40.0)) == [Round("thorough", 40.0)]


def test_quick_tactics_have_little_of_the_time_where_others_come_after_them() -> None:
    asked, told = asked_of({("used", "quick", False): LATE, ("used", "thorough", False): YES})
    assert [item[1:] for item in asked if item[0] == "used"] == [("quick", 12.0), ("thorough", 40.0)]
    assert [item[1:] for item in asked if item[0] == "using"] == [("quick", 12.0), ("lemmas", 40.0), ("thorough", 40.0)]
    assert told == {"used": [YES], "using": [NO]}


def test_what_was_late_comes_last() -> None:
    asked, _ = asked_of({("used", "quick", False): LATE})
    assert [id for id, effort, _ in asked if effort == "quick"] == ["used", "using"]
    assert [id for id, effort, _ in asked if effort == "thorough"] == ["using", "used"]


@pytest.mark.parametrize(("effort", "late"), [("quick", False), ("lemmas", True), ("thorough", True)])
def test_who_is_late_with_more_than_quick_tactics_may_come_to_something_else(effort: str, late: bool) -> None:
    _, told = asked_of({("using", effort, False): LATE})
    assert told["using"][-1].late == late
    assert asked_of({("used", "quick", False): LATE}, efforts=["quick"])[1]["used"][-1].late


def test_what_follows_from_an_open_claim_is_asked_further_and_said_at_once() -> None:
    asked, told = asked_of({("using", "lemmas", False): IF})
    assert asked[-1] == ("using", "thorough", 40.0)  # after all others
    assert [(said.given, said.more) for said in told["using"]] == [((USED,), True), ((USED,), False)]
    _, told = asked_of({("using", "lemmas", False): IF, ("using", "thorough", True): YES})
    assert told["using"][-1] == YES


def test_what_was_late_without_the_open_claim_may_be_asked_again_by_another_run() -> None:
    _, told = asked_of({("using", "lemmas", False): IF, ("using", "thorough", True): LATE})
    assert told["using"][-1].more


def test_what_follows_from_a_confirmed_claim_is_not_asked_further() -> None:
    sure = Confirmation(True, "", USED)
    asked, told = asked_of({("used", "thorough", False): sure, ("using", "lemmas", False): IF})
    assert [effort for id, effort, _ in asked if id == "using"] == ["quick", "lemmas"]
    assert not told["using"][-1].more
    assert asked_of({}, known={"used": sure}, given=IF)[0] == []


def test_what_was_to_be_asked_further_in_an_earlier_run_is_not_asked_by_lemmas_again() -> None:
    asked, told = asked_of({("using", "thorough", True): YES}, known={"used": NO}, given=IF)
    assert [effort for _, effort, _ in asked] == ["thorough"]
    assert told["using"] == [IF, YES]


def test_where_a_proof_uses_nothing_there_are_no_lemmas() -> None:
    asked, told = asked_of({}, efforts=["lemmas"])
    assert [id for id, _, _ in asked] == ["using"]
    assert "uses no claim" in told["used"][0].reason
