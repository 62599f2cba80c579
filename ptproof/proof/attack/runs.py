"""Attacking a statement about runs: they are integrated from starts that it allows, by a method without guarantees.

Nothing of it is shared with the enclosures: Adams' and Gear's methods in floating-point numbers. A hit is a relation
that fails by far more than two tolerances make a difference.
"""

from __future__ import annotations

import math
import time as clock
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import sympy as sp

from ptproof.proof.relation import MEANING, Relation
from ptproof.proof.runs import Runs

if TYPE_CHECKING:
    import numpy as np

_STARTS, _TRIES, _INSTANTS = 4, 4000, 400
_TOLERANCES = 1e-7, 1e-8
_WORK = 150_000  # rates
_APART = 1e3  # so many times the difference of the two


class Failure(NamedTuple):
    """A start, and the instant at which a relation fails on the run from there, with its two sides."""

    values: dict[sp.Symbol, float]
    part: Relation
    left: str
    right: str


@dataclass(frozen=True)
class Tried:
    """How many runs were looked at, and what failed on one of them."""

    runs: int
    failure: Failure | None


def tried(said: Runs, seed: int, seconds: float = math.inf) -> Tried:
    """Runs from a few starts, at least one, for about so many seconds."""
    end, count = clock.process_time() + seconds, 0
    rates = _Rates(said)
    for start in _starts(said, seed):
        first, second = (_run(said, rates, start, tolerance) for tolerance in _TOLERANCES)
        if first is not None and second is not None:
            count += 1
            if (failure := _failure(said, start, first, second)) is not None:
                return Tried(count, failure)
        if clock.process_time() > end or rates.left < 0:
            break
    return Tried(count, None)


class _TooMuch(Exception):
    """Runs that take too many steps: the work is limited, so that the same is tried on every machine."""


class _Rates:
    """The rates as numbers, so many times and no more."""

    def __init__(self, said: Runs) -> None:
        # Written as Python, a branch that does not hold is not computed; Mod is not written rightly so.
        plain = "numpy" if any(rate.has(sp.Mod) for rate in said.rates) else "math"
        self.function = sp.lambdify(said.letters, said.rates, modules=plain, cse=False)
        self.left = _WORK

    def __call__(self, time: float, x: Any) -> Any:
        self.left -= 1
        if self.left < 0:
            raise _TooMuch
        return self.function(float(time), *x.tolist())


def _starts(said: Runs, seed: int) -> Iterator[np.ndarray[Any, Any]]:
    """Starts that are allowed: equations for a state are solved by putting in the others, the rest is drawn."""
    import numpy as np

    fixed = [part for part in said.starts if part.sign == "=" and part.left in said.state]
    given = {part.left: sp.lambdify(said.state, part.right, modules="numpy") for part in fixed}
    rest = [part for part in said.starts if part not in fixed]
    sides = [sp.lambdify(said.state, [part.left, part.right], modules="numpy") for part in rest]
    lot, found = np.random.default_rng(seed), 0
    for _ in range(_TRIES):
        point = lot.normal(size=len(said.state)) * 10.0 ** lot.uniform(-1, 1)
        for _ in range(2):  # one that is given by another that is given, too
            for k, x in enumerate(said.state):
                if x in given:
                    point[k] = float(given[x](*point))
        if all(MEANING[part.sign](*map(float, side(*point))) for part, side in zip(rest, sides, strict=True)):
            yield point
            found += 1
        if found == _STARTS or (found and len(fixed) == len(said.state)):
            return


def _run(said: Runs, rates: Any, start: Any, tolerance: float) -> Any:
    """The states (n × instants), from the first instant to the last that is spoken of; None where that fails."""
    import numpy as np
    from scipy.integrate import solve_ivp

    begin, first, last = (float(instant) for instant in (said.span[0], *said.during))
    if not last > begin:
        return None
    instants = [last] if said.at_once else np.linspace(first, last, _INSTANTS)
    try:
        done = solve_ivp(rates, (begin, last), start, "LSODA", instants, rtol=tolerance, atol=tolerance)
    except (ValueError, ArithmeticError, _TooMuch):
        return None
    return np.asarray(done.y) if done.success and np.all(np.isfinite(done.y)) else None


def _failure(said: Runs, start: Any, first: Any, second: Any) -> Failure | None:
    import numpy as np

    instants = np.linspace(float(said.during[0]), float(said.during[1]), first.shape[1])
    for part in said.parts:
        sides = sp.lambdify(said.letters, [part.left, part.right], modules="numpy")
        values = []
        for run in (first, second):
            left, right = (np.broadcast_to(side, instants.shape) for side in sides(instants, *run))
            values.append(left - right)
        apart = np.abs(values[1])
        sure = apart > _APART * (np.abs(values[0] - values[1]) + 1e-9 * (1 + np.abs(left) + np.abs(right)))
        wrong = sure & ~MEANING[part.sign](values[1], np.zeros_like(apart))
        if wrong.any():
            k = int(np.argmax(wrong))
            where = {**dict(zip(said.state, map(float, start), strict=True)), said.time: float(instants[k])}
            return Failure(where, part, f"{left[k]:.12g}", f"{right[k]:.12g}")
    return None
