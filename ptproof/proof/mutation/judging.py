"""One mutant: attacked, given to the proof of its original, and held against it."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeVar

from ptproof.proof.deciding import run_one
from ptproof.proof.mutation.attacking import Point, searched, witness_at
from ptproof.proof.mutation.equivalence import equivalent, implied
from ptproof.proof.mutation.haste import in_haste
from ptproof.proof.mutation.mutant import Mutant
from ptproof.proof.mutation.outcomes import Outcome, Word
from ptproof.proof.verdict import Evidence, Verdict, Witness
from ptproof.reading.limits import OutOfTime, within

Answer = TypeVar("Answer")
STEPS = 5


@dataclass(frozen=True)
class Patience:
    """How long each step may take. [s]

    Attributes
    ----------
    step
        An attack at given points, a proof, or the comparison with the original.
    question
        z3, for one question of a proof.
    refuted
        z3, for one question where the mutant is known to be false.
    search
        The search for a witness where the points showed none; three times that where something is proved.
    """

    step: float = 8.0
    question: float = 1.0
    refuted: float = 0.4
    search: float = 0.4


def judge(mutant: Mutant, points: tuple[Point, ...], patience: Patience) -> Outcome:
    """What comes of the mutant: its proof is run whether it is refuted or not, since no false one may be proved."""
    start = time.perf_counter()
    outcome = _judged(mutant, points, patience, _Steps(patience.step))
    return replace(outcome, seconds=time.perf_counter() - start)


def _judged(mutant: Mutant, points: tuple[Point, ...], patience: Patience, steps: _Steps) -> Outcome:
    witness = steps.take("attack", lambda: witness_at(mutant, points), None)
    with in_haste(patience.refuted if witness is not None else patience.question):
        evidence = steps.take("proof", lambda: run_one(mutant.claim), _NO_ANSWER)
    if evidence.verdict is Verdict.REFUTED and witness is None:
        return _outcome(mutant, Word.REFUTED, evidence.detail, evidence.witness, false=True)
    proved = evidence.verdict is Verdict.PROVED
    how = why = ""
    if witness is None:
        how = steps.take("comparison", lambda: equivalent(mutant), "")
        why = "" if how else steps.take("comparison", lambda: implied(mutant), "")
    if witness is None and not how and not why:  # what follows from the original cannot be refuted
        seconds = 3 * patience.search if proved else patience.search
        with in_haste(patience.refuted):
            witness = steps.take("attack", lambda: searched(mutant, seconds), None)
    if witness is not None:
        word = Word.PROVED if proved else Word.REFUTED
        return _outcome(mutant, word, "exact values at which it fails", witness, false=True)
    if how:
        return _outcome(mutant, Word.EQUIVALENT, how)
    if proved:
        return _outcome(mutant, Word.PROVED, why or evidence.detail)
    return _outcome(mutant, Word.UNDECIDED, "; ".join(filter(None, [why, evidence.detail, *steps.troubles])))


def unanswered(mutant: Mutant, reason: str) -> Outcome:
    """The outcome of a mutant whose process came to no end, or to a bad one."""
    return Outcome(mutant.kind, mutant.change, "", Word.UNDECIDED, reason)


_NO_ANSWER = Evidence("time limit", Verdict.UNDECIDED, "the proof had no answer in time")


def _outcome(mutant: Mutant, word: Word, why: str, witness: Witness | None = None, false: bool = False) -> Outcome:
    statement = str(mutant.claim.statement) if word is Word.PROVED else ""  # printing may take numerical integrals
    return Outcome(mutant.kind, mutant.change, statement, word, why, witness, false)


class _Steps:
    """Steps of which one that fails or takes too long costs its own answer only."""

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self.troubles: list[str] = []

    def take(self, name: str, work: Callable[[], Answer], otherwise: Answer) -> Answer:
        """The answer of the work, or ``otherwise`` where it raises or has none in time."""
        try:
            return within(self._seconds, work)
        except OutOfTime:
            self.troubles.append(f"{name}: no answer in {self._seconds:g} s")
            _wait_for_the_rest()
        except Exception as error:
            self.troubles.append(f"{name}: {type(error).__name__}: {error}")
        return otherwise


def _wait_for_the_rest() -> None:
    """Work that was told to stop may still be inside z3, which nobody else may use meanwhile."""
    for thread in threading.enumerate():
        if thread.name == "ptproof time limit":
            thread.join(5.0)
