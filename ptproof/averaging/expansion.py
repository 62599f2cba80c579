"""Averages to any order by a near-identity change of variables, solved order by order in exact algebra.

For an :class:`Oscillation` put L_j = f_j · ∂/∂x + p_j ∂/∂φ + h_j · ∂/∂y and L₀ = ∂/∂φ + (A y + h_0) · ∂/∂y, so that
along its solutions dW/dσ = Σ δ^j L_j W. Two questions have one recursion,
L₀ W_n = mean − (Σ_{j ≥ 1} L_j W_{n−j} − known):

- *closed*: X = x + δ W_1 + … + δ^N W_N with dX/dσ = δ G_1(X) + … + δ^N G_N(X) + O(δ^(N+1)); what is known at order n is
  what G_1, …, G_{n−1} at X contribute. G does not depend on phase and fast states: it is the average.
- *open*: for scalar functions V(x), W = V + δ W_1 + … with dW/dσ = δ M_1(x) + … + δ^N M_N(x) + O(δ^(N+1)), nothing
  known. What is left over is a finite sum, and given whole: what a Lyapunov function needs.
"""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import sympy as sp

from ptproof.averaging.brackets import Vector
from ptproof.averaging.damped import Pieces, phases_for
from ptproof.averaging.homological import Homological, in_order
from ptproof.averaging.oscillation import Oscillation
from ptproof.averaging.refusal import AveragingUndecided
from ptproof.averaging.ring import Coefficient, Ring, RingFull
from ptproof.averaging.waves import Wave, Waves, together
from ptproof.errors import InputError

_ROOM, _MOST_ROOM = 64, 1024


@dataclass(frozen=True)
class Expansion:
    """Means and correctors up to δ^order, and what is left; written as expressions when they are asked for.

    Attributes
    ----------
    oscillation, observables
        What was expanded; the observables are V_1, …, V_p.
    means
        [n−1] holds the p means at order δ^n, functions of the slow states: G_n if it is closed, M_n if it is open.
    correctors
        [n−1] holds W_n for each observable, in phase, slow and fast states.
    rest
        {power of δ: p expressions}: of an open expansion all that the series of the oscillation leave of dW/dσ, of a
        closed one its leading term, at δ^(order + 1).
    """

    oscillation: Oscillation
    observables: Vector
    closed: bool
    waves: Waves = field(repr=False)
    mean_coefficients: tuple[tuple[Coefficient, ...], ...] = field(repr=False)
    corrector_waves: tuple[tuple[Wave, ...], ...] = field(repr=False)
    rest_waves: Mapping[int, tuple[Wave, ...]] = field(repr=False)

    @property
    def order(self) -> int:
        """The highest power of δ that is solved."""
        return len(self.mean_coefficients)

    @functools.cached_property
    def means(self) -> tuple[Vector, ...]:
        write = self.waves.ring.expression
        return tuple(tuple(map(write, row)) for row in self.mean_coefficients)

    @functools.cached_property
    def correctors(self) -> tuple[Vector, ...]:
        return tuple(tuple(map(self.waves.expression, row)) for row in self.corrector_waves)

    @functools.cached_property
    def rest(self) -> Mapping[int, Vector]:
        return {power: tuple(map(self.waves.expression, row)) for power, row in self.rest_waves.items()}


def normal_form(oscillation: Oscillation, order: int) -> Expansion:
    """The closed expansion of the states themselves: the averaged system up to δ^``order``.

    The correctors have mean 0 over the phase where they are free of the fast states; with another choice averages of
    order 3 and more look otherwise and say the same.

    >>> s, a = sp.symbols("s a", real=True)
    >>> pushed = Oscillation(s, 2 * sp.pi, (a,), ((a**2 * (1 + sp.cos(s)),),))
    >>> [mean for (mean,) in normal_form(pushed, 2).means]
    [a**2, 0]

    Raises
    ------
    AveragingRefused, AveragingUndecided
        If the system is outside the class that is expanded exactly.
    """
    return _with_room(oscillation, oscillation.slow, order, True)


