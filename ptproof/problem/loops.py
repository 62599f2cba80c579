"""The closed loops of seekers, in both times and in full or reduced coordinates.

Each is built from one right-hand side, the seeker's with a gain K that stays a symbol: in t the gain is put in,
in τ with dτ/dt = K the whole is divided by it first, so no gain is left to cancel. The reduced model of a loop, and its
Lie bracket average, are derived from it by the functions of the chain.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import sympy as sp

from ptproof.averaging import average, split_dithers
from ptproof.errors import InputError
from ptproof.problem.drift import Drift, bounded_drift
from ptproof.problem.field import Field
from ptproof.problem.model import GAIN, PHASE, TAU, TIME, parameters
from ptproof.problem.seekers.seeker import Law, Letters, Seeker, letters
from ptproof.problem.smooth import require_smooth
from ptproof.system import DitherSystem, System, substitute
from ptproof.transforms.clocks import CappedClock, Clock, capped, constant_clock, named_clock
from ptproof.transforms.reduction import split
from ptproof.transforms.states import change_variable, solve_state
from ptproof.transforms.time import dilate

FRAMES = ("t", "tau")
COORDINATES = ("full", "reduced")


@lru_cache(maxsize=64)
def states_of(variables: tuple[sp.Symbol, ...]) -> Letters:
    """The states' letters; theta, z and u2 give way (theta_, …) where a coordinate has that name."""
    if len(variables) != 2:
        raise InputError(
            f"field.variables: a unicycle moves in the plane, but the field has {len(variables)} variables"
        )
    taken = {symbol.name for symbol in variables}

    def letter(name: str) -> sp.Symbol:
        while name in taken:
            name += "_"
        return sp.Symbol(name, real=True)

    x1, x2 = variables
    return Letters((x1, x2), letter("theta"), letter("z"), letter("u2"))


@lru_cache(maxsize=64)
def symbolic_clock(name: str, exponent: bool, clipped: bool, gain: sp.Expr | None = None) -> Clock | CappedClock:
    """A named clock, clipped or not, in the symbols of :class:`parameters`; with a constant ``gain``, that of its rate.

    ``exponent`` says whether the clock has one.
    """
    symbols = parameters
    if gain is not None:
        return constant_clock(TIME, TAU, start=symbols.t0, rate=gain)
    order = symbols.exponent if exponent else None
    clock = named_clock(name, TIME, TAU, start=symbols.t0, horizon=symbols.T, exponent=order)
    return capped(clock, symbols.nu_min) if clipped else clock


def check_word(what: str, word: str, allowed: Sequence[str]) -> None:
    """Refuse a word that is not one of those that are allowed."""
    if word not in allowed:
        raise InputError(f"{what}: {word!r} is not one of {', '.join(allowed)}")


@lru_cache(maxsize=256)
def closed_loop(
    field: Field, drift: Drift, seeker: Seeker, clock: Clock | CappedClock, frame: str, coordinates: str
) -> System:
    """The symbolic closed loop; arguments as for :meth:`ptproof.problem.Problem.closed_loop`.

    ``clock`` is the symbolic clock whose rate is the seeker's gain.
    """
    check_word("frame", frame, FRAMES)
    check_word("coordinates", coordinates, COORDINATES)
    states = states_of(field.variables)
    if coordinates == "full":
        return in_frame(seeker.law(field.expression, drift, GAIN, states), clock, frame)
    if not seeker.averaged:
        raise InputError(
            f"coordinates: a {seeker.name} seeker has no reduced coordinates, its heading has its own dynamics"
        )
    return in_frame(reduced_loop(field.expression, drift, seeker.law, states), clock, frame)


