"""A corrupted claim as a value, and the places of a statement at which it can be corrupted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

from ptproof.proof.claim import Claim
from ptproof.proof.mutation.edits import Letters
from ptproof.proof.statement import free_symbols, undefined_functions

Place: TypeAlias = tuple[str | int, ...]


@dataclass(frozen=True)
class Mutant:
    """A claim of which one thing was changed.

    Attributes
    ----------
    claim
        The changed claim, under the id and with the proof of the original.
    original
        What it was made of.
    kind
        A word for the kind of change.
    change
        What was changed, in words.
    """

    claim: Claim
    original: Claim
    kind: str
    change: str


@dataclass(frozen=True)
class Candidate:
    """A change that can be made: its kind, the row that it touches, and its words and the changed claim when asked for.

    ``make`` may raise ValueError, TypeError or another error of SymPy where the changed expression cannot be built.
    """

    kind: str
    row: Place
    words: Callable[[], str]
    make: Callable[[], Claim]


def letters_of(claim: Claim) -> Letters:
    """The symbols and undefined functions that the claim speaks of, in the order of their names."""
    spoken_of = [claim.statement, *claim.assumptions]
    return sorted([*free_symbols(spoken_of), *undefined_functions(spoken_of)], key=str)
