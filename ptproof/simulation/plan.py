"""What an engine is asked, and what it answers: plain data, the same for every engine."""

from __future__ import annotations

import itertools
import math
from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
import sympy as sp
from sympy.core.relational import Relational

from ptproof.errors import InputError
from ptproof.simulation.settings import Limit, Outcome, Settings, Stop
from ptproof.system import System

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Sampling:
    """How a loop is sampled.

    Attributes
    ----------
    held
        What is computed at each instant, in this order, from the states there and what stands before it.
    inputs
        Which of these the vehicle is given, by name.
    rates
        The states' rates between two instants (n).
    """

    held: tuple[tuple[sp.Symbol, sp.Expr], ...]
    inputs: tuple[tuple[str, int], ...]
    rates: tuple[sp.Expr, ...]


@dataclass(frozen=True)
class Plan:
    """A system with symbolic parameters, and what all members of an ensemble share.

    Attributes
    ----------
    system
        Its ``parameters`` get their values per member.
    settings
        Tolerances, samples and limits.
    watched, center, radius
        A run has escaped when the states ``watched`` (indices) are further than ``radius`` from ``center``.
    tightening
        A power of ten by which relative tolerances shrink, since an angle counts absolutely however far it has turned.
    conditions
        The conditions of choices in the right-hand side that change at the inner edges of a member, and only there.
    sampling
        How the loop is sampled, if it is; then it is a map from sample to sample and no engine takes it.
    """

    system: System
    settings: Settings
    watched: tuple[int, ...]
    center: tuple[float, ...]
    radius: float
    tightening: float = 1.0
    conditions: tuple[Relational, ...] = ()
    sampling: Sampling | None = None

    def away(self, x: Array) -> float:
        """The distance of one state x (n) from the center; for one, NumPy takes longer than the distance."""
        return math.dist([x.item(i) for i in self.watched], self.center)

    def distance(self, x: Array) -> Array:
        """The distance of the watched states from the center, for x (n × …)."""
        with np.errstate(all="ignore"):
            squares = [(x[i] - center) ** 2 for i, center in zip(self.watched, self.center, strict=True)]
            return np.asarray(np.sqrt(sum(squares[1:], squares[0])))

    def inside(self, x: Array) -> int:
        """How many of the states x (n × …) come before the first that has escaped or is not a number."""
        if x.shape[1] == 1:
            return int(self.away(x[:, 0]) <= self.radius)
        good = self.distance(x) <= self.radius
        return len(good) if good.all() else int(np.argmin(good))

    def within(self, x: Array) -> bool:
        """Whether no state of x (n × …) has escaped, or is not a number."""
        return self.inside(x) == x.shape[1]

    def at_limit(self, limit: Limit, time: float, end: float) -> Stop:
        """A limit met at ``time``, on the way to ``end``."""
        time_limit, steps = f"time limit of {self.settings.time_limit:g} s", f"{self.settings.max_steps} steps"
        what = time_limit if limit is Limit.TIME else f"step limit of {steps}"
        return Stop(
            Outcome.STEP_LIMIT,
            f"the {what} was met at {self.system.time} = {time:.6g}, on the way to {end:.6g}; a larger {limit} lets it "
            f"go further",
            limit,
        )

    @property
    def escaped(self) -> Stop:
        """Further away than the radius of escape."""
        return Stop(Outcome.ESCAPED, f"left the ball of radius {self.radius:.3g}")

    def broken(self, start: Array, end: Array, why: str) -> Stop:
        """A solver that could not go on at ``end``: out of the ball or far away it has met an escape in finite time."""
        first, last = self.away(start), self.away(end)
        if last > self.radius:
            return self.escaped
        if not np.all(np.isfinite(end)) or last > 1000 * max(1.0, first):
            return Stop(Outcome.ESCAPED, f"{why}, at a distance of {last:.3g} after a start at {first:.3g}")
        return Stop(Outcome.FAILED, why)


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

    def grids(self, samples: int) -> Iterator[Array]:
        """For each smooth piece of a single member about its part of ``samples`` intervals, with both ends."""
        edges = self.edges[:, 0].tolist()
        for a, b in itertools.pairwise(edges):
            if b > a:
                count = math.ceil(samples * (b - a) / (edges[-1] - edges[0]) - 1e-9)
                yield np.linspace(a, b, count + 1) if count > 1 else np.array([a, b])

    def path_times(self, samples: int) -> Array:
        """The times of :meth:`grids` in one, for members that share their edges."""
        if (self.edges != self.edges[:, :1]).any():
            raise ValueError("members whose way is sampled together share their edges")
        return np.concatenate([self.edges[:1, 0], *(grid[1:] for grid in self.member(0).grids(samples))])


