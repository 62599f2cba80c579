"""A loop that is sampled: the field is measured at instants, with noise, and what is applied is held between them.

The controller measures y = F(x) + noise at the instants t₀ + i·h, computes its gain and its inputs from y and its own
state there, and holds them until the next; its filter goes on with the held measurement. The vehicle and the drift
move on between the instants, by the classical Runge-Kutta method with as many steps in each interval as the
tolerance asks for, found by halving.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
import sympy as sp

from ptproof.errors import InputError
from ptproof.problem.model import GAIN, TIME
from ptproof.simulation.plan import Array, Batch, Engine, Plan, Run, Sampling
from ptproof.simulation.settings import Budget, Outcome, Stop
from ptproof.simulation.translate import translate
from ptproof.system import System

if TYPE_CHECKING:
    from ptproof.problem import Problem
    from ptproof.transforms import CappedClock, Clock

SAMPLE_TIME = sp.Symbol("sample_time", positive=True)
NOISE = sp.Symbol("noise", nonnegative=True)
NOISE_SEED = sp.Symbol("noise_seed", integer=True, nonnegative=True)
SETTINGS = (SAMPLE_TIME, NOISE, NOISE_SEED)
_DRAWN, _MEASURED = sp.symbols("drawn y", real=True)
_BLOCK = 1000
_MOST_SAMPLES = 2_000_000
_MOST_HALVINGS = 6


def sampled(problem: Problem, seeker: str, clock: Clock | CappedClock, loop: System) -> tuple[System, Sampling]:
    """The closed ``loop`` with the three parameters of a sampled run, and how it is sampled.

    A rate that is an input, as dθ/dt = u₂ is, is held whole; in the others the measurement and the gain are.
    """
    record, states = problem.seeker(seeker), problem.states
    law = record.law(_MEASURED, problem.drift, GAIN, states)
    wanted = record.inputs(_MEASURED, GAIN, states)
    held: list[tuple[sp.Symbol, sp.Expr]] = [
        (_MEASURED, problem.field.expression + NOISE * _DRAWN), (GAIN, clock.rate),
    ]  # fmt: skip
    inputs, symbols = [], {}
    for name, expression in wanted.items():
        inputs.append((name, len(held)))
        symbols[expression] = sp.Symbol(f"held_{name}", real=True)
        held.append((symbols[expression], expression))
    rates = tuple(symbols.get(rate, rate) for rate in law.rhs)
    system = System(TIME, loop.state, loop.rhs, (*(loop.parameters or ()), *SETTINGS), f"sampled {loop.name}")
    return system, Sampling(tuple(held), tuple(inputs), rates)


@lru_cache(maxsize=32)
def _step(system: System, sampling: Sampling) -> Any:
    """CasADi's step (states and held) × (t, h, whether it opens an interval, drawn, parameters) → the same after h."""
    import casadi as ca

    n, names = system.dimension, system.parameters or ()
    before, p = ca.SX.sym("x", n + len(sampling.held)), ca.SX.sym("p", len(names))
    t, h, opens, drawn = (ca.SX.sym(name) for name in ("t", "h", "opens", "drawn"))
    x = before[:n]
    table: dict[Any, Any] = {symbol: p[i] for i, symbol in enumerate(names)}
    here = table | {TIME: t, _DRAWN: drawn} | {symbol: x[i] for i, symbol in enumerate(system.state)}
    held = []
    for i, (symbol, expression) in enumerate(sampling.held):
        (value,) = translate([expression], here)
        here[symbol] = ca.if_else(opens, value, before[n + i])
        held.append(here[symbol])
    table |= {symbol: here[symbol] for symbol, _ in sampling.held}

    def rate(time: Any, at: Any) -> Any:
        values = table | {TIME: time} | {symbol: at[i] for i, symbol in enumerate(system.state)}
        return ca.vertcat(*translate(sampling.rates, values))

    k1 = rate(t, x)
    k2 = rate(t + h / 2, x + h / 2 * k1)
    k3 = rate(t + h / 2, x + h / 2 * k2)
    k4 = rate(t + h, x + h * k3)
    after = ca.vertcat(x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), *held)
    return ca.Function("step", [before, ca.vertcat(t, h, opens, drawn), p], [after])


@lru_cache(maxsize=32)
def _block(system: System, sampling: Sampling, steps: int) -> Any:
    """The steps of a block of samples, one after the other, with the state after each."""
    return _step(system, sampling).mapaccum("block", _BLOCK * steps)


class _Sampled(Engine):
    """Behind the same door as the engines, but for what they can't take: a loop that is sampled."""

    block = 1  # a member takes seconds, and each is shown as it is done

    def trajectory(self, plan: Plan, member: Batch) -> Run:
        """One run, its samples at instants of sampling; each state before the inputs computed there are applied."""
        assert plan.sampling is not None
        budget = Budget(plan.settings)
        found = _Pass(plan, plan.sampling, member, 1).run(budget)
        for halving in range(1, _MOST_HALVINGS + 1):
            if found.stop.limit is not None:
                return found
            finer = _Pass(plan, plan.sampling, member, 2**halving).run(budget)
            if finer.stop.limit is not None or _close(plan, found, finer):
                return finer
            found = finer
        why = f"the run changes with the steps between its samples, even with {2**_MOST_HALVINGS} in each interval"
        return Run(found.time, found.x, Stop(Outcome.FAILED, f"{why}; sample more often"), found.inputs)


