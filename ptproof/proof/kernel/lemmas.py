"""The claims that a claim uses, as lemmas for Coq: what follows from them counts once Coq has confirmed them all."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import replace

from ptproof.proof.answering import READ, read
from ptproof.proof.claim import Claim
from ptproof.proof.kernel.remembered import Confirmation
from ptproof.proof.kernel.terms import NoTranslation
from ptproof.proof.kernel.theorem import Proposition, proposition
from ptproof.proof.load import homes_of
from ptproof.proof.statement import Exists, ForAll
from ptproof.proof.steps import Step, noting
from ptproof.reading.limits import Answered, Workers


def lemmas_of(claim: Claim) -> dict[str, Proposition]:
    """What the claim uses and Coq can be told, by the contents of these claims."""
    found = {}
    for used in claim.uses:
        with suppress(NoTranslation):
            found[used.content] = proposition(used)
    return found


def from_lemmas(said: Proposition, lemmas: Iterable[Proposition]) -> str:
    """That the proposition follows from the lemmas, which stand before it."""
    return "\n  -> ".join(f"({text})" for text in (*(lemma.text for lemma in lemmas), said.text))


def settled(answers: Mapping[str, Confirmation]) -> dict[str, Confirmation]:
    """The answers, with what follows from lemmas confirmed where all of these are."""
    confirmed = {answer.proposition for answer in answers.values() if answer.confirmed}
    open_ = {name: answer for name, answer in answers.items() if answer.given and not answer.confirmed}
    while ready := {name for name, answer in open_.items() if confirmed.issuperset(answer.given)}:
        confirmed |= {open_.pop(name).proposition for name in ready}
    return {
        name: replace(answer, confirmed=True, reason="")
        if answer.given and not answer.confirmed and name not in open_
        else answer
        for name, answer in answers.items()
    }


def has_steps(claim: Claim) -> bool:
    """Whether the proof may put something to use, a claim or what is assumed for all values; or chooses a value."""
    chooses = isinstance(claim.statement, Exists)
    return chooses or bool(claim.uses) or any(isinstance(item, ForAll) for item in claim.assumptions)


class Noted:
    """The steps of the claims' proofs, noted in processes of their own while others wait for them."""

    def __init__(self, claims: Sequence[Claim], workers: int, seconds: float) -> None:
        homes = homes_of(claims)
        self._found: dict[str, Future[tuple[Step, ...]]] = {claim.id: Future() for claim in claims}
        self._seconds = seconds
        at_home = [claim.id for claim in claims if claim.id in homes]
        for claim in claims:
            if claim.id not in homes:
                self._found[claim.id].set_result(())
        self._tasks = {id: (id,) for id in at_home}
        self._processes = Workers(workers, start=read, arguments=(tuple(sorted({homes[id] for id in at_home})),))

    def take(self) -> None:
        """Take each proof; the steps of one that fails, or takes too long, are none."""
        try:
            if self._tasks:
                for id, outcome in self._processes.each(self._seconds, steps_of, self._tasks):
                    self._found[id].set_result(outcome.answer if isinstance(outcome, Answered) else ())
        finally:
            self.stop()

    def of(self, claim: Claim) -> tuple[Step, ...]:
        """The steps of this claim's proof, once they are there."""
        return self._found[claim.id].result()

    def stop(self) -> None:
        """End the processes; who still waits is told that there are no steps."""
        self._processes.stop()
        for found in self._found.values():
            if not found.done():
                found.set_result(())


def steps_of(id: str) -> tuple[Step, ...]:
    """In a worker: the steps of the proof of a claim that was read."""
    claim = READ[id]
    with noting() as steps, suppress(Exception):
        claim.prove(claim.goal())
    return tuple(steps)