@dataclass(frozen=True)
class Run:
    """One member's answer: times (m), states (n × m), why it stopped, and the inputs (m) where they were held."""

    time: Array
    x: Array
    stop: Stop
    inputs: Mapping[str, Array] | None = None


@dataclass
class Samples:
    """The samples of a run as they come, beginning with its start."""

    member: Batch
    times: list[Array] = field(default_factory=list)
    states: list[Array] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.add(self.member.edges[0], self.member.initial)

    def add(self, times: Array, states: Array) -> None:
        """More times (m) with their states (n × m)."""
        self.times.append(times)
        self.states.append(states)

    @property
    def time(self) -> float:
        return float(self.times[-1][-1])

    @property
    def state(self) -> Array:
        return self.states[-1][:, -1]

    def run(self, stop: Stop | None = None) -> Run:
        """The run as far as it came."""
        return Run(np.concatenate(self.times), np.concatenate(self.states, axis=1), stop or Stop())


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


@dataclass(frozen=True)
class Paths:
    """The way of many that share their times: times (m) and states (n × N × m), NaN where a run had ended before."""

    time: Array
    x: Array


@dataclass(frozen=True)
class Work:
    """What a question costs, as far as it is known beforehand, for an engine to say whether it wants it.

    Attributes
    ----------
    many
        Whether it is an ensemble.
    radians
        How far the dither turns in a run; None where there is none.
    spans
        The length of a run in units of the filter's time constant; None where there is none.
    """

    many: bool
    radians: float | None = None
    spans: float | None = None


class Engine(ABC):
    """An integrator behind the door: one trajectory with samples, or many end states.

    ``block`` members of an ensemble are handed to it at once; ``missing`` is what would have to be installed for it.
    """

    block: int = 256
    missing: str = ""

    def wants(self, plan: Plan, batch: Batch, work: Work) -> bool:
        """Whether this work is done better here than by the default engine: it can, and it is worth it."""
        return False

    @abstractmethod
    def trajectory(self, plan: Plan, member: Batch) -> Run:
        """One run with samples."""

    def finals(self, plan: Plan, batch: Batch, workers: int = 1) -> Finals:
        """The end states of many, on up to ``workers`` threads, which don't change the numbers; here one by one."""
        runs = [self.trajectory(plan, batch.member(i)) for i in range(batch.size)]
        return Finals(
            np.array([run.time[-1] for run in runs]),
            np.stack([run.x[:, -1] for run in runs], axis=1),
            tuple(run.stop.outcome for run in runs),
        )

    def paths(self, plan: Plan, batch: Batch, workers: int = 1) -> Paths:
        """The way of many with one and the same edges, on up to ``workers`` threads; here one by one.

        Each is sampled at the times of :meth:`Batch.grids`, to the error that is asked of a trajectory.
        """
        time = batch.path_times(plan.settings.samples)
        x = np.full((*batch.initial.shape, len(time)), np.nan)
        for i in range(batch.size):
            run = self.trajectory(plan, batch.member(i))
            at = np.minimum(np.searchsorted(time, run.time), len(time) - 1)
            there = time[at] == run.time  # a run that stopped early ends between two of them
            x[:, i, at[there]] = run.x[:, there]
        return Paths(time, x)
