"""What came of mutants, as values: one outcome a mutant, the counts of a claim, the whole with its alarms."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from ptproof.proof.claim import Claim
from ptproof.proof.verdict import Witness


class Word(StrEnum):
    """What a mutant can end in."""

    EQUIVALENT = "equivalent"
    REFUTED = "refuted"
    UNDECIDED = "undecided"
    PROVED = "proved"


@dataclass(frozen=True)
class Outcome:
    """What came of one mutant: what was changed in words (``change``), and what it states, where that is proved.

    The ``word`` is ``equivalent`` to the original, and shown to be; ``refuted`` by exact values; ``proved`` by the
    original's proof; or ``undecided``. ``why`` says how that is known, or for what is proved why it is true, as far as
    that is known. ``witness`` are exact values at which it fails; it may be ``false`` by the attacker's numbers only.
    ``seconds`` is how long it took. [s]
    """

    kind: str
    change: str
    statement: str
    word: Word
    why: str
    witness: Witness | None = None
    false: bool = False
    seconds: float = 0.0

    @property
    def alarm(self) -> bool:
        """Something false is proved."""
        return self.false and self.word is Word.PROVED

    def to_json(self) -> dict[str, Any]:
        return {
            "kind": self.kind, "change": self.change, "statement": self.statement, "outcome": str(self.word),
            "why": self.why, "false": self.false,
            "witness": None if self.witness is None else self.witness.to_json(), "seconds": round(self.seconds, 3),
        }  # fmt: skip


@dataclass(frozen=True)
class Mutation:
    """The outcomes of the mutants of every claim, in the order of the claims."""

    claims: tuple[Claim, ...]
    outcomes: Mapping[str, tuple[Outcome, ...]]
    seconds: float

    @property
    def alarms(self) -> tuple[tuple[Claim, Outcome], ...]:
        """The mutants that are false and proved, with the claims that they were made of."""
        return tuple((claim, item) for claim in self.claims for item in self.outcomes[claim.id] if item.alarm)

    @property
    def sound(self) -> bool:
        """Whether nothing false is proved."""
        return not self.alarms

    def counts(self, id: str) -> dict[str, int]:
        """How many mutants of a claim were made, and how many of them ended in each word."""
        return _counts(self.outcomes[id])

    def summary(self) -> dict[str, Any]:
        """The counts of all claims together, and by kind of change."""
        return summed([self])

    def to_json(self) -> dict[str, Any]:
        return {
            "claims": {
                claim.id: {**self.counts(claim.id), "mutants": [item.to_json() for item in self.outcomes[claim.id]]}
                for claim in self.claims
            },
            "summary": self.summary(),
        }


def summed(papers: Sequence[Mutation]) -> dict[str, Any]:
    """The counts of all claims of some papers together, and by kind of change."""
    everything = [item for found in papers for items in found.outcomes.values() for item in items]
    kinds = dict.fromkeys(sorted({item.kind for item in everything}))
    return {
        "claims": sum(len(found.claims) for found in papers),
        **_counts(everything),
        "false": sum(item.false for item in everything),
        "false_proved": sum(len(found.alarms) for found in papers),
        "kinds": {kind: _counts([item for item in everything if item.kind == kind]) for kind in kinds},
        "seconds": round(sum(found.seconds for found in papers), 1),
    }


def _counts(outcomes: Any) -> dict[str, int]:
    words = [item.word for item in outcomes]
    return {"made": len(words)} | {str(word): words.count(word) for word in Word}
