"""The mutants of a claim: each kind and each row at least once, the rest by lot, always the same ones."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence

from ptproof.errors import InputError
from ptproof.proof.claim import Claim
from ptproof.proof.mutation.hypotheses import changed_hypotheses
from ptproof.proof.mutation.mutant import Candidate, Mutant, Place
from ptproof.proof.mutation.statements import changed_statements

PER_CLAIM = 21
_NOT_BUILT = (ArithmeticError, AttributeError, IndexError, NotImplementedError, TypeError, ValueError, InputError)


def mutants(claim: Claim, others: Sequence[Claim] = (), *, count: int = PER_CLAIM, seed: int = 0) -> list[Mutant]:
    """About ``count`` corrupted versions of the claim, fewer where there are no more.

    Every kind of change that applies is there, and every row of every vector and part of a conjunction, even where
    that takes more than ``count``. No two are the same claim, and none is the original.

    Parameters
    ----------
    claim
        What is corrupted.
    others
        Claims that may be put in the place of one that is used.
    count
        How many are wanted.
    seed
        Another number makes another choice.
    """
    choice = _Choice(claim, random.Random(f"{seed}:{claim.id}"))
    waiting: dict[str, list[Candidate[Claim]]] = {}
    for candidate in (*changed_statements(claim), *changed_hypotheses(claim, others)):
        waiting.setdefault(candidate.kind, []).append(candidate)
    rows = {item.row for items in waiting.values() for item in items if item.row[0] not in ("declared", "uses")}
    for candidates in waiting.values():
        choice.random.shuffle(candidates)
    first = True
    while any(waiting.values()) and (first or len(choice.made) < count):
        for candidates in waiting.values():
            if first or len(choice.made) < count:
                choice.take_one(candidates)
        first = False
    for row in sorted(rows - choice.rows, key=str):
        choice.take_one([item for candidates in waiting.values() for item in candidates if item.row == row])
    return choice.made


class _Choice:
    """What was chosen so far, and which rows it touches."""

    def __init__(self, claim: Claim, lot: random.Random) -> None:
        self.claim, self.random = claim, lot
        self.made: list[Mutant] = []
        self.rows: set[Place] = set()
        self._seen = {claim.content}

    def take_one(self, candidates: list[Candidate[Claim]]) -> None:
        """Make the first of the candidates that can be made and is new, those of an untouched row first."""
        while candidates:
            place = next((i for i, item in enumerate(candidates) if item.row not in self.rows), 0)
            candidate = candidates.pop(place)
            try:
                changed = candidate.make()
            except _NOT_BUILT:
                continue  # SymPy cannot build its expressions, or they are no expressions any more
            if changed.content in self._seen:
                continue
            self._seen.add(changed.content)
            self.rows.add(candidate.row)
            self.made.append(Mutant(changed, self.claim, candidate.kind, candidate.words()))
            return


def neighbours(claims: Sequence[Claim]) -> Iterator[tuple[Claim, tuple[Claim, ...]]]:
    """Each claim with the one before and the two before that, which may be put in the place of what it uses."""
    for position, claim in enumerate(claims):
        yield claim, tuple(claims[max(0, position - 3) : position])
