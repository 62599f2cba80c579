"""The verdict of a claim as a reader sees it: a word, a sign and a colour."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ptproof.proof.result import Result
from ptproof.proof.verdict import Verdict


@dataclass(frozen=True)
class Status:
    """``key`` names the colour, ``sign`` stands beside it for those who do not see it."""

    key: str
    word: str
    sign: str
    meaning: str

    @property
    def proved(self) -> bool:
        """Whether it is proved, if only from what others say."""
        return self.sign.startswith("✓")


FULLY = Status("full", "fully proved", "✓", "the claim and everything that it uses are proved")
MODULO_CITATIONS = Status(
    "modulo", "proved, modulo citations", "✓*", "proved from claims of which some are cited from the literature"
)
MODULO_OPEN = Status("open", "proved, modulo open claims", "✓?", "proved from claims of which some are not proved")
REFUTED = Status("refuted", "refuted", "✗", "false: exact values satisfy every assumption and separate the two sides")
UNDECIDED = Status("undecided", "undecided", "?", "neither proved nor refuted, with what was tried")
CITED = Status("cited", "cited", "§", "taken from the literature and not proved here")
OBSERVED = Status("observed", "observed", "◉", "a numerical experiment says so; evidence, not a proof")
ALL = (FULLY, MODULO_CITATIONS, MODULO_OPEN, REFUTED, UNDECIDED, CITED, OBSERVED)

_PLAIN = {
    Verdict.REFUTED: REFUTED,
    Verdict.UNDECIDED: UNDECIDED,
    Verdict.CITED: CITED,
    Verdict.OBSERVED: OBSERVED,
}


def status_of(result: Result, results: Mapping[str, Result]) -> Status:
    """The status of a result; ``results`` has the results of the claims that it rests on."""
    if result.verdict is not Verdict.PROVED:
        return _PLAIN[result.verdict]
    if result.fully_proved:
        return FULLY
    only_cited = all(name in results and results[name].verdict is Verdict.CITED for name in result.rests_on)
    return MODULO_CITATIONS if only_cited and result.rests_on else MODULO_OPEN
