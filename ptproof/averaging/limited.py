"""A study under a time limit: it runs in a process of its own, and what comes back is text."""

from __future__ import annotations

from concurrent.futures import TimeoutError as OutOfTime
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ptproof.errors import InputError

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
    from pebble import ProcessExpired, ProcessPool

    if not 0 < seconds < 1e7:
        raise InputError(f"the time limit must be a positive number of seconds, not {seconds}")
    with ProcessPool(max_workers=1) as pool:
        future = pool.schedule(_study, args=(str(path),), timeout=seconds)
        try:
            return future.result()
        except OutOfTime:
            reason = f"{path}: no answer within {seconds:g} s; a longer --timeout may help"
        except InputError:
            raise
        except ProcessExpired as error:
            reason = f"{path}: the computation ended without an answer ({error})"
        except Exception as error:
            reason = f"{path}: the computation failed, nothing is claimed ({type(error).__name__}: {error})"
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
