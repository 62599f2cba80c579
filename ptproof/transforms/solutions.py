"""Solutions carried through a change of time, and checked against their system."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.signs import vanishes
from ptproof.system import System
from ptproof.transforms.clocks.algebra import settle
from ptproof.transforms.clocks.clock import Clock
from ptproof.transforms.names import moves_smoothly


def carry_solution(solution: Mapping[sp.Symbol, sp.Expr], clock: Clock) -> dict[sp.Symbol, sp.Expr]:
    """A solution of a dilated system, in τ, as one of the system in t: x(t) = x̂(a(t)), state by state.

    A bound in τ is carried in the same way. Guaranteed for t₀ ≤ t < t₀ + horizon, the clock's interval.

    Raises
    ------
    InputError
        If a value contains t already.

    >>> from ptproof.transforms.clocks.named import logarithmic_clock
    >>> t, tau, x = sp.symbols("t tau x", real=True); T, k = sp.symbols("T k", positive=True)
    >>> carry_solution({x: sp.exp(-k * tau)}, logarithmic_clock(t, tau, start=0, horizon=T))
    {x: ((T - t)/T)**(T*k)}
    """
    _refuse(solution, clock.t, clock.name)
    return {state: _as_power(settle(value.subs(clock.tau, clock.to_tau))) for state, value in solution.items()}


def _refuse(solution: Mapping[sp.Symbol, sp.Expr], time: sp.Symbol, where: str) -> None:
    """A solution in one time that contains the other would have two meanings of it afterwards."""
    for state, value in solution.items():
        if time.name in {symbol.name for symbol in (state, *value.free_symbols)}:
            raise InputError(f"{where}: the solution {state} = {value} already contains {time}")


def _as_power(expression: sp.Expr) -> sp.Expr:
    """exp(c ln b) as b^c."""

    def power(exponent: sp.Expr) -> sp.Expr:
        factors = sp.Mul.make_args(exponent)
        logarithms = [factor for factor in factors if isinstance(factor, sp.log)]
        if len(logarithms) != 1:
            return sp.exp(exponent)
        return logarithms[0].args[0] ** sp.Mul(*(factor for factor in factors if factor is not logarithms[0]))

    return expression.replace(sp.exp, power)


def bring_solution(solution: Mapping[sp.Symbol, sp.Expr], clock: Clock) -> dict[sp.Symbol, sp.Expr]:
    """A solution in t as one of the dilated system: x̂(τ) = x(a⁻¹(τ)); one that contains τ already is refused."""
    _refuse(solution, clock.tau, clock.name)
    return {state: settle(value.subs(clock.t, clock.to_t)) for state, value in solution.items()}


def solves(system: System, solution: Mapping[sp.Symbol, sp.Expr], clock: Clock | None = None) -> bool:
    """Whether exact algebra shows that ``solution`` satisfies the system's equations; False says "not shown".

    It is about every interval of time on which the solution is defined and real, and says nothing about initial
    values. With the clock in whose time t it runs, only t₀ ≤ t < t₀ + horizon counts, and there the solution is shown
    to be continuously differentiable.

    Raises
    ------
    InputError
        If a state has no solution, a solution contains a state, or the clock is one of another time.
    """
    if missing := [state.name for state in system.state if state not in solution]:
        raise InputError(f"{system.name}: no solution is given for {', '.join(missing)}")
    values = {state: sp.sympify(solution[state]) for state in system.state}
    for state, value in values.items():
        if value.free_symbols & set(system.state):
            raise InputError(
                f"{system.name}: the solution {state} = {value} contains a state; name its start otherwise"
            )
    if clock is not None and clock.t != system.time:
        raise InputError(f"{system.name}: runs in {system.time}, but {clock.name} in {clock.t}")
    if clock is None:
        view, moves = (lambda entry: entry), (lambda value: moves_smoothly(value, [system.time]))
    else:
        view, moves = clock.on_interval, clock.is_smooth_on_interval
    return all(map(moves, values.values())) and all(
        vanishes(view(sp.diff(values[state], system.time) - rate.subs(values, simultaneous=True)))
        for state, rate in zip(system.state, system.rhs, strict=True)
    )
