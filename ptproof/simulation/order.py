"""Whether an average describes a system: the gap between them must fall like a power of ω that theory names."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import sympy as sp

from ptproof.averaging.correction import Correction, first_correction
from ptproof.errors import InputError
from ptproof.simulation.drawing import BLUE, RED, new_figure
from ptproof.simulation.numbers import as_float, by_name
from ptproof.simulation.plan import Array
from ptproof.simulation.run import simulate
from ptproof.simulation.settings import Outcome, Settings
from ptproof.simulation.trajectory import Trajectory
from ptproof.system import DitherSystem, System, substitute

LADDER = (100.0, 200.0, 400.0, 800.0, 1600.0)
_SLACK = 0.1
_SETTINGS = Settings(rtol=1e-9)
_SAMPLES_A_TURN = 16
_Numbers = Callable[[Any, Any, float], Array]


@dataclass(frozen=True)
class GapOrder:
    """The largest gap over an interval for a ladder of ω, and the power of ω that fits it.

    Attributes
    ----------
    omegas, gaps
        The ladder and the largest distance between system and average on it; NaN from where on a run did not get
        through.
    slope, intercept, spread
        log gap ≈ intercept + slope · log ω by least squares, and the standard error of the slope.
    tail
        The slope between the last two rungs: a gap that stops falling shows here first.
    expected
        The theoretical slope: −1/2 for an average, −1 for one with its first correction.
    """

    omegas: tuple[float, ...]
    gaps: tuple[float, ...]
    slope: float
    intercept: float
    spread: float
    tail: float
    expected: float
    message: str = ""

    @property
    def agrees(self) -> bool:
        """Whether the gap falls at least as fast as expected, over the ladder and at its end (within 0.1)."""
        return max(self.slope, self.tail) <= self.expected + _SLACK and self.spread <= _SLACK

    def to_json(self) -> dict[str, Any]:
        """The whole as data."""
        return {
            "omegas": list(self.omegas), "gaps": list(self.gaps), "slope": self.slope, "spread": self.spread,
            "tail": self.tail, "expected": self.expected, "agrees": self.agrees,
        }  # fmt: skip

    def plot(self, ax: Any = None) -> Any:
        """The ladder with the fitted and the expected slope; the Matplotlib ``Axes``."""
        ax = new_figure()[1] if ax is None else ax
        omega = np.array(self.omegas)
        ax.loglog(omega, self.gaps, "o", color=BLUE, label="gap")
        fit = f"fit: slope {self.slope:.3f}; between the last two {self.tail:.3f}"
        ax.loglog(omega, np.exp(self.intercept) * omega**self.slope, color=BLUE, lw=1, label=fit)
        anchor = self.gaps[-1] * (omega / omega[-1]) ** self.expected
        ax.loglog(omega, anchor, color=RED, lw=1, ls="--", label=f"theory: slope {self.expected:g}")
        ax.set(xlabel="ω", ylabel="largest gap over the interval")
        ax.legend()
        return ax


def gap_order(
    system: DitherSystem | System,
    average: System | Correction,
    *,
    initial: Mapping[Any, Any] | Sequence[Any],
    end: Any,
    start: Any = 0,
    omega: sp.Symbol | None = None,
    values: Mapping[Any, Any] | None = None,
    omegas: Sequence[float] = LADDER,
    expected: float | None = None,
    sharp: bool = False,
    settings: Settings = _SETTINGS,
) -> GapOrder:
    """Measure how the gap between a dithered system and its average falls with ω.

    Parameters
    ----------
    system
        A dither system, or any system in which ``omega`` is a parameter, such as a closed loop in τ with its filter.
    average
        A system whose states are among the first's, by name; or a ``Correction``, to first order.
    initial
        The system's initial state, in order or by name; the average starts in its part of it.
    start, end, omegas
        The fixed interval of time, and the ladder, increasing.
    values
        Values for parameters and undefined functions of both; they may contain ω, such as ``{mu: omega**-2 / 5}``, a
        filter so fast that it does not interfere with the order.
    expected
        −1/2 for a plain average and −1 for a ``Correction`` if left out.
    sharp
        For a dither system and a plain average: add the derived near-identity term to the average before comparing.
        The order becomes −1, and an average that is wrong by a percent, hidden by the dither otherwise, shows.
    settings
        Of the runs; their samples follow ω.

    Returns
    -------
    GapOrder
        ``agrees`` says whether the theoretical order was met. A wrong average leaves a gap that does not fall.

    Raises :class:`InputError` if states or parameters don't fit.
    """
    ladder = _ladder(omegas)
    if sharp:
        if not isinstance(system, DitherSystem) or isinstance(average, Correction):
            raise InputError("sharp: needs a dither system and a plain average of it")
        average = replace(first_correction(system), average=average)
    if expected is None:
        expected = -1.0 if isinstance(average, Correction) else -0.5
    symbol = omega if omega is not None else getattr(system, "omega", None) or sp.Symbol("omega", positive=True)
    span = (as_float(start, "start"), as_float(end, "end"))
    gaps, message = _pair(system, average, symbol, initial, span, dict(values or {}), settings).gaps(ladder)
    return fit_order(ladder, gaps, expected, message)


def _ladder(omegas: Sequence[float]) -> tuple[float, ...]:
    ladder = tuple(as_float(value, "omegas") for value in omegas)
    if len(ladder) < 3 or any(b <= a for a, b in itertools.pairwise(ladder)) or ladder[0] <= 0:
        raise InputError("omegas: expected at least three positive numbers in increasing order")
    return ladder


def _pair(
    system: DitherSystem | System, average: System | Correction, omega: sp.Symbol,
    initial: Mapping[Any, Any] | Sequence[Any], span: tuple[float, float], values: dict[Any, Any], settings: Settings,
) -> _Pair:  # fmt: skip
    """The two systems that are run, with the values put in."""
    full, slow = (
        made.with_values(values) if values else made
        for made in (
            system.to_system() if isinstance(system, DitherSystem) else system,
            average.corrected_average if isinstance(average, Correction) else average,
        )
    )
    names = [state.name for state in full.state]
    if missing := [state.name for state in slow.state if state.name not in names]:
        raise InputError(f"{slow.name}: {', '.join(missing)} is not a state of {full.name}")
    table = by_name(initial) if isinstance(initial, Mapping) else dict(zip(names, initial, strict=False))
    return _Pair(full, slow, omega, table, span, *_correction(average, values), settings)


def fit_order(omegas: Sequence[float], gaps: Sequence[float], expected: float, message: str = "") -> GapOrder:
    """The straight line through (log ω, log gap) and the standard error of its slope; NaN if a gap is not positive."""
    if not all(math.isfinite(gap) and gap > 0 for gap in gaps):
        return GapOrder(tuple(omegas), tuple(gaps), math.nan, math.nan, math.inf, math.nan, expected, message)
    x, y = np.log(omegas), np.log(gaps)
    (slope, intercept), covariance = np.polyfit(x, y, 1, cov=True)
    line = float(slope), float(intercept), math.sqrt(covariance[0, 0])
    return GapOrder(tuple(omegas), tuple(gaps), *line, float((y[-1] - y[-2]) / (x[-1] - x[-2])), expected, message)


@dataclass(frozen=True)
class _Pair:
    """A system and its average, to be run side by side."""

    full: System
    slow: System
    omega: sp.Symbol
    initial: Mapping[str, Any]
    span: tuple[float, float]
    start: _Numbers
    along: _Numbers
    settings: Settings

    def gaps(self, ladder: Sequence[float]) -> tuple[tuple[float, ...], str]:
        """The gap at each ω, up to one at which a run did not get through: without it there is no order."""
        found: list[float] = []
        message = ""
        while len(found) < len(ladder) and not message:
            gap, message = self.gap(ladder[len(found)])
            found.append(gap)
        return (*found, *[math.nan] * (len(ladder) - len(found))), message

    def gap(self, rung: float) -> tuple[float, str]:
        """The largest distance at ω = ``rung``, or NaN and why a run did not get through."""
        (begin, end), names = self.span, [state.name for state in self.full.state]
        samples = min(200_000, max(400, math.ceil(_SAMPLES_A_TURN * rung * (end - begin) / (2 * math.pi))))
        fast = self._run(self.full, {name: self.initial[name] for name in names if name in self.initial}, rung, samples)
        if fast.outcome is not Outcome.REACHED:
            return math.nan, f"at omega = {rung:g} the system ended as {fast.outcome}"
        shared = [state.name for state in self.slow.state]
        x0 = self.start(begin, [as_float(self.initial[name], f"initial.{name}") for name in shared], rung)
        mean = self._run(self.slow, dict(zip(shared, x0, strict=True)), rung, samples)
        if mean.outcome is not Outcome.REACHED:
            return math.nan, f"at omega = {rung:g} the average ended as {mean.outcome}"
        rows = [names.index(name) for name in shared]
        # A system that jumps has its samples between the jumps; its average is smooth, and has many.
        at = mean.x if np.array_equal(fast.t, mean.t) else _between(mean, fast.t)
        return float(np.max(np.linalg.norm(fast.x[rows] - self.along(fast.t, at, rung), axis=0))), ""

    def _run(self, system: System, initial: Mapping[str, Any], rung: float, samples: int) -> Trajectory:
        given = {self.omega.name: rung} if self.omega in (system.parameters or ()) else {}
        return simulate(
            system, initial=initial, parameters=given, span=self.span, settings=self.settings, samples=samples
        )


def _between(run: Trajectory, times: Array) -> Array:
    """The states of a smooth run between its samples."""
    from scipy.interpolate import CubicSpline

    return np.asarray(CubicSpline(run.t, run.x, axis=1)(times))


def _correction(average: System | Correction, values: Mapping[Any, Any]) -> tuple[_Numbers, _Numbers]:
    """From time, state of the average and ω: the state that it starts in, and the one that the system should be in."""
    if not isinstance(average, Correction):
        return (lambda _, x, __: np.asarray(x),) * 2
    arguments = (average.system.time, average.system.state, average.system.omega)

    def numbers(expressions: Sequence[sp.Expr]) -> _Numbers:
        function = sp.lambdify(arguments, list(substitute(expressions, values)), modules="numpy", cse=True)
        return lambda t, x, omega: np.array([np.broadcast_to(row, np.shape(t)) for row in function(t, tuple(x), omega)])

    return numbers(average.initial_state), numbers(average.expressions)


def hover_radius(omega: Any) -> Any:
    """1/√ω: the leading term of the distance at which the seeker stays from the source, its average having arrived.

    Derivation. With θ = p₀ + ωτ − kF(x), the reduced model is dx/dτ = drift + √ω (cos θ, sin θ). Its first correction
    is the antiderivative of zero mean of the dither, (sin θ, −cos θ)/√ω, a vector of length exactly 1/√ω
    whatever F, k and p₀ are, so that x = x̄ + (sin θ, −cos θ)/√ω + O(1/ω): where x̄ = x*, |x − x*| = 1/√ω + O(1/ω).
    For a radial field without drift the circle of radius 1/√ω around the source is itself a solution, with its
    filter at rest: F does not change along it, the heading turns at the rate ω, and the speed is √ω = ω/√ω. The
    term does not depend on k, T or the gain; a filter of time constant μ changes it by terms in μω.

    Works for numbers, arrays and symbols.
    """
    if isinstance(omega, sp.Basic):
        return 1 / sp.sqrt(omega)
    return 1 / np.sqrt(omega)
