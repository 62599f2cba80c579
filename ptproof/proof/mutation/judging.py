"""One mutant: attacked, given to the proof of its original, and held against it."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeVar

from ptproof.proof.answering import TIME, run_here
from ptproof.proof.mutation.attacking import Falsity, falsity
from ptproof.proof.mutation.equivalence import equivalent, implied
from ptproof.proof.mutation.haste import in_haste
from ptproof.proof.mutation.mutant import Mutant
from ptproof.proof.mutation.outcomes import Outcome, Word
from ptproof.proof.settling import ATTACK
from ptproof.proof.verdict import Evidence, Verdict
from ptproof.reading.limits import OutOfTime, within

Answer = TypeVar("Answer")
STEPS = 5


@dataclass(frozen=True)
class Patience:
    """How long each ``step`` may take (an attack, a proof, the comparison with the original), and the attacker. [s]

    ``question`` is for z3, of one question of a proof, and ``refuted`` where what is to be proved is known to be false.
    """

    step: float = 8.0
    question: float = 0.8
    refuted: float = 0.3
    attack: float = 0.3


def judge(mutant: Mutant, patience: Patience) -> Outcome:
    """What comes of the mutant: its proof is run whether it is refuted or not, since no false one may be proved."""
    start = time.perf_counter()
    with in_haste(patience.question):
        outcome = _judged(mutant, patience, _Steps(patience.step))
    return replace(outcome, seconds=time.perf_counter() - start)


def _judged(mutant: Mutant, patience: Patience, steps: _Steps) -> Outcome:
    false, how, why = None, "", ""
    restates = mutant.claim.statement == mutant.original.statement
    if restates:  # an assumption that says more, or another dependency, makes nothing false
        why = steps.take("comparison", lambda: implied(mutant), "")
    if not why:
        false = steps.take("attack", lambda: falsity(mutant, patience.attack), None)
    with in_haste(patience.refuted if false else patience.question):
        evidence = run_here(mutant.claim, patience.step)
        if evidence.engine == TIME:
            _wait_for_the_rest()
    if false is None:
        false = _by_the_proof(evidence)
    if false is None:
        how = steps.take("comparison", lambda: equivalent(mutant), "")
        if evidence.verdict is Verdict.PROVED and not how and not restates:
            why = steps.take("comparison", lambda: implied(mutant), "")
    if false is not None:
        return _false(mutant, false, evidence, steps.troubles)
    if how:
        return _outcome(mutant, Word.EQUIVALENT, how)
    if evidence.verdict is Verdict.PROVED:
        return _outcome(mutant, Word.PROVED, why or evidence.detail)
    return _outcome(mutant, Word.UNDECIDED, "; ".join(filter(None, [why, evidence.detail, *steps.troubles])))


def _by_the_proof(evidence: Evidence) -> Falsity | None:
    """What an engine refuted, or what the attack met before something was to count as proved."""
    if evidence.verdict is Verdict.REFUTED:
        return Falsity(evidence.witness, evidence.detail)
    return Falsity(None, evidence.detail) if _shows_what_is_false(evidence) else None


def _shows_what_is_false(evidence: Evidence) -> bool:
    """Whether an engine proved it, and only the attacker kept it from counting."""
    return any(item.engine == ATTACK and item.verdict is Verdict.REFUTED for item in evidence.besides)


def _false(mutant: Mutant, false: Falsity, evidence: Evidence, troubles: list[str]) -> Outcome:
    """The outcome of a mutant that is false; only exact values refute it."""
    if evidence.verdict is Verdict.PROVED or _shows_what_is_false(evidence):
        return _outcome(mutant, Word.PROVED, f"{false.how}; {evidence.engine}: {evidence.detail}", false)
    if false.witness is None and evidence.verdict is not Verdict.REFUTED:
        return _outcome(mutant, Word.UNDECIDED, "; ".join([false.how, evidence.detail, *troubles]), false)
    return _outcome(mutant, Word.REFUTED, false.how, false)


def unanswered(mutant: Mutant, reason: str) -> Outcome:
    """The outcome of a mutant whose process came to no end, or to a bad one."""
    return Outcome(mutant.kind, mutant.change, "", Word.UNDECIDED, reason)


def _outcome(mutant: Mutant, word: Word, why: str, false: Falsity | None = None) -> Outcome:
    statement = str(mutant.claim.statement) if word is Word.PROVED else ""  # printing may take numerical integrals
    witness = None if false is None else false.witness
    return Outcome(mutant.kind, mutant.change, statement, word, why, witness, false is not None)


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
