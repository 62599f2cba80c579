"""A seeking problem as a value, and the systems that follow from it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property, lru_cache
from types import MappingProxyType
from typing import Any

import sympy as sp

from ptproof.errors import InputError
from ptproof.problem import loops
from ptproof.problem.drift import Drift
from ptproof.problem.field import Field
from ptproof.problem.model import TAU, TIME, Initial, Saturation, Tuning, loop_letters, number, parameters
from ptproof.problem.seekers import SEEKERS, Letters, Seeker, seeker_named
from ptproof.system import System
from ptproof.transforms.clocks import CappedClock, Clock, capped, named_clock


@dataclass(frozen=True)
class Problem:
    """A source to seek: a field with its source, a drift, a seeker's tuning and an initial state.

    Attributes
    ----------
    field
        F over n coordinates with its source x* and κ. Closed loops need n = 2.
    drift
        f(t, x) in :data:`TIME` and ``variables``.
    tuning, initial, saturation
        See the classes; ``saturation`` is None where the problem has none.
    name
        For people.

    Raises
    ------
    InputError
        For data that don't fit together, naming the key at fault.

    Examples
    --------
    >>> import ptproof
    >>> problem = ptproof.example("vanishing")
    >>> problem.peak, problem.tuning.k
    (3, 9/5)
    """

    field: Field
    drift: Drift
    tuning: Tuning
    initial: Initial
    saturation: Saturation | None = None
    name: str = "problem"

    def __post_init__(self) -> None:
        n = self.field.dimension
        if taken := sorted({item.name for item in self.variables} & loop_letters()):
            raise InputError(
                f"field.variables: {', '.join(taken)} has a meaning of its own in the loop; choose another name"
            )
        for what, length in (("initial.x", len(self.initial.x)), ("drift", len(self.drift.rate))):
            if length != n:
                raise InputError(f"{what}: {length} entries for {n} coordinates; give one for each")
        self._check_drift()
        for i, value in enumerate(self.source):
            number(value, f"field.source[{i}]")
        for where, point in (("field.source", self.source), ("initial.x", self.initial.x)):
            value = self.field.value(point)
            try:
                number(value, where)
            except InputError:
                raise InputError(
                    f"field.expression at {where}: the field has no finite real value there ({value})"
                ) from None

    def _check_drift(self) -> None:
        """The drift speaks of the time and the coordinates alone, and is that of this field where it follows one."""
        drift = self.drift
        for where, entries, allowed in (
            ("drift", drift.rate, {TIME, *self.variables}), ("drift.bound", (drift.bound or sp.S.Zero,), {TIME}),
        ):  # fmt: skip
            if unknown := set().union(*(entry.free_symbols for entry in entries)) - allowed:
                names, known = (", ".join(sorted(map(str, symbols))) for symbols in (unknown, allowed))
                raise InputError(
                    f"{where}: contains {names}, but may depend on {known} alone (with their declarations)"
                )
        if drift.matrix is not None:
            rate = drift.matrix * self.field.gradient
            if any(sp.expand(a - b) != 0 for a, b in zip(rate, drift.rate, strict=True)):
                raise InputError("drift: is E∇F of another field; make it with gradient_drift(E, F, x) of this one")

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        # Problems are looked up several times in each run; hashing their expressions anew would cost more than a run.
        return hash((self.field, self.drift, self.tuning, self.initial, self.saturation, self.name))

    def __getstate__(self) -> dict[str, Any]:
        # What is cached stays behind: the hash of a name differs from process to process.
        return {item.name: getattr(self, item.name) for item in fields(self)}

    @property
    def variables(self) -> tuple[sp.Symbol, ...]:
        """The n coordinates of the field, real symbols."""
        return self.field.variables

    @property
    def source(self) -> tuple[sp.Expr, ...]:
        """x*, n exact numbers."""
        return self.field.source

    @property
    def kappa(self) -> int:
        """The κ of the field's bounds, a positive integer."""
        return self.field.kappa

    @property
    def peak(self) -> sp.Expr:
        """F(x*)."""
        return self.field.peak

    @cached_property
    def measured(self) -> sp.Expr:
        """z₀: the given filter state, or the field at the initial position."""
        return self.field.value(self.initial.x) if self.initial.z is None else self.initial.z

    @cached_property
    def clock(self) -> Clock | CappedClock:
        """The clock whose rate is the prescribed-time gain, with the problem's numbers, in TIME and TAU."""
        tuning = self.tuning
        clock = named_clock(tuning.clock, TIME, TAU, start=tuning.t0, horizon=tuning.T, exponent=tuning.exponent)
        return clock if tuning.nu_min is None else capped(clock, tuning.nu_min)

    @property
    def states(self) -> Letters:
        """The letters of the closed loops' states; theta, z and u2 give way to a coordinate of that name."""
        return loops.states_of(self.variables)

    @cached_property
    def default_seeker(self) -> str:
        """The name of the seeker that the problem's tables are meant for, ``pt`` where it has none of its own."""
        fitting = [seeker for seeker in SEEKERS.values() if not self._missing(seeker)]
        return max(fitting, key=lambda seeker: len(seeker.tables)).name

    def _missing(self, seeker: Seeker) -> list[str]:
        return [table for table in seeker.tables if getattr(self, table, None) is None]

    def seeker(self, name: str) -> Seeker:
        """The record of a seeker, refused where the problem has not all its tables."""
        seeker = seeker_named(name)
        if missing := self._missing(seeker):
            raise InputError(f"seeker: the seeker {name!r} needs the table [{missing[0]}], which {self.name} has not")
        return seeker

    def seeker_clock(self, seeker: str = "pt") -> Clock | CappedClock:
        """The symbolic clock whose rate is the seeker's gain, in the symbols of :class:`parameters`."""
        tuning = self.tuning
        return loops.symbolic_clock(
            tuning.clock, tuning.exponent is not None, tuning.nu_min is not None, self.seeker(seeker).gain
        )

    @cached_property
    def values(self) -> Mapping[sp.Symbol, sp.Expr]:
        """The exact value of each parameter symbol of the symbolic closed loops."""
        tables = [vars(table) for table in (self.tuning, self.saturation) if table is not None]
        given = [(name, value) for table in tables for name, value in table.items() if value is not None]
        values = {getattr(parameters, name): value for name, value in given if hasattr(parameters, name)}
        values[parameters.p0] = self.initial.theta + self.tuning.k * self.measured
        return MappingProxyType(values)

    def closed_loop(
        self, seeker: str = "pt", frame: str = "t", *, coordinates: str = "full", symbolic: bool = False
    ) -> System:
        """The closed loop of the problem under a seeker.

        Parameters
        ----------
        seeker
            ``pt`` (eq:closed_loop_system_t with the clipped gain of eq:kt where the problem has a ν_min),
            ``asymptotic`` (eq:exponential_seeker), ``saturated`` (eq:sat_seeker with that gain),
            ``saturated-constant`` (with the constant gain), or another of :data:`ptproof.problem.SEEKERS`.
        frame
            ``t``, or ``tau`` with dτ/dt equal to the gain.
        coordinates
            ``full``: (x₁, x₂, θ, z), with u₂ before z for a saturated seeker. ``reduced``: (x₁, x₂, z) with
            θ = p₀ + ω(τ − t₀) − kz (eq:tau_pt_system, there with p₀ = t₀ = 0); not for a saturated seeker.
        symbolic
            Keep the symbols of :class:`parameters`; otherwise their exact values are put in.

        Raises
        ------
        InputError
            For a word that is not one of these, a field that is not planar, or a seeker whose table is missing.
        """
        return self._derived("", loops.closed_loop, seeker, frame, symbolic, coordinates)

    def reduced_model(self, seeker: str = "pt", frame: str = "t", *, symbolic: bool = False) -> System:
        """The reduced model (eq:reduced_model_tau): the closed loop with z at its quasi-steady state F(x).

        Arguments and errors as for :meth:`closed_loop`; states (x₁, x₂), parameter p₀ included.
        """
        return self._derived("reduced model of the ", loops.reduced_model, seeker, frame, symbolic)

    def averaged(self, seeker: str = "pt", frame: str = "t", *, symbolic: bool = False) -> System:
        """The Lie bracket average (eq:lie_bracket_system_real in τ, eq:LBA_reduced_model_t in t); states (x₁, x₂).

        It is derived once from an undefined field and drift, through reduction, dithers and brackets, and then the
        problem's own are put in. Arguments and errors as for :meth:`closed_loop`.
        """
        return self._derived("average of the ", loops.averaged_system, seeker, frame, symbolic)

    def _derived(
        self, what: str, derive: Callable[..., System], seeker: str, frame: str, symbolic: bool, *more: str
    ) -> System:
        clock = self.seeker_clock(seeker)
        system = derive(self.field, self.drift, self.seeker(seeker), clock, frame, *more)
        name = f"{what}{seeker} seeker of {self.name} in {frame}"
        return system if symbolic else replace(_with_values(system, tuple(self.values.items())), name=name)


@lru_cache(maxsize=64)
def _with_values(system: System, values: tuple[tuple[sp.Symbol, sp.Expr], ...]) -> System:
    return system.with_values(dict(values))
