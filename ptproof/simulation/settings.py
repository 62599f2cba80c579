"""How a question is answered, and how an answer ended: settings, limits on the work, outcomes."""

from __future__ import annotations

import enum
import time as clock
from dataclasses import dataclass

from ptproof.errors import InputError
from ptproof.simulation.numbers import as_float


class Outcome(enum.StrEnum):
    """How a run ended. Outcomes are values; a run that goes wrong raises nothing.

    ``UNTIL`` is a problem's run to the end that it was asked for, before the prescribed time.

    >>> Outcome("reached T") is Outcome.REACHED
    True
    """

    REACHED = "reached T"
    UNTIL = "reached the time asked for"
    ESCAPED = "escaped"
    STEP_LIMIT = "step limit"
    FAILED = "failed"

    @property
    def complete(self) -> bool:
        """Whether the run came as far as it was asked to."""
        return self in (Outcome.REACHED, Outcome.UNTIL)


class Limit(enum.StrEnum):
    """Which limit ended a run, named as the option that moves it."""

    TIME = "time_limit"
    STEPS = "max_steps"
    GAIN = "nu_end"


@dataclass(frozen=True)
class Settings:
    """How a question is answered; nothing here changes what is asked.

    Attributes
    ----------
    rtol, atol
        The error asked for, relative and absolute, of the end result; the local tolerances of an engine are tighter
        (CVODES: 50 times, SciPy's: 10). ``atol`` is ``rtol``/10 if left out.
    engine
        One of :func:`ptproof.simulation.engines.names`; left out, it is chosen to fit.
    samples
        About how many intervals a trajectory has.
    escape_radius
        The distance at which a run has escaped; 10⁶ times the initial one (or 1) if left out.
    max_steps, time_limit
        Bounds on the work of each run, in steps and in seconds; past them its outcome is ``step limit``, and its
        ``limit`` says which of them it was.

    Raises
    ------
    InputError
        For a number that is none, or that is out of its range.
    """

    rtol: float = 1e-8
    atol: float | None = None
    engine: str | None = None
    samples: int = 1000
    escape_radius: float | None = None
    max_steps: int = 50_000_000
    time_limit: float = 60.0

    def __post_init__(self) -> None:
        for name in ("rtol", "atol", "escape_radius", "time_limit"):
            value = getattr(self, name)
            if value is not None and type(value) is not float:
                object.__setattr__(self, name, as_float(value, name))
        if not 1e-14 <= self.rtol <= 1e-2:
            raise InputError(f"rtol: expected a number between 1e-14 and 1e-2, got {self.rtol}")
        if not (self.absolute > 0 and self.time_limit > 0 and self.max_steps >= 1):
            raise InputError("atol, time_limit and max_steps must be positive")
        if not 1 <= self.samples <= 1_000_000:
            raise InputError(f"samples: expected 1 to 1000000, got {self.samples}")

    @property
    def absolute(self) -> float:
        """The absolute tolerance."""
        return self.rtol / 10 if self.atol is None else self.atol


@dataclass(frozen=True)
class Stop:
    """Why a run went no further, in words; ``limit`` where it was a limit on its work."""

    outcome: Outcome = Outcome.REACHED
    message: str = ""
    limit: Limit | None = None


class Budget:
    """What is left of the limits on a run's work: ``steps``, and the time until a deadline."""

    def __init__(self, settings: Settings) -> None:
        self.deadline, self.steps = clock.monotonic() + settings.time_limit, settings.max_steps

    @property
    def spent(self) -> Limit | None:
        """The limit that is met, if any."""
        if self.steps <= 0:
            return Limit.STEPS
        return Limit.TIME if clock.monotonic() > self.deadline else None
