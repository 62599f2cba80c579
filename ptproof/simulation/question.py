"""What is asked of a simulation, as a value, and the options by which it is asked."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from typing import Any, TypedDict

from ptproof.errors import InputError
from ptproof.problem import Problem, example
from ptproof.simulation.numbers import as_float, by_name
from ptproof.simulation.settings import Settings
from ptproof.simulation.setup import Setup, default_sample_time, from_problem, from_system
from ptproof.system import System


@dataclass(frozen=True)
class Question:
    """What is to be simulated.

    Attributes
    ----------
    target
        A :class:`Problem` (its closed loop to T), an example's name, or a :class:`System` (which needs ``initial``
        and ``span``).
    seeker, frame, coordinates
        For a problem: as for :func:`ptproof.problem.closed_loop`.
    model
        For a problem: ``closed loop``, ``reduced model`` or ``average``.
    initial, parameters
        Values by name; for a problem they replace its own. A number given as text is exact.
    span
        (start, end) for a system.
    until
        For a problem: another end than t₀ + T, in t.
    nu_end
        For a gain that is never clipped: the ν at which the run stops, since no run reaches T.
    motion
        For a problem whose source moves: how far it is from its place, an expression in t for each coordinate
        (:func:`ptproof.problem.moving.moving_source`). [length]
    sample_time
        For a closed loop that is sampled in t: the time between two measurements; the inputs are held between them.
        Left out where there is ``noise``, it is a twentieth of the filter's time constant at its fastest. [time]
    noise
        The standard deviation of what is added to each measurement of the field, drawn anew at each sample.
    noise_seed
        Of what is drawn.
    """

    target: Problem | System | str
    seeker: str = "pt"
    frame: str = "t"
    coordinates: str = "full"
    model: str = "closed loop"
    initial: Any = None
    parameters: Mapping[Any, Any] | None = None
    span: tuple[Any, Any] | None = None
    until: Any = None
    nu_end: float | None = None
    motion: tuple[Any, ...] | None = None
    sample_time: Any = None
    noise: Any = None
    noise_seed: int = 0

    @property
    def problem(self) -> Problem | None:
        """The problem that is meant, if it is one."""
        if isinstance(self.target, str):
            return example(self.target)
        return self.target if isinstance(self.target, Problem) else None

    @property
    def plain(self) -> bool:
        """Whether it is a problem with its own numbers, so that it need be prepared once only."""
        changes = (self.initial, self.parameters, self.span, self.until, self.motion, self.sample_time, self.noise)
        return self.problem is not None and all(change is None for change in changes)

    def setup(self) -> Setup:
        """The system with its parameters, initial states and times by name.

        Raises :class:`InputError` for what does not fit together.
        """
        if isinstance(self.target, System):
            if self.motion is not None or self.sampled:
                raise InputError(
                    "motion, sample_time, noise: need a problem, whose field is measured; this is a system"
                )
            return from_system(self.target, self.initial, self.span, self.parameters)
        problem = self.problem
        if problem is None:
            kind = type(self.target).__name__
            raise InputError(f"simulate: expected a problem, a system or an example's name, got {kind}")
        if self.span is not None:
            raise InputError("span: a problem has its own; use until= for another end")
        until = None if self.until is None else as_float(self.until, "until")
        setup = _setup(
            problem, self.seeker, self.frame, self.coordinates, self.model, until, self.nu_end,
            None if self.motion is None else tuple(self.motion), self.sampled,
        )  # fmt: skip
        if self.sampled:
            setup = replace(setup, defaults=dict(setup.defaults) | self._sampling(problem, setup))
            setup = replace(setup, free=tuple(dict.fromkeys((*setup.free, *setup.defaults))))
        return self._with_values(setup)

    @property
    def sampled(self) -> bool:
        """Whether the loop is sampled."""
        return self.sample_time is not None or self.noise is not None

    def _sampling(self, problem: Problem, setup: Setup) -> dict[str, float]:
        """The parameters of a sampled run, by name."""
        noise = 0.0 if self.noise is None else as_float(self.noise, "noise")
        if noise < 0:
            raise InputError(f"noise: a standard deviation is not negative, got {noise:g}")
        if (
            isinstance(self.noise_seed, bool)
            or not isinstance(self.noise_seed, int)
            or not 0 <= self.noise_seed < 2**53
        ):
            raise InputError(f"noise_seed: expected an integer from 0 to 2^53, got {self.noise_seed!r}")
        if self.sample_time is None:
            length = default_sample_time(problem, self.seeker, setup)
        else:
            length = as_float(self.sample_time, "sample_time")
        if length <= 0:
            raise InputError(f"sample_time: must be positive, got {length:g}")
        return {"sample_time": length, "noise": noise, "noise_seed": float(self.noise_seed)}

    def _with_values(self, setup: Setup) -> Setup:
        if self.initial is not None and not isinstance(self.initial, Mapping):
            raise InputError("initial: give a problem's initial states by name, such as {'theta': 1}")
        changes = by_name(self.initial or {}) | by_name(self.parameters or {})
        if not changes:
            return setup
        for name in changes:
            if name not in setup.free:
                raise InputError(f"initial, parameters: {name!r} is not one of {', '.join(setup.free)}")
        numbers = {name: as_float(value, name) for name, value in changes.items()}
        return replace(setup, defaults=dict(setup.defaults) | numbers)


_setup = lru_cache(maxsize=64)(from_problem)


class Options(TypedDict, total=False):
    """What ``simulate`` and ``ensemble`` take by keyword: the fields of :class:`Question` and :class:`Settings`."""

    coordinates: str
    model: str
    initial: Mapping[Any, Any] | Sequence[Any] | None
    parameters: Mapping[Any, Any] | None
    span: tuple[Any, Any] | None
    until: Any
    nu_end: float | None
    motion: tuple[Any, ...] | None
    sample_time: Any
    noise: Any
    noise_seed: int
    settings: Settings
    rtol: float | str
    atol: float | str | None
    engine: str | None
    samples: int
    escape_radius: float | None
    max_steps: int
    time_limit: float


_ASKED = frozenset(entry.name for entry in fields(Question))
_HOW = frozenset(entry.name for entry in fields(Settings))


def asked(target: Question | Problem | System | str, options: Mapping[str, Any]) -> tuple[Question, Settings]:
    """The question and the settings that a target and options make; options replace what is in values that are given.

    A seeker or a frame that is None counts as left out.

    Raises
    ------
    TypeError
        For an option that there is none of.
    """
    for name in options:
        if name not in _ASKED and name not in _HOW and name != "settings":
            known = ", ".join(sorted((_ASKED | _HOW | {"settings"}) - {"target"}))
            raise TypeError(f"{name!r} is not an option of a simulation (those are {known})")
    left_out = {name for name in ("seeker", "frame") if options.get(name) is None}
    what = {name: value for name, value in options.items() if name in _ASKED - left_out}
    how = {name: value for name, value in options.items() if name in _HOW}
    question = replace(target, **what) if isinstance(target, Question) else Question(target, **what)
    settings = options.get("settings")
    if settings is None:
        return question, Settings(**how)
    return question, replace(settings, **how) if how else settings
