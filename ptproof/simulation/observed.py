"""What a paper says of its simulations: as numbers against a criterion, and as claims that are observed.

An observation is evidence for what no engine can decide. It is never a proof, and nothing that is proved uses it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

from ptproof.proof import Claim, Evidence, Goal, Prose, Verdict, claim, engine


@dataclass(frozen=True)
class Statement:
    """One statement about simulations, quantified.

    Attributes
    ----------
    id, words
        A name, and the statement as the paper means it.
    criterion
        What has to hold for the numbers to support it.
    supported
        Whether it does.
    data
        The numbers, plain floats.
    settings
        What repeats them.
    remark
        What the numbers say beyond the words.
    """

    id: str
    words: str
    criterion: str
    supported: bool
    data: Mapping[str, float]
    settings: Mapping[str, Any]
    remark: str = ""

    def to_json(self) -> dict[str, Any]:
        """The whole as data."""
        return asdict(self)

    def __str__(self) -> str:
        numbers = "; ".join(f"{name} {value:.4g}" for name, value in self.data.items())
        settings = ", ".join(f"{name} {value}" for name, value in self.settings.items())
        words = "supported" if self.supported else "not supported"
        remark = f" ({self.remark})" if self.remark else ""
        return f"{words}: {self.criterion}. {numbers}. Settings: {settings}{remark}"


@engine
def simulation(goal: Goal, experiment: Callable[..., Statement], *arguments: Any) -> Evidence:
    """Make the experiment; numbers that do not support its statement leave the claim open."""
    found = experiment(*arguments)
    return Evidence("simulation", Verdict.OBSERVED if found.supported else Verdict.UNDECIDED, str(found))


def observed(
    id: str, title: str, text: str, place: str, experiment: Callable[..., Statement], *arguments: Any,
    section: str, expected: str = "observed",
) -> Claim:  # fmt: skip
    """The claim that an experiment supports its statement, which is decided by making it.

    Parameters
    ----------
    id, title, text, place, section
        As for any claim; the text is what it states.
    experiment, arguments
        What is made, when the claim is decided.
    """

    def prove(goal: Goal) -> Evidence:
        return simulation(goal, experiment, *arguments)

    prove.__doc__ = f"A numerical experiment, repeated by `ptproof verify -k {id} --fresh`."
    return replace(claim(id, title, Prose(text), expected=expected, place=place)(prove), section=section)
