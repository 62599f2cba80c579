"""The reduced model of a closed loop, and its Lie bracket average, derived by the functions of the chain."""

from __future__ import annotations

from functools import lru_cache

import sympy as sp

from ptproof.averaging import average, split_dithers
from ptproof.errors import InputError
from ptproof.problem.drift import Drift, bounded_drift
from ptproof.problem.field import Field
from ptproof.problem.loops import FRAMES, check_word, in_frame, reduced_loop, states_of
from ptproof.problem.model import GAIN, TAU, TIME, parameters
from ptproof.problem.seekers.seeker import Law, Seeker, letters
from ptproof.problem.smooth import require_smooth
from ptproof.system import DitherSystem, System, substitute
from ptproof.transforms.clocks import CappedClock, Clock
from ptproof.transforms.reduction import split


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
