"""A study under a time limit: it runs in a process of its own, and what comes back is text."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ptproof.errors import InputError
from ptproof.reading.limits import Answered, Unanswered, Why, apart, check_seconds

if TYPE_CHECKING:
    from ptproof.averaging.study import Average


@dataclass(frozen=True)
class Outcome:
    """What people and programs are told about one dither system."""

    data: dict[str, Any]
    as_expected: bool
    latex: str = ""
    state: tuple[str, ...] = ()
    gradient: str = ""
    caveats: tuple[str, ...] = ()
    reason: str = field(default="")


def study_file(path: str | Path, seconds: float) -> Outcome:
    """Read, average and examine the dither system in a TOML file, within ``seconds``.

    Raises :class:`InputError` for bad input. Out of time, the outcome says so, and nothing in it is claimed.
    """
    check_seconds(seconds, "--timeout")
    match apart(seconds, _study, str(path)):
        case Answered(outcome):
            return outcome
        case Unanswered(error=InputError() as error):
            raise error
        case Unanswered(Why.TIME):
            reason = f"{path}: no answer within {seconds:g} s; a longer --timeout may help"
        case Unanswered(_, reason):
            reason = f"{path}: nothing is claimed: {reason}"
    data: dict[str, Any] = {"average": None, "v": {}, "assumptions": {}, "expected": None}
    return Outcome(data, as_expected=False, reason=reason)


def _study(path: str) -> Outcome:
    from ptproof.averaging.reading import load_dither_system
    from ptproof.averaging.study import study

    problem = load_dither_system(path)
    found = study(problem)
    gradient = found.gradient
    return Outcome(
        found.to_json(),
        found.as_expected,
        found.latex(),
        tuple(str(symbol) for symbol in problem.system.state),
        f"drift + ({gradient[0]}) * grad {gradient[1]}" if gradient else "",
        found.caveats if found.system is not None else (),
        _reason(found),
    )


def _reason(found: Average) -> str:
    """Why there is no average, in one line."""
    if found.system is not None:
        return ""
    if found.refusals:
        return "; ".join(f"refused, {text}" for text in found.refusals)
    return "; ".join(f"undecided, {text}" for text in found.caveats)