def along(oscillation: Oscillation, observables: Sequence[sp.Expr], order: int) -> Expansion:
    """The open expansion of scalar functions of the slow states, with all that is left of their derivatives.

    >>> s, a = sp.symbols("s a", real=True)
    >>> pushed = Oscillation(s, 2 * sp.pi, (a,), ((a * sp.cos(s),),))
    >>> found = along(pushed, [a**2], 1)
    >>> found.means, found.correctors, found.rest
    (((0,),), ((-2*a**2*sin(s),),), {2: (-2*a**2*sin(2*s),)})
    """
    return _with_room(oscillation, tuple(observables), order, False)


def _with_room(oscillation: Oscillation, observables: Vector, order: int, closed: bool) -> Expansion:
    if order < 1:
        raise InputError(f"order: expected a whole number from 1 on, got {order}")
    room = _ROOM
    while True:
        try:
            return _Calculation(oscillation, Ring(room), order).expanded(observables, closed)
        except RingFull:
            room *= 4
            if room > _MOST_ROOM:
                raise InputError(f"order: {order} needs more than {_MOST_ROOM} different functions here") from None


class _Calculation:
    """One expansion: the operators L_j as waves, and the recursion."""

    def __init__(self, oscillation: Oscillation, ring: Ring, order: int) -> None:
        self.oscillation, self.order = oscillation, order
        rates = [entry for vector in oscillation.rates for entry in vector]
        functions = [*rates, *oscillation.turning, *(entry for vector in oscillation.forcing for entry in vector)]
        phases = phases_for(ring, oscillation.phase, oscillation.period, _of_phase(functions, oscillation.phase))
        if isinstance(phases, Pieces):
            phases = _with_filter(phases, oscillation)
        self.waves = waves = Waves(ring, phases, oscillation.fast)
        self.rates = [
            [waves.read(entry, f"d{symbol}") for symbol, entry in zip(oscillation.slow, vector, strict=True)]
            for vector in oscillation.rates
        ]
        self.forcing = [
            [waves.read(entry, f"d{symbol}") for symbol, entry in zip(oscillation.fast, vector, strict=True)]
            for vector in oscillation.forcing
        ]
        self.turning = [waves.read(entry, f"d{oscillation.phase}") for entry in oscillation.turning]
        zero = self.forcing[0] if self.forcing else [{} for _ in oscillation.fast]
        self.homological = Homological(waves, sp.Matrix(oscillation.matrix), zero)
        self.highest = max(len(self.rates), len(self.forcing) - 1, len(self.turning))

    def applied(self, power: int, wave: Wave) -> Wave:
        """L_power of a wave."""
        waves, oscillation, parts = self.waves, self.oscillation, []
        if power <= len(self.rates):
            for symbol, rate in zip(oscillation.slow, self.rates[power - 1], strict=True):
                if rate:
                    parts.append(waves.product(rate, waves.along_slow(wave, symbol)))
        if power < len(self.forcing):
            for index, rate in enumerate(self.forcing[power]):
                if rate:
                    parts.append(waves.product(rate, waves.along_fast(wave, index)))
        if power <= len(self.turning) and self.turning[power - 1]:
            parts.append(waves.product(self.turning[power - 1], waves.along_phase(wave)))
        return waves.total(parts)

    def moved(self, correctors: Sequence[Wave], power: int) -> Wave:
        """What the terms of order ≥ 1 of dW/dσ are at δ^power, from W_0, W_1, …"""
        pairs = ((j, power - j) for j in range(1, min(power, self.highest) + 1))
        return self.waves.total(self.applied(j, correctors[n]) for j, n in pairs if n < len(correctors))

    def expanded(self, observables: Vector, closed: bool) -> Expansion:
        waves, ring = self.waves, self.waves.ring
        correctors = [[waves.constant(ring.read(entry))] for entry in observables]
        means: list[list[Coefficient]] = []
        for power in range(1, self.order + 1):
            known = self._known(correctors, means, power) if closed else [{}] * len(observables)
            row = []
            for own, taken in zip(correctors, known, strict=True):
                found, mean = self.homological.solve(waves.total((self.moved(own, power), waves.negative(taken))))
                own.append(found)
                row.append(mean)
            means.append(row)
        left: dict[int, list[Wave]] = {}
        last = self.order + 1 if closed else self.order + self.highest
        for power in range(self.order + 1, last + 1):
            known = self._known(correctors, means, power) if closed else [{}] * len(observables)
            left[power] = [
                waves.total((self.moved(own, power), waves.negative(taken)))
                for own, taken in zip(correctors, known, strict=True)
            ]
        return Expansion(
            self.oscillation,
            observables,
            closed,
            waves,
            tuple(map(tuple, means)),
            tuple(tuple(own[n] for own in correctors) for n in range(1, self.order + 1)),
            {power: tuple(row) for power, row in left.items()},
        )

    def _known(self, correctors: list[list[Wave]], means: list[list[Coefficient]], power: int) -> list[Wave]:
        """For each state, what Σ δ^j G_j(x + δ W_1 + …) is at δ^power, with the G_j that are known."""
        waves, count = self.waves, len(self.oscillation.slow)
        series = [dict(enumerate(own[1:], start=1)) for own in correctors]
        parts: list[list[Wave]] = [[] for _ in range(count)]
        for j, row in enumerate(means, start=1):
            depth = power - j
            if depth == 0 or not any(value != 0 for value in row):
                continue
            for exponents in _exponents(count, depth):
                shift = self._shift(series, exponents, depth)
                if not shift:
                    continue
                for place, value in enumerate(row):
                    derived = self._derivative(value, exponents)
                    if derived != 0:
                        parts[place].append(waves.scaled(shift, derived))
        return [waves.total(entries) for entries in parts]

    def _derivative(self, value: Coefficient, exponents: tuple[int, ...]) -> Coefficient:
        """∂^α value / α!."""
        ring = self.waves.ring
        for symbol, power in zip(self.oscillation.slow, exponents, strict=True):
            for _ in range(power):
                value = ring.derivative(value, symbol)
        return value * ring.number(sp.Rational(1, math.prod(map(math.factorial, exponents))))

    def _shift(self, series: list[dict[int, Wave]], exponents: tuple[int, ...], depth: int) -> Wave:
        """The coefficient of δ^depth in Π (δ W_1 + δ² W_2 + …)^α."""
        factors = [series[i] for i, power in enumerate(exponents) for _ in range(power)]
        waves = self.waves
        total: dict[int, Wave] = {0: waves.constant(waves.ring.one)}
        for factor in factors:
            sums: dict[int, list[Wave]] = {}
            for (a, first), (b, second) in itertools.product(total.items(), factor.items()):
                if a + b <= depth:
                    sums.setdefault(a + b, []).append(waves.product(first, second))
            total = {power: waves.total(entries) for power, entries in sums.items()}
        return total.get(depth, {})


