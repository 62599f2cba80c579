"""A corrupted claim as a value, and the places of a statement at which it can be corrupted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Generic, TypeAlias, TypeVar

from ptproof.proof.claim import Claim
from ptproof.proof.mutation.edits import Letters
from ptproof.proof.statement import free_symbols, undefined_functions

Place: TypeAlias = tuple[str | int, ...]
Changed = TypeVar("Changed", covariant=True)


@dataclass(frozen=True)
class Mutant:
    """A claim of which one thing was changed, under the id and with the proof of the ``original``.

    ``kind`` is a word for the kind of change, and ``change`` says in words what was changed.
    """

    claim: Claim
    original: Claim
    kind: str
    change: str


@dataclass(frozen=True)
class Candidate(Generic[Changed]):
    """A change that can be made: its kind, the row that it touches, and its words and what it makes when asked for.

    ``make`` may raise ValueError, TypeError or another error of SymPy where the changed expression cannot be built.
    """

    kind: str
    row: Place
    words: Callable[[], str]
    make: Callable[[], Changed]

    def within(self, whole: Callable[[Changed], Claim], row: Place, before: str) -> Candidate[Claim]:
        """The same change as one of the whole claim, with words before its own."""
        return Candidate(self.kind, row, lambda: before + self.words(), lambda: whole(self.make()))


def restated(claim: Claim, **changes: Any) -> Claim:
    """The claim with parts of its statement changed."""
    statement: Any = claim.statement
    return replace(claim, statement=replace(statement, **changes))


def letters_of(claim: Claim) -> Letters:
    """The symbols and undefined functions that the claim speaks of, in the order of their names."""
    spoken_of = [claim.statement, *claim.assumptions]
    return sorted([*free_symbols(spoken_of), *undefined_functions(spoken_of)], key=str)
