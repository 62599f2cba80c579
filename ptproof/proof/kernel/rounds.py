"""The rounds in which Coq is asked: one effort after the other with little time, and once more where that was short."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from ptproof.proof.claim import Claim
from ptproof.proof.kernel.asking import Effort, Question
from ptproof.proof.kernel.lemmas import has_steps, settled
from ptproof.proof.kernel.remembered import Confirmation

# What an effort gets of a claim's time limit while others are still to come. Of 143 claims that quick tactics confirmed
# the slowest took 4 s, and they went on for the whole limit in every third of the others.
_SHARES: dict[Effort, float] = {"quick": 0.2, "lemmas": 0.5, "thorough": 0.5}

_NOT_ASKED = "it uses no claim that Coq could be told"


@dataclass(frozen=True)
class Round:
    """One effort, with so many ``seconds`` for a claim.

    ``again``: for those only that were late with it before. ``returns``: who is late with it is asked again.
    """

    effort: Effort
    seconds: float
    again: bool = False
    returns: bool = False


def rounds(efforts: Sequence[Effort], timeout: float) -> Iterator[Round]:
    """Every effort with its share of the time limit of a claim, and then with all of it.

    The first of several does not come again: the others begin with its hints.
    """
    if len(efforts) == 1:
        yield Round(efforts[0], timeout)
        return
    for effort in efforts:
        yield Round(effort, _SHARES[effort] * timeout, returns=effort != efforts[0])
    for effort in efforts[1:]:
        yield Round(effort, timeout, again=True)


class Inquiry:
    """The questions that are still open, from round to round.

    Parameters
    ----------
    questions
        All of them.
    answer
        Called with what is known of a claim: once it is confirmed, when it is found to follow from claims that may
        never be, and else at the end.
    """

    def __init__(self, questions: Iterable[Question], answer: Callable[[Claim, Confirmation], None]) -> None:
        self._open = {question.claim.id: question for question in questions}
        self._answer = answer
        self._answered: dict[str, Confirmation] = {}
        for question in self._open.values():
            if question.given is not None:
                self._tell(question, question.given)

    def known(self, answers: Mapping[str, Confirmation]) -> None:
        """What was known before, by the ids of claims."""
        self._answered.update(answers)

    def now(self, asked: Round) -> list[Question]:
        """What is asked in this round."""
        self._settle()
        return [question for question in self._open.values() if _belongs(question, asked)]

    def say(self, asked: Round, question: Question, said: Confirmation) -> None:
        """What Coq said of a question; it stays open while there may be more to say."""
        name = question.claim.id
        if said.confirmed:
            del self._open[name]
            self._tell(question, said)
            return
        late = question.late - {asked.effort}
        if said.late and (asked.returns or asked.again):
            late |= {asked.effort}
        given = question.given
        if said.given:
            given = replace(said, more=True)
            self._tell(question, given)
        self._open[name] = replace(question, late=late, given=given, last=said)

    def end(self) -> None:
        """What is left has no other answer."""
        self._settle()
        for question in self._open.values():
            if question.given is not None:
                self._tell(question, replace(question.given, more=False))
            else:
                last = question.last or Confirmation(False, _NOT_ASKED, question.said.text)
                self._tell(question, replace(last, late=last.late or bool(question.late)))

    def _tell(self, question: Question, said: Confirmation) -> None:
        self._answered[question.claim.id] = said
        self._answer(question.claim, said)

    def _settle(self) -> None:
        """What follows from claims that are confirmed by now is not asked any more."""
        for name, answer in settled(self._answered).items():
            if answer.confirmed and (question := self._open.pop(name, None)) is not None and question.given is not None:
                self._tell(question, replace(question.given, more=False))


def _belongs(question: Question, asked: Round) -> bool:
    if asked.again:
        return asked.effort in question.late
    # Where a proof puts nothing to use, there is nothing to ask about with lemmas; nor twice.
    return asked.effort != "lemmas" or (has_steps(question.claim) and question.given is None)
