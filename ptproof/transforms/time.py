"""What a change of time does to a system.

``dilate`` writes a system in the stretched time τ, ``contract`` writes it in the original time t again. They undo each
other, for every clock.
"""

from __future__ import annotations

import sympy as sp

from ptproof.errors import InputError
from ptproof.system import System
from ptproof.transforms.clocks.algebra import factored, settle
from ptproof.transforms.clocks.clock import Clock


def dilate(system: System, clock: Clock) -> System:
    """The system in the clock's stretched time: dx/dτ = (dt/dτ) · rhs(a⁻¹(τ), x).

    An undefined function of time, such as a drift f(t, x), is taken at the same instant: f(a⁻¹(τ), x).
    """
    if system.time != clock.t:
        raise InputError(f"{system.name}: runs in {system.time}, but {clock.name} dilates {clock.t}")
    rhs = tuple(_tidy(entry.subs(clock.t, clock.to_t), clock.rate_back) for entry in system.rhs)
    return System(clock.tau, system.state, rhs, name=f"{system.name} in {clock.tau}")


def contract(system: System, clock: Clock) -> System:
    """The system in the clock's original time: dx/dt = (dτ/dt) · rhs(a(t), x)."""
    if system.time != clock.tau:
        raise InputError(f"{system.name}: runs in {system.time}, but {clock.name} contracts {clock.tau}")
    rhs = tuple(_tidy(entry.subs(clock.tau, clock.to_tau), clock.rate) for entry in system.rhs)
    if clock.to_tau.has(sp.exp, sp.log):
        rhs = tuple(map(settle, rhs))
    return System(clock.t, system.state, rhs, name=f"{system.name} in {clock.t}")


def _tidy(entry: sp.Expr, rate: sp.Expr) -> sp.Expr:
    """``rate`` times ``entry``, term by term, with rational factors cancelled and arguments in factored form."""
    entry = entry.replace(
        lambda node: isinstance(node, sp.core.function.AppliedUndef),
        lambda node: node.func(*(factored(sp.cancel(argument)) for argument in node.args)),
    )
    return sp.Add(*(_cancel_factors(rate * term) for term in sp.Add.make_args(entry)))


def _cancel_factors(term: sp.Expr) -> sp.Expr:
    rational: list[sp.Expr] = []
    rest: list[sp.Expr] = []
    for factor in sp.Mul.make_args(term):
        (rational if factor.is_rational_function() and not factor.is_Add else rest).append(factor)
    return factored(sp.cancel(sp.Mul(*rational))) * sp.Mul(*rest)


def scale_time(system: System, factor: sp.Expr, time: sp.Symbol, name: str | None = None) -> System:
    """The system in the time ``system.time``/factor, such as the fast time τ̃ = τ/μ."""
    rhs = tuple(factor * entry.subs(system.time, factor * time) for entry in system.rhs)
    return System(time, system.state, rhs, name=system.name if name is None else name)
