"""A claim with what came out of deciding it, and the outcome of all claims of a run."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from ptproof.proof.claim import Claim
from ptproof.proof.verdict import Evidence, Verdict


@dataclass(frozen=True)
class Result:
    """A claim with what came out: the verdict after its ancestors were looked at, and all evidence."""

    claim: Claim
    verdict: Verdict
    evidence: tuple[Evidence, ...]
    fully_proved: bool
    rests_on: tuple[str, ...] = field(default=())

    @property
    def hit(self) -> Evidence | None:
        """The attack that met an exact point at which something false was shown, by nothing but what is fully proved:
        an error of ptproof."""
        hits = (item for item in self.evidence if (item.engine, item.verdict) == ("attack", Verdict.REFUTED))
        return next(hits, None)

    @property
    def as_expected(self) -> bool:
        """Whether it came out as its author recorded, and nothing contradicts it."""
        return self.verdict is self.claim.expected and self.hit is None

    def to_json(self) -> dict[str, Any]:
        witness = next((item.witness for item in self.evidence if item.witness is not None), None)
        return {
            "id": self.claim.id,
            "labels": list(self.claim.labels),
            "title": self.claim.title,
            "kind": self.claim.kind,
            "statement": str(self.claim.statement),
            "verdict": str(self.verdict),
            "expected": str(self.claim.expected),
            "fully_proved": self.fully_proved,
            "uses": [used.id for used in self.claim.uses],
            "evidence": [item.to_json() for item in self.evidence],
            "witness": None if witness is None else witness.to_json(),
            "erratum": None if self.claim.erratum is None else self.claim.erratum.to_json(),
        }


@dataclass(frozen=True)
class Verification:
    """The outcome of every claim, in the order of the derivation; ``remembered`` are those of an earlier run.

    ``gaps`` is the number of formulas of which nothing is stated yet.
    """

    results: tuple[Result, ...]
    seconds: float
    remembered: frozenset[str] = frozenset()
    gaps: int = 0

    @property
    def as_expected(self) -> bool:
        """Whether every claim came out as its author recorded."""
        return all(result.as_expected for result in self.results)

    def summary(self) -> dict[str, int]:
        """How many claims ended in each verdict, are fully proved, not as expected, or proved and yet hit."""
        counts = {str(verdict): 0 for verdict in Verdict}
        for result in self.results:
            counts[str(result.verdict)] += 1
        counts["total"] = len(self.results)
        counts["fully_proved"] = sum(result.fully_proved for result in self.results)
        counts["unexpected"] = sum(not result.as_expected for result in self.results)
        counts["hit"] = sum(result.hit is not None for result in self.results)
        return counts | ({"gaps": self.gaps} if self.gaps else {})

    def to_json(self) -> dict[str, Any]:
        claims = [result.to_json() for result in self.results]
        for item in claims:
            if item["id"] in self.remembered:
                item["evidence"][0]["remembered"] = True
        return {"claims": claims, "summary": self.summary()}
