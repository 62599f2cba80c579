"""What an engine is asked, and what it answers: plain data, the same for every engine."""

from __future__ import annotations

import enum
import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from ptproof.errors import InputError
from ptproof.system import System

Array = npt.NDArray[np.float64]


class Outcome(enum.StrEnum):
    """How a run ended. Outcomes are values; a run that goes wrong raises nothing."""

    REACHED = "reached T"
    ESCAPED = "escaped"
    STEP_LIMIT = "step limit"
    FAILED = "failed"


@dataclass(frozen=True)
class Plan:
    """A system with symbolic parameters, and the settings that all members of an ensemble share.

    Attributes
    ----------
    system
        Its ``parameters`` get their values per member.
    samples
        About how many intervals the answer of a single run has.
    rtol, atol
        The error asked for, relative and absolute, of the end result; engines work with tighter local tolerances.
    watched, center, radius
        A run has escaped when the states ``watched`` (indices) are further than ``radius`` from ``center``.
    tightening
        A power of ten by which relative tolerances shrink, since an angle counts absolutely however far it has turned.
    max_steps, time_limit
        A run that needs more steps, or more seconds, ends with the outcome ``step limit``.
    """

    system: System
    samples: int
    rtol: float
    atol: float
    watched: tuple[int, ...]
    center: tuple[float, ...]
    radius: float
    max_steps: int = 50_000_000
    time_limit: float = 60.0
    tightening: float = 1.0

    def __post_init__(self) -> None:
        if not 1e-14 <= self.rtol <= 1e-2:
            raise InputError(f"rtol: expected a number between 1e-14 and 1e-2, got {self.rtol}")
        if not self.atol > 0 or not self.time_limit > 0 or self.max_steps < 1:
            raise InputError("atol, time_limit and max_steps must be positive")
        if not 1 <= self.samples <= 1_000_000:
            raise InputError(f"samples: expected 1 to 1000000, got {self.samples}")

    def distance(self, x: Array) -> Array:
        """The distance of the watched states from the center, for x (n × …)."""
        if x.ndim == 1:
            return np.asarray(math.dist([x[i] for i in self.watched], self.center))
        offset = np.asarray(self.center).reshape((-1,) + (1,) * (x.ndim - 1))
        with np.errstate(all="ignore"):
            return np.sqrt(np.sum((x[list(self.watched)] - offset) ** 2, axis=0))


@dataclass(frozen=True)
class Batch:
    """N members: initial states (n × N), parameters (m × N), and edges (q × N).

    The edges are the start, the instants at which the right-hand side has a kink in time, and the end.
    """

    initial: Array
    parameters: Array
    edges: Array

    def __post_init__(self) -> None:
        for name in ("initial", "parameters", "edges"):
            if not np.isfinite(getattr(self, name)).all():
                raise InputError(f"{name}: contains NaN or infinity; finite numbers are needed")
        if (self.edges[1:] < self.edges[:-1]).any() or (self.edges[-1] <= self.edges[0]).any():
            raise InputError("the time span must end after it starts")

    @property
    def size(self) -> int:
        return int(self.initial.shape[1])

    def member(self, index: int) -> Batch:
        return self.slice(index, index + 1)

    def slice(self, first: int, last: int) -> Batch:
        return Batch(self.initial[:, first:last], self.parameters[:, first:last], self.edges[:, first:last])

    def pieces(self) -> list[tuple[float, float]]:
        """The smooth pieces of a single member, without empty ones."""
        edges = self.edges[:, 0]
        return [(float(a), float(b)) for a, b in itertools.pairwise(edges) if b > a]


@dataclass(frozen=True)
class Run:
    """One member's answer: times (m), states (n × m), and how it ended."""

    time: Array
    x: Array
    outcome: Outcome
    message: str = ""


@dataclass(frozen=True)
class Finals:
    """A batch's answer: end times (N), end states (n × N) and outcomes (N)."""

    time: Array
    x: Array
    outcomes: tuple[Outcome, ...]

    @staticmethod
    def join(parts: Sequence[Finals]) -> Finals:
        return Finals(
            np.concatenate([part.time for part in parts]),
            np.concatenate([part.x for part in parts], axis=1),
            tuple(outcome for part in parts for outcome in part.outcomes),
        )


class Engine(Protocol):
    """An integrator behind the door: one trajectory with samples, or many end states."""

    @property
    def name(self) -> str: ...

    def trajectory(self, plan: Plan, member: Batch) -> Run: ...

    def finals(self, plan: Plan, batch: Batch, workers: int = 1) -> Finals: ...


def one_by_one(engine: Any, plan: Plan, batch: Batch) -> Finals:
    """:meth:`Engine.finals` by single runs, for members that need an outcome of their own."""
    runs = [engine.trajectory(plan, batch.member(i)) for i in range(batch.size)]
    return Finals(
        np.array([run.time[-1] for run in runs]),
        np.stack([run.x[:, -1] for run in runs], axis=1),
        tuple(run.outcome for run in runs),
    )


def stopped(plan: Plan, start: Array, end: Array, reason: str) -> tuple[Outcome, str]:
    """The outcome of a run that could not go on at state ``end``.

    A limit is a limit wherever it is met; a solver that breaks down far away has met an escape in finite time.
    """
    if "limit" in reason:
        return Outcome.STEP_LIMIT, reason
    first, last = float(plan.distance(start)), float(plan.distance(end))
    if not np.all(np.isfinite(end)) or last > 1000 * max(1.0, first):
        return Outcome.ESCAPED, f"{reason}, at a distance of {last:.3g} after a start at {first:.3g}"
    return Outcome.FAILED, reason
