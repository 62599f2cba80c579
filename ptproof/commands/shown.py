"""A verification as plain data: what is printed, and what can be kept for a run in which nothing has changed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ptproof.commands.papers import qualified, shared

if TYPE_CHECKING:
    from ptproof.proof.result import Verification


@dataclass(frozen=True)
class Shown:
    """The JSON of a verification, the section of each claim, and how long it took. [s]"""

    json: Mapping[str, Any]
    sections: Mapping[str, str]
    seconds: float

    @classmethod
    def of(cls, verification: Verification) -> Shown:
        """What there is to show of a verification."""
        sections = {result.claim.id: result.claim.section for result in verification.results}
        return cls(verification.to_json(), sections, verification.seconds)

    @classmethod
    def again(cls, data: Any) -> Shown | None:
        """What was kept as ``data``, all of it remembered; None if that is not in it."""
        try:
            json, sections = data["json"], dict(data["sections"])
            for claim in json["claims"]:
                sections[claim["id"]]
                claim["evidence"][0]["remembered"] = True
            return cls(json, sections, 0.0)
        except (KeyError, TypeError, IndexError):
            return None

    @property
    def data(self) -> dict[str, Any]:
        """As :meth:`again` takes it."""
        return {"json": self.json, "sections": self.sections}

    @property
    def claims(self) -> list[Mapping[str, Any]]:
        """The claims as they stand in the JSON."""
        return list(self.json["claims"])

    @property
    def as_expected(self) -> bool:
        """Whether every claim came out as its author recorded."""
        return all(claim["verdict"] == claim["expected"] for claim in self.claims)

    @property
    def remembered(self) -> int:
        """How many claims an earlier run has decided."""
        return sum(any(item.get("remembered") for item in claim["evidence"]) for claim in self.claims)


def together(found: Mapping[str, Shown]) -> dict[str, Any]:
    """The JSON of all papers: if there are several, each claim says of which it is, and the sums are over all of them.

    An id that stands in two of the papers is written ``paper:id``.
    """
    if len(found) == 1:
        return dict(*(shown.json for shown in found.values()))
    twice = shared({name: [claim["id"] for claim in shown.claims] for name, shown in found.items()})
    claims = [
        {
            **claim,
            "id": qualified(claim["id"], name, twice),
            "uses": [qualified(used, name, twice) for used in claim["uses"]],
            "paper": name,
        }
        for name, shown in found.items()
        for claim in shown.claims
    ]
    total: Counter[str] = Counter()
    for shown in found.values():
        total.update(shown.json["summary"])
    summaries = {name: shown.json["summary"] for name, shown in found.items()}
    return {"claims": claims, "summary": dict(total), "papers": summaries}
