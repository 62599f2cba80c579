"""The reduced model of a problem's closed loop, and its Lie bracket average, derived by the functions of the chain."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import sympy as sp

from ptproof.averaging import average, split_dithers
from ptproof.errors import InputError
from ptproof.problem.loops import (
    FRAMES,
    GAIN,
    SEEKERS,
    TAU,
    check_word,
    clock_of,
    gain_of,
    in_frame,
    loop_letters,
    parameter_values,
    parameters,
    reduced_loop,
    without_start,
)
from ptproof.problem.model import TIME, Problem
from ptproof.problem.seekers import asymptotic_seeker
from ptproof.system import DitherSystem, System, substitute
from ptproof.transforms.reduction import split
from ptproof.transforms.states import change_variable, solve_state


def reduced_model(problem: Problem, seeker: str = "pt", frame: str = "t", *, symbolic: bool = False) -> System:
    """The reduced model (eq:reduced_model_tau): the closed loop with z at its quasi-steady state F(x).

    Arguments and errors as for :func:`ptproof.problem.closed_loop`; states (x₁, x₂), parameter p₀ included.
    """
    system = _reduced_model(without_start(problem), *_checked(seeker, frame))
    return _finish(problem, system, symbolic, f"reduced model of the {seeker} seeker of {problem.name} in {frame}")


def averaged_system(problem: Problem, seeker: str = "pt", frame: str = "t", *, symbolic: bool = False) -> System:
    """The Lie bracket average (eq:lie_bracket_system_real in τ, eq:LBA_reduced_model_t in t); states (x₁, x₂).

    It is derived once from an undefined field and drift, through reduction, dithers and brackets, and then the
    problem's own are put in. Arguments and errors as for :func:`ptproof.problem.closed_loop`.
    """
    system = _averaged(without_start(problem), *_checked(seeker, frame))
    return _finish(problem, system, symbolic, f"average of the {seeker} seeker of {problem.name} in {frame}")


def _checked(seeker: str, frame: str) -> tuple[str, str]:
    check_word("seeker", seeker, SEEKERS)
    check_word("frame", frame, FRAMES)
    if seeker.startswith("saturated"):
        raise InputError("seeker: a saturated seeker is not averaged; its heading has dynamics of its own")
    return seeker, frame


def _finish(problem: Problem, system: System, symbolic: bool, name: str) -> System:
    return system if symbolic else replace(system.with_values(parameter_values(problem)), name=name)


@lru_cache(maxsize=64)
def _reduced_model(problem: Problem, seeker: str, frame: str) -> System:
    letters = loop_letters(problem)
    slow = split(reduced_loop(problem), [letters.filter], parameters.mu).reduced_model()
    return in_frame(slow, clock_of(problem, seeker), gain_of(problem, seeker), frame)


@lru_cache(maxsize=1)
def generic_dithers() -> tuple[DitherSystem, System]:
    """The reduced model for undefined F(x₁, x₂) and drift g(τ, x₁, x₂), as a dither system, and its average.

    The phase constant is p₀ − ωt₀; it turns the dithers, and the average does not contain it.
    """
    x1, x2 = sp.symbols("x1 x2", real=True)
    F = sp.Function("F", real=True)(x1, x2)
    g = tuple(sp.Function(name, real=True)(TAU, x1, x2) for name in ("g1", "g2"))
    k, omega, mu, p0 = parameters.k, parameters.omega, parameters.mu, parameters.p0
    loop = asymptotic_seeker(F, g, k=k, omega=omega, mu=mu, time=TAU)
    theta, z = loop.state[2:]
    p = sp.Symbol("p", real=True)
    turned = solve_state(change_variable(loop, theta, p, theta + k * z, p - k * z), p, p0 + omega * TAU)
    dithers = split_dithers(split(turned, [z], mu).reduced_model(), omega)
    return dithers, average(dithers)


@lru_cache(maxsize=64)
def _averaged(problem: Problem, seeker: str, frame: str) -> System:
    loop_letters(problem)
    _, generic = generic_dithers()
    x1, x2 = generic.state
    renamed = dict(zip(problem.variables, (x1, x2), strict=True))
    F = sp.Function("F", real=True)(x1, x2)
    values = {F: problem.field.expression.subs(renamed, simultaneous=True)}
    for name, rate in zip(("g1", "g2"), problem.drift.rate, strict=True):
        values[sp.Function(name, real=True)(TAU, x1, x2)] = rate.subs(renamed, simultaneous=True) / GAIN
    back = {new: old for old, new in renamed.items()}
    # From τ to t with the gain K still a symbol: the rate is multiplied by K.
    rhs = tuple(
        sp.Add(*(GAIN * term for term in sp.Add.make_args(sp.expand_mul(entry)))).subs(back, simultaneous=True)
        for entry in substitute(generic.rhs, values)
    )
    system = System(TIME, problem.variables, rhs, name="average")
    return in_frame(system, clock_of(problem, seeker), gain_of(problem, seeker), frame)
