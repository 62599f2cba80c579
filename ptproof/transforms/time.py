"""What a change of time does to a system.

``dilate`` writes a system in the stretched time τ, ``contract`` writes it in the original time t again. They undo each
other, for every clock, capped or not.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from functools import lru_cache

import sympy as sp
from sympy.core.relational import Relational

from ptproof.errors import InputError
from ptproof.proof.signs import vanishes
from ptproof.system import System
from ptproof.transforms.clocks.algebra import factored, settle
from ptproof.transforms.clocks.cap import CappedClock
from ptproof.transforms.clocks.clock import Clock, Piece
from ptproof.transforms.names import fresh


def dilate(system: System, clock: Clock | CappedClock, gain: sp.Symbol | None = None) -> System:
    """The system in the clock's stretched time: dx/dτ = (dt/dτ) · rhs(a⁻¹(τ), x).

    An undefined function of time, such as a drift f(t, x), is taken at the same instant: f(a⁻¹(τ), x). A symbol
    ``gain`` in the system stands for dτ/dt; what it multiplies loses it before anything is put in, and τ may stand
    beside it for the dilated time. Guaranteed for the times τ that the clock reaches.

    Raises
    ------
    InputError
        If the system runs in another time, or contains τ and no gain.

    >>> from ptproof.transforms import prescribed_time_clock
    >>> t, tau, x = sp.symbols("t tau x", real=True)
    >>> T = sp.Symbol("T", positive=True)
    >>> clock = prescribed_time_clock(t, tau, start=0, horizon=T)
    >>> dilate(System(t, (x,), (-x / (1 - t / T) ** 2,)), clock).rhs
    (-x,)
    """
    if system.time != clock.t:
        raise InputError(f"{system.name}: runs in {system.time}, but {clock.name} dilates {clock.t}")
    if gain is None:
        fresh(clock.tau, system.symbols, system.name)
        return _through(system, clock, clock.tau, lambda entry, piece: _tidy(
            entry.subs(clock.t, piece.to_t), piece.rate_back
        ))  # fmt: skip
    terms = (sp.Add(*(term / gain for term in sp.Add.make_args(entry))) for entry in system.rhs)
    rhs = tuple(entry.subs(gain, 1 / clock.rate_back).subs(clock.t, clock.to_t) for entry in terms)
    return System(clock.tau, system.state, rhs, name=f"{system.name} in {clock.tau}")


def contract(system: System, clock: Clock | CappedClock) -> System:
    """The system in the clock's original time: dx/dt = (dτ/dt) · rhs(a(t), x).

    >>> from ptproof.transforms import prescribed_time_clock
    >>> t, tau, x = sp.symbols("t tau x", real=True)
    >>> T = sp.Symbol("T", positive=True)
    >>> clock = prescribed_time_clock(t, tau, start=0, horizon=T)
    >>> contract(System(tau, (x,), (-x,)), clock).rhs
    (-T**2*x/(T - t)**2,)
    """
    if system.time != clock.tau:
        raise InputError(f"{system.name}: runs in {system.time}, but {clock.name} contracts {clock.tau}")
    fresh(clock.t, system.symbols, system.name)
    undone = clock.pieces[0].to_tau.has(sp.exp, sp.log)

    def change(entry: sp.Expr, piece: Piece) -> sp.Expr:
        entry = _tidy(entry.subs(clock.tau, piece.to_tau), piece.rate)
        return settle(entry) if undone else entry

    return _through(system, clock, clock.t, change)


def _through(
    system: System, clock: Clock | CappedClock, time: sp.Symbol, change: Callable[[sp.Expr, Piece], sp.Expr]
) -> System:
    """Each entry changed on each piece of the clock, and joined where the pieces differ."""

    def changed(entry: sp.Expr) -> sp.Expr:
        first, *later = (change(_chosen(entry, clock.conditions, i), piece) for i, piece in enumerate(clock.pieces))
        for second in later:
            assert isinstance(clock, CappedClock)
            difference = first - second
            if vanishes(difference) or (time == clock.t and vanishes(clock.clock.on_interval(difference))):
                return second
            return join(first, second, clock.conditions[time == clock.tau])
        return first

    return System(time, system.state, tuple(map(changed, system.rhs)), name=f"{system.name} in {time}")


def _chosen(entry: sp.Expr, conditions: tuple[Relational, ...], late: int) -> sp.Expr:
    """The entry with each choice by one of the ``conditions`` made: the first piece, or what holds ``late``."""

    def choose(*pieces: sp.Basic) -> sp.Basic:
        if len(pieces) == 2 and pieces[0][1] in conditions:
            return pieces[late][0]
        return sp.Piecewise(*pieces)

    return entry.replace(sp.Piecewise, choose) if conditions else entry


def join(first: sp.Expr, second: sp.Expr, condition: Relational) -> sp.Expr:
    """``first`` where the condition holds and ``second`` elsewhere, the choice made as deep inside as they differ.

    >>> x, t = sp.symbols("x t", real=True)
    >>> join(x * sp.sin(t), x * sp.sin(1), t <= 1)
    x*sin(Piecewise((t, t <= 1), (1, True)))
    """
    if first == second:
        return first
    if isinstance(first, sp.Add | sp.Mul) and first.func == second.func:
        shared = Counter(first.args) & Counter(second.args)
        rests = [first.func(*(Counter(side.args) - shared).elements()) for side in (first, second)]
        if shared:
            return first.func(*shared.elements(), join(rests[0], rests[1], condition))
    plain = isinstance(first, sp.Function) and not isinstance(first, sp.Piecewise)
    if plain and first.func == second.func and len(first.args) == len(second.args):
        return first.func(*(join(a, b, condition) for a, b in zip(first.args, second.args, strict=True)))
    return sp.Piecewise((first, condition), (second, True))


def _tidy(entry: sp.Expr, rate: sp.Expr) -> sp.Expr:
    """``rate`` times ``entry``, term by term, with rational factors cancelled and arguments in factored form."""
    entry = entry.replace(
        lambda node: isinstance(node, sp.core.function.AppliedUndef),
        lambda node: node.func(*map(_shortened, node.args)),
    )
    return sp.Add(*(_cancel_factors(rate * term) for term in sp.Add.make_args(entry)))


@lru_cache(maxsize=1024)
def _shortened(argument: sp.Expr) -> sp.Expr:
    return factored(sp.cancel(argument))


@lru_cache(maxsize=1024)
def _cancel_factors(term: sp.Expr) -> sp.Expr:
    rational: list[sp.Expr] = []
    rest: list[sp.Expr] = []
    for factor in sp.Mul.make_args(term):
        (rational if factor.is_rational_function() and not factor.is_Add else rest).append(factor)
    return _shortened(sp.Mul(*rational)) * sp.Mul(*rest)


def scale_time(system: System, factor: sp.Expr, time: sp.Symbol) -> System:
    """The system in the time ``system.time``/factor, such as the fast time τ̃ = τ/μ.

    Raises
    ------
    InputError
        If the factor is not a positive constant, or the new time is a letter in use.
    """
    factor = sp.sympify(factor)
    if not factor.is_positive or factor.free_symbols & {system.time, *system.state}:
        raise InputError(f"{system.name}: the factor {factor} is not a positive constant")
    if time != system.time:
        fresh(time, (*system.symbols, *factor.free_symbols), system.name)
    rhs = tuple(factor * entry.subs(system.time, factor * time) for entry in system.rhs)
    return System(time, system.state, rhs, name=system.name)
