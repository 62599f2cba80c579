"""Questions to Coq: several claims in a file, those that it did not come to in another one."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

from ptproof.proof.claim import Claim
from ptproof.proof.kernel import coq
from ptproof.proof.kernel.hints.portfolio import script
from ptproof.proof.kernel.lemmas import from_lemmas, lemmas_of
from ptproof.proof.kernel.remembered import Confirmation
from ptproof.proof.kernel.theorem import Proposition
from ptproof.proof.steps import Put, Step

Effort: TypeAlias = Literal["quick", "lemmas", "thorough"]
EFFORTS: tuple[Effort, ...] = ("quick", "lemmas", "thorough")
StepsOf: TypeAlias = Callable[[Claim], Sequence[Step]]
_TO_START = 30.0


@dataclass(frozen=True)
class Question:
    """A claim in Coq's words.

    ``late`` are the efforts whose answers came too late so far, ``given`` is the answer that it follows from other
    claims, and ``last`` the last one that was none.
    """

    claim: Claim
    said: Proposition
    late: frozenset[Effort] = frozenset()
    given: Confirmation | None = None
    last: Confirmation | None = None


@dataclass(frozen=True)
class _Asked:
    """A question with the tactics that Coq is to try now, and the lemmas that it may use."""

    question: Question
    theorem: coq.Theorem
    lemmas: tuple[Proposition, ...] = ()

    def answered(self, against: str, seconds: float) -> Confirmation:
        """What it means that the kernel has checked the theorem."""
        given, text = tuple(lemma.text for lemma in self.lemmas), self.question.said.text
        if not against and given:
            names = ", ".join(lemma.claim.id for lemma in self.lemmas)
            return Confirmation(False, f"only if {names}", text, seconds, given=given)
        return Confirmation(not against, against, text, seconds)

    def refused(self, why: coq.Refusal | None, seconds: float) -> Confirmation:
        """What it means that Coq has found no proof."""
        why = why or coq.Refusal("Coq gave no answer", late=True)
        return Confirmation(False, why.reason, self.question.said.text, seconds, late=why.late)


@dataclass(frozen=True)
class Asking:
    """How claims are asked about: ``folder`` for the files, and whether to stop."""

    folder: Path
    stop: coq.Stop

    def answers(
        self, name: str, effort: Effort, asked: Sequence[Question], timeout: float, steps: StepsOf
    ) -> Iterator[tuple[Question, Confirmation]]:
        """What Coq says of the claims of one file with the tactics of one effort.

        Those that it did not come to are asked about again, as long as it comes to any.

        Parameters
        ----------
        name
            That of the file.
        effort, asked
            The effort, and the claims.
        timeout
            The time limit of one claim. [s]
        steps
            Gives those of a claim's proof.
        """
        left = [_asked(question, name, effort, steps) for question in asked]
        run = 0
        while left and not self.stop.is_set():
            theorems = [item.theorem for item in left]
            file = self.folder / f"claims_{name}{f'_{run}' if run else ''}.v"
            file.write_text(coq.source(theorems, timeout), encoding="utf-8")
            start = time.perf_counter()
            printed = coq.ask(self.folder, file.name, _TO_START + 2 * timeout * len(left), self.stop)
            if self.stop.is_set():
                return
            seconds = (time.perf_counter() - start) / len(left)
            again: list[_Asked] = []
            heard, reasons = _read(printed, theorems)
            moved = bool(heard) or any(reason is not None for reason in reasons.values())
            for item in left:
                if (against := heard.get(item.theorem.name)) is not None:
                    yield item.question, item.answered(against, seconds)
                elif (reason := reasons[item.theorem.name]) is None and moved:  # Coq was ended before it came to it
                    again.append(item)
                else:
                    yield item.question, item.refused(reason, seconds)
            left = again
            run += 1


def _asked(question: Question, name: str, effort: Effort, steps: StepsOf) -> _Asked:
    """The question with the tactics of an effort."""
    claim, said = question.claim, question.said
    lemmas = lemmas_of(claim) if effort == "lemmas" else {}
    taken = _steps(steps(claim), lemmas) if effort == "lemmas" else ()
    text = from_lemmas(said, lemmas.values()) if lemmas else said.text
    theorem = coq.Theorem(f"{said.name}_{name}", text, _tactics(said, effort, lemmas, taken))
    return _Asked(question, theorem, tuple(lemmas.values()))


def _steps(noted: Sequence[Step], lemmas: dict[str, Proposition]) -> tuple[Step, ...]:
    """The claims that it uses as they stand, and the steps of the proof."""
    put = {step.content for step in noted if isinstance(step, Put)}
    return (*(Put(content) for content in lemmas if content not in put), *noted)


def _read(
    printed: coq.Printed, theorems: Sequence[coq.Theorem]
) -> tuple[dict[str, str], dict[str, coq.Refusal | None]]:
    """What was heard of theorems, and why Coq did not accept the others."""
    heard = coq.heard(printed.output, theorems)
    # What was proved before Coq was ended, and has not been looked at to the end, is asked again.
    there = coq.proved(printed.output, theorems)
    unheard = (theorem for theorem in theorems if theorem.name not in heard)
    return heard, {item.name: None if item.name in there else printed.stopped(item) for item in unheard}


def _tactics(said: Proposition, effort: Effort, lemmas: dict[str, Proposition], steps: Sequence[Step]) -> str:
    """The tactics; where the search for hints fails, Coq is told so in their place."""
    try:
        return script(said, thorough=effort == "thorough", lemmas=lemmas, steps=steps)
    except Exception as error:  # SymPy's, of whatever kind: the claim is without hints, the others are not
        reason = f"{type(error).__name__} in the search for hints: {error}".replace('"', "'")
        return f'fail 0 "at" "{" ".join(reason.split())}"'
