"""Solutions carried through a change of time, and checked against their system."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from ptproof.errors import InputError
from ptproof.proof.signs import vanishes
from ptproof.system import System
from ptproof.transforms.clocks.algebra import settle
from ptproof.transforms.clocks.clock import Clock


def carry_solution(solution: Mapping[sp.Symbol, sp.Expr], clock: Clock) -> dict[sp.Symbol, sp.Expr]:
    """A solution of a dilated system, in τ, as one of the system in t: x(t) = x̂(a(t)), state by state.

    A bound in τ is carried in the same way.

    >>> from ptproof.transforms.clocks.named import logarithmic_clock
    >>> t, tau, x = sp.symbols("t tau x", real=True); T, k = sp.symbols("T k", positive=True)
    >>> carry_solution({x: sp.exp(-k * tau)}, logarithmic_clock(t, tau, start=0, horizon=T))
    {x: ((T - t)/T)**(T*k)}
    """
    return {state: _as_power(settle(value.subs(clock.tau, clock.to_tau))) for state, value in solution.items()}


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
    """A solution in t as one of the dilated system: x̂(τ) = x(a⁻¹(τ))."""
    return {state: settle(value.subs(clock.t, clock.to_t)) for state, value in solution.items()}


def solves(system: System, solution: Mapping[sp.Symbol, sp.Expr], clock: Clock | None = None) -> bool:
    """Whether exact algebra shows that ``solution`` satisfies the system's equations; False says "not shown".

    With the clock in whose time t it runs, only t₀ ≤ t < t₀ + horizon counts.

    Raises
    ------
    InputError
        If a state has no solution.
    """
    if missing := [state.name for state in system.state if state not in solution]:
        raise InputError(f"{system.name}: no solution is given for {', '.join(missing)}")
    view = clock.on_interval if clock is not None else (lambda entry: entry)
    return all(
        vanishes(view(sp.diff(solution[state], system.time) - rate.subs(dict(solution), simultaneous=True)))
        for state, rate in zip(system.state, system.rhs, strict=True)
    )
