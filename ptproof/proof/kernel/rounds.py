"""The rounds in which Coq is asked: one effort after the other, what is likely to be confirmed before what is not."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from ptproof.proof.claim import Claim
from ptproof.proof.kernel.asking import Effort, Question
from ptproof.proof.kernel.lemmas import has_steps, settled
from ptproof.proof.kernel.remembered import Confirmation

# What quick tactics get of a claim's time limit while others are still to come, which begin with the same hints. Of 306
# claims that they confirmed the slowest took 6 s; they went on for any time in every fifth of the others.
_QUICKLY = 0.3
_NOT_ASKED = "it uses no claim that Coq could be told"


@dataclass(frozen=True)
class Round:
    """One effort, with so many ``seconds`` for a claim.

    ``waiting``: for those only that were found to follow from claims, some of which are still open.
    """

    effort: Effort
    seconds: float
    waiting: bool = False


def rounds(efforts: Sequence[Effort], timeout: float) -> Iterator[Round]:
    """Every effort, and after all of them once more those behind "lemmas" for what waits for an open claim."""
    several = len(efforts) > 1
    for effort in efforts:
        yield Round(effort, timeout * _QUICKLY if several and effort == "quick" else timeout)
    if "lemmas" in efforts:
        for effort in efforts[efforts.index("lemmas") + 1 :]:
            yield Round(effort, timeout, waiting=True)


class Inquiry:
    """The questions that are still open, from round to round.

    Parameters
    ----------
    questions
        All of them.
    known
        What was known before, by the ids of claims.
    answer
        Called with what is known of a claim: once it is confirmed, when it is found to follow from claims that may
        never be, and else at the end.
    """

    def __init__(
        self, questions: Iterable[Question], known: Mapping[str, Confirmation],
        answer: Callable[[Claim, Confirmation], None],
    ) -> None:  # fmt: skip
        self._open = {question.claim.id: question for question in questions}
        self._answer = answer
        self._answered = dict(known)
        for question in self._open.values():
            if question.given is not None:
                self._tell(question, question.given)

    def now(self, asked: Round) -> list[Question]:
        """What is asked in this round, last of all what was late before."""
        self._settle()
        chosen = (question for question in self._open.values() if _belongs(question, asked))
        return sorted(chosen, key=lambda question: len(question.late))

    def say(self, asked: Round, question: Question, said: Confirmation) -> None:
        """What Coq said of a question; it stays open while there may be more to say."""
        name = question.claim.id
        if said.confirmed:
            del self._open[name]
            self._tell(question, said)
            return
        late, given = question.late | ({asked.effort} if said.late else set()), question.given
        if said.given:
            given = replace(said, more=True)
            self._tell(question, given)
        self._open[name] = replace(question, late=late, given=given, last=said)

    def end(self) -> None:
        """What is left has no other answer."""
        self._settle()
        for question in self._open.values():
            late = bool(question.late - {"quick"})
            if question.given is not None:
                self._tell(question, replace(question.given, more=late))
            else:
                last = question.last or Confirmation(False, _NOT_ASKED, question.said.text)
                self._tell(question, replace(last, late=last.late or late))

    def _tell(self, question: Question, said: Confirmation) -> None:
        self._answered[question.claim.id] = said
        self._answer(question.claim, said)

    def _settle(self) -> None:
        """What follows from claims that are confirmed by now is not asked any more."""
        for name, answer in settled(self._answered).items():
            if answer.confirmed and (question := self._open.pop(name, None)) is not None and question.given is not None:
                self._tell(question, replace(question.given, more=False))


def _belongs(question: Question, asked: Round) -> bool:
    if asked.waiting or question.given is not None:
        return asked.waiting and question.given is not None
    # Where a proof puts nothing to use, there is nothing to ask about with lemmas.
    return asked.effort != "lemmas" or has_steps(question.claim)
