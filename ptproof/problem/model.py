"""The data of a seeking problem, checked when they are put together."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import sympy as sp

from ptproof.errors import InputError
from ptproof.problem.drift import Drift
from ptproof.problem.field import Field
from ptproof.system import System

TIME = sp.Symbol("t", real=True)
_LARGEST = 1e15
_SMALLEST = 1e-15


def number(value: Any, where: str) -> sp.Expr:
    """``value`` as an exact real number, refused unless it is finite and of a size that floats can follow."""
    exact = sp.sympify(value)
    if not isinstance(exact, sp.Expr) or exact.free_symbols or not exact.is_number:
        raise InputError(f"{where}: {value} is not a number")
    approximate = sp.N(exact, 17)
    if not approximate.is_Float and not approximate.is_Integer and not approximate.is_Rational:
        raise InputError(f"{where}: {value} is not a finite real number")
    if abs(approximate) > _LARGEST:
        raise InputError(f"{where}: {value} is too large; numbers up to {_LARGEST:g} make sense here")
    return exact


def positive(value: Any, where: str) -> sp.Expr:
    """:func:`number`, refused unless it is positive and not vanishingly small."""
    exact = number(value, where)
    if not sp.N(exact, 17) >= _SMALLEST:
        raise InputError(f"{where}: must be positive (at least {_SMALLEST:g}), got {value}")
    return exact


@dataclass(frozen=True)
class Tuning:
    """What the user of the seeker chooses.

    Attributes
    ----------
    k, omega, mu
        Gain, dither frequency ω [rad/time] and filter constant μ [time], positive.
    T
        The prescribed time. [time]
    t0
        The start. [time]
    nu_min
        ν_min in (0, 1], at which the gain 1/ν² is clipped; None if it never is.
    """

    k: sp.Expr
    omega: sp.Expr
    mu: sp.Expr
    T: sp.Expr
    t0: sp.Expr = sp.S.Zero
    nu_min: sp.Expr | None = None

    def __post_init__(self) -> None:
        for name in ("k", "omega", "mu", "T"):
            object.__setattr__(self, name, positive(getattr(self, name), f"seeker.{name}"))
        object.__setattr__(self, "t0", number(self.t0, "seeker.t0"))
        if self.nu_min is not None:
            nu_min = positive(self.nu_min, "seeker.nu_min")
            if nu_min > 1:
                raise InputError(f"seeker.nu_min: must lie in (0, 1], got {nu_min}")
            object.__setattr__(self, "nu_min", nu_min)


@dataclass(frozen=True)
class Saturation:
    """An angular acceleration sat(…)/ε with sat at ±level, and the constant gain to compare with (eq:sat_seeker)."""

    epsilon: sp.Expr
    level: sp.Expr
    gain: sp.Expr

    def __post_init__(self) -> None:
        for name in ("epsilon", "level", "gain"):
            object.__setattr__(self, name, positive(getattr(self, name), f"saturation.{name}"))


@dataclass(frozen=True)
class Initial:
    """Where the seeker starts: position x, heading θ, filter state z (None: the measured field) and velocity u₂."""

    x: tuple[sp.Expr, ...]
    theta: sp.Expr = sp.S.Zero
    z: sp.Expr | None = None
    u2: sp.Expr = sp.S.Zero

    def __post_init__(self) -> None:
        position = tuple(number(value, f"initial.x[{i}]") for i, value in enumerate(self.x))
        object.__setattr__(self, "x", position)
        for name in ("theta", "z", "u2"):
            value = getattr(self, name)
            if value is not None:
                object.__setattr__(self, name, number(value, f"initial.{name}"))


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
    """

    field: Field
    drift: Drift
    tuning: Tuning
    initial: Initial
    saturation: Saturation | None = None
    name: str = "problem"

    def __post_init__(self) -> None:
        n = self.field.dimension
        for what, length in (("initial.x", len(self.initial.x)), ("drift", len(self.drift.rate))):
            if length != n:
                raise InputError(f"{what}: {length} entries for {n} coordinates; give one for each")
        if self.kappa > 1000:
            raise InputError(f"field.kappa: must be a positive integer (up to 1000), got {self.kappa}")
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

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        # Problems are looked up several times in each run; hashing their expressions anew would cost more than a run.
        return hash((self.field, self.drift, self.tuning, self.initial, self.saturation, self.name))

    def __getstate__(self) -> dict[str, Any]:
        # The hash of a name differs from process to process.
        return {key: value for key, value in self.__dict__.items() if key != "_hash"}

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

    @property
    def values(self) -> Mapping[sp.Symbol, sp.Expr]:
        """The exact value of each parameter symbol of the symbolic closed loops."""
        from ptproof.problem.loops import parameter_values

        return parameter_values(self)

    def closed_loop(
        self, seeker: str = "pt", frame: str = "t", *, coordinates: str = "full", symbolic: bool = False
    ) -> System:
        """The closed loop as a :class:`System`; see :func:`ptproof.problem.closed_loop`."""
        from ptproof.problem.loops import closed_loop

        return closed_loop(self, seeker, frame, coordinates=coordinates, symbolic=symbolic)

    def reduced_model(self, seeker: str = "pt", frame: str = "t", *, symbolic: bool = False) -> System:
        """The closed loop with the filter at its quasi-steady state; see :func:`ptproof.problem.reduced_model`."""
        from ptproof.problem.models import reduced_model

        return reduced_model(self, seeker, frame, symbolic=symbolic)

    def averaged(self, seeker: str = "pt", frame: str = "t", *, symbolic: bool = False) -> System:
        """Its Lie bracket average as a :class:`System`; see :func:`ptproof.problem.averaged_system`."""
        from ptproof.problem.models import averaged_system

        return averaged_system(self, seeker, frame, symbolic=symbolic)
