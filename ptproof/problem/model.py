"""The parts of a seeking problem beside its field and drift, each checked when it is made, and their symbols."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp

from ptproof.errors import InputError
from ptproof.transforms.clocks.named import check_clock

TIME = sp.Symbol("t", real=True)
TAU = sp.Symbol("tau", real=True)
GAIN = sp.Symbol("K", positive=True)
PHASE = sp.Symbol("p", real=True)
_LARGEST = 1e15
_SMALLEST = 1e-15


class parameters:
    """The symbols of the symbolic closed loops; ``p0`` is the constant θ₀ + k z₀ of the reduced coordinates."""

    k, omega, mu, T, nu_min, exponent = sp.symbols("k omega mu T nu_min exponent", positive=True)
    # As the tables of a problem file call them, so that a table's values find their symbols.
    epsilon, level, gain = sp.symbols("epsilon S C", positive=True)
    t0, p0 = sp.symbols("t0 p0", real=True)


def loop_letters() -> frozenset[str]:
    """The names that the closed loops need for their own symbols, which no coordinate may have.

    The states theta, z and u2 are not among them: they give way to a coordinate of that name.
    """
    own = (item.name for item in vars(parameters).values() if isinstance(item, sp.Symbol))
    return frozenset({TIME.name, TAU.name, GAIN.name, PHASE.name, *own})


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
        ν_min in (0, 1], at which the gain is clipped; None if it never is.
    clock
        The name of the clock whose rate is the gain (:data:`ptproof.transforms.CLOCKS`); ``paper`` for 1/ν².
    exponent
        The m > 0 of the clock ``power``, whose rate is 1/ν^(m + 1); None for the others.
    """

    k: sp.Expr
    omega: sp.Expr
    mu: sp.Expr
    T: sp.Expr
    t0: sp.Expr = sp.S.Zero
    nu_min: sp.Expr | None = None
    clock: str = "paper"
    exponent: sp.Expr | None = None

    def __post_init__(self) -> None:
        for name in ("k", "omega", "mu", "T"):
            object.__setattr__(self, name, positive(getattr(self, name), f"seeker.{name}"))
        object.__setattr__(self, "t0", number(self.t0, "seeker.t0"))
        if self.nu_min is not None:
            nu_min = positive(self.nu_min, "seeker.nu_min")
            if nu_min > 1:
                raise InputError(f"seeker.nu_min: must lie in (0, 1], got {nu_min}")
            object.__setattr__(self, "nu_min", nu_min)
        try:
            check_clock(self.clock, self.exponent)
        except InputError as error:
            raise InputError(f"seeker.{error}") from None
        if self.exponent is not None:
            object.__setattr__(self, "exponent", positive(self.exponent, "seeker.exponent"))


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
