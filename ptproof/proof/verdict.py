"""The words a claim can end in, and what is handed over with them."""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


class Verdict(enum.Enum):
    """What is known about a claim; each word has one meaning, written in CONTRIBUTING.

    A verdict is not a truth value: ``if verdict:`` raises, because "undecided" is neither.
    """

    PROVED = "proved"
    REFUTED = "refuted"
    UNDECIDED = "undecided"
    CITED = "cited"
    OBSERVED = "observed"

    def __bool__(self) -> bool:
        raise TypeError("a verdict is not a truth value; compare it: verdict is Verdict.PROVED")

    def __str__(self) -> str:
        return self.value


@dataclass(frozen=True)
class Witness:
    """Exact values at which a claim fails, and what the two sides are there.

    ``values`` maps each symbol, or each undefined function written as applied, to an exact expression as
    text; ``left`` and ``right`` are the two sides there: the exact value and an enclosure of it.
    """

    values: Mapping[str, str]
    left: str
    right: str

    def to_json(self) -> dict[str, Any]:
        return {"values": dict(self.values), "left": self.left, "right": self.right}


@dataclass(frozen=True)
class Evidence:
    """What one engine says about one statement: the verdict, and how.

    Attributes
    ----------
    seconds
        How long the proof took; whoever runs it says so. [s]
    witness
        Exact values at which the statement fails.
    found
        The values of integrals and limits that the engine has found, for whoever looks for a witness.
    suspect
        Exact values at which the engine expects the statement to fail: a witness, if they stand the check.
    facts
        The facts that the engine was given beside those of the goal, for whoever asks where the goal is defined.
    certifies
        What the engine was asked about and what it said, sealed by :func:`ptproof.proof.claim.engine`; evidence
        without it counts for nothing.
    content
        What the claim says that was decided, as :attr:`ptproof.proof.claim.Claim.content` has it.
    besides
        What was found about the same claim by others: where it is defined, and what the attack met.
    """

    engine: str
    verdict: Verdict
    detail: str
    seconds: float = 0.0
    witness: Witness | None = None
    found: Mapping[Any, Any] = field(default_factory=dict, compare=False, repr=False)
    suspect: Mapping[Any, Any] | None = field(default=None, compare=False, repr=False)
    facts: tuple[Any, ...] = field(default=(), compare=False, repr=False)
    certifies: Any = field(default=None, compare=False, repr=False)
    content: str = field(default="", compare=False, repr=False)
    besides: tuple[Evidence, ...] = ()

    def to_json(self) -> dict[str, Any]:
        return {
            "engine": self.engine,
            "verdict": str(self.verdict),
            "detail": self.detail,
            "seconds": round(self.seconds, 4),
        }
