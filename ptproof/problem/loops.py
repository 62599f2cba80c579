"""The closed loops of a problem, in both times and in full or reduced coordinates, and their averages.

Each is built from one right-hand side, the seeker's with a gain K that stays a symbol: in t the gain is put in,
in τ with dτ/dt = K the whole is divided by it first, so no gain is left to cancel.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from types import MappingProxyType

import sympy as sp

from ptproof.errors import InputError
from ptproof.problem.clipped import ClippedClock
from ptproof.problem.model import TIME, Problem, Saturation
from ptproof.problem.seekers import Letters, asymptotic_seeker, prescribed_time_gain, saturated_seeker
from ptproof.system import System
from ptproof.transforms.clocks.clock import Clock
from ptproof.transforms.clocks.named import prescribed_time_clock
from ptproof.transforms.states import change_variable, solve_state

SEEKERS = ("pt", "asymptotic", "saturated", "saturated-constant")
FRAMES = ("t", "tau")
COORDINATES = ("full", "reduced")
TAU = sp.Symbol("tau", real=True)
GAIN = sp.Symbol("K", positive=True)


class parameters:
    """The symbols of the symbolic closed loops; ``p0`` is the constant θ₀ + k z₀ of the reduced coordinates."""

    k, omega, mu, T, nu_min = sp.symbols("k omega mu T nu_min", positive=True)
    epsilon, level, gain = sp.symbols("epsilon S C", positive=True)
    t0, p0 = sp.symbols("t0 p0", real=True)


@lru_cache(maxsize=256)
def parameter_values(problem: Problem) -> Mapping[sp.Symbol, sp.Expr]:
    """The exact value of each of :class:`parameters` in ``problem``."""
    tuning, symbols = problem.tuning, parameters
    values = {
        symbols.k: tuning.k, symbols.omega: tuning.omega, symbols.mu: tuning.mu, symbols.T: tuning.T,
        symbols.t0: tuning.t0, symbols.p0: problem.initial.theta + tuning.k * problem.measured,
    }  # fmt: skip
    if tuning.nu_min is not None:
        values[symbols.nu_min] = tuning.nu_min
    if problem.saturation is not None:
        saturation = problem.saturation
        values |= {
            symbols.epsilon: saturation.epsilon, symbols.level: saturation.level, symbols.gain: saturation.gain,
        }  # fmt: skip
    return MappingProxyType(values)


@lru_cache(maxsize=256)
def loop_letters(problem: Problem) -> Letters:
    """The states' letters; theta, z and u2 give way (theta_, …) where a coordinate has that name."""
    if len(problem.variables) != 2:
        raise InputError(
            f"{problem.name}: a unicycle moves in the plane, but the field has {len(problem.variables)} variables"
        )
    taken = {symbol.name for symbol in problem.variables}

    def letter(name: str) -> sp.Symbol:
        while name in taken:
            name += "_"
        return sp.Symbol(name, real=True)

    x1, x2 = problem.variables
    return Letters((x1, x2), letter("theta"), letter("z"), letter("u2"))


def clock_of(problem: Problem, seeker: str = "pt") -> Clock | ClippedClock | None:
    """The symbolic clock whose rate is the seeker's gain; None where the gain is constant and τ = t is used."""
    check_word("seeker", seeker, SEEKERS)
    if seeker in ("asymptotic", "saturated-constant"):
        return None
    return _clock(problem.tuning.nu_min is not None)


@lru_cache
def _clock(clipped: bool) -> Clock | ClippedClock:
    clock = prescribed_time_clock(TIME, TAU, start=parameters.t0, horizon=parameters.T)
    return ClippedClock(clock, parameters.nu_min) if clipped else clock


@lru_cache(maxsize=256)
def gain_of(problem: Problem, seeker: str = "pt") -> sp.Expr:
    """K(t), symbolic: the seeker's gain."""
    clock = clock_of(problem, seeker)
    if isinstance(clock, ClippedClock):
        return prescribed_time_gain(clock.clock, clock.minimum)
    if clock is not None:
        return prescribed_time_gain(clock)
    return parameters.gain if seeker == "saturated-constant" else sp.S.One


def closed_loop(
    problem: Problem, seeker: str = "pt", frame: str = "t", *, coordinates: str = "full", symbolic: bool = False
) -> System:
    """The closed loop of ``problem``.

    Parameters
    ----------
    seeker
        ``pt`` (eq:closed_loop_system_t with the clipped gain of eq:kt where the problem has a ν_min),
        ``asymptotic`` (eq:exponential_seeker), ``saturated`` (eq:sat_seeker with that gain) or
        ``saturated-constant`` (with the constant gain).
    frame
        ``t``, or ``tau`` with dτ/dt equal to the gain (τ = t for the asymptotic seeker and the constant gain).
    coordinates
        ``full``: (x₁, x₂, θ, z), with u₂ before z for a saturated seeker. ``reduced``: (x₁, x₂, z) with
        θ = p₀ + ω(τ − t₀) − kz (eq:tau_pt_system, there with p₀ = t₀ = 0); not for a saturated seeker.
    symbolic
        Keep the symbols of :class:`parameters`; otherwise their exact values are put in.

    Raises
    ------
    InputError
        For a word that is not one of these, a field that is not planar, or a saturated seeker without its data.
    """
    check_word("seeker", seeker, SEEKERS)
    check_word("frame", frame, FRAMES)
    check_word("coordinates", coordinates, COORDINATES)
    system = _closed_loop(without_start(problem), seeker, frame, coordinates)
    if symbolic:
        return system
    return replace(system.with_values(parameter_values(problem)), name=f"{seeker} seeker of {problem.name} in {frame}")


