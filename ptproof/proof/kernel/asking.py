"""Questions to Coq: several claims in a file, each of them again with other hints where Coq finds no proof."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal, TypeAlias

from ptproof.proof.claim import Claim
from ptproof.proof.kernel import coq
from ptproof.proof.kernel.hints.portfolio import script
from ptproof.proof.kernel.lemmas import from_lemmas, has_steps, lemmas_of
from ptproof.proof.kernel.remembered import Confirmation
from ptproof.proof.kernel.theorem import Proposition
from ptproof.proof.steps import Put, Step

Effort: TypeAlias = Literal["quick", "lemmas", "thorough"]
EFFORTS: tuple[Effort, ...] = ("quick", "lemmas", "thorough")
_TO_START = 30.0


@dataclass(frozen=True)
class Asked:
    """A claim in Coq's words, and how it is asked about now: with which tactics, and from which lemmas."""

    claim: Claim
    said: Proposition
    theorem: coq.Theorem
    left: tuple[Effort, ...] = ()
    lemmas: tuple[Proposition, ...] = ()
    late: bool = False  # whether another effort came to its time limit

    def answered(self, against: str, seconds: float) -> Confirmation:
        """What it means that the kernel has checked the theorem."""
        given = tuple(lemma.text for lemma in self.lemmas)
        if not against and given:
            names = ", ".join(lemma.claim.id for lemma in self.lemmas)
            return Confirmation(False, f"only if {names}", self.said.text, seconds, given=given)
        return Confirmation(not against, against, self.said.text, seconds)


@dataclass(frozen=True)
class Asking:
    """How claims are asked about: ``folder`` for the files, the time limit of one claim [s], and whether to stop.

    ``steps`` gives those of a claim's proof.
    """

    folder: Path
    timeout: float
    efforts: tuple[Effort, ...]
    stop: coq.Stop
    steps: Callable[[Claim], Sequence[Step]]

    def answers(self, number: int, claims: Sequence[tuple[Claim, Proposition]]) -> Iterator[tuple[Claim, Confirmation]]:
        """What Coq says of the claims of one file; those at which it stops are asked about again."""
        left: list[Asked] = []
        for claim, said in claims:
            if (first := self._asked(claim, said, number, self.efforts)) is not None:
                left.append(first)
            else:
                yield claim, Confirmation(False, "it uses no claim that Coq could be told", said.text)
        run = 0
        while left and not self.stop.is_set():
            theorems = [asked.theorem for asked in left]
            file = self.folder / f"claims_{number:03d}{f'_{run}' if run else ''}.v"
            file.write_text(coq.source(theorems, self.timeout), encoding="utf-8")
            start = time.perf_counter()
            printed = coq.ask(self.folder, file.name, _TO_START + 2 * self.timeout * len(left), self.stop)
            if self.stop.is_set():
                return
            seconds = (time.perf_counter() - start) / len(left)
            again: list[Asked] = []
            heard, reasons = _read(printed, theorems)
            moved = bool(heard) or any(reason is not None for reason in reasons.values())
            for asked in left:
                if (against := heard.get(asked.theorem.name)) is not None:
                    yield asked.claim, asked.answered(against, seconds)
                    continue
                reason = reasons[asked.theorem.name]
                if reason is None and moved:  # Coq was ended before it came to this one
                    again.append(asked)
                elif (
                    reason is not None
                    and (more := self._asked(asked.claim, asked.said, number, asked.left)) is not None
                ):
                    again.append(replace(more, late=asked.late or reason.late))
                else:
                    why = reason or coq.Refusal("Coq gave no answer", late=True)
                    late = asked.late or why.late
                    yield asked.claim, Confirmation(False, why.reason, asked.said.text, seconds, late=late)
            left = again
            run += 1

    def _asked(self, claim: Claim, said: Proposition, number: int, efforts: Sequence[Effort]) -> Asked | None:
        """The claim with the tactics of the first of the efforts that can be made for it."""
        for position, effort in enumerate(efforts):
            lemmas = lemmas_of(claim) if effort == "lemmas" else {}
            steps = self._steps(claim, lemmas) if effort == "lemmas" and has_steps(claim) else ()
            if effort == "lemmas" and not steps:
                continue
            name, left = f"{said.name}_{number}", tuple(efforts[position + 1 :])
            text = from_lemmas(said, lemmas.values()) if lemmas else said.text
            tactics = _tactics(said, effort, lemmas, steps)
            return Asked(claim, said, coq.Theorem(name, text, tactics), left, tuple(lemmas.values()))
        return None

    def _steps(self, claim: Claim, lemmas: dict[str, Proposition]) -> tuple[Step, ...]:
        """The claims that it uses as they stand, and the steps of the proof."""
        steps = tuple(self.steps(claim))
        put = {step.content for step in steps if isinstance(step, Put)}
        return (*(Put(content) for content in lemmas if content not in put), *steps)


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