SAMPLED = _Sampled()


def _close(plan: Plan, coarse: Run, fine: Run) -> bool:
    """Whether halving the steps changed the end by no more than the error asked for; the method's order is 4."""
    if coarse.stop.outcome is not fine.stop.outcome or coarse.time[-1] != fine.time[-1]:
        return False
    if fine.stop.outcome is Outcome.ESCAPED:
        return True
    settings, watched = plan.settings, list(plan.watched)
    error = np.abs(fine.x[watched, -1] - coarse.x[watched, -1]) / 15
    return bool(np.all(error <= settings.absolute + settings.rtol * np.maximum(1.0, np.abs(fine.x[watched, -1]))))


@dataclass(frozen=True)
class _Pass:
    """One run with a given number of ``steps`` in each interval between two samples."""

    plan: Plan
    sampling: Sampling
    member: Batch
    steps: int

    def run(self, budget: Budget) -> Run:
        """From the start to the end, or to where it leaves the ball or its budget is spent."""
        plan, start, end = self.plan, *self.member.edges[[0, -1], 0]
        n, numbers = plan.system.dimension, self.member.parameters[:, 0]
        values = dict(zip(plan.system.parameters or (), numbers.tolist(), strict=True))
        instants = sample_instants(start, end, values[SAMPLE_TIME])
        generator = np.random.default_rng(np.random.SeedSequence(int(values[NOISE_SEED])))
        columns = self._columns(instants, generator.standard_normal(len(instants) - 1))
        block, size = _block(plan.system, self.sampling, self.steps), _BLOCK * self.steps
        along = np.full((n + len(self.sampling.held), len(instants)), np.nan)
        along[:n, 0] = self.member.initial[:, 0]
        last, stop = 0, Stop()
        while last < len(instants) - 1:
            part = columns[:, last * self.steps : last * self.steps + size]
            made = part.shape[1] // self.steps
            padded = np.pad(part, ((0, 0), (0, size - part.shape[1])))
            found = np.array(block(along[:, last], padded, np.repeat(numbers[:, None], size, axis=1)))
            along[:, last + 1 : last + made + 1] = found[:, self.steps - 1 :: self.steps][:, :made]
            inside = plan.inside(along[:n, last + 1 : last + made + 1])
            budget.steps -= part.shape[1]
            if inside < made:
                last += inside + 1
                finite = np.isfinite(along[:n, last]).all()
                why = "what is held drives the state beyond all bounds; sample more often"
                stop = plan.escaped if finite else plan.broken(along[:n, 0], along[:n, last - 1], why)
                break
            last += made
            if last < len(instants) - 1 and (limit := budget.spent):
                stop = plan.at_limit(limit, float(instants[last]), float(end))
                break
        return self._thinned(instants[: last + 1], along[:, : last + 1], stop)

    def _columns(self, instants: Array, drawn: Array) -> Array:
        """For each step its start, its length, whether it opens an interval, and what is drawn for that one."""
        lengths, inner = np.diff(instants) / self.steps, np.arange(self.steps)
        starts = instants[:-1, None] + lengths[:, None] * inner
        columns = (starts, lengths[:, None], inner == 0, drawn[:, None])
        return np.array(np.broadcast_arrays(*columns), dtype=float).reshape(4, -1)

    def _thinned(self, instants: Array, along: Array, stop: Stop) -> Run:
        """The samples that are kept; an input at an instant is the one applied up to it, at the start from it."""
        n, last = self.plan.system.dimension, len(instants) - 1
        if last and not np.isfinite(along[:n, last]).all():
            last -= 1
        kept = np.unique(np.append(np.arange(0, last + 1, max(1, last // self.plan.settings.samples)), last))
        held = along[n:, np.maximum(kept, min(1, last))]
        inputs = {name: held[i] for name, i in self.sampling.inputs}
        return Run(instants[kept], along[:n, kept], stop, inputs)


def noise_seeds(size: int, *seeds: int) -> Array:
    """A seed of its own for each of ``size`` members; the first ones are the same for every size."""
    return np.random.default_rng(np.random.SeedSequence(seeds)).integers(0, 2**53, size).astype(float)


def sample_instants(start: float, end: float, length: float) -> Array:
    """The instants start, start + h, … and the end, for intervals of ``length`` h.

    Raises
    ------
    InputError
        For more than two million samples.
    """
    count = int(np.ceil((end - start) / length - 1e-9))
    if count > _MOST_SAMPLES:
        raise InputError(f"sample_time: {length:g} makes {count} samples; up to {_MOST_SAMPLES} are followed")
    return np.append(start + length * np.arange(max(count, 1)), end)
