"""A dither system as it is asked about: with its fast states, the region of interest and the author's claim."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.errors import InputError
from ptproof.proof.statement import Relation
from ptproof.system import DitherSystem, check_names

TIME = sp.Symbol("tau", real=True)
PHASE = sp.Symbol("theta", real=True)
OMEGA = sp.Symbol("omega", positive=True)
MU = sp.Symbol("mu", positive=True)


HIGHEST = 12


def check_order(order: Any, where: str) -> int:
    """``order``, if it is a whole number from 1 to 12."""
    if not isinstance(order, int) or isinstance(order, bool) or not 1 <= order <= HIGHEST:
        raise InputError(f"{where}: expected a whole number from 1 to {HIGHEST}, got {order}")
    return order


def check_expected_order(order: Any, where: str) -> int:
    """``order``, if it is a whole number from 2 to 12: what is expected of order 1 is the average itself."""
    if not isinstance(order, int) or isinstance(order, bool) or not 2 <= order <= HIGHEST:
        raise InputError(
            f"{where}: {order} is not an order from 2 to {HIGHEST}; what is expected of order 1 is the average"
        )
    return order


@dataclass(frozen=True)
class FastStates:
    """μ dz/dτ = rate(x, z), with the quasi-steady state z = l(x) where the author gives it.

    >>> x, z = sp.symbols("x z", real=True)
    >>> filtered = FastStates((z,), (x**2 - z,))
    """

    state: tuple[sp.Symbol, ...]
    rate: tuple[sp.Expr, ...]
    quasi_steady_state: tuple[sp.Expr, ...] | None = None

    def __post_init__(self) -> None:
        if len(self.state) != len(self.rate):
            raise InputError(f"{len(self.state)} fast states but {len(self.rate)} rates")
        if self.quasi_steady_state is not None and len(self.quasi_steady_state) != len(self.state):
            raise InputError(f"{len(self.state)} fast states but {len(self.quasi_steady_state)} quasi-steady states")
        for value in self.quasi_steady_state or ():
            if value.free_symbols & set(self.state):
                raise InputError(f"the quasi-steady state {value} contains a fast state")


@dataclass(frozen=True)
class DitherProblem:
    """What is averaged and what is asked about it.

    Attributes
    ----------
    system
        Slow states only; drift and fields may contain the fast states.
    fast
        The fast states, or None.
    functions
        The undefined functions as applied, each known to be smooth and otherwise arbitrary. None stands for
        all that occur.
    region
        Closed intervals for slow or fast states: the compact set asked about. A state that is missing ranges
        over every compact set.
    start
        The earliest slow time asked about; the times are ``start`` ≤ τ < ∞. None stands for all real times.
    bounded
        Undefined functions of the slow time that are assumed bounded in it, with their derivatives.
    expected
        The average that the author claims, n expressions, or None.
    expected_orders
        {N: n expressions}: what the author claims of the averages of order N ≥ 2, for correctors of mean 0.
    mu_omega
        m = μω, a positive constant, where the fast states are as fast as the dithers; None where they are faster.
    """

    system: DitherSystem
    fast: FastStates | None = None
    functions: tuple[AppliedUndef, ...] | None = None
    region: Mapping[sp.Symbol, tuple[sp.Expr, sp.Expr]] = field(default_factory=dict)
    start: sp.Expr | None = sp.S.Zero
    bounded: tuple[AppliedUndef, ...] = ()
    expected: tuple[sp.Expr, ...] | None = None
    mu_omega: sp.Expr | None = None
    expected_orders: Mapping[int, tuple[sp.Expr, ...]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        known = {*self.system.state, *(self.fast.state if self.fast else ())}
        if self.fast and set(self.fast.state) & set(self.system.state):
            raise InputError(f"{self.system.name}: a state is slow and fast at once")
        if self.fast:
            for i, dither in enumerate(self.system.dithers, start=1):
                if dither.free_symbols & set(self.fast.state):
                    raise InputError(f"{self.system.name}: dither {i} depends on a fast state; put that into its field")
            rates = set().union(*(rate.free_symbols for rate in self.fast.rate))
            system = (self.system.time, self.system.phase, self.system.omega, *self.system.state, *self.fast.state)
            check_names((*system, *sorted(rates, key=lambda symbol: symbol.name)), self.system.name)
        if self.mu_omega is not None:
            if isinstance(self.mu_omega, int):
                object.__setattr__(self, "mu_omega", sp.Integer(self.mu_omega))
            if not isinstance(self.mu_omega, sp.Expr) or self.mu_omega.has(sp.Float):
                raise InputError(f"{self.system.name}: mu_omega = {self.mu_omega} is not an exact expression")
            if self.fast is None:
                raise InputError(f"{self.system.name}: mu_omega is given, but there are no fast states")
            if self.mu_omega.free_symbols & {*known, self.system.time, self.system.phase, self.system.omega}:
                raise InputError(f"{self.system.name}: mu_omega = {self.mu_omega} is not a constant")
            if self.mu_omega.is_positive is not True:
                raise InputError(f"{self.system.name}: mu_omega = {self.mu_omega} is not known to be positive")
        for symbol, (low, high) in self.region.items():
            if symbol not in known:
                raise InputError(f"{self.system.name}: the region speaks of {symbol}, which is not a state")
            if (high - low).is_positive is not True:
                raise InputError(f"{self.system.name}: the interval [{low}, {high}] of {symbol} is empty")
        for entries in (*self.expected_orders.values(), *(() if self.expected is None else (self.expected,))):
            if len(entries) != len(self.system.state):
                raise InputError(
                    f"{self.system.name}: {len(entries)} expected entries for {len(self.system.state)} states"
                )
        for order in self.expected_orders:
            check_expected_order(order, f"{self.system.name}: expected_orders")

    @property
    def smooth_functions(self) -> tuple[AppliedUndef, ...]:
        """The undefined functions that are taken as smooth."""
        if self.functions is not None:
            return self.functions
        entries = [*self.system.drift, *itertools.chain.from_iterable(self.system.fields)]
        entries += list(self.fast.rate) if self.fast else []
        return tuple(sorted(set().union(*(entry.atoms(AppliedUndef) for entry in entries)), key=str))

    @property
    def domain(self) -> tuple[Relation, ...]:
        """Times and region as relations."""
        relations = [] if self.start is None else [Relation(self.start, "<=", self.system.time)]
        for symbol, (low, high) in self.region.items():
            relations += [Relation(low, "<=", symbol), Relation(symbol, "<=", high)]
        return tuple(relations)

    def reduced(self, steady: tuple[sp.Expr, ...]) -> DitherSystem:
        """The dither system with the fast states replaced by their quasi-steady state."""
        if self.fast is None:
            return self.system
        values = dict(zip(self.fast.state, steady, strict=True))

        def put(entry: sp.Expr) -> sp.Expr:
            return entry.subs(values, simultaneous=True)

        return replace(
            self.system,
            drift=tuple(map(put, self.system.drift)),
            fields=tuple(tuple(map(put, entries)) for entries in self.system.fields),
        )