@lru_cache(maxsize=64)
def reduced_loop(field: sp.Expr, drift: Drift, law: Law, states: Letters) -> System:
    """The loop in (x₁, x₂, z), in t with the symbol K, and TAU in the place of the dilated time.

    θ is exchanged for p = θ + kz, and p for its solution p₀ + ω(τ − t₀).
    """
    symbols, p = parameters, PHASE
    turn = symbols.k * states.filter
    rotated = change_variable(law(field, drift, GAIN, states), states.heading, p, states.heading + turn, p - turn)
    # dτ/dt = K, so that the equation dp/dt = Kω loses the gain in τ, where its solution is checked.
    dilated = System(TAU, rotated.state, tuple(sp.expand(entry / GAIN) for entry in rotated.rhs))
    phase = symbols.p0 + symbols.omega * (TAU - symbols.t0)
    solve_state(dilated, p, phase)
    rates = {state: rate.subs(p, phase) for state, rate in zip(rotated.state, rotated.rhs, strict=True) if state != p}
    return System(TIME, tuple(rates), tuple(rates.values()), name=rotated.name)


def in_frame(system: System, clock: Clock | CappedClock, frame: str) -> System:
    """A system in t with the symbol K for the clock's rate, and TAU for the dilated time, in one ``frame`` alone."""
    if frame == "tau":
        return dilate(system, clock, GAIN)
    rhs = tuple(entry.subs(TAU, clock.to_tau).subs(GAIN, clock.rate) for entry in system.rhs)
    return System(TIME, system.state, rhs, name=system.name)


def _check(seeker: Seeker, frame: str) -> None:
    check_word("frame", frame, FRAMES)
    if not seeker.averaged:
        raise InputError(f"seeker: a {seeker.name} seeker is not averaged; its heading has dynamics of its own")


@lru_cache(maxsize=64)
def reduced_model(field: Field, drift: Drift, seeker: Seeker, clock: Clock | CappedClock, frame: str) -> System:
    """The symbolic reduced model (eq:reduced_model_tau); see :meth:`ptproof.problem.Problem.reduced_model`."""
    _check(seeker, frame)
    states = states_of(field.variables)
    loop = reduced_loop(field.expression, drift, seeker.law, states)
    return in_frame(split(loop, [states.filter], parameters.mu).reduced_model(), clock, frame)


@lru_cache(maxsize=8)
def generic_dithers(law: Law) -> tuple[DitherSystem, System]:
    """The reduced model for undefined F(x₁, x₂) and drift g(τ, x₁, x₂), as a dither system, and its average.

    The phase constant is p₀ − ωt₀; it turns the dithers, and the average does not contain it.
    """
    states = letters()
    position = states.position
    F = sp.Function("F", real=True)(*position)
    g = tuple(sp.Function(name, real=True)(TAU, *position) for name in ("g1", "g2"))
    loop = reduced_loop(F, bounded_drift(g), law, states)
    now = {GAIN: 1, parameters.t0: 0, TIME: TAU}
    in_tau = System(TAU, loop.state, tuple(entry.subs(now) for entry in loop.rhs), name=loop.name)
    dithers = split_dithers(split(in_tau, [states.filter], parameters.mu).reduced_model(), parameters.omega)
    return dithers, average(dithers)


@lru_cache(maxsize=64)
def averaged_system(field: Field, drift: Drift, seeker: Seeker, clock: Clock | CappedClock, frame: str) -> System:
    """The symbolic average (eq:lie_bracket_system_real); see :meth:`ptproof.problem.Problem.averaged`."""
    _check(seeker, frame)
    states_of(field.variables)
    require_smooth(field.expression, field.variables, 2, "average: the Lie brackets need a smooth field")
    _, generic = generic_dithers(seeker.law)
    renamed = dict(zip(field.variables, generic.state, strict=True))
    F = sp.Function("F", real=True)(*generic.state)
    values = {F: field.value(renamed)}
    for name, rate in zip(("g1", "g2"), drift.rate, strict=True):
        values[sp.Function(name, real=True)(TAU, *generic.state)] = rate.subs(renamed, simultaneous=True) / GAIN
    back = {new: old for old, new in renamed.items()}
    # From τ to t with the gain K still a symbol: the rate is multiplied by K.
    rhs = tuple(
        sp.Add(*(GAIN * term for term in sp.Add.make_args(sp.expand_mul(entry)))).subs(back, simultaneous=True)
        for entry in substitute(generic.rhs, values)
    )
    return in_frame(System(TIME, field.variables, rhs, name="average"), clock, frame)