def check_word(what: str, word: str, allowed: tuple[str, ...]) -> None:
    if word not in allowed:
        raise InputError(f"{what}: {word!r} is not one of {', '.join(allowed)}")


@lru_cache(maxsize=256)
def without_start(problem: Problem) -> Problem:
    """The problem without what its systems don't contain, so that problems that differ in it share one."""
    origin = replace(problem.initial, x=problem.source, theta=sp.S.Zero, z=None, u2=sp.S.Zero)
    tuning = replace(problem.tuning, k=sp.S.One, omega=sp.S.One, mu=sp.S.One, T=sp.S.One, t0=sp.S.Zero)
    if tuning.nu_min is not None:
        tuning = replace(tuning, nu_min=sp.S.Half)
    saturation = None if problem.saturation is None else Saturation(sp.S.One, sp.S.One, sp.S.One)
    return replace(problem, name="", initial=origin, tuning=tuning, saturation=saturation)


@lru_cache(maxsize=256)
def _closed_loop(problem: Problem, seeker: str, frame: str, coordinates: str) -> System:
    letters, symbols = loop_letters(problem), parameters
    if seeker.startswith("saturated"):
        if problem.saturation is None:
            raise InputError("seeker: a saturated seeker needs the table [saturation] with epsilon, level and gain")
        if coordinates == "reduced":
            raise InputError(
                "coordinates: a saturated seeker has no reduced coordinates, its heading has its own dynamics"
            )
        system = saturated_seeker(
            problem.field.expression, k=symbols.k, omega=symbols.omega, mu=symbols.mu, epsilon=symbols.epsilon,
            level=symbols.level, gain=GAIN, time=TIME, drift=problem.drift, states=letters,
        )  # fmt: skip
    else:
        system = asymptotic_seeker(
            problem.field.expression, problem.drift, k=symbols.k, omega=symbols.omega, mu=symbols.mu, time=TIME,
            gain=GAIN, states=letters,
        )  # fmt: skip
        if coordinates == "reduced":
            system = reduced_loop(problem)
    return in_frame(system, clock_of(problem, seeker), gain_of(problem, seeker), frame)


@lru_cache(maxsize=64)
def reduced_loop(problem: Problem) -> System:
    """The loop in (x₁, x₂, z), in t with the symbol K, and TAU in the place of the dilated time.

    θ is exchanged for p = θ + kz, and p for its solution p₀ + ω(τ − t₀).
    """
    letters, symbols, p = loop_letters(problem), parameters, sp.Symbol("p", real=True)
    full = asymptotic_seeker(
        problem.field.expression, problem.drift, k=symbols.k, omega=symbols.omega, mu=symbols.mu, time=TIME, gain=GAIN,
        states=letters,
    )  # fmt: skip
    rotated = change_variable(
        full, letters.heading, p, letters.heading + symbols.k * letters.filter, p - symbols.k * letters.filter
    )
    # dτ/dt = K, so that the equation dp/dt = Kω loses the gain in τ, where its solution is checked.
    dilated = System(TAU, rotated.state, tuple(sp.expand(entry / GAIN) for entry in rotated.rhs))
    phase = symbols.p0 + symbols.omega * (TAU - symbols.t0)
    solve_state(dilated, p, phase)
    keep = [index for index, variable in enumerate(rotated.state) if variable != p]
    rhs = tuple(rotated.rhs[i].subs(p, phase) for i in keep)
    return System(TIME, tuple(rotated.state[i] for i in keep), rhs, name=full.name)


def in_frame(system: System, clock: Clock | ClippedClock | None, gain: sp.Expr, frame: str) -> System:
    """A system in t with the symbol K for its gain, and TAU for the dilated time, written in ``frame`` alone."""
    if frame == "t":
        to_tau = TIME if clock is None else clock.to_tau
        rhs = tuple(entry.subs(TAU, to_tau).subs(GAIN, gain) for entry in system.rhs)
        return System(TIME, system.state, rhs, name=system.name)
    if clock is None:
        rhs = tuple(entry.subs(GAIN, gain).subs(TIME, TAU) for entry in system.rhs)
    else:
        rhs = tuple(
            sp.Add(*(term / GAIN for term in sp.Add.make_args(entry)))
            .subs(GAIN, 1 / clock.rate_back)
            .subs(TIME, clock.to_t)
            for entry in system.rhs
        )
    return System(TAU, system.state, rhs, name=system.name)