def _with_filter(phases: Pieces, oscillation: Oscillation) -> Pieces:
    """The basis in which dithers with jumps are answered by the fast states of an oscillation."""
    if any(oscillation.turning):
        raise AveragingUndecided("a phase that the states turn is covered with sines and cosines only, not with jumps")
    if not oscillation.fast:
        return phases
    matrix = oscillation.matrix
    edges = [(i, j) for i in range(matrix.rows) for j in range(matrix.cols) if i != j and matrix[i, j] != 0]
    if in_order(matrix.rows, edges) is None:
        raise AveragingUndecided(
            f"the fast states drive each other in a circle, {matrix.tolist()}; with dithers that jump or have kinks "
            "exact averages are for filters in series and in parallel, whose free motions are real exponentials"
        )
    return Pieces(phases.ring, phases.phase, phases.period, phases.points, [-matrix[i, i] for i in range(matrix.rows)])


def _exponents(count: int, depth: int) -> list[tuple[int, ...]]:
    """All α with 1 ≤ |α| ≤ depth."""
    found = itertools.product(range(depth + 1), repeat=count)
    return [exponents for exponents in found if 1 <= sum(exponents) <= depth]


def _of_phase(functions: Sequence[sp.Expr], phase: sp.Symbol) -> list[sp.Expr]:
    """The factors that depend on the phase, each once."""
    found: dict[sp.Expr, Any] = {}
    for entry in functions:
        for term in together(entry, phase):
            factor = term.as_independent(phase, as_Add=False)[1]
            if phase in factor.free_symbols:
                found[factor] = None
    return list(found)
