"""What Coq has answered, from one run to the next: known again by the proposition itself, in this version of all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING

from ptproof.proof.kernel import coq

if TYPE_CHECKING:
    from ptproof.proof.memory import Memory


@dataclass(frozen=True)
class Confirmation:
    """What Coq's kernel says of one claim: whether it has checked a proof of it as restated, and if not, the reason.

    ``proposition`` is the claim in Coq's words, where it has a translation. ``seconds`` is how long the file took that
    the claim stood in, shared among its claims. [s] ``late``: for want of time; ``remembered``: from an earlier run.
    ``given`` are the propositions of the claims from which Coq has shown that it follows; it is confirmed if they are.
    ``more``: there are efforts with which it may be asked, should they not be.
    """

    confirmed: bool
    reason: str = ""
    proposition: str = ""
    seconds: float = 0.0
    late: bool = False
    remembered: bool = False
    given: tuple[str, ...] = ()
    more: bool = False


def recall(memory: Memory, proposition: str, efforts: Sequence[str]) -> Confirmation | None:
    """What an earlier run was answered about this very text, with these efforts and this version of Coq."""
    match memory.recall_said(*_key(proposition, efforts)):
        case {"confirmed": bool(sure), "reason": str(why), "seconds": int() | float() as seconds, "given": list(given),
              "more": bool(more)}:  # fmt: skip
            return Confirmation(sure, why, proposition, seconds, remembered=True, given=tuple(given), more=more)
    return None


def keep(memory: Memory, said: Confirmation, efforts: Sequence[str]) -> None:
    """Keep what was said, unless for want of time."""
    if not said.late:
        memory.keep_said(asdict(said), *_key(said.proposition, efforts))


def _key(proposition: str, efforts: Sequence[str]) -> tuple[str, ...]:
    return ("Coq's kernel", coq.version(), *efforts, proposition)
