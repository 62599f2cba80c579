"""What a reader has to know of a printed claim that is false, besides the witness: how grave it is, in words."""

from __future__ import annotations

import enum
from dataclasses import dataclass

from ptproof.errors import InputError


class Grade(enum.Enum):
    """How much an erratum weighs, from the heaviest to the lightest."""

    ERROR = "error"
    DEFINITION = "definition"
    HYPOTHESIS = "hypothesis"
    NUMBER = "number"
    MISPRINT = "misprint"
    WORDING = "wording"

    @property
    def words(self) -> str:
        """The grade as the report prints it."""
        return _WORDS[self][0]

    @property
    def meaning(self) -> str:
        """What the grade says of the paper."""
        return _WORDS[self][1]

    @property
    def rank(self) -> int:
        """0 for the heaviest."""
        return list(Grade).index(self)


_WORDS = {
    Grade.ERROR: ("error in the mathematics", "a step that does not follow, or a formula that is false as it is meant"),
    Grade.DEFINITION: ("inconsistent definition", "a definition that does not say what it is used for"),
    Grade.HYPOTHESIS: ("hypothesis not met", "a condition that is asked for and does not hold where it is used"),
    Grade.NUMBER: ("wrong number", "a number that is not the value of its formula"),
    Grade.MISPRINT: ("misprint", "a letter or a sign that the context corrects, and that the rest does not use"),
    Grade.WORDING: ("wording", "a sentence that says more, or other, than what is meant"),
}


@dataclass(frozen=True)
class Erratum:
    """What the author of a derivation says of a printed claim that is refuted: how grave that is, and two sentences.

    ``wrong`` says what is wrong, and ``survives`` what becomes of the results that rest on it.
    """

    grade: Grade
    wrong: str
    survives: str

    def __post_init__(self) -> None:
        for name, sentence in (("wrong", self.wrong), ("survives", self.survives)):
            if not sentence.strip():
                raise InputError(f"an erratum needs a sentence for {name!r}, which is empty")

    def to_json(self) -> dict[str, str]:
        return {"grade": self.grade.value, "wrong": self.wrong, "survives": self.survives}


def erratum(id: str, expected: str, grade: str, wrong: str, survives: str) -> Erratum | None:
    """The erratum of the claim ``id``; None where all three are left out.

    Raises
    ------
    InputError
        If some are left out, the grade is unknown, or the claim is not expected to be refuted.
    """
    if not (grade or wrong or survives):
        return None
    if not (grade and wrong and survives):
        raise InputError(f"claim {id}: `grade`, `wrong` and `survives` are given together or not at all")
    if expected != "refuted":
        raise InputError(f"claim {id}: only a claim with expected='refuted' has a grade")
    known = [item.value for item in Grade]
    if grade not in known:
        raise InputError(f"claim {id}: the grade {grade!r} is none of {', '.join(known)}")
    return Erratum(Grade(grade), wrong, survives)
